//! How exact `reflector_cubemap.wesl` and its twin are, that they agree, and when maps are made anew.

use catoptric_scene::{Scene, Shape, View};
use glam::{DVec2, DVec3, Vec2};

use super::twin::{CubemapStep, CubemapWalk};
use super::{InMaps, ReflectorCubemap, Settings};
use crate::gpu::{Gpu, storage_bytes};
use crate::search::{Context, Instrumentation, Search};
use crate::stage::points::{Found, Points, points_layout};
use crate::stage::twin::vertices;
use crate::stage::variant::Variant;
use crate::testing::{Searched, assert_layout, gpu_or_skip, scene, stage};
use crate::{Support, parse, supports};

/// The search of a technique on a scene's first mirror.
fn walk(scene: &Scene, technique: &str) -> CubemapWalk {
    CubemapWalk::new(parse(technique).expect("a technique").options(), scene, 0)
}

fn unseen(_: CubemapStep) {}

/// The digits of `index` behind the point, in reverse: evenly spread in [0, 1).
fn spread(mut index: u32, base: u32) -> f64 {
    let (mut sum, mut unit) = (0.0, 1.0);
    while index > 0 {
        unit /= f64::from(base);
        sum += unit * f64::from(index % base);
        index /= base;
    }
    sum
}

/// Vertices whose reflection is seen at a known place: out from the mirror along reflected eye
/// rays, as far as 0.05 to 8 (evenly in the logarithm).
fn known(scene: &Scene, view: &View) -> Vec<(DVec3, DVec2)> {
    let shape = &scene.mirrors[0].shape;
    let size = DVec2::new(f64::from(view.size[0]), f64::from(view.size[1]));
    let vertex = |index| {
        let at = DVec2::new(spread(index, 2), spread(index, 3)) * size;
        let ray = view.ray(at);
        let hit = shape.intersect(view.eye, ray, 0.0)?;
        let distance = (0.05_f64.ln() + 160.0_f64.ln() * spread(index, 5)).exp();
        Some((hit.position + distance * ray.reflect(hit.normal), at))
    };
    (1..3000).filter_map(vertex).collect()
}

/// Distances in pixels between the places found and the true ones, ascending.
fn offsets(name: &str, technique: &str) -> Vec<f64> {
    let scene = scene(name);
    let view = scene.camera.view([512, 512]);
    let walk = walk(&scene, technique);
    let offset = |(vertex, truth): (DVec3, DVec2)| {
        let found = walk.search(vertex.as_vec3(), unseen);
        let at = view.project(found.position.as_dvec3());
        at.map_or(f64::INFINITY, |(at, _)| at.distance(truth))
    };
    let mut offsets: Vec<_> = known(&scene, &view).into_iter().map(offset).collect();
    offsets.sort_by(f64::total_cmp);
    offsets
}

#[test]
fn the_error_falls_with_the_iterations() {
    // Medians after 3, 5, 7, 9 iterations that a prototype in f64 reached from the point that
    // faces the eye.
    for (name, medians) in [
        ("prototype-sphere", [10.0, 2.7, 0.74, 0.21]),
        ("prototype-ellipsoid", [16.0, 5.7, 2.2, 0.82]),
    ] {
        for (iterations, median) in [3, 5, 7, 9].into_iter().zip(medians) {
            for hidden in ["drop", "extend"] {
                let technique =
                    format!("reflector-cubemap(iterations={iterations},hidden={hidden})");
                let offsets = offsets(name, &technique);
                assert!(offsets.len() > 700, "{} vertices", offsets.len());
                let found = offsets[offsets.len() / 2];
                assert!(found <= median, "{name} {technique}: {found} > {median}");
            }
        }
    }
}

/// Distances in pixels between the places found and the true ones of vertices that are `near` off the
/// mirror, ascending.
fn offsets_near(name: &str, technique: &str, near: f64) -> Vec<f64> {
    let scene = scene(name);
    let view = scene.camera.view([512, 512]);
    let walk = walk(&scene, technique);
    let shape = &scene.mirrors[0].shape;
    let offset = |index| {
        let at = DVec2::new(spread(index, 2), spread(index, 3)) * 512.0;
        let ray = view.ray(at);
        let hit = shape.intersect(view.eye, ray, 0.0)?;
        let vertex = hit.position + near * ray.reflect(hit.normal);
        let found = walk.search(vertex.as_vec3(), unseen).position;
        let (found, _) = view.project(found.as_dvec3())?;
        Some(found.distance(at))
    };
    let mut offsets: Vec<_> = (1..3000).filter_map(offset).collect();
    offsets.sort_by(f64::total_cmp);
    offsets
}

#[test]
fn vertices_near_the_mirror_are_found() {
    // A step as long as for far vertices overshoots ever more the nearer a vertex is.
    for near in [0.3, 0.1, 0.03, 0.01, 0.003] {
        let technique = "reflector-cubemap(iterations=15)";
        let offsets = offsets_near("prototype-sphere", technique, near);
        let [p50, p95] = [0.5, 0.95].map(|share| offsets[(offsets.len() as f64 * share) as usize]);
        println!("{near}: {p50} {p95}");
        assert!(offsets.len() > 700 && p50 < 0.05, "{near}: {p50}, {p95}");
    }
    let fixed = offsets_near("prototype-sphere", "reflector-cubemap(step=0.5)", 0.01);
    assert!(fixed[fixed.len() / 2] > 5.0, "what a fixed step is off by");
}

#[test]
fn many_iterations_are_exact() {
    // The bilinear maps of 256 texels an edge are off by the sagitta of a texel, 8e-6 of the
    // radius or 0.002 pixels; what remains is the slow end of grazing vertices.
    const P95: f64 = 0.02;
    for name in ["prototype-sphere", "prototype-ellipsoid"] {
        let offsets = offsets(name, "reflector-cubemap(iterations=40,hidden=extend)");
        let p95 = offsets[offsets.len() * 95 / 100];
        assert!(p95 < P95, "{name}: {p95}");
    }
}

#[test]
fn the_published_projection_ends_at_the_same_points() {
    // Both fields vanish where bisector and normal are one. On an ellipsoid the rays along them meet
    // the face elsewhere than the ray through the point reached: the ways between are too long here
    // and too short there, and grazing vertices need more steps.
    let technique = "reflector-cubemap(iterations=60,projection=published)";
    for (name, limits) in [
        ("prototype-sphere", [0.005, 0.01]),
        ("prototype-ellipsoid", [0.005, 0.1]),
    ] {
        let offsets = offsets(name, technique);
        let found = [0.5, 0.95].map(|share| offsets[(offsets.len() as f64 * share) as usize]);
        assert!(
            found[0] < limits[0] && found[1] < limits[1],
            "{name}: {found:?}"
        );
    }
}

#[test]
fn maps_of_a_coarse_mesh_move_the_points() {
    let median = |tessellation: u32| {
        let technique = format!("reflector-cubemap(iterations=40,tessellation={tessellation})");
        let offsets = offsets("prototype-sphere", &technique);
        offsets[offsets.len() / 2]
    };
    // With the square of a segment.
    let [coarse, fine] = [32, 128].map(median);
    assert!(coarse > 8.0 * fine && fine < 0.5, "{coarse} {fine}");
}

#[test]
fn in_a_bowl_the_inverted_images_are_found() {
    // Sagittal rays of a mirror of radius R meet last: 1/a + 1/b = 2 cos i / R. With the eye at least
    // 4.6 away and R = 1.5, b < 3 up to 65 degrees of incidence, more than are seen here: what is
    // farther is seen inverted.
    const BEYOND_FOCUS: f64 = 3.0;
    const SHARE: f64 = 0.95;
    let scene = scene("prototype-bowl");
    let view = scene.camera.view([512, 512]);
    let walk = walk(&scene, "reflector-cubemap(iterations=40)");
    let shape = &scene.mirrors[0].shape;
    let gap = |(vertex, at): (DVec3, DVec2)| {
        let hit = shape.intersect(view.eye, view.ray(at), 0.0)?;
        let (found, _) = view.project(walk.search(vertex.as_vec3(), unseen).position.as_dvec3())?;
        (vertex.distance(hit.position) > BEYOND_FOCUS).then(|| found.distance(at))
    };
    let gaps: Vec<_> = known(&scene, &view).into_iter().filter_map(gap).collect();
    let exact = gaps.iter().filter(|gap| **gap < 0.1).count() as f64 / gaps.len() as f64;
    assert!(
        gaps.len() > 200 && exact > SHARE,
        "{exact} of {}",
        gaps.len()
    );
}

/// Vertices seen in the bowl at a known place, with the number of focal points of the reflected beam
/// before each: sagittal rays meet where 1/a + 1/b = 2 cos i / R, tangential ones where it is 2 / (R cos i).
fn known_in_the_bowl(scene: &Scene, view: &View) -> Vec<(DVec3, DVec2, usize)> {
    let Shape::Bowl(bowl) = &scene.mirrors[0].shape else {
        panic!("a bowl")
    };
    let class = |(vertex, at): (DVec3, DVec2)| {
        let hit = scene.mirrors[0]
            .shape
            .intersect(view.eye, view.ray(at), 0.0)?;
        let (way, eye) = (vertex - hit.position, view.eye - hit.position);
        let cosine = hit.normal.dot(eye.normalize());
        // Not the back, and nothing that the bowl itself hides.
        let again = scene.mirrors[0]
            .shape
            .intersect(hit.position, way.normalize(), 1e-9);
        if cosine <= 0.0 || again.is_some_and(|again| again.t < way.length()) {
            return None;
        }
        let before = |bend: f64| {
            let focus = 1.0 / (2.0 * bend / bowl.radius - 1.0 / eye.length());
            usize::from(focus > 0.0 && focus < way.length())
        };
        Some((vertex, at, before(cosine) + before(1.0 / cosine)))
    };
    known(scene, view).into_iter().filter_map(class).collect()
}

/// Shares of the known points in the bowl that a technique finds to 0.75 px, by the number of focal
/// points before the vertex, and of all.
fn recall_in_the_bowl(gpu: &Gpu, technique: &str) -> [f64; 4] {
    let scene = scene("prototype-bowl");
    let size = [512, 512];
    let searched = Searched::new(gpu, &scene, technique, size);
    let known = known_in_the_bowl(&scene, &scene.camera.view(size));
    let four = |vertex: &DVec3| vertex.as_vec3().extend(1.0).to_array();
    let positions: Vec<_> = known.iter().map(|(vertex, ..)| four(vertex)).collect();
    let positions = storage_bytes(gpu, bytemuck::cast_slice(&positions));
    let count = known.len() as u32;
    let mut found = vec![[false; 3]; known.len()];
    for sheet in &searched.sheets {
        let points = Points::new(gpu, &points_layout(gpu), &positions, count);
        gpu.run(|frame| {
            let (stage, variant) = (&searched.stage, Variant::Color);
            (searched.search).record_search(frame, stage, *sheet, &points, variant);
        });
        for ((found, answer), (_, at, _)) in found
            .iter_mut()
            .zip(points.read_found(gpu, count))
            .zip(&known)
        {
            let near = answer.at.as_dvec2().distance(*at) < 0.75;
            found[sheet.number] = near && answer.state != Found::FAILED;
        }
    }
    let share = |wanted: Option<usize>| {
        let pairs = known.iter().zip(&found);
        let of_class: Vec<_> = pairs
            .filter(|((.., class), _)| wanted.is_none_or(|wanted| wanted == *class))
            .collect();
        assert!(of_class.len() > 50, "{wanted:?}: {}", of_class.len());
        let hits = of_class.iter().filter(|(_, found)| found.contains(&true));
        hits.count() as f64 / of_class.len() as f64
    };
    [share(Some(0)), share(Some(1)), share(Some(2)), share(None)]
}

#[test]
fn on_each_sheet_of_a_bowl_its_images_are_found() {
    let Some(gpu) = gpu_or_skip() else { return };
    let recall = |sheets: &str, iterations: u32| {
        let technique = format!("reflector-cubemap(iterations={iterations},sheets={sheets})");
        let recall = recall_in_the_bowl(&gpu, &technique);
        println!("{technique}: {recall:.3?}");
        recall
    };
    // As published, the inverted images alone.
    let [upright, between, inverted, _] = recall("first", 40);
    assert!(upright < 0.02 && between < 0.02 && inverted > 0.99);
    let [upright, between, inverted, all] = recall("extrema", 40);
    assert!(upright > 0.98 && between < 0.02 && inverted > 0.99 && all > 0.85);
    let [upright, between, inverted, all] = recall("all", 40);
    assert!(upright > 0.98 && between > 0.98 && inverted > 0.99 && all > 0.985);
}

#[test]
fn vertices_beyond_the_rim_are_unreflected() {
    // Outside the cone from the centre through the rim nothing of a small bowl is in view of what lies
    // beside it; and all that is reflected in view is in the cap.
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("prototype-bowl");
    let states = |scene: &Scene| {
        let searched = Searched::new(&gpu, scene, "reflector-cubemap(iterations=40)", [128, 128]);
        let count = searched.stage.world.vertices();
        let found = searched.batches[0].read_found(&gpu, count);
        let Shape::Bowl(bowl) = &scene.mirrors[0].shape else {
            panic!("a bowl")
        };
        for answer in &found {
            let direction = (answer.position.as_dvec3() - bowl.center).normalize();
            let angle = direction.angle_between(bowl.axis);
            // A texel is 0.4 degrees wide at most.
            if answer.state == Found::UNREFLECTED {
                assert!(angle > bowl.half_angle - 0.01, "{angle}");
            } else if answer.state == Found::FOUND {
                assert!(angle < bowl.half_angle + 0.01, "{angle}");
            }
        }
        let beyond = found
            .iter()
            .filter(|answer| answer.state == Found::UNREFLECTED);
        beyond.count()
    };
    let whole = states(&scene);
    let Shape::Bowl(bowl) = &mut scene.mirrors[0].shape else {
        panic!("a bowl")
    };
    bowl.half_angle /= 2.0;
    let cut = states(&scene);
    assert!(cut > whole + 100, "{whole} {cut}");
}

#[test]
fn hidden_vertices_are_continued_to_where_they_are() {
    // The image of a hidden vertex in the tangent plane under its line of sight is on the
    // reflected ray there: R is where the line meets the mirror, V' is V itself.
    const P95: f64 = 0.1;
    let scene = scene("prototype-ellipsoid");
    let view = scene.camera.view([512, 512]);
    let walk = walk(&scene, "reflector-cubemap(iterations=40,hidden=extend)");
    let gap = |index| {
        let at = DVec2::new(spread(index, 2), spread(index, 3)) * 512.0;
        let ray = view.ray(at);
        let hit = scene.mirrors[0].shape.intersect(view.eye, ray, 0.0)?;
        let behind = (0.05_f64.ln() + 160.0_f64.ln() * spread(index, 5)).exp();
        let found = walk.search((hit.position + behind * ray).as_vec3(), unseen);
        let (found, _) = view.project(found.position.as_dvec3())?;
        Some(found.distance(at))
    };
    let mut gaps: Vec<_> = (1..3000).filter_map(gap).collect();
    gaps.sort_by(f64::total_cmp);
    let p95 = gaps[gaps.len() * 95 / 100];
    assert!(gaps.len() > 500 && p95 < P95, "{p95} of {}", gaps.len());
}

#[test]
fn gpu_finds_the_same_points() {
    // GPU and twin round alike but for fused products and roots. Steps that are too long for a
    // vertex near the mirror amplify that, about tenfold each at a twentieth of the radius,
    // until they are shortened: after two steps it is still small, after many it is gone.
    const NEAR: f32 = 0.02;
    const SHARE: f64 = 0.99;
    for (name, technique) in [
        ("prototype-sphere", "reflector-cubemap(iterations=2)"),
        ("prototype-sphere", "reflector-cubemap(iterations=60)"),
        (
            "prototype-ellipsoid",
            "reflector-cubemap(iterations=2,start=eye,size=64)",
        ),
        (
            "prototype-ellipsoid",
            "reflector-cubemap(iterations=2,projection=published,tessellation=96)",
        ),
        (
            "sphere-touching",
            "reflector-cubemap(iterations=2,hidden=extend)",
        ),
        (
            "prototype-bowl",
            "reflector-cubemap(iterations=2,hidden=extend)",
        ),
        (
            "prototype-bowl",
            "reflector-cubemap(iterations=60,sheets=extrema)",
        ),
    ] {
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene(name);
        let size = [160, 120];
        let searched = Searched::new(&gpu, &scene, technique, size);
        let positions = vertices(&searched.stage);
        let count = positions.len() as u32;
        let found = searched.batches[0].read_found(&gpu, count);
        let efforts = searched.batches[0].read_efforts(&gpu, count);
        let view = scene.camera.view(size);
        let walk = walk(&scene, technique);
        // Where a walk ends that does not arrive is nothing to agree on.
        let pairs = found.iter().zip(&efforts).zip(&positions);
        let same = pairs.filter(|((found, effort), vertex)| {
            let answer = walk.search(**vertex, unseen);
            let at = view.project(answer.position.as_dvec3());
            let at = at.map_or(Vec2::NAN, |(at, _)| at.as_vec2());
            let state = match answer {
                _ if answer.failed => Found::FAILED,
                _ if answer.hidden => Found::HIDDEN,
                _ if answer.unreflected => Found::UNREFLECTED,
                _ => Found::FOUND,
            };
            let first = 1 + 2 * u32::from(walk.looks_along_the_line_of_sight());
            assert_eq!(effort.evaluations, 2 * effort.steps + first);
            (state == Found::FAILED || at.distance(found.at) < NEAR) && state == found.state
        });
        let same = same.count();
        let share = same as f64 / positions.len() as f64;
        assert!(
            positions.len() > 500,
            "{name}: {} vertices",
            positions.len()
        );
        assert!(share >= SHARE, "{name} {technique}: {share}");
    }
}

#[test]
fn the_settings_lie_as_the_shader_reads_them() {
    assert_layout!(
        Settings {
            size,
            iterations,
            first_step,
            shrink,
            grow,
            different,
            similar,
            least,
            greatest,
            from_eye,
            facing,
            sense,
            image,
            accept,
            offset
        },
        "reflector_cubemap",
        &[],
        "Settings"
    );
}

#[test]
fn maps_are_made_again_for_a_mirror_that_moves_and_only_then() {
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let mut scene = scene("spheres");
    let spec = parse("reflector-cubemap(size=16)").expect("a technique");
    let mut stage = stage(&gpu, &scene, [32, 24]);
    let (options, _): (ReflectorCubemap, _) = spec.options().of().expect("its own");
    let context = Context {
        gpu: &gpu,
        stage: &stage,
        extends: false,
        points_layout: &points_layout(&gpu),
        instrumentation: Instrumentation::Efforts,
    };
    let mut search = InMaps::new(&options, &context).expect("can be made");
    let mirrors = scene.mirrors.len() as u32;
    assert_eq!(search.builds, mirrors);
    let mut builds_after = |scene: &Scene| {
        stage.world.update(&gpu, scene).expect("the same scene");
        search.update(&gpu, &stage);
        search.builds - mirrors
    };
    scene.camera.eye += DVec3::new(0.1, 0.2, 0.0);
    scene.objects[0].mesh.positions[0] += 0.5;
    assert_eq!(builds_after(&scene), 0, "eye and objects");
    let Shape::Sphere(sphere) = &mut scene.mirrors[0].shape else {
        panic!("a sphere")
    };
    sphere.center.x += 0.1;
    assert_eq!(builds_after(&scene), 1, "moved");
    let Shape::Sphere(sphere) = &mut scene.mirrors[0].shape else {
        panic!("a sphere")
    };
    sphere.radius *= 1.01;
    assert_eq!(builds_after(&scene), 2, "deformed");
    assert_eq!(builds_after(&scene), 2, "at rest");
}

#[test]
fn scenes_with_mirrors_that_no_closed_shape_stands_for_are_refused_by_name() {
    let spec = parse("reflector-cubemap").expect("a technique");
    let why = |name: &str| match supports(&spec, &scene(name)) {
        Support::Yes => None,
        Support::No(why) => Some(why),
    };
    assert_eq!(why("spheres"), None);
    assert_eq!(why("ellipsoid"), None);
    assert_eq!(why("bowl"), None);
    assert!(why("planar").is_some_and(|why| why.contains("open")));
    assert!(why("torus").is_some_and(|why| why.contains("whole")));
}

use catoptric_scene::{CameraPath, Material, Mesh, Motion, Move, Paint, Random, Scene, Subject};
use glam::{DVec2, DVec3, Vec3};

use super::geometry::Placing;
use super::paths::Bounce;
use super::settings::Settings;
use super::tally::Tally;
use super::twin;
use super::*;
use crate::testing::{assert_layout, gpu_or_skip, scene, stage};
use crate::{parse, prepare};

const SIZE: [u32; 2] = [96, 72];

/// Ids of the objects that the mirrors show, 0 elsewhere.
fn ids(gpu: &Gpu, scene: &Scene, technique: &str) -> Vec<u32> {
    let spec = parse(technique).expect("a technique");
    let mut prepared = prepare(gpu, &spec, scene, SIZE).expect("fits");
    let output = prepared.render().expect("renders");
    output
        .frame
        .reflected
        .expect("all layers")
        .id
        .pixels()
        .to_vec()
}

/// Pixels that `beams` and `ray-trace` show another object at.
fn unlike(gpu: &Gpu, scene: &Scene, technique: &str) -> usize {
    let [traced, ours] = ["ray-trace", technique].map(|technique| ids(gpu, scene, technique));
    assert!(traced.iter().any(|id| *id > 0), "something is reflected");
    traced.iter().zip(&ours).filter(|(a, b)| a != b).count()
}

/// What is drawn of a scene, with lists of at most `room` bytes, and what is counted.
fn drawn(
    gpu: &Gpu,
    scene: &Scene,
    room: u64,
    reflections: u32,
) -> (Vec<[f32; 4]>, Tally, usize, Stage) {
    let stage = stage(gpu, scene, SIZE);
    let wanted = Wanted {
        tile: Tile::Two,
        room,
        reflections,
    };
    let beams = Ready::new(gpu, &stage, wanted).expect("fits");
    gpu.run(|frame| {
        stage.begin(frame, Variant::AllLayers);
        beams.record(frame, &stage, Variant::AllLayers);
    });
    let position = gpu.read_texture(&stage.reflections.position);
    (
        position,
        beams.lists.tally(gpu),
        beams.lists.slices(),
        stage,
    )
}

/// `sphere-square` with other triangles.
fn with_triangles(triangles: &[[Vec3; 3]]) -> Scene {
    let mut scene = scene("sphere-square");
    scene.objects[0].mesh = Mesh {
        positions: triangles.as_flattened().to_vec(),
        triangles: (0..triangles.len() as u32)
            .map(|index| [0, 1, 2].map(|corner| 3 * index + corner))
            .collect(),
        material: vec![0; triangles.len()],
        materials: vec![Material {
            name: "grey".to_owned(),
            paint: Paint::Color(Vec3::splat(0.5)),
        }],
        ..Mesh::default()
    };
    scene
}

/// A point whose components lie between −1 and 1.
fn anywhere(random: &mut Random) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| 2.0 * random.unit() as f32 - 1.0))
}

/// Triangles of a size around a point.
fn triangle(random: &mut Random, center: Vec3, size: f32) -> [Vec3; 3] {
    [(); 3].map(|()| center + size * anywhere(random))
}

#[test]
fn every_pixel_sees_what_the_ray_tracer_sees() {
    let Some(gpu) = gpu_or_skip() else { return };
    for name in ["sphere-table", "bowl", "kitchen", "faceted"] {
        for technique in ["beams", "beams(tile=4)", "beams(tile=8)"] {
            assert_eq!(
                unlike(&gpu, &scene(name), technique),
                0,
                "{name} {technique}"
            );
        }
    }
    for name in ["spheres", "torus"] {
        let [traced, ours] = ["ray-trace(gbuffer=mesh)", "beams(gbuffer=mesh)"]
            .map(|technique| ids(&gpu, &scene(name), technique));
        assert_eq!(traced, ours, "{name}");
    }
}

#[test]
fn the_traversal_takes_what_its_twin_takes() {
    let Some(gpu) = gpu_or_skip() else { return };
    for name in ["sphere-table", "bowl", "spheres"] {
        let (_, counted, _, stage) = drawn(&gpu, &scene(name), lists::ROOM, 1);
        let expected = twin::tally(&gpu, &stage);
        let pairs = [
            (counted.cluster_tests, expected.cluster_tests),
            (counted.triangle_tests, expected.triangle_tests),
            (counted.pairs, expected.pairs),
            (counted.exact, expected.exact),
        ];
        println!("{name}: {pairs:?}");
        for (counted, expected) in pairs {
            // A device may fuse a product and a sum: of thousands of tests one goes the other way.
            let apart = counted.abs_diff(expected) as f64 / expected as f64;
            assert!(
                expected > 1000 && apart < 1e-3,
                "{name}: {counted}, not {expected}"
            );
        }
    }
}

#[test]
fn clusters_that_are_sent_down_in_slices_give_the_same_picture() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("spheres");
    let took = |tally: &Tally| {
        (
            tally.cluster_tests,
            tally.triangle_tests,
            tally.pairs,
            tally.exact,
        )
    };
    for reflections in [1, 3] {
        let (whole, counted, slices, _) = drawn(&gpu, &scene, lists::ROOM, reflections);
        assert_eq!(slices, 1);
        // 16 nodes of 32 × 32 pixels with room for 50 clusters each.
        let (sliced, again, slices, _) = drawn(&gpu, &scene, 16 * 50 * 4, reflections);
        assert_eq!(slices, 8);
        assert!(whole == sliced);
        assert_eq!(took(&counted), took(&again));
    }
}

#[test]
fn paths_go_on_as_far_as_they_are_asked_to() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("facing");
    let longest = |technique: &str| {
        let spec = parse(technique).expect("a technique");
        let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits");
        let reflected = prepared.render().expect("renders").frame.reflected;
        let bounces = reflected.expect("all layers").bounces;
        bounces.map(|bounces| bounces.pixels().iter().max().copied())
    };
    assert_eq!(longest("beams"), None);
    for bounces in [2, 3, 5] {
        let technique = format!("beams(bounces={bounces})");
        assert_eq!(longest(&technique), Some(Some(bounces)));
    }
}

#[test]
fn moved_mirrors_are_seen_in_mirrors_where_they_are() {
    let Some(gpu) = gpu_or_skip() else { return };
    for name in ["facing", "spheres", "room"] {
        let mut scene = scene(name);
        let moves = (0..scene.mirrors.len()).map(|index| Move {
            subject: Subject::Mirror(index),
            rotate_deg: DVec3::new(0.0, 2.0, 0.0),
            about: DVec3::ZERO,
            translate: DVec3::new(0.05, 0.02, 0.01),
        });
        scene.motion = Some(Motion {
            frames: 2,
            growth: 1.0,
            camera: CameraPath::Still,
            moves: moves.collect(),
        });
        let moved = scene.at(1);
        let technique = "beams(bounces=3)";
        let spec = parse(technique).expect("a technique");
        let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits");
        let before = prepared.render().expect("renders").frame.reflected;
        prepared.update(&moved).expect("the same scene");
        let after = prepared.render().expect("renders").frame.reflected;
        let [before, after] = [before, after].map(|layers| layers.expect("all layers").id);
        assert_ne!(before.pixels(), after.pixels(), "{name}");
        assert_eq!(ids(&gpu, &moved, technique), after.pixels(), "{name}");
    }
}

#[test]
fn moving_frames_are_as_exact_and_take_no_more_memory() {
    let Some(gpu) = gpu_or_skip() else { return };
    for name in ["ellipsoid", "sphere-objects-1k", "sphere-square"] {
        let scene = scene(name);
        let frames = scene.motion.as_ref().expect("it moves").frames;
        let ready = |technique: &str| {
            let spec = parse(technique).expect("a technique");
            prepare(&gpu, &spec, &scene, SIZE).expect("fits")
        };
        let mut both = ["ray-trace", "beams"].map(ready);
        let mut bytes = Vec::new();
        for frame in [0, frames / 2, frames - 1] {
            let [traced, ours] = both.each_mut().map(|prepared| {
                prepared.update(&scene.at(frame)).expect("the same scene");
                let output = prepared.render().expect("renders");
                let reflected = output.frame.reflected.expect("all layers");
                (reflected.id.pixels().to_vec(), output.work.bytes)
            });
            assert_eq!(traced.0, ours.0, "{name}, frame {frame}");
            bytes.extend(ours.1);
        }
        assert!(bytes.len() == 3 && bytes.iter().all(|other| *other == bytes[0]));
    }
}

/// Sends triangles down over so many frames, in each a little elsewhere: no frame makes a buffer or a
/// texture, and the last is exact.
fn exact_after_frames(gpu: &Gpu, frames: u32, triangles: &[[Vec3; 3]]) {
    let mut scene = with_triangles(triangles);
    let spec = parse("beams").expect("a technique");
    let mut prepared = prepare(gpu, &spec, &scene, SIZE).expect("fits");
    for frame in 0..frames {
        for position in &mut scene.objects[0].mesh.positions {
            *position += Vec3::new(1e-4, 0.0, 0.0);
        }
        prepared.update(&scene).expect("the same scene");
        prepared.time_frame().expect("renders");
        assert_eq!(gpu.made(), 0, "frame {frame}");
    }
    let output = prepared.render().expect("renders");
    let reflected = output.frame.reflected.expect("all layers");
    let traced = ids(gpu, &scene, "ray-trace");
    assert!(traced.iter().any(|id| *id > 0), "something is reflected");
    assert_eq!(traced, reflected.id.pixels());
}

#[test]
fn all_triangles_in_one_tile_are_met() {
    let Some(gpu) = gpu_or_skip() else { return };
    let plain = scene("sphere-square");
    let view = plain.camera.view(SIZE);
    let direction = view.ray(DVec2::new(50.5, 30.5));
    let hit = plain.mirrors[0]
        .shape
        .intersect(view.eye, direction, 0.0)
        .expect("the ball");
    let reflected = direction.reflect(hit.normal);
    let mut random = Random::new(1);
    let triangles: Vec<_> = (0..30_000)
        .map(|_| {
            let t = 0.5 + random.unit();
            triangle(&mut random, (hit.position + t * reflected).as_vec3(), 2e-3)
        })
        .collect();
    exact_after_frames(&gpu, 20, &triangles);
}

#[test]
fn triangles_that_all_span_the_mirror_are_met() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut random = Random::new(2);
    let triangles: Vec<_> = (0..1000)
        .map(|_| triangle(&mut random, Vec3::new(0.0, -3.0, 3.0), 1.0))
        .map(|corners| corners.map(|corner| 20.0 * corner))
        .collect();
    exact_after_frames(&gpu, 20, &triangles);
}

#[test]
fn of_triangles_of_two_objects_that_coincide_the_first_is_seen_until_they_part() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut random = Random::new(4);
    let center = Vec3::new(0.0, -1.5, 1.5);
    let triangles: Vec<_> = (0..300)
        .map(|_| triangle(&mut random, center, 1.0))
        .collect();
    let mut scene = with_triangles(&triangles);
    let mut second = scene.objects[0].clone();
    for corners in &mut second.mesh.triangles {
        corners.rotate_left(1);
    }
    scene.objects.push(second);
    let mut parted = scene.clone();
    for position in &mut parted.objects[0].mesh.positions {
        *position += Vec3::new(0.0, -20.0, 0.0);
    }
    let spec = parse("beams").expect("a technique");
    let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits");
    for (scene, seen) in [(&scene, 1), (&parted, 2), (&scene, 1)] {
        prepared.update(scene).expect("the same scene");
        let output = prepared.render().expect("renders");
        let reflected = output.frame.reflected.expect("all layers");
        let count = |id: u32| {
            reflected
                .id
                .pixels()
                .iter()
                .filter(|other| **other == id)
                .count()
        };
        assert!(
            count(seen) > 200 && count(3 - seen) < 50,
            "{} and {}",
            count(1),
            count(2)
        );
        assert_eq!(ids(&gpu, scene, "ray-trace"), reflected.id.pixels());
    }
}

#[test]
fn a_million_triangles_are_met() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut random = Random::new(3);
    let triangles: Vec<_> = (0..1_000_000)
        .map(|_| {
            let center = 3.0 * anywhere(&mut random) + Vec3::new(0.0, -1.0, 5.0);
            triangle(&mut random, center, 0.01)
        })
        .collect();
    exact_after_frames(&gpu, 4, &triangles);
}

#[test]
fn nothing_to_reflect_and_no_mirror_in_view_are_pictures() {
    let Some(gpu) = gpu_or_skip() else { return };
    let empty = scene("prototype-sphere");
    assert!(ids(&gpu, &empty, "beams").iter().all(|id| *id == 0));
    let mut away = scene("sphere-square");
    away.camera.target = away.camera.eye * 2.0;
    assert!(ids(&gpu, &away, "beams").iter().all(|id| *id == 0));
    // Points are no triangles that a ray meets.
    let points = with_triangles(&[[Vec3::new(0.0, -1.0, 1.6); 3]; 40]);
    assert!(ids(&gpu, &points, "beams").iter().all(|id| *id == 0));
}

#[test]
fn the_settings_lie_as_the_shaders_read_them() {
    assert_layout!(
        Settings {
            wider,
            tiles,
            triangles,
            first_cluster,
            cluster_count,
            room,
            is_first,
            mirror_triangles,
            touching
        },
        "beams/tiles",
        &[],
        "Settings"
    );
    assert_layout!(
        Bounce {
            last,
            mirrors,
            touching
        },
        "beams/bounce",
        &["rays"],
        "Bounce"
    );
    assert_layout!(
        Placing {
            count,
            mirror_triangles,
            stride,
            first
        },
        "beams/refit",
        &[],
        "Placing"
    );
}

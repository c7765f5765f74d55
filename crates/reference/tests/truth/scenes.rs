//! The built-in scenes: they render, and the two halves of this crate agree on them.

use catoptric_frame::Status;
use catoptric_reference::{RenderOptions, Surface, Tracer, Truth, reflection_points, reflections};
use catoptric_scene::{LoadOptions, Scene, list};
use glam::{DVec2, DVec3};

const SIZE: [u32; 2] = [48, 36];

/// Every built-in scene that a clone alone can load, but for the large ones of each family.
fn scenes() -> Vec<Scene> {
    let options = LoadOptions {
        models: None,
        resolution: Some(SIZE),
    };
    list::builtin(&options)
        .into_iter()
        .filter(|info| info.available && info.vertices <= 20_000)
        .filter(|info| !catoptric_scene::builtin::is_single_step(&info.name))
        .map(|info| Scene::load(&info.name, &options).unwrap())
        .collect()
}

#[test]
fn pictures_are_complete() {
    let scenes = scenes();
    assert!(scenes.len() > 10);
    for scene in &scenes {
        let tracer = Tracer::new(scene).unwrap();
        let [first, full] = [Truth::FirstBounce, Truth::Full { bounces: 4 }]
            .map(|truth| tracer.render(&RenderOptions::new(SIZE, truth)));
        assert_eq!(first.primary, full.primary, "{}", scene.name);
        let (primary, reflected) = (first.primary.unwrap(), first.reflected.unwrap());
        let mirrors = scene.objects.len() as u32;
        let mut seen = 0;
        for (id, status) in primary.id.pixels().iter().zip(reflected.status.pixels()) {
            assert_eq!(
                *id > mirrors,
                *status != Status::NotMirror,
                "{}",
                scene.name
            );
            seen += u32::from(*id > mirrors);
        }
        // One family is about mirrors that are small in the picture.
        let fewest = match scene.name.starts_with("sphere-small-") {
            true => 1,
            false => 20,
        };
        assert!(seen >= fewest, "{}: {seen} mirror pixels", scene.name);
        assert!(
            reflected.id.pixels().iter().all(|id| *id <= mirrors),
            "{}",
            scene.name
        );
        assert!(
            first
                .color
                .pixels()
                .iter()
                .all(|color| color.is_finite() && color.min_element() >= 0.0)
        );
    }
}

/// What a traced ray meets after its reflection has a reflection point where it was reflected.
#[test]
fn traced_reflections_are_exact_reflection_points() {
    let mut checked = 0;
    for scene in &scenes() {
        let tracer = Tracer::new(scene).unwrap();
        let view = scene.camera.view(SIZE);
        let mirrors = scene.mirrors.iter();
        let solvers: Vec<_> = mirrors
            .map(|mirror| reflections(&mirror.shape, view.eye).unwrap())
            .collect();
        for index in 0..SIZE[0] * SIZE[1] {
            let at = DVec2::new(f64::from(index % SIZE[0]), f64::from(index / SIZE[0])) + 0.5;
            let trace = tracer.reflect_pixel(&view, at, Truth::FirstBounce);
            let Some((primary, hit)) = trace.primary.zip(trace.reflection.and_then(|r| r.hit))
            else {
                continue;
            };
            let Surface::Mirror { index, .. } = primary.surface else {
                unreachable!()
            };
            let found = solvers[index](hit.position);
            let off = |point: &DVec3| point.distance(primary.position);
            let nearest = found.points.iter().map(off).fold(f64::INFINITY, f64::min);
            // Next to a caustic two solutions meet, and lose half their digits; the stored normals of
            // facets, which rays are reflected at, are rounded to f32.
            let limit = match scene.mirrors[index].shape.is_analytic() {
                true => 1e-7,
                false => 4e-7,
            };
            assert!(
                nearest < limit,
                "{} at {at}: off by {nearest:e}",
                scene.name
            );
            checked += 1;
        }
    }
    assert!(checked > 1000, "{checked}");
}

/// The scene `crack` by the published criterion: error of an edge = (1 − cos δ)/2, δ the angle
/// between the mirror's normal at the middle of the edge's reflection points and the bisector of
/// the directions from there to the eye and to the middle of the edge (Szabo, CESCG 2013, §4.2).
#[test]
fn crack_splits_one_triangle_and_not_its_neighbour() {
    /// The threshold the paper recommends.
    const THRESHOLD: f64 = 1e-3;
    let scene = Scene::load("crack", &LoadOptions::default()).unwrap();
    let (shape, mesh) = (&scene.mirrors[0].shape, &scene.objects[0].mesh);
    let view = scene.camera.view(scene.camera.resolution);
    let reflected = |vertex: DVec3| {
        let found = reflection_points(shape, view.eye, vertex).unwrap();
        found.points[0]
    };
    let corner = |index: u32| mesh.positions[index as usize].as_dvec3();
    let error = |[a, b]: [u32; 2]| {
        let (a, b) = (corner(a), corner(b));
        let middle = (reflected(a) + reflected(b)) / 2.0;
        let towards = |point: DVec3| (point - middle).normalize();
        let bisector = (towards(view.eye) + towards((a + b) / 2.0)).normalize();
        let seen = shape.intersect(view.eye, -towards(view.eye), 0.0).unwrap();
        (1.0 - seen.normal.dot(bisector)) / 2.0
    };
    let [large, small] = [mesh.triangles[0], mesh.triangles[1]];
    let edges = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]];
    let worst = |triangle| edges(triangle).map(error).into_iter().fold(0.0, f64::max);
    assert!(worst(small) < 0.9 * THRESHOLD, "{}", worst(small));
    assert!(worst(large) > 5.0 * THRESHOLD, "{}", worst(large));

    // The shared edge bends into the triangle that is split, away from the other: a gap.
    let [a, b] = edges(large)[0];
    assert!(edges(small).contains(&[b, a]));
    let at = |point: DVec3| view.project(reflected(point)).unwrap().0;
    let [from, to] = [a, b].map(|index| at(corner(index)));
    let middle = at((corner(a) + corner(b)) / 2.0);
    let across = |point: DVec2| (to - from).perp_dot(point - from) / (to - from).length();
    let [inside, outside] = [large[2], small[2]].map(|index| across(at(corner(index))));
    assert!(inside * outside < 0.0 && across(middle) * inside > 0.0);
    assert!(across(middle).abs() > 9.0, "{} pixels wide", across(middle));
}

//! The built-in scenes: they render, and the two halves of this crate agree on them.

use catoptric_frame::Status;
use catoptric_reference::{RenderOptions, Surface, Tracer, Truth, reflection_points};
use catoptric_scene::{LoadOptions, Scene, builtin};
use glam::DVec2;

const SIZE: [u32; 2] = [48, 36];

/// Every built-in scene that a clone alone can load, but for the large ones of each family.
fn scenes() -> Vec<Scene> {
    let options = LoadOptions {
        models: None,
        resolution: Some(SIZE),
    };
    builtin::list(&options)
        .into_iter()
        .filter(|info| info.available && info.vertices <= 20_000)
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
        assert!(seen > 20, "{}: {seen} mirror pixels", scene.name);
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
            let shape = &scene.mirrors[index].shape;
            let Ok(found) = reflection_points(shape, view.eye, hit.position) else {
                assert!(!shape.is_analytic(), "{}: {:?}", scene.name, hit.position);
                continue;
            };
            let off = |point: &glam::DVec3| point.distance(primary.position);
            let nearest = found.points.iter().map(off).fold(f64::INFINITY, f64::min);
            // Next to a caustic two solutions meet, and lose half their digits.
            assert!(nearest < 1e-7, "{} at {at}: off by {nearest:e}", scene.name);
            checked += 1;
        }
    }
    assert!(checked > 1000, "{checked}");
}

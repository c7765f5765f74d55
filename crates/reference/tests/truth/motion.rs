//! Slow camera paths: how far true reflection points move from frame to frame.

use catoptric_reference::true_vertices;
use catoptric_scene::{LoadOptions, Scene};
use glam::DVec2;

/// Mean motion of the true reflection points of the slow paths, in pixels a frame.
const SLOW: f64 = 0.038;

/// The scenes' angles are written to three digits.
const ROUNDING: f64 = 0.002;

/// Mean, over all vertices with a reflection point in two frames running, of the way it moves in
/// the image.
fn mean_motion(scene: &Scene) -> f64 {
    let frames: Vec<Vec<Option<DVec2>>> = (0..scene.frames())
        .map(|frame| {
            let posed = scene.at(frame);
            let view = posed.camera.view(posed.camera.resolution);
            true_vertices(&posed, &view)
                .unwrap()
                .iter()
                .map(|vertex| vertex.points.first()?.1)
                .collect()
        })
        .collect();
    let (mut sum, mut count) = (0.0, 0u32);
    for pair in frames.windows(2) {
        for (before, after) in pair[0].iter().zip(&pair[1]) {
            if let (Some(before), Some(after)) = (before, after) {
                sum += before.distance(*after);
                count += 1;
            }
        }
    }
    sum / f64::from(count)
}

#[test]
fn slow_paths_are_as_slow_as_they_say() {
    for name in [
        "prototype-sphere",
        "prototype-ellipsoid",
        "sphere-square",
        "sphere-objects-1k",
        "ellipsoid",
    ] {
        let scene = Scene::load(name, &LoadOptions::default()).unwrap();
        assert_eq!(scene.frames(), 40, "{name}");
        let motion = mean_motion(&scene);
        assert!(
            (motion / SLOW - 1.0).abs() < ROUNDING,
            "{name}: {motion} pixels a frame"
        );
    }
}

//! How far reflections truly move from frame to frame in the scenes `moving-…`.

use catoptric_frame::TrueVertex;
use catoptric_reference::true_vertices;
use catoptric_scene::{LoadOptions, Scene, builtin};
use glam::DVec2;

/// The shortest step must be about this long at most, and the longest at least, in pixels.
const STEPS_PX: [f64; 2] = [0.05, 15.0];

/// A solution that moved farther is another one of the same vertex.
const SAME_PX: f64 = 60.0;

fn truth(scene: &Scene, frame: u32) -> Vec<TrueVertex> {
    let posed = scene.at(frame);
    let view = posed.camera.view(posed.camera.resolution);
    true_vertices(&posed, &view).expect("exact mirrors")
}

/// Median way in pixels between a frame and the next of the reflections in view; of the moving
/// object's alone where nothing else moves.
fn median_step(scene: &Scene, only: Option<&str>, frame: u32) -> f64 {
    let [width, height] = scene.camera.resolution.map(f64::from);
    let inside = |at: DVec2| at.cmpge(DVec2::ZERO).all() && at.x < width && at.y < height;
    let objects = scene.objects.iter().flat_map(|object| {
        let counts = only.is_none_or(|name| name == object.name);
        std::iter::repeat_n(counts, object.mesh.positions.len())
    });
    let pairs = truth(scene, frame).into_iter().zip(truth(scene, frame + 1));
    let mut ways: Vec<f64> = objects
        .zip(pairs)
        .filter(|(counts, _)| *counts)
        .flat_map(|(_, (before, after))| {
            let after: Vec<DVec2> = after.points.iter().filter_map(|(_, at)| *at).collect();
            let before = before.points.into_iter().filter_map(|(_, at)| at);
            before
                .filter(|at| inside(*at))
                .filter_map(|at| after.iter().map(|to| to.distance(at)).reduce(f64::min))
                .collect::<Vec<_>>()
        })
        .filter(|way| *way < SAME_PX)
        .collect();
    assert!(ways.len() > 100, "{} reflections", ways.len());
    ways.sort_by(f64::total_cmp);
    ways[ways.len() / 2]
}

#[test]
fn steps_grow_from_a_twentieth_of_a_pixel_to_fifteen() {
    let names = builtin::names().into_iter();
    let moving: Vec<_> = names
        .filter(|name| name.starts_with("moving-") && name.split('-').count() == 3)
        .collect();
    assert_eq!(moving.len(), 28);
    let mut wrong = Vec::new();
    for name in moving {
        let scene = Scene::load(&name, &LoadOptions::default()).expect("a built-in scene");
        let only = name.ends_with("-object").then_some("globe");
        let [first, last] = [0, scene.frames() - 2].map(|frame| median_step(&scene, only, frame));
        println!("{name}: {first} {last}");
        if first > STEPS_PX[0]
            || last < STEPS_PX[1]
            || first * 3.0 < STEPS_PX[0]
            || last > 1.5 * STEPS_PX[1]
        {
            wrong.push(format!("{name}: {first} {last}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

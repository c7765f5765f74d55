//! The true motion of reflections: against closed forms, there and back, and where nothing moves.

use catoptric_reference::{Follow, Followed, Seen, Target, reflections};
use catoptric_scene::{LoadOptions, Scene, Shape, builtin};
use glam::{DVec2, DVec3};

use crate::common::Random;

const SIZE: [u32; 2] = [640, 480];

/// Pixels looked at in each pair of frames.
const PIXELS: usize = 1500;

/// What is required, in pixels.
const EXACT_PX: f64 = 1e-6;

/// Where nothing moves.
const STILL_PX: f64 = 1e-9;

/// Pairs of frames: short and long steps.
const PAIRS: [[u32; 2]; 3] = [[1, 0], [8, 7], [11, 10]];

/// Least share of the mirror's pixels of which the motion is known in any of these sequences: in the
/// longest steps many reflections leave the mirror.
const KNOWN: f64 = 0.5;

fn moving() -> impl Iterator<Item = Scene> {
    let names = builtin::names().into_iter();
    // Sequences, not the single steps.
    let moving = names.filter(|name| name.starts_with("moving-") && name.split('-').count() == 3);
    moving.map(|name| Scene::load(&name, &LoadOptions::default()).expect("a built-in scene"))
}

/// Reflections at random places, and where they are at the other frame.
fn followed(scene: &Scene, frames: [u32; 2]) -> (Follow, Vec<(DVec2, Seen, Followed)>, usize) {
    let follow = Follow::new(scene, frames, SIZE).expect("can be traced");
    let mut random = Random::new(7);
    let mut all = Vec::new();
    let mut seen = 0;
    for _ in 0..PIXELS {
        let at = DVec2::new(
            random.between(0.0, f64::from(SIZE[0])),
            random.between(0.0, f64::from(SIZE[1])),
        );
        let Some(here) = follow.seen_at(at) else {
            continue;
        };
        seen += 1;
        if let Ok(there) = follow.follow(&here) {
            all.push((at, here, there));
        }
    }
    (follow, all, seen)
}

/// Where the target is at a frame, or the direction in which it lies.
fn target_at(posed: &Scene, target: &Target) -> Result<DVec3, DVec3> {
    match *target {
        Target::Direction(direction) => Err(direction),
        Target::Point {
            object,
            triangle,
            weights,
        } => {
            let mesh = &posed.objects[object].mesh;
            let corners = mesh.triangles[triangle];
            let [a, b, c] = corners.map(|index| mesh.positions[index as usize].as_dvec3());
            Ok(weights.x * a + weights.y * b + weights.z * c)
        }
    }
}

#[test]
fn forwards_and_backwards_agree() {
    for scene in moving() {
        let (mut worst, mut known, mut all, mut longest) = (0.0_f64, 0, 0, 0.0_f64);
        for frames in PAIRS {
            let (_, found, seen) = followed(&scene, frames);
            let [from, to] = frames;
            let back = Follow::new(&scene, [to, from], SIZE).expect("can be traced");
            for (at, _, there) in &found {
                let here = back.follow(&there.seen).expect("it was seen there");
                worst = worst.max(here.at.distance(*at));
                longest = longest.max(there.at.distance(*at));
            }
            known += found.len();
            all += seen;
        }
        println!(
            "{}: {known} of {all}, {worst:e} px, up to {longest} px",
            scene.name
        );
        assert!(worst < EXACT_PX, "{}: {worst} px", scene.name);
        assert!(
            known as f64 > KNOWN * all as f64,
            "{}: {known} of {all}",
            scene.name
        );
    }
}

/// Of a plane, the picture in a mirrored camera; of all shapes, one of the exact reflection points, which
/// on spheres and ellipsoids is the only one.
#[test]
fn reflections_are_where_the_closed_forms_have_them() {
    for scene in moving() {
        let mut worst = 0.0_f64;
        for frames in PAIRS {
            let (_, found, _) = followed(&scene, frames);
            let posed = scene.at(frames[1]);
            let view = posed.camera.view(SIZE);
            let shape = &posed.mirrors[0].shape;
            let exact = reflections(shape, view.eye).expect("exact points");
            // A mesh takes long.
            let every = if shape.as_mesh().is_some() { 8 } else { 1 };
            for (_, here, there) in found.iter().step_by(every) {
                // A direction is a point so far away that its parallax is below f64.
                let target = target_at(&posed, &here.target);
                let point = target.unwrap_or_else(|direction| 1e11 * direction);
                let places: Vec<DVec2> = match shape {
                    Shape::Plane(_) => {
                        let (on, normal) = shape.flat().expect("a plane");
                        let image = |p: DVec3| p - 2.0 * (p - on).dot(normal) * normal;
                        vec![view.project(image(point)).expect("in front").0]
                    }
                    _ => {
                        let points = exact(point).points;
                        let places = points.iter().filter_map(|point| view.project(*point));
                        places.map(|(at, _)| at).collect()
                    }
                };
                let off = places.iter().map(|at| at.distance(there.at));
                let off = off.reduce(f64::min).expect("a reflection point");
                worst = worst.max(off);
            }
        }
        println!("{}: {worst:e} px", scene.name);
        assert!(worst < EXACT_PX, "{}: {worst} px", scene.name);
    }
}

#[test]
fn where_nothing_moves_nothing_moves() {
    for scene in moving() {
        let still = scene.at(5);
        let (_, found, seen) = followed(&still, [1, 0]);
        assert_eq!(found.len(), seen, "{}", scene.name);
        let ways = found.iter().map(|(at, _, there)| there.at.distance(*at));
        let worst = ways.fold(0.0, f64::max);
        assert!(worst < STILL_PX, "{}: {worst:e} px", scene.name);
        assert!(found.iter().all(|(.., there)| !there.hidden));
    }
}

#[test]
fn what_was_hidden_is_said_to_be() {
    // The globe moves before the floor: in its wake the floor comes to light.
    let scene = Scene::load("moving-plane-object", &LoadOptions::default()).expect("built in");
    let follow = Follow::new(&scene, [11, 10], [160, 120]).expect("can be traced");
    let layer = follow.layer(None);
    let hidden = layer.disoccluded.expect("the reference knows");
    let hidden = hidden.pixels().iter().filter(|hidden| **hidden).count();
    let known = layer.valid.pixels().iter().filter(|valid| **valid).count();
    assert!(hidden > 10 && hidden < known / 20, "{hidden} of {known}");
}

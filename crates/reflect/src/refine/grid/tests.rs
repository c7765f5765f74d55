//! What the grid promises, on the software adapter.

use catoptric_frame::VertexState;
use glam::Vec2;

use super::forest::Place;
use super::*;
use crate::testing::{assert_layout, gpu_or_skip, scene};
use crate::{Output, Prepared, parse, prepare};

/// All but exact.
const SEARCH: &str = "reflector-cubemap(iterations=60,size=128,hidden=extend,depth=virtual)";
/// Of the pictures, which do not matter: reflection points are found without them.
const SIZE: [u32; 2] = [32, 32];

fn ready<'g>(gpu: &'g Gpu, scene: &Scene, technique: &str) -> Prepared<'g> {
    let spec = parse(technique).expect("a technique");
    prepare(gpu, &spec, scene, SIZE).expect("fits the device")
}

fn render(gpu: &Gpu, scene: &Scene, refinement: &str) -> Output {
    let technique = format!("{SEARCH}{refinement}");
    ready(gpu, scene, &technique).render().expect("renders")
}

/// State and image coordinates of every vertex.
fn answers(output: &Output) -> Vec<(VertexState, Vec2)> {
    let vertices = output.vertices.iter().flatten();
    vertices.map(|vertex| (vertex.state, vertex.at)).collect()
}

#[test]
fn fraction_one_bypasses_the_grid_and_a_tenth_searches_a_tenth() {
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("sphere-objects-1k");
    let plain = render(&gpu, &scene, "");
    let bypassed = render(&gpu, &scene, "+grid(fraction=1)");
    assert_eq!(answers(&plain), answers(&bypassed));
    assert_eq!(
        (plain.searched, plain.work),
        (bypassed.searched, bypassed.work)
    );
    // Whatever the search was asked for.
    for search in ["linear", "newton"] {
        let spec = |refinement| parse(&format!("{search}{refinement}")).expect("a technique");
        let [alone, bypassed] = ["", "+grid(fraction=1)"].map(|refinement| {
            let prepared = prepare(&gpu, &spec(refinement), &scene, [80, 60]);
            prepared
                .expect("fits the device")
                .render()
                .expect("renders")
        });
        assert_eq!(alone.frame.color, bypassed.frame.color, "{search}");
    }
    let tenth = render(&gpu, &scene, "+grid(fraction=0.1)");
    let share = tenth.searched as f64 / plain.searched as f64;
    // Objects of a few dozen vertices cannot come down to a tenth.
    assert!((0.05..0.3).contains(&share), "{share}");
}

#[test]
fn what_the_search_takes_is_told_with_a_grid_too() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-objects-1k");
    let work = |technique| {
        let output = ready(&gpu, &scene, technique).render().expect("renders");
        (output.work.evaluations, output.work.node_tests)
    };
    let (evaluations, node_tests) = work("ray-hierarchy+grid");
    assert!(evaluations >= Some(1.0) && node_tests >= Some(1.0));
    assert_eq!(
        work("ray-hierarchy"),
        work("ray-hierarchy+grid(fraction=1)")
    );
    assert_eq!(work("linear+grid").1, None, "there is no hierarchy");
}

#[test]
fn interpolation_is_as_exact_as_the_cells_are_small() {
    // Mean offsets of a prototype in pixels of a 512 × 512 picture, by the edge of the cells in
    // radii. It had vertices around the sphere, not those that nearly touch it, where cells
    // reach into the mirror: hence those from a radius away.
    const MEANS: [(f64, f32); 4] = [(0.1, 0.04), (0.25, 0.2), (0.5, 0.72), (1.0, 2.2)];
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("prototype-sphere");
    let exact = answers(&render(&gpu, &scene, ""));
    let far: Vec<_> = (scene.objects[0].mesh.positions.iter())
        .map(|position| position.length() > 2.2)
        .collect();
    for (edge, mean) in MEANS {
        let found = render(&gpu, &scene, &format!("+grid(cell={edge})"));
        let pairs = exact.iter().zip(answers(&found)).zip(&far);
        let gaps = pairs.filter(|(_, far)| **far);
        let gaps: Vec<_> = gaps.map(|((a, b), _)| a.1.distance(b.1) * 16.0).collect();
        let found = gaps.iter().sum::<f32>() / gaps.len() as f32;
        assert!(gaps.len() > 500, "{} vertices", gaps.len());
        assert!(found < mean, "{found} px in cells of {edge}");
    }
}

#[test]
fn drawing_is_in_space_whatever_the_depth_option() {
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("sphere-objects-1k");
    let draw = |technique: &str| {
        let output = ready(&gpu, &scene, technique).render().expect("renders");
        let reflected = output.frame.reflected.expect("all layers");
        (reflected.id, reflected.position)
    };
    let thesis = draw("linear(depth=thesis)+grid");
    assert_eq!(thesis, draw("linear(depth=virtual)+grid"));
    // What it would have been.
    assert_ne!(draw("linear(depth=thesis)"), draw("linear(depth=virtual)"));
}

#[test]
fn hidden_corners_are_continued_though_hidden_triangles_are_dropped() {
    // Interpolation does not depend on what is drawn; only which vertices count as hidden does.
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("sphere-touching");
    let with = |hidden: &str| {
        let technique = format!("reflector-cubemap(iterations=60,size=128,hidden={hidden})+grid");
        let output = ready(&gpu, &scene, &technique).render().expect("renders");
        answers(&output)
    };
    assert_eq!(with("drop"), with("extend"));
    // The hierarchy cannot continue them: all that a hidden corner touches is dropped.
    let hidden = |answers: Vec<(VertexState, Vec2)>| {
        let states = answers.into_iter().map(|(state, _)| state);
        states.filter(|state| *state == VertexState::Hidden).count()
    };
    let hierarchy = ready(&gpu, &scene, "ray-hierarchy(repair=enlarge)+grid").render();
    let hierarchy = hidden(answers(&hierarchy.expect("renders")));
    assert!(hierarchy > hidden(with("drop")), "{hierarchy}");
}

#[test]
fn corners_inside_the_mirror_are_left_out_and_counted() {
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("sphere-touching");
    let touching = render(&gpu, &scene, "+grid");
    assert_eq!(touching.notes.len(), 1, "{:?}", touching.notes);
    assert!(touching.notes[0].contains("inside mirror `ball`"));
    // A vertex that has lost all corners is hidden inside, and none is lost.
    let positions = scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions);
    let mut hidden_inside = 0;
    for ((state, _), position) in answers(&touching).iter().zip(positions) {
        assert_ne!(*state, VertexState::Failed, "{position}");
        let inside = scene.mirrors[0].shape.contains(position.as_dvec3());
        hidden_inside += u32::from(inside && *state == VertexState::Hidden);
    }
    assert!(hidden_inside > 0);
}

#[test]
fn the_grid_moves_with_its_mesh() {
    // Where the mesh went, the same grid gives what a grid made there gives: the move is along
    // the axes, so that both divide the mesh alike. Rounding of the moved positions, in pixels
    // of this small picture.
    const ROUNDING: f32 = 1e-3;
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let mut scene = scene("sphere-objects-1k");
    let technique = format!("{SEARCH}+grid");
    let mut moving = ready(&gpu, &scene, &technique);
    moving.render().expect("renders");
    for object in &mut scene.objects {
        for position in &mut object.mesh.positions {
            *position += Vec3::new(0.25, 0.0, 0.5);
        }
    }
    moving.update(&scene).expect("the same scene");
    let moved = moving.render().expect("renders");
    let fresh = render(&gpu, &scene, "+grid");
    let pairs = answers(&moved).into_iter().zip(answers(&fresh));
    let worst = pairs.map(|(a, b)| a.1.distance(b.1)).fold(0.0, f32::max);
    assert!(worst < ROUNDING, "{worst}");
}

#[test]
fn a_place_lies_as_the_shader_reads_it() {
    assert_layout!(Place { local, cell }, "grid/interpolate", &[], "Place");
}

//! What the grid promises, on the software adapter.

use catoptric_frame::{Status, VertexState};
use glam::Vec2;

use super::forest::Place;
use super::*;
use crate::testing::{Searched, assert_layout, gpu_or_skip, scene};
use crate::{Output, Prepared, parse, prepare};

/// A scene on all of whose mirrors a grid has been interpolated.
pub(crate) struct Gridded {
    pub options: Grid,
    /// The search continues hidden points.
    pub continued: bool,
    pub interpolation: Interpolation,
}

impl Gridded {
    pub(crate) fn new(gpu: &Gpu, scene: &Scene, technique: &str, size: [u32; 2]) -> Self {
        let spec = parse(technique).expect("a technique");
        let searched = Searched::new(gpu, scene, technique, size);
        let options = spec.refinement().expect("a refinement");
        let (options, _): (Grid, _) = options.of().expect("a grid");
        let (mut interpolation, continued) = searched.make(gpu, technique, |context| {
            let made = Interpolation::new(&options, context);
            made.map(|made| (made, context.continued))
        });
        let stage = &searched.stage;
        interpolation.begin_frame(gpu, stage, false);
        searched.on_sheets(gpu, |frame, sheet| {
            let (search, variant) = (searched.search.as_ref(), Variant::AllLayers);
            interpolation.record(frame, stage, search, sheet, variant);
        });
        Self {
            options,
            continued,
            interpolation,
        }
    }
}

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
fn corners_inside_the_mirror_tell_their_cells_as_others_do() {
    // A board that touches the ball: corners of its cells lie inside. What they say of the vertices around
    // is as exact as what corners outside say; without them these were guessed from one side.
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let scene = scene("sphere-touching");
    let exact = answers(&render(&gpu, &scene, ""));
    let found = render(&gpu, &scene, "+grid");
    assert_eq!(found.notes, Vec::<String>::new());
    let found = answers(&found);
    let failed = |(state, _): &(VertexState, Vec2)| *state == VertexState::Failed;
    assert!(!found.iter().any(failed), "every corner has an image");
    let ball = &scene.mirrors[0].shape;
    let positions = scene.objects.iter().flat_map(|o| &o.mesh.positions);
    let mut near = Vec::new();
    for ((exact, found), position) in exact.iter().zip(&found).zip(positions) {
        let height = position.as_dvec3().distance(ball.center()) - 1.0;
        if exact.0 == VertexState::Found && height < 0.1 {
            near.push(exact.1.distance(found.1));
        }
    }
    near.sort_by(f32::total_cmp);
    assert!(near.len() > 200, "{} vertices", near.len());
    let middle = near[near.len() / 2];
    assert!(middle < 0.05, "{middle} px");
}

#[test]
fn the_cells_move_with_their_mesh() {
    // Where the mesh went, the same cells give what cells made there give: the move is along the axes, so
    // that both divide the mesh alike, but for what rounding puts on the other side of a cell of a tree. In
    // pixels of this small picture.
    const ROUNDING: f32 = 1e-3;
    let Some(gpu) = gpu_or_skip() else {
        return;
    };
    let still = scene("sphere-objects-1k");
    for (refinement, limit) in [
        ("+grid", ROUNDING),
        ("+grid(cells=octree,error=0.02)", 0.02),
    ] {
        let mut scene = still.clone();
        let mut moving = ready(&gpu, &scene, &format!("{SEARCH}{refinement}"));
        moving.render().expect("renders");
        for object in &mut scene.objects {
            for position in &mut object.mesh.positions {
                *position += Vec3::new(0.25, 0.0, 0.5);
            }
        }
        moving.update(&scene).expect("the same scene");
        let moved = moving.render().expect("renders");
        let fresh = render(&gpu, &scene, refinement);
        let pairs = answers(&moved).into_iter().zip(answers(&fresh));
        let worst = pairs.map(|(a, b)| a.1.distance(b.1)).fold(0.0, f32::max);
        assert!(worst < limit, "{refinement}: {worst}");
    }
}

#[test]
fn a_place_lies_as_the_shader_reads_it() {
    assert_layout!(Place { local, cell }, "grid/interpolate", &[], "Place");
}

/// What a refinement shows of the kitchen, against what all vertices searched show.
#[derive(Debug)]
struct Kitchen {
    /// Share of the mirror pixels that show the same object.
    same: f64,
    /// Share of the searches.
    searched: f64,
    /// Percentiles of the offsets of reflected vertices: 50 and 95, pixels.
    offsets: [f32; 2],
}

/// Kitchens of several refinements, in a quarter of the picture that the numbers of the README are of.
fn kitchens<const N: usize>(gpu: &Gpu, refinements: [&str; N]) -> [Kitchen; N] {
    let scene = scene("kitchen");
    let draw = |refinement: &str| {
        let search = "reflector-cubemap(iterations=25,hidden=extend,depth=virtual)";
        let spec = parse(&format!("{search}{refinement}")).expect("a technique");
        let prepared = prepare(gpu, &spec, &scene, [160, 120]);
        prepared.expect("fits").render().expect("renders")
    };
    let seen = |output: &Output| {
        let reflected = output.frame.reflected.as_ref().expect("all layers");
        let statuses = reflected.status.pixels().iter().copied();
        let ids = reflected.id.pixels().iter().copied();
        statuses.zip(ids).collect::<Vec<_>>()
    };
    let all = draw("");
    let exact = answers(&all);
    refinements.map(|refinement| {
        let found = draw(refinement);
        let pairs: Vec<_> = seen(&all).into_iter().zip(seen(&found)).collect();
        let on_mirrors = pairs.iter().filter(|(a, _)| a.0 != Status::NotMirror);
        let same = on_mirrors.clone().filter(|(a, b)| a == b).count();
        let pairs = exact.iter().zip(answers(&found));
        let pairs = pairs.filter(|(exact, _)| exact.0 == VertexState::Found);
        let mut gaps: Vec<_> = pairs.map(|(a, b)| a.1.distance(b.1)).collect();
        gaps.sort_by(f32::total_cmp);
        Kitchen {
            same: same as f64 / on_mirrors.count() as f64,
            searched: found.searched as f64 / all.searched as f64,
            offsets: [50, 95].map(|percent| gaps[gaps.len() * percent / 100]),
        }
    })
}

#[test]
fn searching_the_vertices_of_mixed_cells_mends_the_silhouettes() {
    // In the whole picture of 320 × 240 the same shares are .911 and .949.
    let Some(gpu) = gpu_or_skip() else { return };
    let [published, searched] = kitchens(&gpu, ["+grid", "+grid(mixed=search)"]);
    assert!(published.same < 0.92, "{published:?}");
    assert!(searched.same > 0.94, "{searched:?}");
    assert!(searched.offsets[1] < 0.8 * published.offsets[1]);
    let more = searched.searched - published.searched;
    assert!(more > 0.0 && more < 0.05, "{searched:?}");
}

#[test]
fn a_tree_shows_what_all_vertices_show_for_a_part_of_the_searches() {
    // An eighth of a pixel here is a quarter of one in the whole picture, where the shares are .987 and .29.
    let Some(gpu) = gpu_or_skip() else { return };
    let errors = [0.5, 0.25, 0.125];
    let trees = errors.map(|error| format!("+grid(cells=octree,error={error})"));
    let trees = kitchens(&gpu, trees.each_ref().map(String::as_str));
    for (tree, error) in trees.iter().zip(errors) {
        // What the centres tell holds for nearly all that lies around them.
        assert!(f64::from(tree.offsets[1]) < error, "{error}: {tree:?}");
    }
    let finest = &trees[2];
    assert!(finest.same >= 0.985 && finest.searched <= 0.4, "{finest:?}");
    let rising = trees
        .windows(2)
        .all(|pair| pair[0].same < pair[1].same && pair[0].searched < pair[1].searched);
    assert!(rising, "{trees:?}");
}

#[test]
fn a_newton_step_takes_most_of_what_interpolation_misses() {
    let Some(gpu) = gpu_or_skip() else { return };
    let refinements = [
        "+grid",
        "+grid(polish=1)",
        "+grid(cells=octree,error=0.5,polish=1)",
    ];
    let [grid, polished, tree] = kitchens(&gpu, refinements);
    assert_eq!(grid.searched, polished.searched, "a step is no search");
    assert!(polished.same > grid.same + 0.04, "{polished:?}");
    assert!(polished.offsets[1] < 0.2 * grid.offsets[1], "{polished:?}");
    assert!(tree.same > 0.985 && tree.searched < 0.15, "{tree:?}");
}

#[test]
fn a_search_starts_from_its_own_answer_of_the_frame_before() {
    // Which records are searched is another list in every frame; the answers stay where they are.
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-objects-1k");
    let spec = parse("newton(start=previous,hidden=extend)+grid(cells=octree)");
    let spec = spec.expect("a technique");
    let prepared = prepare(&gpu, &spec, &scene, [80, 60]);
    let mut prepared = prepared.expect("fits the device");
    let [first, second] = [(); 2].map(|()| prepared.render().expect("renders"));
    assert_eq!(first.searched, second.searched);
    // What has no answer starts anew.
    let (cold, warm) = (first.work.evaluations, second.work.evaluations);
    assert!(warm < cold.map(|cold| 0.6 * cold), "{warm:?} of {cold:?}");
    // Both end where a step is below 1e-4 px.
    let pairs = answers(&first).into_iter().zip(answers(&second));
    let mut gaps: Vec<_> = pairs.map(|(a, b)| a.1.distance(b.1)).collect();
    gaps.sort_by(f32::total_cmp);
    assert!(gaps[gaps.len() * 95 / 100] < 1e-3, "{gaps:?}");
}

#[test]
fn a_scene_without_vertices_has_cells_neither() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("sphere-objects-1k");
    scene.objects.truncate(1);
    scene.objects[0].mesh = Default::default();
    for refinement in [
        "+grid",
        "+grid(mixed=search)",
        "+grid(cells=octree)",
        "+grid(cell=1)",
    ] {
        assert_eq!(render(&gpu, &scene, refinement).searched, 0);
    }
}

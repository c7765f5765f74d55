//! What the loop promises, on the software adapter.

use catoptric_scene::Scene;
use glam::Vec3;

use super::*;
use crate::refine::adaptive::Adaptive;
use crate::refine::full::Full;
use crate::testing::{Searched, gpu_or_skip, scene};
use crate::{Output, parse, prepare};

const SIZE: [u32; 2] = [160, 120];

/// A scene tessellated on all mirrors.
pub(crate) struct Tessellated {
    pub searched: Searched,
    pub rule: Rule,
    tessellation: Tessellation,
}

impl Tessellated {
    pub(crate) fn new(gpu: &Gpu, scene: &Scene, technique: &str, size: [u32; 2]) -> Self {
        Self::within(gpu, scene, technique, size, 128 << 20)
    }

    fn within(gpu: &Gpu, scene: &Scene, technique: &str, size: [u32; 2], binding: u64) -> Self {
        let spec = parse(technique).expect("a technique");
        let searched = Searched::new(gpu, scene, technique, size);
        let options = spec.refinement().expect("a refinement");
        let adaptive = options
            .of()
            .map(|(adaptive, _): (Adaptive, _)| adaptive.rule());
        let full = options.of().map(|(full, _): (Full, _)| full.rule());
        let rule = adaptive.or(full).expect("a rule");
        let mut tessellation = searched.make(gpu, technique, |context| {
            Tessellation::within(context, rule, binding)
        });
        let stage = &searched.stage;
        tessellation.begin_frame(gpu, stage, false);
        searched.on_sheets(gpu, |frame, sheet| {
            let (search, variant) = (searched.search.as_ref(), Variant::AllLayers);
            tessellation.record(frame, stage, search, sheet, variant);
        });
        Self {
            searched,
            rule,
            tessellation,
        }
    }

    /// The finished triangles of a sheet.
    pub(crate) fn leaves(&self, gpu: &Gpu, sheet: usize) -> Vec<Leaf> {
        let mut leaves = Vec::new();
        let sheet = self.searched.sheets[sheet];
        let search = self.searched.search.as_ref();
        let stage = &self.searched.stage;
        (self.tessellation).leaves(gpu, stage, search, sheet, |leaf| leaves.push(leaf));
        leaves
    }
}

fn output(gpu: &Gpu, scene: &Scene, technique: &str) -> Output {
    let spec = parse(technique).expect("a technique");
    let mut prepared = prepare(gpu, &spec, scene, SIZE).expect("fits the device");
    prepared.render().expect("renders")
}

fn same_picture(a: &Output, b: &Output) -> bool {
    let layers = |output: &Output| {
        let reflected = output.frame.reflected.clone().expect("all layers");
        (output.frame.color.clone(), reflected.position, reflected.id)
    };
    layers(a) == layers(b)
}

fn same(a: &Output, b: &Output) -> bool {
    same_picture(a, b)
        && (a.searched, &a.triangles) == (b.searched, &b.triangles)
        && a.work == b.work
}

#[test]
fn threshold_0_is_full_and_1_is_none() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    let full = output(&gpu, &scene, "linear+full(level=4)");
    let zero = output(&gpu, &scene, "linear+adaptive(level=4,threshold=0)");
    let triangles = |output: &Output| output.triangles.clone().expect("counted");
    assert_eq!(triangles(&full).by_level, triangles(&zero).by_level);
    assert_eq!(full.frame.color, zero.frame.color);
    assert_eq!(full.searched, zero.searched);
    assert_eq!(
        (
            triangles(&full).unfinished,
            triangles(&zero).unfinished > 100
        ),
        (0, true)
    );

    let none = output(&gpu, &scene, "linear");
    for technique in ["linear+adaptive(threshold=1)", "linear+full(level=0)"] {
        let one = output(&gpu, &scene, technique);
        let counts = triangles(&one);
        assert_eq!(
            (counts.by_level[0], counts.drawn, counts.unfinished),
            (2, 2, 0)
        );
        assert_eq!(one.frame.color, none.frame.color);
        assert_eq!((one.searched, one.work), (none.searched, none.work));
    }
}

#[test]
fn every_frame_is_the_same_to_the_bit() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("spheres");
    let spec = parse("linear+adaptive(level=2)").expect("a technique");
    let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits the device");
    let first = prepared.render().expect("renders");
    assert!(
        first
            .triangles
            .as_ref()
            .is_some_and(|triangles| triangles.by_level[1] > 0)
    );
    for _ in 0..2 {
        prepared.time_frame().expect("renders");
        assert!(same(&first, &prepared.render().expect("renders")));
    }
}

#[test]
fn chunks_make_the_same_triangles() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let technique = "linear+adaptive(level=2,threshold=0.01)";
    let whole = Tessellated::new(&gpu, &scene, technique, SIZE);
    // Room for 682 answers, 16 a triangle.
    let parts = Tessellated::within(&gpu, &scene, technique, SIZE, 32 << 10);
    assert_eq!(parts.tessellation.plan.chunk, 42);
    let key = |leaf: &Leaf| (leaf.piece.source, leaf.piece.places.to_array(), leaf.drawn);
    let keys = |made: &Tessellated| {
        let mut keys: Vec<_> = made.leaves(&gpu, 0).iter().map(key).collect();
        keys.sort_unstable();
        keys
    };
    assert_eq!(keys(&whole), keys(&parts));
    let counted = |made: &Tessellated| {
        let stage = &made.searched.stage;
        let efforts = made.tessellation.efforts(&gpu, stage);
        let triangles = made.tessellation.triangles(&gpu, stage);
        (
            triangles,
            efforts.searched,
            efforts.steps,
            efforts.evaluations,
        )
    };
    assert_eq!(counted(&whole), counted(&parts));
    let junctions = |made: &Tessellated| {
        let search = made.searched.search.as_ref();
        let surface = (made.tessellation).surface(&gpu, &made.searched.stage, search);
        surface.map(|surface| (surface.t_junctions, surface.levels))
    };
    assert_eq!(junctions(&whole), junctions(&parts));
}

#[test]
fn pieces_lie_in_their_source() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-objects-1k");
    let made = Tessellated::new(&gpu, &scene, "linear+full(level=2)", SIZE);
    let mut sources: Vec<[Vec3; 3]> = Vec::new();
    for object in &scene.objects {
        let position = |vertex: u32| object.mesh.positions[vertex as usize];
        sources.extend(
            object
                .mesh
                .triangles
                .iter()
                .map(|corners| corners.map(position)),
        );
    }
    // The middles are rounded twice.
    const ROUNDING: f32 = 1e-6;
    let leaves = made.leaves(&gpu, 0);
    assert!(leaves.len() > sources.len());
    for leaf in leaves {
        let [a, b, c] = sources[leaf.piece.source as usize];
        for (place, corner) in leaf.piece.places.to_array().into_iter().zip(leaf.corners) {
            let second = (place & 0xffff) as f32 / 16384.0;
            let third = (place >> 16) as f32 / 16384.0;
            let expected = a * (1.0 - second - third) + b * second + c * third;
            assert!(corner.distance(expected) < ROUNDING * (1.0 + corner.length()));
        }
    }
}

#[test]
fn only_what_is_hidden_by_all_corners_stops_early() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    let made = Tessellated::new(&gpu, &scene, "linear+full(level=4)", SIZE);
    let leaves = made.leaves(&gpu, 0);
    let early = leaves.iter().filter(|leaf| leaf.piece.level < 4);
    assert!(early.clone().count() > 0);
    assert!(early.clone().all(|leaf| leaf.states == [Found::HIDDEN; 3]));
    let area = leaves
        .iter()
        .map(|leaf| 0.25_f64.powi(leaf.piece.level as i32));
    assert_eq!(area.sum::<f64>(), 2.0, "the pieces fill both triangles");
}

#[test]
fn triangles_whose_corners_have_no_answer_are_split() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("sphere-square-hidden");
    // A floor so wide that all its corners are reflected outside the picture.
    for position in &mut scene.objects[0].mesh.positions {
        let middle = Vec3::new(0.1, 0.0, 0.7);
        *position = (*position - middle) * Vec3::new(12.0, 1.0, 12.0);
    }
    scene.camera.eye = glam::DVec3::new(0.0, 0.4, 1.7);
    scene.camera.target = scene.mirrors[0].shape.center();
    scene.camera.fov = catoptric_scene::Fov::Y(14.0);
    let made = Tessellated::new(&gpu, &scene, "newton+full(level=4)", SIZE);
    let leaves = made.leaves(&gpu, 0);
    let at_corners = made.searched.batches[0].read_found(&gpu, 4);
    let states: Vec<_> = at_corners.iter().map(|found| found.state).collect();
    assert_eq!(states, [Found::FAILED; 4]);
    assert!(leaves.iter().any(|leaf| leaf.drawn), "{}", leaves.len());
}

#[test]
fn every_search_goes_with_every_refinement() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    for search in ["linear", "ray-hierarchy", "reflector-cubemap", "newton"] {
        for refinement in [
            "full(level=2)",
            "adaptive(level=2)",
            "grid",
            "pixel(level=3)",
        ] {
            let spec = parse(&format!("{search}+{refinement}")).expect("a technique");
            let prepared = prepare(&gpu, &spec, &scene, [40, 30]);
            let output = prepared.expect("fits the device").render();
            assert!(output.is_ok_and(|output| output.searched >= 4), "{spec}");
        }
    }
}

/// The edge error by hand: with exact reflection points that of the edge which the triangles of
/// `crack` share is 0.000814, those of the small triangle's others are below 0.0004, those of the
/// large one's above 0.009. Whole pixels of this size blur it by less than a tenth.
#[test]
fn the_edge_error_is_the_one_computed_by_hand() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("crack");
    let triangles = |threshold: &str| {
        let technique = format!("linear+adaptive(level=1,threshold={threshold})");
        let spec = parse(&technique).expect("a technique");
        let mut prepared = prepare(&gpu, &spec, &scene, [640, 480]).expect("fits the device");
        let output = prepared.render().expect("renders");
        output.triangles.expect("counted").by_level
    };
    assert_eq!(triangles("0.00074"), [0, 8], "both split");
    assert_eq!(triangles("0.00089"), [1, 4], "the large one alone");
    assert_eq!(triangles("0.008"), [1, 4]);
}

#[test]
fn a_previous_frame_helps_the_scenes_own_vertices_alone() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    let spec = parse("linear(start=previous)+full(level=1)").expect("a technique");
    let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits the device");
    let [first, second] = [(); 2].map(|()| prepared.render().expect("renders"));
    assert!(same_picture(&first, &second));
    // Four vertices of ten then take one step each.
    let [cold, warm] = [&first, &second].map(|output| output.work.steps.expect("steps"));
    assert!(warm < 0.8 * cold && warm > 2.0, "{cold} {warm}");
    assert!(second.notes[0].contains("start=previous"));
    assert_eq!(output(&gpu, &scene, "linear+full(level=1)").notes.len(), 0);
}

#[test]
fn t_junctions_are_those_of_what_is_drawn_where_hidden_corners_are_continued() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    let adaptive = "+adaptive(level=5,threshold=0.00003)";
    for (hidden, continues) in [("drop", false), ("extend", true)] {
        let technique = format!("linear(hidden={hidden}){adaptive}");
        let made = Tessellated::new(&gpu, &scene, &technique, SIZE);
        let mut leaves = made.leaves(&gpu, 0);
        leaves.retain(|leaf| leaf.drawn);
        let hidden = |leaf: &Leaf| leaf.states.contains(&Found::HIDDEN);
        assert_eq!(leaves.iter().any(hidden), continues, "{technique}");
        let shown = |leaf: &Leaf| leaf.states.contains(&Found::FOUND);
        assert!(leaves.iter().all(shown), "{technique}");

        // On the one object every corner that lies inside the edge of another triangle counts.
        let inside = |point: Vec3, [a, b]: [Vec3; 2]| {
            let across = (b - a).cross(point - a).length();
            let along = (b - a).dot(point - a) / (b - a).length_squared();
            across < 1e-6 && (1e-3..1.0 - 1e-3).contains(&along)
        };
        let edges = leaves.iter().flat_map(|leaf| {
            let [a, b, c] = leaf.corners;
            [[a, b], [b, c], [c, a]]
        });
        let edges: Vec<_> = edges.collect();
        let mut corners: Vec<_> = leaves.iter().flat_map(|leaf| leaf.corners).collect();
        corners.sort_by_key(|corner| corner.to_array().map(f32::to_bits));
        corners.dedup();
        corners.retain(|corner| edges.iter().any(|edge| inside(*corner, *edge)));
        let count = output(&gpu, &scene, &technique).t_junctions;
        assert_eq!(count, Some(corners.len() as u64), "{technique}");
        assert!(count > Some(0), "{technique}");
    }
}

#[test]
fn neighbours_that_split_differently_meet_in_t_junctions() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square-hidden");
    let adaptive = output(&gpu, &scene, "linear+adaptive(level=5,threshold=0.00003)");
    assert!(adaptive.t_junctions.is_some_and(|count| count > 0));
    assert_eq!(
        output(&gpu, &scene, "linear+full(level=4)").t_junctions,
        Some(0)
    );
    assert_eq!(output(&gpu, &scene, "linear").t_junctions, None);
}

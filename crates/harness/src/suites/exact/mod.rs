//! `catoptric bench exact`: what exact reflections cost, and which way to them a renderer should take. Three are
//! exact to float32: beams, which need no hierarchy over the scene; rays through a hierarchy that is built once,
//! refitted or built for each frame; and rays in hardware. All that a technique needs for a frame is counted: its
//! own passes, and what it builds on the CPU before them. Inexact techniques stand beside them.
//!
//! The first figure has the answers, on scenes of all kinds; those after it say how cost grows with triangles,
//! mirror pixels and mirrors, what motion does to a refitted hierarchy, and where beams' time goes.

mod claims;
mod crossover;
mod labels;

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, ANGLE, BUILD_CPU, BYTES, EVALUATIONS, FULL_AGREEMENT, MOVED_NODES, MOVING_MS,
    NODE_TESTS, OWN_MS, PIXELS, REFIT_MS, STILL_MS, TRACE_MS,
};
use crate::suites::series::{Point, Series};
use crate::suites::suite::{Asked, Budget, Layout, Suite};

use labels::{BEAMS, HARDWARE, HARDWARE_REBUILT, MAPS, REBUILT, REFIT, SEARCHED, STATIC};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "exact",
    title: "Exact reflections, and their price",
    why: "Which exact technique should a renderer take for what it draws, what does it pay, and what would it save \
          with one that is not exact?",
    figures,
    judged: None,
    pictures: None,
    timing: Budget::Whole(100.0),
    resolution: Some(SIZE),
    layout: Layout::Figures,
};

/// Of all pictures: the largest scenes take a software adapter seconds a frame.
const SIZE: [u32; 2] = [160, 120];

/// Label and technique.
const ALL: [(&str, &str); 8] = [
    (BEAMS, "beams"),
    (STATIC, "ray-trace"),
    (REFIT, "ray-trace(update=refit)"),
    (REBUILT, "ray-trace(update=frame)"),
    (HARDWARE, "ray-trace(traversal=hardware)"),
    (
        HARDWARE_REBUILT,
        "ray-trace(traversal=hardware,update=frame)",
    ),
    (
        MAPS,
        "cubemap-trace(sampling=texel,pyramid=sound,update=frame)",
    ),
    (SEARCHED, "newton"),
];

/// Scenes of all kinds: convex, concave and mixed mirrors, one and several, few triangles and many, models that may
/// be missing.
const SCENES: [&str; 10] = [
    "sphere-table",
    "sphere-objects-20k",
    "bowl",
    "torus",
    "spheres",
    "kitchen",
    "room",
    "box",
    "teapot-ball",
    "sponza-ball",
];

/// One surface, cut finer: triangles, and the ending of the scene's name.
const SIZES: [(f64, &str); 6] = [
    (1_922.0, "1k"),
    (5_832.0, "3k"),
    (19_602.0, "10k"),
    (59_168.0, "30k"),
    (198_450.0, "100k"),
    (999_698.0, "500k"),
];

/// Of more triangles a search has as many vertices, which take minutes.
const MOST_SEARCHED: f64 = 60_000.0;

/// One scene from afar to so near that the mirror fills the picture, and the share of it that it fills, percent.
const VIEWS: [(f64, &str); 6] = [
    (0.4, "sphere-small-8"),
    (1.4, "sphere-small-4"),
    (5.6, "sphere-small-2"),
    (22.0, "sphere-objects-1k"),
    (86.0, "sphere-near-2"),
    (100.0, "sphere-near-4"),
];

/// Numbers of mirrors.
const MIRRORS: [u32; 6] = [1, 2, 3, 4, 6, 8];

/// What moves: a camera, objects within one another that part, an object, everything.
const MOVING: [&str; 4] = [
    "sphere-objects-1k",
    "moving-ball-object",
    "moving-ball-all",
    "parting",
];

/// Frames that are followed.
const FRAMES: u32 = 8;

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    if let Some(scene) = asked.scene {
        return vec![choice(&[scene]), bounces(&[scene])];
    }
    vec![
        choice(&SCENES),
        triangles(),
        pixels(),
        mirrors(),
        motion(),
        bounces(&["box", "bowl", "room", "spheres", "facing"]),
    ]
}

/// All techniques at places along an axis.
fn series(places: &[(f64, String)], keep: impl Fn(&str, f64) -> bool) -> Vec<Series> {
    let series = ALL.iter().map(|(label, technique)| {
        let kept = places.iter().filter(|(x, _)| keep(label, *x));
        Series::new(
            *label,
            kept.map(|(x, scene)| Point::new(*x, scene.clone(), *technique)),
        )
    });
    series.filter(|series| !series.points.is_empty()).collect()
}

/// What is drawn of each of these figures.
fn costs() -> Vec<Quantity> {
    vec![
        Quantity::log(OWN_MS).called("own passes and builds (ms)"),
        Quantity::log(ANGLE),
        Quantity::linear(AGREEMENT),
        Quantity::log(NODE_TESTS),
        Quantity::log(EVALUATIONS),
        Quantity::log(BYTES),
    ]
}

fn choice(scenes: &[&str]) -> Figure {
    let places: Vec<_> = (0..)
        .zip(scenes)
        .map(|(x, scene)| (f64::from(x), (*scene).to_owned()))
        .collect();
    let mut series = series(&places, |_, _| true);
    for point in &mut series[0].points {
        point.picture = ["bowl", "room"].contains(&point.scene.as_str());
    }
    Figure {
        anchor: "choice",
        title: "Which technique to take".to_owned(),
        after: "",
        question: "Scenes of all kinds, every technique with all that a frame needs. What stands still is traced through a \
                   hierarchy that was built once; where things move it is refitted or built anew, or there is none. Real \
                   models stand at the end, where they are there."
            .to_owned(),
        axis: Axis::names("scene", scenes.iter().copied()),
        series,
        quantities: costs(),
        quotes: &[],
        claims: claims::CHOICE,
    }
}

fn triangles() -> Figure {
    let places = SIZES.map(|(triangles, size)| (triangles, format!("sphere-grid-full-{size}")));
    let series = series(&places, |label, triangles| {
        label != SEARCHED || triangles < MOST_SEARCHED
    });
    let passes = [
        ("time_ms.passes.hierarchy", "hierarchy over the rays (ms)"),
        (REFIT_MS, "boxes refitted (ms)"),
        ("time_ms.passes.sift", "clusters sifted (ms)"),
        ("time_ms.passes.tiles", "tiles (ms)"),
        ("time_ms.passes.shade", "shading (ms)"),
        (TRACE_MS, "tracing (ms)"),
        (BUILD_CPU, "building on the CPU (ms)"),
    ];
    let mut quantities = costs();
    quantities.extend(passes.map(|(path, called)| Quantity::log(path).called(called)));
    Figure {
        anchor: "triangles",
        title: "More triangles".to_owned(),
        after: "",
        question: "The same surface cut finer, all of the picture a mirror. Beams send every triangle down, so that their cost \
                   grows with their number; a ray visits a few nodes more. The passes say where the time goes."
            .to_owned(),
        axis: Axis::log("triangles"),
        series,
        quantities,
        quotes: &[],
        claims: claims::TRIANGLES,
    }
}

fn pixels() -> Figure {
    let places = VIEWS.map(|(share, scene)| (share, scene.to_owned()));
    let mut quantities = costs();
    quantities.push(Quantity::log(PIXELS));
    Figure {
        anchor: "pixels",
        title: "More mirror pixels".to_owned(),
        after: "",
        question: "One scene through lenses from wide to narrow: the mirror fills from less than a hundredth of the picture \
                   to all of it."
            .to_owned(),
        axis: Axis::log("% of the picture"),
        series: series(&places, |_, _| true),
        quantities,
        quotes: &[],
        claims: claims::PIXELS_GROW,
    }
}

fn mirrors() -> Figure {
    let places = MIRRORS.map(|mirrors| (f64::from(mirrors), format!("mirrors-{mirrors}")));
    Figure {
        anchor: "mirrors",
        title: "More mirrors".to_owned(),
        after: "",
        question: "One to eight like mirrors over the same things. What answers for all of them in one pass pays for their \
                   pixels; what works mirror by mirror pays for each."
            .to_owned(),
        axis: Axis::log("mirrors"),
        series: series(&places, |_, _| true),
        quantities: costs(),
        quotes: &[],
        claims: claims::MIRRORS_GROW,
    }
}

fn motion() -> Figure {
    let places: Vec<_> = (0..)
        .zip(MOVING)
        .map(|(x, scene)| (f64::from(x), scene.to_owned()))
        .collect();
    let mut series = series(&places, |label, _| {
        [BEAMS, STATIC, REFIT, REBUILT].contains(&label)
    });
    for point in series.iter_mut().flat_map(|series| &mut series.points) {
        point.frames = Some(FRAMES);
    }
    Figure {
        anchor: "motion",
        title: "What motion costs".to_owned(),
        after: "",
        question: format!(
            "{FRAMES} frames of a camera, an object, everything, and of objects that part. A refitted hierarchy keeps the \
             neighbours of its first frame: the nodes that a ray visits in the last one say what that is worth by then, beside \
             those of a hierarchy that was built for it."
        ),
        axis: Axis::names("scene", MOVING),
        series,
        quantities: vec![
            Quantity::linear(MOVED_NODES),
            Quantity::log(MOVING_MS),
            Quantity::log(STILL_MS),
            Quantity::log(OWN_MS).called("own passes and builds (ms)"),
            Quantity::linear("temporal.object_agreement_min"),
        ],
        quotes: &[],
        claims: claims::MOTION,
    }
}

/// Reflections that `beams` follows; the truth follows as many or more.
const BOUNCES: [u32; 4] = [1, 2, 4, 8];

fn bounces(scenes: &[&str]) -> Figure {
    let series = scenes.iter().map(|scene| {
        let points = BOUNCES.map(|bounces| {
            let technique = format!("beams(bounces={bounces})");
            let point = Point::new(f64::from(bounces), *scene, technique);
            match (bounces, *scene) {
                (8, "facing") => point.shown(),
                _ => point,
            }
        });
        Series::new(*scene, points)
    });
    Figure {
        anchor: "bounces",
        title: "Mirrors in mirrors".to_owned(),
        after: "",
        question: "The hierarchy is built again over the second rays, and over the third. Judged by the truth in which mirrors \
                   see mirrors."
            .to_owned(),
        axis: Axis::log("bounces"),
        series: series.collect(),
        quantities: vec![
            Quantity::linear(FULL_AGREEMENT),
            Quantity::log(OWN_MS).called("own passes (ms)"),
            Quantity::log(NODE_TESTS),
            Quantity::log(EVALUATIONS),
        ],
        quotes: &[],
        claims: claims::BOUNCES,
    }
}

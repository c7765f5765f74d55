//! Techniques beside each other: all of them, what they can do (Table 5.1), and how the cost grows
//! with the scene.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, PREPARE_MS, SAMPLES, SEARCH_MS, TRACE_MS, UNRESOLVED,
};
use crate::suites::series::{Point, Series};
use crate::suites::shelf;

use super::claims;
use super::data::point;
use super::labels::{DISTANT, GROWTH, NEAR, TOUCHING};

/// Label and technique.
const ALL: [(&str, &str); 11] = [
    shelf::LINEAR,
    shelf::LINEAR_CROSS,
    shelf::RAY_HIERARCHY,
    shelf::ENVIRONMENT_MAP,
    shelf::ENVIRONMENT_MAP_REDRAWN,
    shelf::REFLECTOR_CUBEMAP,
    shelf::PLANAR,
    shelf::CUBEMAP_PUBLISHED,
    shelf::CUBEMAP,
    (
        "cubemap trace, redrawn",
        "cubemap-trace(sampling=texel,pyramid=sound,update=frame)",
    ),
    shelf::CONTROL,
];

pub fn figures(scene: Option<&str>) -> Vec<Figure> {
    match scene {
        Some(_) => Vec::new(),
        None => vec![capabilities(), growth()],
    }
}

const IN_MIRRORS: &str = "mirrors in mirrors";

/// Scenes that each ask for one ability.
const ABILITIES: [(&str, &str); 5] = [
    (NEAR, "sphere-objects-1k"),
    (DISTANT, "distant"),
    (TOUCHING, "sphere-touching"),
    (IN_MIRRORS, "bowl"),
    ("flat mirrors", "planar"),
];

/// Whether a technique can follow a ray from mirror to mirror.
fn can_bounce(technique: &str) -> bool {
    catoptric_reflect::parse(technique).is_ok_and(|spec| spec.options().has("bounces"))
}

fn capabilities() -> Figure {
    let asked = |ability: &str, technique: &str| match technique.strip_suffix(')') {
        // What cubemap tracing does about mirrors in mirrors.
        Some(options) if ability == IN_MIRRORS && can_bounce(technique) => {
            format!("{options},bounces=3)")
        }
        _ => technique.to_owned(),
    };
    let series = |(label, scene): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: ALL
            .iter()
            .enumerate()
            .map(|(x, (_, technique))| point(x, scene, asked(label, technique)))
            .collect(),
    };
    Figure {
        anchor: "capabilities",
        title: "What each technique can do".to_owned(),
        after: "Číž 2017, Table 5.1",
        question:
            "Measured instead of judged: a scene for each ability; with mirrors in mirrors the \
                   cubemap trace follows three rays and all are held against that truth too. A \
                   technique without a point says why it does not apply."
                .to_owned(),
        axis: Axis::names("technique", ALL.map(|(label, _)| label)),
        series: ABILITIES.iter().map(series).collect(),
        quantities: vec![
            Quantity::linear(AGREEMENT),
            Quantity::linear(FULL_AGREEMENT),
            Quantity::log(PREPARE_MS),
            Quantity::log(FRAME_MS),
        ],
        quotes: &[],
        claims: claims::CAPABILITIES,
    }
}

/// Ending and vertices of a family of scenes that differ only in how finely a square is cut.
const GROWING: [(&str, u32); 4] = [
    ("100", 100),
    ("1k", 1_024),
    ("10k", 10_000),
    ("100k", 99_856),
];

fn growth() -> Figure {
    let series = |(label, technique): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: GROWING
            .iter()
            .map(|(size, vertices)| {
                let scene = format!("sphere-grid-{size}");
                Point {
                    x: f64::from(*vertices),
                    ..point(0, &scene, *technique)
                }
            })
            .collect(),
    };
    Figure {
        anchor: "growth",
        title: "Cost against the size of the scene".to_owned(),
        after: "Číž 2017, chapter 5",
        question:
            "The thesis claims a cost that does not depend on the scene's complexity. Here the same \
                   square is cut into more and more triangles: tracing in maps that stand, and with maps \
                   that are drawn anew. What scenes of other shapes cost stands under the published table."
                .to_owned(),
        axis: Axis::log("vertices"),
        series: GROWTH.iter().map(series).collect(),
        quantities: vec![
            Quantity::log(TRACE_MS).called("tracing pass (ms)"),
            Quantity::log(FRAME_MS),
            Quantity::log(SEARCH_MS).called("search pass (ms)"),
            Quantity::linear(SAMPLES),
            Quantity::linear(UNRESOLVED),
        ],
        quotes: &[],
        claims: claims::GROWS,
    }
}

//! `catoptric bench control`: what the harness itself is worth. The control traces the reference's
//! rays on the GPU; what is left between the two is the floor under every other number. Drawn from
//! triangles, a mirror is not the reference's any more: how far, and how the gap closes. In 32 bits
//! the published search cannot tell neighbouring pixels apart: from which zoom on. And what the
//! alternative to all techniques costs: its hierarchy, built once or for every frame, gone through
//! by a shader or by ray queries in hardware.

use crate::show::number::{percent, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, ANGLE, BUILD_CPU, BUILD_GPU, MEAN_PX, TRACE_MS};
use crate::suites::results::Results;
use crate::suites::results::power;
use crate::suites::series::{Point, Series};
use crate::suites::suite::{Asked, Budget, Layout, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "control",
    title: "The control: rays on the GPU against the reference",
    why: "How much of any error is the harness's own, how much of it the triangles that a mirror is \
          drawn from, and what do ray-traced reflections cost where a scene moves?",
    figures,
    pictures: None,
    timing: Budget::Whole(45.0),
    resolution: None,
    layout: Layout::Figures,
};

const EXACT: &str = "exact mirror";
const DRAWN: &str = "mirror drawn from triangles";

/// Segments around the drawn mirror of the built-in family.
const SEGMENTS: [u32; 6] = [8, 16, 32, 64, 128, 256];

/// The built-in family's sizes: the name's ending, and the triangles of its grid.
const SIZES: [(&str, u32); 6] = [
    ("100", 162),
    ("1k", 1_922),
    ("3k", 5_832),
    ("10k", 19_602),
    ("30k", 59_168),
    ("100k", 198_450),
];

const DOT: &str = "from the cosine (published)";
const CROSS: &str = "from the sine";

/// How much narrower than the prototype's the views are.
const ZOOMS: [u32; 6] = [1, 2, 4, 8, 16, 32];

const STATIC: &str = "built once";
const REBUILT: &str = "built for every frame";
const HARDWARE: &str = "hardware, built once";
const HARDWARE_REBUILT: &str = "hardware, built for every frame";

/// Label and technique.
const COSTS: [(&str, &str); 4] = [
    (STATIC, "ray-trace"),
    (REBUILT, "ray-trace(update=frame)"),
    (HARDWARE, "ray-trace(traversal=hardware)"),
    (
        HARDWARE_REBUILT,
        "ray-trace(traversal=hardware,update=frame)",
    ),
];

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    let scene = asked.scene;
    if let Some(scene) = scene {
        let axis = Axis::names("scene", [scene]);
        return vec![cost(axis, &[(0.0, scene.to_owned())])];
    }
    let sizes =
        SIZES.map(|(size, triangles)| (f64::from(triangles), format!("sphere-grid-{size}")));
    vec![gap(), bits(), cost(Axis::log("triangles"), &sizes)]
}

fn gap() -> Figure {
    let series = |(label, technique): (&str, &str)| Series {
        label: label.to_owned(),
        points: SEGMENTS
            .iter()
            .map(|segments| {
                let scene = format!("sphere-drawn-{segments}");
                let point = Point::new(f64::from(*segments), scene, technique);
                match (label, segments) {
                    (DRAWN, 16 | 128) => point.shown(),
                    _ => point,
                }
            })
            .collect(),
    };
    let series = [(EXACT, "ray-trace"), (DRAWN, "ray-trace(gbuffer=mesh)")].map(series);
    Figure {
        anchor: "gap",
        title: "The mirror's own triangles".to_owned(),
        after: "",
        question: "The same rays from a mirror that each eye ray meets exactly, and from the \
                   triangles that it is drawn with, with interpolated normals. The first curve is \
                   the harness's noise; between the two lies what the papers' applications lost \
                   before any technique had begun."
            .to_owned(),
        axis: Axis::log("segments around the sphere"),
        series: series.into(),
        quantities: vec![
            Quantity::linear(AGREEMENT),
            Quantity::log(ANGLE),
            Quantity::log("angular_error_deg.p99"),
            Quantity::linear("coverage.iou"),
        ],
        quotes: &[],
        analysis: closing,
    }
}

fn closing(results: &Results<'_>) -> Vec<String> {
    let mut said = Vec::new();
    let floor = results.curve(EXACT, ANGLE);
    if let Some(worst) = floor.iter().map(|(_, angle)| *angle).reduce(f64::max) {
        said.push(format!(
            "The exact mirror differs from the reference by {}° in the median, on every size: that \
             is float32.",
            short(worst)
        ));
    }
    let drawn = results.curve(DRAWN, ANGLE);
    if let (Some(first), Some(last), Some(power)) = (drawn.first(), drawn.last(), power(&drawn)) {
        said.push(format!(
            "Drawn from triangles the median error falls from {}° with {} segments to {}° with {}, \
             as the power {} of their number.",
            short(first.1),
            first.0,
            short(last.1),
            last.0,
            short(power)
        ));
    }
    let agreement = results.curve(DRAWN, AGREEMENT);
    if let Some((segments, _)) = agreement.iter().find(|(_, share)| *share >= 0.999) {
        said.push(format!(
            "From {segments} segments on, {} of the mirror's pixels show the right object.",
            percent(0.999)
        ));
    }
    said
}

/// The error function is an angle between two directions; its cosine is flat where it is 0.
fn bits() -> Figure {
    let series = |(label, technique): (&str, &str)| Series {
        label: label.to_owned(),
        points: ZOOMS
            .iter()
            .map(|zoom| {
                let scene = match zoom {
                    1 => "prototype-sphere".to_owned(),
                    _ => format!("prototype-sphere-zoom-{zoom}"),
                };
                Point::new(f64::from(*zoom), scene, technique)
            })
            .collect(),
    };
    Figure {
        anchor: "bits",
        title: "What 32 bits cost the published search".to_owned(),
        after: "Szabo 2013, section 4.1",
        question: "The linear search takes the pixel with the smallest angle between normal and \
                   bisector. As published the angle comes from its cosine, which 32 bits cannot tell \
                   from 1 below 0.02°; from the sine it is exact. The narrower the view, the smaller \
                   the angles between neighbouring pixels. A pixel's centre is 0.38 px from a point in \
                   it in the mean."
            .to_owned(),
        axis: Axis::log("zoom"),
        series: [(DOT, "linear"), (CROSS, "linear(residual=cross)")].map(series).into(),
        quantities: vec![
            Quantity::linear(MEAN_PX),
            Quantity::linear("vertices.offset_share.over_0_71"),
            Quantity::linear("vertices.offset_px.max"),
        ],
        quotes: &[],
        analysis: flat_cosine,
    }
}

fn flat_cosine(results: &Results<'_>) -> Vec<String> {
    let pair = |zoom: f64| {
        let of = |series| results.at(series, zoom, MEAN_PX);
        of(DOT).zip(of(CROSS))
    };
    let (first, last) = (f64::from(ZOOMS[0]), f64::from(ZOOMS[ZOOMS.len() - 1]));
    pair(first)
        .zip(pair(last))
        .map(|((dot, cross), (dot_last, cross_last))| {
            format!(
                "Unzoomed, cosine and sine end {} and {} px from the true point in the mean; at {last} \
                 times the zoom {} and {} px.",
                short(dot),
                short(cross),
                short(dot_last),
                short(cross_last)
            )
        })
        .into_iter()
        .collect()
}

fn cost(axis: Axis, scenes: &[(f64, String)]) -> Figure {
    let series = COSTS.map(|(label, technique)| Series {
        label: label.to_owned(),
        points: (scenes.iter())
            .map(|(x, scene)| Point::new(*x, scene.clone(), technique))
            .collect(),
    });
    Figure {
        anchor: "hierarchy",
        title: "What the rays are traced through".to_owned(),
        after: "",
        question: "A scene that deforms needs its hierarchy anew in every frame. A shader's is built \
                   on the CPU, apart from the frame; the driver's is built on the GPU, in a pass of \
                   its own. Where the adapter has no ray queries, their curves are missing."
            .to_owned(),
        axis,
        series: series.into(),
        quantities: vec![
            Quantity::log(BUILD_CPU),
            Quantity::log(BUILD_GPU).called("building on the GPU (ms)"),
            Quantity::log(TRACE_MS).called("tracing (ms)"),
            Quantity::linear("work.node_tests").called("nodes visited per mirror pixel"),
            Quantity::linear("work.evaluations").called("triangles tested per mirror pixel"),
            Quantity::linear(AGREEMENT),
        ],
        quotes: &[],
        analysis: building,
    }
}

fn building(results: &Results<'_>) -> Vec<String> {
    let mut said = Vec::new();
    for (series, path, place) in [
        (REBUILT, BUILD_CPU, "on the CPU"),
        (HARDWARE_REBUILT, BUILD_GPU, "on the GPU"),
    ] {
        let built = results.curve(series, path);
        let traced = results.curve(series, TRACE_MS);
        let (Some(built_last), Some(traced_last)) = (built.last(), traced.last()) else {
            continue;
        };
        said.push(format!(
            "Building the hierarchy of the largest scene {place} takes {} times as long as tracing \
             through it.",
            short(built_last.1 / traced_last.1)
        ));
        if let Some(power) = power(&built) {
            said.push(format!(
                "The time to build {place} grows as the power {} of the number of triangles.",
                short(power)
            ));
        }
    }
    if let Some(power) = power(&results.curve(STATIC, "work.node_tests")) {
        said.push(format!(
            "The nodes that a ray visits grow as the power {} of the number of triangles.",
            short(power)
        ));
    }
    said
}

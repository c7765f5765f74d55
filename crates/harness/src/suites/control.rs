//! `catoptric bench control`: the errors of the harness itself. The control traces the reference's
//! rays on the GPU; the difference that is left is the floor under every other number. A mirror
//! drawn from triangles differs from the reference's: by how much, and how does the gap close with
//! more triangles? In 32 bits the published search cannot tell neighbouring pixels apart: from
//! which zoom on? And what does the alternative to all techniques cost: its hierarchy, built once
//! or for every frame, traversed by a shader or by ray queries in hardware?

use crate::show::plot::Axis;
use crate::suites::claims::make::{claim, grows, ratio, value};
use crate::suites::claims::{
    Claim, Limit, Noise, Paper, Place, Shown, Term, Which, at, each, last, of,
};
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, ANGLE, BUILD_CPU, BUILD_GPU, MEAN_PX, TRACE_MS};
use crate::suites::series::{Point, Series};
use crate::suites::suite::{Asked, Budget, Layout, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "control",
    title: "The control: rays on the GPU against the reference",
    why: "How much of any error is the harness's own, how much of it the triangles that a mirror is \
          drawn from, and what do ray-traced reflections cost where a scene moves?",
    figures,
    judged: None,
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
        claims: GAP,
    }
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
        claims: BITS,
    }
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
        claims: BUILDING,
    }
}

const GAP: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "Rays traced on the GPU from the exact mirror are the reference's.",
        value(
            each(EXACT),
            Term::Path(ANGLE),
            Limit::Below(0.001),
            Noise::Share(0.1),
            Shown::In("°"),
        ),
        "the median angular error: float32 leaves some 1e-4°, and no technique comes near.",
    ),
    claim(
        Paper::Ours,
        "",
        "What the mirror's triangles cost falls as the square of their number around it.",
        grows(
            Which::Named(DRAWN),
            Term::Path(ANGLE),
            Limit::Between(-2.3, -1.7),
        ),
        "interpolated normals err to second order: a power of −2.",
    ),
    claim(
        Paper::Szabo2013,
        "2.3",
        "How good a reflection is depends on how finely the mirror is modelled.",
        ratio(
            of(Which::Named(DRAWN), Place::First),
            of(Which::Named(DRAWN), Place::Last),
            Term::Path(ANGLE),
            Limit::Above(2.0),
            Noise::Share(0.05),
        ),
        "the median angular error with the fewest segments over that with the most: twice is plain.",
    ),
];

const BITS: &[Claim] = &[
    claim(
        Paper::Szabo2013,
        "3.1",
        "In a usual view the published error, a dot product, finds the pixel that the exact one finds.",
        ratio(
            at(DOT, 1.0),
            at(CROSS, 1.0),
            Term::Path(MEAN_PX),
            Limit::Below(1.05),
            Noise::Share(0.01),
        ),
        "mean offset from the cosine over that from the sine: a twentieth more is the same.",
    ),
    claim(
        Paper::Ours,
        "",
        "In 32 bits the published error cannot tell neighbouring pixels apart in a narrow view.",
        ratio(
            at(DOT, 32.0),
            at(CROSS, 32.0),
            Term::Path(MEAN_PX),
            Limit::Above(1.25),
            Noise::Share(0.02),
        ),
        "the same at 32 times the zoom: a quarter more.",
    ),
];

const BUILDING: &[Claim] = &[
    claim(
        Paper::SzaboCescg,
        "2",
        "A ray tracer's hierarchy is costly where objects move: to build it on the CPU takes longer than to trace.",
        value(
            last(REBUILT),
            Term::Quotient(BUILD_CPU, TRACE_MS),
            Limit::Above(1.0),
            Noise::Clock,
            Shown::Times,
        ),
        "building over tracing in the largest scene.",
    ),
    claim(
        Paper::Ciz2017,
        "2.3.3",
        "A ray tracer's hierarchy is costly where objects move: to build it on the GPU takes longer than to trace.",
        value(
            last(HARDWARE_REBUILT),
            Term::Quotient(BUILD_GPU, TRACE_MS),
            Limit::Above(1.0),
            Noise::Clock,
            Shown::Times,
        ),
        "building over tracing in the largest scene; where the adapter has ray queries.",
    ),
    claim(
        Paper::Ours,
        "",
        "The nodes that a ray visits grow far more slowly than the scene.",
        grows(
            Which::Named(STATIC),
            Term::Path("work.node_tests"),
            Limit::Below(0.5),
        ),
        "the power of the number of triangles: the root of it is far more slowly.",
    ),
];

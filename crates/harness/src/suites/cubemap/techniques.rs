//! Techniques beside each other: all of them, what they can do (Table 5.1), and how the cost grows
//! with the scene.

use crate::plot::Axis;
use crate::report::words::{percent, short};
use crate::suites::results::power;
use crate::suites::{Figure, Point, Quantity, Results, Series};

use super::{AGREEMENT, ANGLE, FRAME_MS, UNRESOLVED, by_scene, names, point};

/// Label and technique.
const ALL: [(&str, &str); 9] = [
    ("linear", "linear"),
    ("linear, cross", "linear(residual=cross,neighbours=8)"),
    ("ray hierarchy", "ray-hierarchy(repair=enlarge)"),
    ("environment map", "environment-map"),
    ("environment map, redrawn", "environment-map(update=frame)"),
    ("planar", "planar"),
    ("cubemap trace", "cubemap-trace"),
    (
        "cubemap trace, ours",
        "cubemap-trace(sampling=texel,pyramid=sound,accept=continuous)",
    ),
    ("ray trace (control)", "ray-trace"),
];

/// Where all stand beside each other.
const SCENES: [&str; 4] = ["sphere-table", "box", "bowl", "planar"];

pub fn figures(scene: Option<&str>) -> Vec<Figure> {
    let own = scene.map(|scene| [scene]);
    let scenes = own.as_ref().map_or(SCENES.as_slice(), |scene| scene);
    let mut figures = vec![all(scenes)];
    if scene.is_none() {
        figures.push(capabilities());
        figures.push(growth());
    }
    figures
}

fn all(scenes: &[&str]) -> Figure {
    let techniques = ALL.map(|(_, technique)| technique.to_owned());
    Figure {
        anchor: "all",
        title: "All techniques".to_owned(),
        after: "all four papers",
        question: "The same scenes by every technique: error, time and work.".to_owned(),
        axis: names("technique", ALL.map(|(label, _)| label)),
        series: by_scene(scenes, &techniques, None),
        quantities: vec![
            Quantity::linear("share of pixels with the right object", AGREEMENT),
            Quantity::log("angular error, median (°)", ANGLE),
            Quantity::linear("FLIP", "color.flip"),
            Quantity::log("time of a frame (ms)", FRAME_MS),
        ],
        quotes: Vec::new(),
        analysis: |results| {
            let series = results.series().iter();
            let sentences = series.filter_map(|series| {
                let agreements = series
                    .points
                    .iter()
                    .filter(|point| point.technique != "ray-trace");
                let best = agreements
                    .filter_map(|point| Some((results.value(point, AGREEMENT)?, point)))
                    .max_by(|a, b| a.0.total_cmp(&b.0))?;
                Some(format!(
                    "{}: of all but the control, {} has the right object most often, on {} of the \
                     mirror pixels.",
                    series.label,
                    best.1.technique,
                    percent(best.0)
                ))
            });
            sentences.collect()
        },
    }
}

/// Scenes that each ask for one ability.
const ABILITIES: [(&str, &str); 4] = [
    ("near objects", "sphere-objects-1k"),
    ("touching objects", "sphere-touching"),
    ("mirrors in mirrors", "bowl"),
    ("flat mirrors", "planar"),
];

fn capabilities() -> Figure {
    let techniques = ALL.map(|(_, technique)| match technique {
        // What the published technique does about mirrors in mirrors.
        "cubemap-trace" => "cubemap-trace(bounces=3)".to_owned(),
        other => other.to_owned(),
    });
    let series = |(label, scene): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: techniques
            .iter()
            .enumerate()
            .map(|(x, technique)| point(x, scene, technique))
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
        axis: names("technique", ALL.map(|(label, _)| label)),
        series: ABILITIES.iter().map(series).collect(),
        quantities: vec![
            Quantity::linear("right object, first bounce", AGREEMENT),
            Quantity::linear(
                "right object, mirrors in mirrors",
                "against_full.object_agreement",
            ),
            Quantity::log("time to prepare (ms)", "time_ms.prepare"),
            Quantity::log("time of a frame (ms)", FRAME_MS),
        ],
        quotes: Vec::new(),
        analysis: refusals,
    }
}

/// Why techniques do not apply.
fn refusals(results: &Results<'_>) -> Vec<String> {
    let points = results.series().iter().flat_map(|series| &series.points);
    let mut sentences: Vec<String> = Vec::new();
    for point in points {
        let reason = results.row(point).and_then(|row| row.reason.clone());
        if let Some(reason) = reason {
            sentences.push(format!("{} on {}: {reason}.", point.technique, point.scene));
        }
    }
    sentences
}

/// Ending and vertices of a family of scenes that differ only in how finely a square is cut.
const GROWING: [(&str, u32); 4] = [
    ("100", 100),
    ("1k", 1_024),
    ("10k", 10_000),
    ("100k", 99_856),
];

fn growth() -> Figure {
    let techniques = [
        ("cubemap trace", "cubemap-trace(pyramid=sound)"),
        (
            "cubemap trace, redrawn",
            "cubemap-trace(pyramid=sound,update=frame)",
        ),
        ("environment map", "environment-map"),
        ("linear", "linear"),
        ("ray trace (control)", "ray-trace"),
    ];
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
            "The thesis claims a cost that does not depend on the scene's geometry. It holds for \
                   tracing in maps that stand; a map drawn anew costs what its scene costs."
                .to_owned(),
        axis: Axis::log("vertices"),
        series: techniques.iter().map(series).collect(),
        quantities: vec![
            Quantity::log("tracing pass (ms)", "time_ms.passes.trace"),
            Quantity::log("time of a frame (ms)", FRAME_MS),
            Quantity::linear("samples per mirror pixel", super::SAMPLES),
            Quantity::linear("share of pixels unresolved", UNRESOLVED),
        ],
        quotes: Vec::new(),
        analysis: |results| {
            let series = results.series().iter();
            let sentences = series.filter_map(|series| {
                let frame = power(&results.curve(&series.label, FRAME_MS))?;
                let trace = power(&results.curve(&series.label, "time_ms.passes.trace"));
                let trace = trace.map_or_else(String::new, |power| {
                    format!("; its tracing pass as that to the power {}", short(power))
                });
                Some(format!(
                    "“{}”: a frame grows as the vertices to the power {}{trace}.",
                    series.label,
                    short(frame)
                ))
            });
            sentences.collect()
        },
    }
}

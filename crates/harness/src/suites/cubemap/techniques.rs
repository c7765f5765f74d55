//! Techniques beside each other: all of them, what they can do (Table 5.1), and how the cost grows
//! with the scene.

use crate::show::number::{count, percent, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, PREPARE_MS, SAMPLES, TRACE_MS, UNRESOLVED,
};
use crate::suites::results::Results;
use crate::suites::results::{power, power_error};
use crate::suites::series::{Point, Series};
use crate::suites::shelf;

use super::data::point;

/// A cost that grows as the scene to a smaller power counts as flat.
const FLAT: f64 = 0.05;

/// Label and technique.
const ALL: [(&str, &str); 9] = [
    shelf::LINEAR,
    shelf::LINEAR_CROSS,
    shelf::RAY_HIERARCHY,
    shelf::ENVIRONMENT_MAP,
    shelf::ENVIRONMENT_MAP_REDRAWN,
    shelf::PLANAR,
    shelf::CUBEMAP_PUBLISHED,
    shelf::CUBEMAP,
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
const ABILITIES: [(&str, &str); 4] = [
    ("near objects", "sphere-objects-1k"),
    ("touching objects", "sphere-touching"),
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
        analysis: abilities,
    }
}

/// The table in words, a technique a sentence: the right object where each ability is asked for, or
/// why the technique does not apply there, and what it costs.
fn abilities(results: &Results<'_>) -> Vec<String> {
    let technique = |(place, (label, _)): (usize, &(&str, &str))| {
        let abilities = results.series().iter().filter_map(|series| {
            let point = series.points.get(place)?;
            let row = results.row(point)?;
            let what = match &row.reason {
                Some(reason) => format!("does not apply ({reason})"),
                None => percent(results.value(point, judged_by(&series.label))?),
            };
            Some(format!("{} {what}", series.label))
        });
        let abilities: Vec<_> = abilities.collect();
        let points = results
            .series()
            .iter()
            .filter_map(|series| series.points.get(place));
        let known = points
            .clone()
            .filter_map(|point| results.value(point, FRAME_MS));
        let frames: Vec<f64> = known.collect();
        let prepared = points.filter_map(|point| results.value(point, PREPARE_MS));
        let range = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(0.0, f64::max);
            format!("{} to {} ms", short(least), short(most))
        };
        (!frames.is_empty()).then(|| {
            let prepared: Vec<f64> = prepared.collect();
            format!(
                "{label}: {}; a frame takes {}, preparing {}.",
                abilities.join("; "),
                range(&frames),
                range(&prepared)
            )
        })
    };
    ALL.iter().enumerate().filter_map(technique).collect()
}

/// Mirrors in mirrors are held against the truth that has them.
fn judged_by(ability: &str) -> &'static str {
    match ability {
        IN_MIRRORS => FULL_AGREEMENT,
        _ => AGREEMENT,
    }
}

/// Ending and vertices of a family of scenes that differ only in how finely a square is cut.
const GROWING: [(&str, u32); 4] = [
    ("100", 100),
    ("1k", 1_024),
    ("10k", 10_000),
    ("100k", 99_856),
];

/// Label and technique; the first one is what the claim is about.
const GROWTH: [(&str, &str); 5] = [
    ("cubemap trace", "cubemap-trace(pyramid=sound)"),
    (
        "cubemap trace, redrawn",
        "cubemap-trace(pyramid=sound,update=frame)",
    ),
    ("environment map", "environment-map"),
    ("linear", "linear"),
    ("ray trace (control)", "ray-trace"),
];

/// A power, and how sure it is.
fn with_error(power: f64, error: Option<f64>) -> String {
    let error = error.map_or_else(String::new, |error| format!(" ± {}", short(error)));
    format!("{}{error}", short(power))
}

/// Whether tracing costs the same whatever the scene's size: by what is counted, and by the time of
/// the pass, which counts as flat where its power is small or no larger than its noise.
fn claimed(results: &Results<'_>, label: &str) -> Option<String> {
    let samples = results.curve(label, SAMPLES);
    let times = results.curve(label, TRACE_MS);
    let counted = power(&samples)?;
    let (timed, error) = (power(&times)?, power_error(&times));
    let by_count = counted.abs() < FLAT;
    let by_time = timed.abs() < FLAT.max(2.0 * error.unwrap_or(0.0));
    let verdict = match (by_count, by_time) {
        (true, true) => "the claim holds for tracing, as far as the number of triangles goes",
        (true, false) => "the claim holds for what is looked up, but not for the time",
        (false, true) => "the claim holds for the time, but not for what is looked up",
        (false, false) => "the claim does not hold",
    };
    let (least, most) = (samples.first()?, samples.last()?);
    Some(format!(
        "“{label}”: from {} to {} vertices a mirror pixel takes {} and {} samples, and the tracing pass \
         grows as the vertices to the power {}: {verdict}.",
        count(least.0 as u64),
        count(most.0 as u64),
        short(least.1),
        short(most.1),
        with_error(timed, error),
    ))
}

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
            Quantity::linear(SAMPLES),
            Quantity::linear(UNRESOLVED),
        ],
        quotes: &[],
        analysis: |results| {
            let verdict = claimed(results, GROWTH[0].0);
            let series = results.series().iter();
            let frames = series.filter_map(|series| {
                let curve = results.curve(&series.label, FRAME_MS);
                Some(format!(
                    "“{}”: a whole frame grows as the vertices to the power {}, the scene itself being \
                     drawn in it.",
                    series.label,
                    with_error(power(&curve)?, power_error(&curve)),
                ))
            });
            verdict.into_iter().chain(frames).collect()
        },
    }
}

//! `catoptric bench papers`: the techniques of all four papers side by side, in one table and, scene
//! by scene, error against time.

use crate::record::technique::properties;
use crate::show::number::percent;
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, ANGLE, FLIP, FRAME_MS};
use crate::suites::results::Results;
use crate::suites::series::{Point, Series};
use crate::suites::shelf;
use crate::suites::suite::{Asked, Budget, Layout, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "papers",
    title: "The four papers side by side",
    why: "Which technique of which paper is exact where, at what cost?",
    figures,
    pictures: None,
    timing: Budget::Whole(120.0),
    resolution: None,
    layout: Layout::Figures,
};

/// Small enough that all of them can be measured on a software adapter.
const SIZE: [u32; 2] = [240, 180];

/// Label and technique, paper by paper: Szabo's searches and refinements (to level 2, where the scene
/// of most triangles, `planar`, has 820 000), Estalella's as the paper runs them, what games use, Číž's as published and as we correct it, and the control.
const TECHNIQUES: [(&str, &str); 12] = [
    shelf::LINEAR,
    shelf::RAY_HIERARCHY,
    ("linear+full", "linear+full(level=2)"),
    ("linear+adaptive", "linear+adaptive(level=2)"),
    shelf::REFLECTOR_CUBEMAP,
    (
        "reflector cubemap+grid",
        "reflector-cubemap(hidden=extend,depth=virtual)+grid",
    ),
    shelf::ENVIRONMENT_MAP,
    shelf::ENVIRONMENT_MAP_REDRAWN,
    shelf::PLANAR,
    shelf::CUBEMAP_PUBLISHED,
    shelf::CUBEMAP,
    shelf::CONTROL,
];

/// Scenes of all four papers.
const SCENES: [&str; 8] = [
    "sphere-table",
    "sphere-objects-1k",
    "ellipsoid",
    "bowl",
    "planar",
    "kitchen",
    "box",
    "room",
];

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    let scene = asked.scene;
    let Some(scene) = scene else {
        let scatters = SCENES.map(|scene| scatter(scene, scene));
        return [table(&SCENES)].into_iter().chain(scatters).collect();
    };
    vec![table(&[scene]), scatter("scatter", scene)]
}

fn point(x: usize, scene: &str, technique: &str) -> Point {
    Point {
        resolution: Some(SIZE),
        ..Point::new(x as f64, scene, technique)
    }
}

fn quantities() -> Vec<Quantity> {
    vec![
        Quantity::log(ANGLE),
        Quantity::linear(AGREEMENT),
        Quantity::linear(FLIP),
    ]
}

fn table(scenes: &[&str]) -> Figure {
    let series = |scene: &&str| Series {
        label: (*scene).to_owned(),
        points: TECHNIQUES
            .iter()
            .enumerate()
            .map(|(x, (_, technique))| point(x, scene, technique))
            .collect(),
    };
    Figure {
        anchor: "all",
        title: "All techniques".to_owned(),
        after: "all four papers",
        question:
            "The same scenes by every technique. Where one has no point it does not apply, for \
                   the reason given below."
                .to_owned(),
        axis: Axis::names("technique", TECHNIQUES.map(|(label, _)| label)),
        series: scenes.iter().map(series).collect(),
        quantities: [quantities(), vec![Quantity::log(FRAME_MS)]].concat(),
        quotes: &[],
        analysis: |results| {
            results
                .series()
                .iter()
                .filter_map(|one| best(results, one))
                .collect()
        },
    }
}

fn best(results: &Results<'_>, series: &Series) -> Option<String> {
    let points = series.points.iter();
    let points = points.filter(|point| !properties(&point.technique).is_control);
    let known = points.filter_map(|point| Some((results.value(point, AGREEMENT)?, point)));
    let (agreement, point) = known.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "{}: of all but the control, {} has the right object most often, on {} of the mirror pixels.",
        series.label,
        point.technique,
        percent(agreement)
    ))
}

fn scatter(anchor: &'static str, scene: &str) -> Figure {
    let series = |(label, technique): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: vec![Point {
            along: Some(FRAME_MS),
            ..point(0, scene, technique)
        }],
    };
    Figure {
        anchor,
        title: format!("Error against time: {scene}"),
        after: "all four papers",
        question: "Better is further down and to the left (up for shares). The control traces the \
                   reference's rays on the GPU: what it is off by is the floor of the measurement."
            .to_owned(),
        axis: Axis::log("time of a frame (ms)"),
        series: TECHNIQUES.iter().map(series).collect(),
        quantities: quantities(),
        quotes: &[],
        analysis: |results| front(results).into_iter().collect(),
    }
}

/// Which techniques no other one beats in both time and angle.
fn front(results: &Results<'_>) -> Option<String> {
    let series = results.series().iter();
    let known = series.filter_map(|series| {
        let point = series.points.first()?;
        let is_control = properties(&point.technique).is_control;
        let place = (
            results.value(point, FRAME_MS)?,
            results.value(point, ANGLE)?,
        );
        (!is_control).then_some((series.label.as_str(), place))
    });
    let known: Vec<_> = known.collect();
    let beaten = |(time, angle): (f64, f64)| {
        let mut others = known.iter().map(|(_, place)| *place);
        others.any(|(t, a)| t <= time && a <= angle && (t < time || a < angle))
    };
    let mut left: Vec<_> = known.iter().filter(|(_, place)| !beaten(*place)).collect();
    left.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
    let names: Vec<&str> = left.iter().map(|(label, _)| *label).collect();
    (!names.is_empty()).then(|| {
        format!(
            "From the fastest to the most exact, no other technique beats in both time and median \
             angle: {}.",
            names.join("; ")
        )
    })
}

//! `catoptric bench papers`: the techniques of all four papers side by side, in one table and, scene
//! by scene, error against time. At its end stand all claims of the papers: the figures of the other
//! suites that decide them are measured too, in a small size.

use crate::show::plot::Axis;
use crate::suites::claims::make::{claim, difference, value};
use crate::suites::claims::{Claim, EVERY, Limit, Noise, Paper, Pick, Place, Shown, Term, of};
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, ANGLE, FLIP, FRAME_MS};
use crate::suites::series::{Point, Series};
use crate::suites::shelf;
use crate::suites::suite::{Asked, Budget, Layout, Suite};
use crate::suites::{control, cubemap, estalella, ledger, search, tessellation};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "papers",
    title: "The four papers side by side",
    why: "Which technique of which paper is exact where, at what cost?",
    figures,
    judged: Some(judged),
    pictures: None,
    timing: Budget::Whole(180.0),
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
        claims: ALL,
    }
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
        claims: &[],
    }
}

/// Size of what decides the claims.
const JUDGED: [u32; 2] = [160, 120];

/// The figures of the other suites under which a paper's claim stands.
fn judged(scene: Option<&str>) -> Vec<(&'static str, Figure)> {
    if scene.is_some() {
        return Vec::new();
    }
    let suites = [
        &search::SUITE,
        &tessellation::SUITE,
        &estalella::SUITE,
        &cubemap::SUITE,
        &control::SUITE,
        &SUITE,
    ];
    let figures = suites.into_iter().flat_map(|suite| {
        let figures = (suite.figures)(&Asked::default()).into_iter();
        figures.map(|figure| (suite.name, figure))
    });
    let figures = figures.map(|(suite, figure)| (suite, ledger::pared(&figure)));
    let mut figures: Vec<_> = figures
        .filter(|(_, figure)| !figure.series.is_empty())
        .collect();
    for (suite, figure) in &mut figures {
        for point in figure
            .series
            .iter_mut()
            .flat_map(|series| &mut series.points)
        {
            point.picture = false;
            if *suite != SUITE.name {
                point.resolution = Some(JUDGED);
            }
        }
    }
    figures
}

/// In every scene, the technique of that place.
const fn every(place: usize) -> Pick {
    of(EVERY, Place::At(place as f64))
}

const RIGHT: Term = Term::Path(AGREEMENT);
const ROUNDING: Noise = Noise::Plus(0.001);
const EXACT: &str = "95 of 100 mirror pixels show the right object.";

const ALL: &[Claim] = &[
    claim(
        Paper::Szabo2013,
        "1.3, 7.2",
        "The linear search reflects accurately.",
        value(
            every(0),
            RIGHT,
            Limit::Above(0.95),
            ROUNDING,
            Shown::Percent,
        ),
        EXACT,
    ),
    claim(
        Paper::SzaboCescg,
        "5.1, 6",
        "With adaptive tessellation it reflects accurately without any preparation of the models.",
        value(
            every(3),
            RIGHT,
            Limit::Above(0.95),
            ROUNDING,
            Shown::Percent,
        ),
        EXACT,
    ),
    claim(
        Paper::Estalella2005,
        "8",
        "The search in reflector cube maps reflects very accurately.",
        value(
            every(4),
            RIGHT,
            Limit::Above(0.95),
            ROUNDING,
            Shown::Percent,
        ),
        EXACT,
    ),
    claim(
        Paper::Estalella2005,
        "8",
        "Environment maps, even if made in every frame, are too inexact.",
        difference(every(4), every(7), RIGHT, Limit::Above(0.01), ROUNDING),
        "the share of right mirror pixels that the search has more: one in a hundred can be told.",
    ),
    claim(
        Paper::Ciz2017,
        "5",
        "Cubemap tracing compares with ray tracing.",
        value(
            every(9),
            RIGHT,
            Limit::Above(0.95),
            ROUNDING,
            Shown::Percent,
        ),
        EXACT,
    ),
    claim(
        Paper::Ours,
        "",
        "Cubemap tracing as corrected here is more exact.",
        difference(every(10), every(9), RIGHT, Limit::Above(0.0), ROUNDING),
        "the share of right mirror pixels that the corrected one has more.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suites::plan;

    #[test]
    fn what_decides_the_claims_is_not_all_that_the_suites_measure() {
        let figures = judged(None).into_iter().map(|(_, figure)| figure);
        let own = figures_of_the_page().into_iter();
        let all: Vec<Figure> = own.chain(figures).collect();
        let jobs = plan::wanted(&all, SUITE.timing);
        let rows: usize = jobs.iter().map(|job| job.techniques.len()).sum();
        assert!((200..500).contains(&rows), "{rows}");
    }

    fn figures_of_the_page() -> Vec<Figure> {
        figures(&Asked::default())
    }
}

//! `catoptric bench search`: the linear search against the ray hierarchy, Szabo 2013, chapters 4
//! and 6.
//!
//! Scenes of objects and the cases with holes and with an early stop (Fig. 4.3), frame and search
//! time against the number of vertices (Fig. 6.1 and 6.2), how exact the answers are on points with
//! known reflection points, and how steady they are on a slow camera path. Each with both searches
//! cold, the linear one warm, and all repairs of the hierarchy; times, counted work and accuracy on
//! the same axes. Maps (Fig. 3.1) and paths (Fig. 4.2) as pictures.

mod claims;
mod data;
mod labels;
mod more;
mod pictures;
mod recall;

use crate::show::plot::Axis;
use crate::suites::claims::Claim;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    EVALUATIONS, FRAME_MS, JITTER_MAX, JITTER_MEAN, JUMPS, MEAN_PX, MOVING_MS, NODE_TESTS, P95_PX,
    SEARCH_MS, STEPS, STILL_MS,
};
use crate::suites::series::{Point, Series};
use crate::suites::shelf::CONTROL;
use crate::suites::suite::{Asked, Budget, Layout, Suite};

use self::data::{CASES, FRAMES, MESH, MOVING, QUOTES, SEARCHES, SIZES, SWEPT, SWEPT_WARM};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "search",
    title: "Searches for reflection points: linear against hierarchy",
    why: "What does it cost to find where each vertex is seen in the mirror, how does the cost grow \
          with the vertices, and how exact and steady are the answers? The comparison of the thesis \
          that proposed both searches, repeated.",
    figures,
    judged: None,
    pictures: Some(pictures::make),
    timing: Budget::Whole(110.0),
    resolution: None,
    layout: Layout::Figures,
};

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    let scene = asked.scene;
    if let Some(scene) = scene {
        return vec![
            objects(&[(scene, scene)], &[], claims::SCENE),
            motion(&[(scene, scene)]),
        ];
    }
    let mut figures = vec![
        objects(&CASES, &QUOTES, claims::OBJECTS),
        growth(
            "vertices",
            "Cost against the number of vertices",
            "Szabo 2013, Fig. 6.1",
            "A square before a mirror sphere, cut finer and finer, no vertex hidden; the mirror is a part of the picture.",
            "sphere-grid-",
            claims::GENERAL_VIEW,
        ),
        growth(
            "vertices-full",
            "The same where the reflection fills the view",
            "Szabo 2013, Fig. 6.2",
            "Every pixel is a mirror pixel and nearly every one shows the square, so that walks lead everywhere.",
            "sphere-grid-full-",
            claims::FULL_VIEW,
        ),
        exactness(),
        recall::figure(),
        motion(&MOVING),
    ];
    figures.extend(more::figures());
    figures
}

/// Every search on a few scenes.
fn series(scenes: &[(&str, &str)], point: impl Fn(Point) -> Point) -> Vec<Series> {
    let all = SEARCHES.iter();
    all.map(|search| one(search, scenes, &point)).collect()
}

/// One search, by label and technique.
fn one(
    (label, technique): &(&str, &str),
    scenes: &[(&str, &str)],
    point: impl Fn(Point) -> Point,
) -> Series {
    Series {
        label: (*label).to_owned(),
        points: (scenes.iter().enumerate())
            .map(|(x, (_, scene))| point(Point::new(x as f64, *scene, *technique)))
            .collect(),
    }
}

/// What an application would use instead, and the harness's own noise.
fn control(scenes: &[(&str, &str)]) -> Series {
    let point = |(x, (_, scene)): (usize, &(&str, &str))| Point::new(x as f64, *scene, CONTROL.1);
    Series {
        label: "rays traced (control)".to_owned(),
        points: scenes.iter().enumerate().map(point).collect(),
    }
}

/// Fig. 4.3.
fn objects(scenes: &[(&str, &str)], quotes: &'static [Quote], claims: &'static [Claim]) -> Figure {
    Figure {
        anchor: "objects",
        title: "Both searches, with and without repairs".to_owned(),
        after: "Szabo 2013, Fig. 4.3",
        question:
            "The same picture by every search: its time, its work and its error. The hierarchy \
                   has holes between its cones; a vertex in one is placed somewhere (no repair), \
                   searched again in enlarged cones, or answered at a higher level."
                .to_owned(),
        axis: Axis::names("scene", scenes.iter().map(|(name, _)| *name)),
        series: (series(scenes, Point::shown).into_iter())
            .chain([one(&MESH, scenes, Point::shown), control(scenes)])
            .collect(),
        quantities: quantities(Quantity::linear),
        quotes,
        claims,
    }
}

/// Fig. 6.1 and 6.2.
fn growth(
    anchor: &'static str,
    title: &str,
    after: &'static str,
    question: &str,
    family: &str,
    claims: &'static [Claim],
) -> Figure {
    let series = |(label, technique): &(&str, &str)| Series {
        label: (*label).to_owned(),
        points: SIZES
            .iter()
            .map(|(size, vertices)| {
                Point::new(f64::from(*vertices), format!("{family}{size}"), *technique)
            })
            .collect(),
    };
    Figure {
        anchor,
        title: title.to_owned(),
        after,
        question: question.to_owned(),
        axis: Axis::log("vertices"),
        series: (SEARCHES.iter().chain([&SWEPT, &SWEPT_WARM]).map(series)).collect(),
        quantities: quantities(Quantity::log),
        quotes: &[],
        claims,
    }
}

fn quantities(time: fn(&'static str) -> Quantity) -> Vec<Quantity> {
    vec![
        time(FRAME_MS),
        time(SEARCH_MS).called("search pass (ms)"),
        Quantity::linear(EVALUATIONS).called("error evaluations or ray distances per vertex"),
        Quantity::linear(NODE_TESTS).called("node tests per vertex"),
        Quantity::linear(STEPS).called("steps per vertex"),
        Quantity::linear(MEAN_PX),
        Quantity::linear("vertices.failed"),
    ]
}

/// Accuracy apart from drawing: points whose reflection points are known by construction.
fn exactness() -> Figure {
    let scenes = [
        ("sphere", "prototype-sphere"),
        ("ellipsoid", "prototype-ellipsoid"),
        ("bowl", "prototype-bowl"),
    ];
    Figure {
        anchor: "exactness",
        title: "How far from the true reflection point".to_owned(),
        after: "Szabo 2013, section 4.2",
        question: "Points without triangles, placed so that each has a reflection point in view. The \
                   distance of a pixel centre from a point in that pixel is 0.38 pixels in the mean: \
                   no search that answers with a pixel does better. The thesis searches on the mirror as \
                   it is drawn, a mesh with interpolated normals; the others here on the exact surface."
            .to_owned(),
        axis: Axis::names("scene", scenes.map(|(name, _)| name)),
        series: (series(&scenes, |point| point).into_iter())
            .chain([one(&MESH, &scenes, |point| point)])
            .collect(),
        quantities: vec![
            Quantity::linear(MEAN_PX),
            Quantity::linear(P95_PX),
            Quantity::linear("vertices.offset_share.over_2"),
            Quantity::linear("vertices.failed"),
            Quantity::linear("vertices.hole"),
            Quantity::linear("vertices.recall"),
            Quantity::linear(NODE_TESTS).called("node tests per vertex"),
        ],
        quotes: &[],
        claims: claims::EXACTNESS,
    }
}

/// Jitter, and what motion costs.
fn motion(scenes: &[(&str, &str)]) -> Figure {
    Figure {
        anchor: "motion",
        title: "On a slow camera path".to_owned(),
        after: "Szabo 2013, sections 4.2 and 6.1",
        question:
            "The camera moves so slowly that true reflection points move by parts of a pixel. \
                   Jitter is how much a vertex' error changes from one frame to the next; a change \
                   of more than 2 pixels is a jump. A scene whose file has no motion stands still."
                .to_owned(),
        axis: Axis::names("scene", scenes.iter().map(|(name, _)| *name)),
        series: series(scenes, |point| Point {
            frames: Some(FRAMES),
            ..point
        }),
        quantities: vec![
            Quantity::linear(JITTER_MEAN),
            Quantity::linear("temporal.jitter_px.p99"),
            Quantity::linear(JITTER_MAX),
            Quantity::linear(JUMPS),
            Quantity::linear(MOVING_MS),
            Quantity::linear(STILL_MS),
            Quantity::linear("temporal.steps").called("steps per vertex, from the second frame"),
        ],
        quotes: &[],
        claims: claims::MOTION,
    }
}

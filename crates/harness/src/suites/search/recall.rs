//! How many of all reflection points each search finds, and for how much work.

use crate::show::plot::Axis;
use crate::suites::claims::make::{claim, difference, value};
use crate::suites::claims::{Claim, Limit, Noise, Paper, Shown, Term, each};
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    EVALUATIONS, FAILED, MEAN_PX, NODE_TESTS, RECALL, SEARCH_MS, SPURIOUS, WORK,
};
use crate::suites::series::{Point, Series};

use super::data::{ENLARGED, LINEAR, RAW, STOPPED, SWEPT};
use super::labels::REFLECTOR;

const NEWTON: &str = "Newton";

/// A mirror of each kind.
const SCENES: [(&str, &str); 6] = [
    ("sphere", "prototype-sphere"),
    ("ellipsoid", "prototype-ellipsoid"),
    ("bowl", "prototype-bowl"),
    ("torus", "torus"),
    ("saddle", "saddle"),
    ("mesh", "faceted"),
];

/// Label, technique, and how many of the scenes it can search, in their order.
const SEARCHES: [(&str, &str, usize); 7] = [
    (LINEAR, "linear", 6),
    (RAW, "ray-hierarchy", 6),
    (ENLARGED, "ray-hierarchy(repair=enlarge)", 6),
    (STOPPED, "ray-hierarchy(repair=stop)", 6),
    // Neither the torus nor the saddle is seen whole from a centre.
    (REFLECTOR, "reflector-cubemap(iterations=40,sheets=all)", 3),
    (NEWTON, "newton", 6),
    (SWEPT.0, SWEPT.1, 6),
];

/// The figure.
pub fn figure() -> Figure {
    let series = SEARCHES.map(|(label, technique, scenes)| {
        let scenes = SCENES[..scenes].iter().enumerate();
        let points = scenes.map(|(x, (_, scene))| Point::new(x as f64, *scene, technique));
        Series::new(label, points)
    });
    Figure {
        anchor: "recall",
        title: "All reflection points: found, and at what cost".to_owned(),
        after: "Szabo 2013, section 3.2",
        question: "In a mirror that is not convex a vertex may be seen several times. How many of the true \
                   reflection points in view does a search find, and how much does it look at for that?"
            .to_owned(),
        axis: Axis::names("mirror", SCENES.map(|(name, _)| name)),
        series: series.into(),
        quantities: vec![
            Quantity::linear(RECALL),
            Quantity::linear(WORK).called("looks at texels per vertex"),
            Quantity::linear(EVALUATIONS).called("evaluations per vertex"),
            Quantity::linear(NODE_TESTS).called("node tests per vertex"),
            Quantity::linear(SEARCH_MS).called("search pass (ms)"),
            Quantity::linear(MEAN_PX),
            Quantity::linear(SPURIOUS),
            Quantity::linear(FAILED),
        ],
        quotes: &[],
        claims: CLAIMS,
    }
}

const CLAIMS: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "It finds practically all reflection points.",
        value(
            each(SWEPT.0),
            Term::Path(RECALL),
            Limit::Above(0.999),
            Noise::Exact,
            Shown::Percent,
        ),
        "one in a thousand missed: those of the outermost pixel, and of two that are about to meet.",
    ),
    claim(
        Paper::Ours,
        "",
        "It finds more than the linear search wherever a vertex may have several.",
        difference(
            each(SWEPT.0),
            each(LINEAR),
            Term::Path(RECALL),
            Limit::Above(0.0),
            Noise::Plus(0.001),
        ),
        "a search that gives one answer a vertex can find no other; on convex mirrors there is none.",
    ),
];

//! What this project says about splitting by pixels.

use crate::suites::claims::make::{claim, ratio, value};
use crate::suites::claims::{
    Case, Claim, Interval, Limit, Measure, Noise, Numbers, Paper, Place, Rule, Shown, Term, Which,
    at, of,
};
use crate::suites::paths::{
    ANGLE_P99, CRACK_PIXELS, DRAWN, JUNCTIONS, MOST_CRACKED, MOST_JUNCTIONS,
};

use super::data::{ADAPTIVE, FULL, PIXEL};
use super::labels::{LARGE_MIRROR, SMALL_MIRROR, TO_FIVE};

const OURS: Paper = Paper::Ours;
const COUNTED: &str = "counted exactly.";
const INTERPOLATED: &str = "triangles are counted; between two measured points of a curve lies a straight line in the \
                            logarithms of triangles and error.";

/// The limit level of the full tessellation that others are compared with, which is its place among those measured.
const COMPARED: usize = 2;

/// No pixel, no T-junction.
const fn none(place: Place, says: &'static str, path: &'static str, unit: &'static str) -> Claim {
    claim(
        OURS,
        "",
        says,
        value(
            of(Which::Named(PIXEL), place),
            Term::Path(path),
            Limit::Between(0.0, 0.0),
            Noise::Exact,
            Shown::In(unit),
        ),
        COUNTED,
    )
}

const SOUND: Claim = none(
    Place::Most,
    "Split by pixels, edge by edge, the surface has no T-junction.",
    JUNCTIONS,
    "T-junctions",
);
const WHOLE_SURFACE: Claim = none(
    Place::Most,
    "Split by pixels, edge by edge, the surface has no crack.",
    CRACK_PIXELS,
    "pixels in cracks",
);
/// While the camera moves.
pub const UNBROKEN: Claim = none(
    Place::Each,
    "Split by pixels, the surface has no crack in any frame of a path.",
    MOST_CRACKED,
    "pixels in cracks",
);
/// While the camera moves.
pub const WITHOUT_JUNCTIONS: Claim = none(
    Place::Each,
    "Split by pixels, the surface has no T-junction in any frame of a path.",
    MOST_JUNCTIONS,
    "T-junctions",
);
/// On the scene that is made to crack.
pub const WHOLE: Claim = claim(
    OURS,
    "",
    "Split by pixels, the scene that is made to crack does not.",
    value(
        at(TO_FIVE, 6.0),
        Term::Sum(&[CRACK_PIXELS, "coverage.holes", JUNCTIONS]),
        Limit::Between(0.0, 0.0),
        Noise::Exact,
        Shown::In("pixels in cracks, holes and T-junctions"),
    ),
    COUNTED,
);
/// A mirror near and far.
pub const SMALLER: Claim = claim(
    OURS,
    "",
    "Split by pixels, a mirror that is small in the picture is split less.",
    ratio(
        at(SMALL_MIRROR, 1.0),
        at(LARGE_MIRROR, 1.0),
        Term::Path(DRAWN),
        Limit::Below(0.8),
        Noise::Exact,
    ),
    "triangles are counted: a fifth less is less.",
);

const fn triangles(says: &'static str, of: fn(&dyn Numbers) -> Vec<Case>, most: f64) -> Claim {
    let rule = Rule {
        of: Measure::Own(of, &[ANGLE_P99]),
        is: Limit::Below(most),
        noise: Noise::Exact,
        shown: Shown::Times,
    };
    claim(OURS, "", says, rule, INTERPOLATED)
}

const FEWER_THAN_ADAPTIVE: Claim = triangles(
    "For the error that full tessellation has at level 2 (99th percentile), splitting by pixels needs fewer triangles \
     than adaptive tessellation.",
    over_adaptive,
    1.0,
);

/// Error against triangles, of two triangles.
pub const SQUARE: &[Claim] = &[
    SOUND,
    WHOLE_SURFACE,
    triangles(
        "For the error that full tessellation has at level 2 (99th percentile), splitting by pixels needs fewer \
         triangles.",
        over_full,
        1.0,
    ),
    FEWER_THAN_ADAPTIVE,
];

/// Error against triangles, of many.
pub const MANY: &[Claim] = &[
    SOUND,
    WHOLE_SURFACE,
    triangles(
        "For the error that full tessellation has at level 2 (99th percentile), splitting by pixels needs a quarter of \
         its triangles.",
        over_full,
        0.25,
    ),
    FEWER_THAN_ADAPTIVE,
];

fn over_full(from: &dyn Numbers) -> Vec<Case> {
    cases(from, |triangles, _| Some(triangles))
}

fn over_adaptive(from: &dyn Numbers) -> Vec<Case> {
    cases(from, |_, error| triangles_for(from, ADAPTIVE, error))
}

/// Triangles of splitting by pixels over those of another, at the error that full tessellation has with so many
/// triangles.
fn cases(from: &dyn Numbers, other: impl Fn(f64, f64) -> Option<f64>) -> Vec<Case> {
    let number = || {
        let triangles = *from.places(FULL).get(COMPARED)?;
        let error = from.at(FULL, triangles, ANGLE_P99)?;
        let others = other(triangles, error);
        let ours = triangles_for(from, PIXEL, error);
        Some(Interval::exact(ours? / others?))
    };
    let case = |number| Case {
        label: String::new(),
        number,
    };
    number().map(case).into_iter().collect()
}

/// Triangles with which a series comes to an error.
fn triangles_for(from: &dyn Numbers, series: &str, error: f64) -> Option<f64> {
    let places = from.places(series).into_iter();
    let points = places.filter_map(|x| Some((x, from.at(series, x, ANGLE_P99)?)));
    let mut points: Vec<(f64, f64)> = points.collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (first, first_error) = *points.first()?;
    if first_error <= error {
        return Some(first);
    }
    let around = points.windows(2).find(|pair| pair[1].1 <= error)?;
    let [(few, worse), (many, better)] = [around[0], around[1]];
    let share = (worse / error).ln() / (worse / better).ln();
    Some((few.ln() + share * (many / few).ln()).exp())
}

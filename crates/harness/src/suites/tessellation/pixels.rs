//! Ours against the papers': how many triangles an error takes.

use crate::show::plot::Axis;
use crate::suites::claims::Claim;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, ANGLE_P99, CRACK_PIXELS, DRAWN, JUNCTIONS, REFINE_MS, SEARCHED,
};
use crate::suites::series::{Point, Series};

use super::data::{ADAPTIVE, EXACT, FULL, PIXEL, pixel};

/// Largest deviations, pixels.
const ERRORS: [&str; 5] = ["4", "2", "1", "0.5", "0.25"];
const THRESHOLDS: [&str; 5] = ["0.1", "0.01", "0.001", "0.0001", "0.00001"];
/// Of full and adaptive: at one more, adaptive searches half a million points before the ellipsoid.
const LEVELS: u32 = 3;

/// The size of what is measured.
const SIZE: [u32; 2] = [320, 240];

/// Error against triangles, of one scene.
pub fn curve(anchor: &'static str, scene: &str, claims: &'static [Claim]) -> Figure {
    let series = |label, techniques: Vec<String>| {
        let points = techniques.into_iter().map(|technique| Point {
            resolution: Some(SIZE),
            along: Some(DRAWN),
            ..Point::new(0.0, scene, technique)
        });
        Series::new(label, points)
    };
    let newton = |refinement: String| format!("newton(hidden=extend)+{refinement}");
    let full = (0..=LEVELS).map(|level| newton(format!("full(level={level})")));
    let adaptive = THRESHOLDS
        .map(|threshold| newton(format!("adaptive(level={LEVELS},threshold={threshold})")));
    let exact = ERRORS.map(|error| pixel(error).replace("extend", "extend,fragments=exact"));
    Figure {
        anchor,
        title: format!("Error against triangles: {scene}"),
        after: "this project",
        question: "Each refinement from coarse to fine, with the same search: full by its level limit, adaptive by its \
                   threshold, by pixels by the deviation of edges that it allows. Which has the least error for \
                   its triangles, and which tears the surface?"
            .to_owned(),
        axis: Axis::log("triangles drawn"),
        series: vec![
            series(FULL, full.collect()),
            series(ADAPTIVE, adaptive.to_vec()),
            series(PIXEL, ERRORS.map(pixel).to_vec()),
            series(EXACT, exact.to_vec()),
        ],
        quantities: vec![
            Quantity::log(ANGLE_P99),
            Quantity::close(AGREEMENT),
            Quantity::log(SEARCHED),
            Quantity::linear(CRACK_PIXELS),
            Quantity::linear(JUNCTIONS),
            Quantity::log(REFINE_MS),
        ],
        quotes: &[],
        claims,
    }
}

//! What the figures share: scenes, techniques, numbers of the record, and what is said of them.

use crate::suites::figure::{Guide, Quantity};
use crate::suites::paths::{AGREEMENT, ANGLE, EDGES, FLOOR};
use crate::suites::series::{Point, Series};

pub const WHOLE_PIXELS: Guide = Guide {
    label: "whole pixels",
    path: FLOOR,
};

/// The thesis' scene, two triangles that crack, CESCG's coarse and fine models, and a mirror of facets.
pub const SQUARE: &str = "sphere-square";
pub const CRACK: &str = "crack";
pub const TABLE: &str = "sphere-table";
pub const FACETS: &str = "faceted";

/// The thesis' threshold.
pub const THRESHOLD: &str = "0.001";

/// On what both papers measured times.
pub const PAPERS: &str = "Core 2 Duo, GTX 260";

/// How both papers judged pictures.
pub const BY_EYE: &str = "judged by eye";
pub const MESH: &str = "adaptive, mirror as a mesh";
pub const NONE: &str = "none";
pub const FULL: &str = "full";
pub const ADAPTIVE: &str = "adaptive";
pub const PIXEL: &str = "by pixels";
pub const EXACT: &str = "by pixels, exact fragments";

pub fn full(level: u32) -> String {
    format!("linear+full(level={level})")
}

pub fn adaptive(level: u32, threshold: &str) -> String {
    format!("linear+adaptive(level={level},threshold={threshold})")
}

/// The deviation of edges that `+pixel` allows by itself, pixels.
pub const HALF: &str = "0.5";

/// By pixels, split so often at most.
pub fn pixel_to(level: u32) -> String {
    format!("newton(hidden=extend)+pixel(level={level})")
}

/// By pixels against the level limit.
pub fn pixels_by_level(levels: u32, point: impl Fn(f64, String) -> Point) -> Series {
    let points = (0..=levels).map(|level| point(f64::from(level), pixel_to(level)));
    Series::new(PIXEL, points)
}

/// By pixels, with a search that answers between them.
pub fn pixel(error: &str) -> String {
    format!("newton(hidden=extend)+pixel(error={error})")
}

/// Adaptive on the published maps: what the rasterizer interpolates between a mesh's corners.
pub fn adaptive_on_mesh(levels: u32, point: impl Fn(f64, String) -> Point) -> Series {
    let technique =
        |level: u32| format!("linear(gbuffer=mesh)+adaptive(level={level},threshold={THRESHOLD})");
    let points = (0..=levels).map(|level| point(f64::from(level), technique(level)));
    Series::new(MESH, points)
}

/// None, full and adaptive against the level limit.
pub fn three_modes(levels: u32, point: impl Fn(f64, String) -> Point) -> Vec<Series> {
    let points = |technique: &dyn Fn(u32) -> String| -> Vec<Point> {
        let at = |level: u32| point(f64::from(level), technique(level));
        (0..=levels).map(at).collect()
    };
    vec![
        Series::new(NONE, points(&|_| "linear".to_owned())),
        Series::new(FULL, points(&full)),
        Series::new(ADAPTIVE, points(&|level| adaptive(level, THRESHOLD))),
    ]
}

pub fn accuracy() -> Vec<Quantity> {
    vec![
        Quantity::linear(AGREEMENT),
        Quantity::log(ANGLE),
        Quantity::linear(EDGES),
    ]
}

pub fn quantities(first: impl IntoIterator<Item = Quantity>) -> Vec<Quantity> {
    first.into_iter().chain(accuracy()).collect()
}

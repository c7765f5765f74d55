//! `catoptric bench tessellation`: adaptive against full tessellation of the reflected geometry,
//! Szabo 2013, chapter 5 and section 6.2, and Szabo CESCG, section 5.
//!
//! What the papers show as pictures and times stands here beside what they could not measure:
//! error against a ray-traced truth, so that "almost no visible difference" becomes a number.
//! The thesis' figures are in `square`, those of the other paper in `table` and `facets`.

mod facets;
mod geometry;
mod square;
mod table;

use crate::plot::{Axis, Scale};
use crate::report::words::{count, short};

use super::{Figure, Guide, Point, Quantity, Results, Series, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "tessellation",
    title: "Tessellation of the reflected geometry",
    why: "Straight edges between reflection points are not the curves that the mirror shows. How \
          far must triangles be split, what does it cost, and what does splitting only where an \
          error asks for it save?",
    figures,
    pictures: Some(geometry::make),
    timing_s: 90.0,
};

const FRAME_MS: &str = "time_ms.frame.median";
const AGREEMENT: &str = "object_agreement";
const ANGLE: &str = "angular_error_deg.p50";
const EDGES: &str = "edge_offset_px.mean";
const CRACK_PIXELS: &str = "coverage.crack_pixels";
const JUNCTIONS: &str = "coverage.t_junctions";
/// What whole-pixel answers are off by, from the truth alone.
const FLOOR: &str = "pixel_angle_deg.p50";
const WHOLE_PIXELS: Guide = Guide {
    label: "whole pixels",
    path: FLOOR,
};
const SEARCHED: &str = "vertices.searched";
const DRAWN: &str = "triangles.drawn";

/// The thesis' scene, two triangles that crack, CESCG's coarse and fine models, and a mirror of facets.
const SQUARE: &str = "sphere-square";
const CRACK: &str = "crack";
const TABLE: &str = "sphere-table";
const FACETS: &str = "faceted";

/// The thesis' threshold.
const THRESHOLD: &str = "0.001";

/// On what both papers measured times.
const PAPERS: &str = "Core 2 Duo, GTX 260";
/// How both papers judged pictures.
const BY_EYE: &str = "judged by eye";

const NONE: &str = "none";
const FULL: &str = "full";
const ADAPTIVE: &str = "adaptive";

fn figures(scene: Option<&str>) -> Vec<Figure> {
    let square = scene.unwrap_or(SQUARE);
    let table = table::Place::of(scene);
    vec![
        square::straight(square),
        square::wireframes(square),
        square::by_level(square),
        square::visible_levels(square),
        square::cracks(scene.unwrap_or(CRACK)),
        table::coarse_and_fine(&table),
        table::thresholds(&table),
        table::counts(&table),
        facets::facets(scene.unwrap_or(FACETS)),
    ]
}

fn full(level: u32) -> String {
    format!("linear+full(level={level})")
}

fn adaptive(level: u32, threshold: &str) -> String {
    format!("linear+adaptive(level={level},threshold={threshold})")
}

/// Points at 0, 1, 2, …, one for each technique.
fn series(label: &str, points: impl IntoIterator<Item = Point>) -> Series {
    Series {
        label: label.to_owned(),
        points: points.into_iter().collect(),
    }
}

/// None, full and adaptive against the level limit.
fn three_modes(levels: u32, point: impl Fn(f64, String) -> Point) -> Vec<Series> {
    let points = |technique: &dyn Fn(u32) -> String| -> Vec<Point> {
        let at = |level: u32| point(f64::from(level), technique(level));
        (0..=levels).map(at).collect()
    };
    vec![
        series(NONE, points(&|_| "linear".to_owned())),
        series(FULL, points(&full)),
        series(ADAPTIVE, points(&|level| adaptive(level, THRESHOLD))),
    ]
}

fn accuracy() -> Vec<Quantity> {
    vec![
        Quantity::linear("right object (share of mirror pixels)", AGREEMENT),
        Quantity::log("median angular error (degrees)", ANGLE),
        Quantity::linear("mean offset of edges (px)", EDGES),
    ]
}

fn quantities(first: impl IntoIterator<Item = Quantity>) -> Vec<Quantity> {
    first.into_iter().chain(accuracy()).collect()
}

fn named(label: &str, names: &[&str]) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.iter().map(|name| (*name).to_owned()).collect()),
    }
}

/// What became of a paper's claim.
fn verdict(holds: bool) -> &'static str {
    if holds {
        "holds here"
    } else {
        "does not hold here"
    }
}

/// The share of full's triangles that adaptive does not make at the same limit.
fn spared(results: &Results<'_>) -> Option<String> {
    let (adaptive, full) = (results.last(ADAPTIVE)?, results.last(FULL)?);
    let (adaptive, full) = (adaptive.triangles.as_ref()?, full.triangles.as_ref()?);
    let limit = adaptive.by_level.len() - 1;
    Some(format!(
        "Allowed {limit} levels at a threshold of {THRESHOLD}, adaptive draws {} triangles where full draws \
         {}: {} % are spared.",
        count(adaptive.drawn),
        count(full.drawn),
        short(100.0 * (1.0 - adaptive.drawn as f64 / full.drawn as f64))
    ))
}

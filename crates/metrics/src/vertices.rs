//! Per-vertex answers of a search against the exact reflection points.

use catoptric_frame::{TrueVertex, VertexResult, Work};
use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::MetricsError;
use crate::stats::Summary;

/// The record's `vertices`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VertexReport {
    /// (object vertex, mirror) pairs.
    pub searched: u64,
    /// Of those, with a true reflection point in view.
    pub reflected: u64,
    /// Of those, behind the mirror's silhouette cone: without any reflection point.
    pub hidden: u64,
    /// Of `reflected`, those for which the search says that it has no answer.
    pub failed: u64,
    /// Found true solutions ÷ true solutions in view; found is within 0.75 px. `None` without any.
    pub recall: Option<f64>,
    /// Searches that met a gap in a hierarchy; `None` for searches without one.
    pub hole: Option<u64>,
    /// Searches that used the enlargement repair; `None` for searches without one.
    pub enlarged: Option<u64>,
    /// Distance between the found and the nearest true reflection point in pixels, over `reflected`
    /// without `failed`. `None` without any.
    pub offset_px: Option<Summary>,
    /// How many of those offsets are large, as shares.
    pub offset_share: Option<OffsetShare>,
    /// How the rule that drops vertices behind the mirror's tangent plane fared.
    pub discard: Discard,
}

/// Shares of offsets above a limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OffsetShare {
    /// Above 0.71 px: not the nearest pixel.
    pub over_0_71: f64,
    /// Above 2 px.
    pub over_2: f64,
    /// Above 5 px.
    pub over_5: f64,
}

/// Wrong decisions of the discard rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Discard {
    /// Truly hidden, but kept.
    pub false_keep: u64,
    /// Truly reflected in view, but called hidden.
    pub false_drop: u64,
}

/// How near a found point must be to count as that solution, in pixels: a little over half a
/// pixel's diagonal, so that the nearest pixel centre always counts.
pub const MATCH_RADIUS_PX: f64 = 0.75;

/// Judges a search.
///
/// `results` are in search order (mirrors outer, objects, vertices inner), `truth` likewise with
/// one entry per (object vertex, mirror) pair. A search that returns several solutions gives
/// several results in a row with the same object, vertex and mirror. `in_view(pair, q)` says
/// whether image point `q` of entry `pair` lies inside the image on a pixel of that mirror.
pub fn vertex_report(
    results: &[VertexResult],
    truth: &[TrueVertex],
    in_view: impl Fn(usize, DVec2) -> bool,
) -> Result<VertexReport, MetricsError> {
    let _ = (results, truth, in_view);
    todo!()
}

/// Mean work per (object vertex, mirror) pair; `None` without results.
pub fn mean_work(results: &[VertexResult]) -> Option<Work> {
    let _ = results;
    todo!()
}

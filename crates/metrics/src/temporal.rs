//! Steadiness: how much a vertex' error changes from frame to frame.

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The record's `temporal`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Temporal {
    /// Frames in the sequence.
    pub frames: u64,
    /// Change of the error (found − true) from one frame to the next, in pixels. `None` if no
    /// vertex was found in two frames running.
    pub jitter_px: Option<Jitter>,
    /// Share of those changes above 2 px.
    pub jumps: Option<f64>,
}

/// Distribution of the jitter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Jitter {
    /// Arithmetic mean.
    pub mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// Jitter over a sequence: `errors[frame][vertex]` is found − true in pixels, `None` where the
/// vertex has no true point in view or the search failed. Frames have the same vertices in the same
/// order.
pub fn temporal(errors: &[Vec<Option<DVec2>>]) -> Temporal {
    let _ = errors;
    todo!()
}

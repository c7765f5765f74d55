//! Steadiness: how much a vertex' error changes from frame to frame.

use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::stats::Summary;

/// A change of the error above this is a jump, in pixels.
pub const JUMP_PX: f64 = 2.0;

/// The record's `temporal`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Jitter {
    /// Arithmetic mean.
    pub mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
}

/// Jitter over a sequence: `errors[frame][vertex]` is found − true in pixels, `None` where the
/// vertex has no true point in view or the search failed (an error that is not finite counts as
/// that). Frames have the same vertices in the same order.
pub fn temporal(errors: &[Vec<Option<DVec2>>]) -> Temporal {
    let pairs = errors
        .windows(2)
        .flat_map(|pair| pair[0].iter().zip(&pair[1]));
    let changes: Vec<f64> = pairs
        .filter_map(|(before, after)| Some((*after.as_ref()? - *before.as_ref()?).length()))
        .filter(|change: &f64| change.is_finite())
        .collect();
    let jumps = changes.iter().filter(|&&change| change > JUMP_PX).count();
    let summary = Summary::of(changes.iter().copied());
    Temporal {
        frames: errors.len() as u64,
        jitter_px: summary.map(|Summary { mean, p99, max, .. }| Jitter { mean, p99, max }),
        jumps: summary.map(|_| jumps as f64 / changes.len() as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_error_is_steady() {
        let frame = vec![Some(DVec2::new(3.0, -4.0)), Some(DVec2::ZERO)];
        let steady = temporal(&[frame.clone(), frame.clone(), frame]);
        assert_eq!(steady.frames, 3);
        assert_eq!(
            steady.jitter_px,
            Some(Jitter {
                mean: 0.0,
                p99: 0.0,
                max: 0.0
            })
        );
        assert_eq!(steady.jumps, Some(0.0));
    }

    #[test]
    fn jumps_are_counted_and_gaps_are_left_out() {
        let at = |x| Some(DVec2::new(x, 0.0));
        let found = temporal(&[
            vec![at(0.0), at(0.0)],
            vec![at(3.0), None],
            vec![at(2.0), at(9.0)],
        ]);
        assert_eq!(found.jitter_px.unwrap().mean, 2.0);
        assert_eq!(found.jitter_px.unwrap().max, 3.0);
        assert_eq!(found.jumps, Some(0.5));
    }

    #[test]
    fn without_two_frames_running_there_is_no_jitter() {
        let none = temporal(&[vec![Some(DVec2::ONE)], vec![None]]);
        assert_eq!((none.frames, none.jitter_px, none.jumps), (2, None, None));
        let odd = temporal(&[vec![Some(DVec2::ONE)], vec![Some(DVec2::NAN)]]);
        assert_eq!(odd.jitter_px, None);
        assert_eq!(temporal(&[]).frames, 0);
    }
}

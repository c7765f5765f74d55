//! What became of a picture.

use anyhow::Context;
use catoptric_reference::{RayStart, Truth};

use crate::exit::bad_input;

use super::case::Case;
use super::layer::Layer;
use super::measure::{self, Measured};
use super::ours::Ours;

/// What became of a picture, with our rays starting in one way.
pub struct Verdict<'c> {
    /// What was checked.
    pub case: &'c Case,
    /// Where our reflected rays started.
    pub start: RayStart,
    /// What they saw.
    pub truth: Truth,
    /// Layer by layer.
    pub measured: Measured,
}

impl Verdict<'_> {
    /// Whether all layers agree, on a scene that has not changed.
    pub fn passed(&self) -> bool {
        self.case.stale.is_none() && self.measured.passed()
    }

    /// What became of a layer, in words.
    pub fn of(&self, layer: &Layer) -> &'static str {
        match (&self.case.stale, layer.passed) {
            (Some(_), _) => "stale",
            (None, true) if layer.pixels == 0 => "nothing to compare",
            (None, true) => "ok",
            (None, false) => "falls short",
        }
    }
}

/// The verdict for the first of the picture's possible truths that fits, or else for the nearest
/// one.
pub fn verdict(case: &Case, start: RayStart) -> anyhow::Result<Verdict<'_>> {
    let mut best: Option<Verdict<'_>> = None;
    for truth in &case.truths {
        let ours = Ours::trace(&case.scene, case.channels.size(), *truth, start, case.side)?;
        let measured = measure::measure(&case.channels, &ours)?;
        if measured.layers.iter().all(|layer| layer.pixels == 0) {
            return Err(bad_input(format!(
                "{}: no pixel of any layer could be compared; it has the channels {}",
                case.name,
                case.channels.channel_names().collect::<Vec<_>>().join(", ")
            )));
        }
        let passed = measured.passed();
        let nearer = best
            .as_ref()
            .is_none_or(|best| measured.disagreement() < best.measured.disagreement());
        if passed || nearer {
            best = Some(Verdict {
                case,
                start,
                truth: *truth,
                measured,
            });
        }
        if passed {
            break;
        }
    }
    best.context("no truth to compare with")
}

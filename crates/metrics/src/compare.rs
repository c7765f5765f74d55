//! Two frames in, one [`Comparison`] out.

use catoptric_frame::{Frame, Image};
use glam::Vec3;

use crate::MetricsError;
use crate::flip::DEFAULT_PIXELS_PER_DEGREE;
use crate::record::{ColorError, Comparison};

/// What a comparison cannot see in the pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareOptions {
    /// The technique can leave pixels unresolved, so that none is a result; otherwise the record
    /// has `null` unless some pixel is.
    pub may_be_unresolved: bool,
    /// T-junctions that the technique counted.
    pub t_junctions: Option<u64>,
    /// For FLIP.
    pub pixels_per_degree: f32,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self {
            may_be_unresolved: false,
            t_junctions: None,
            pixels_per_degree: DEFAULT_PIXELS_PER_DEGREE,
        }
    }
}

/// Compares with the default options.
pub fn compare(reference: &Frame, test: &Frame) -> Result<Comparison, MetricsError> {
    compare_with(reference, test, &CompareOptions::default())
}

/// Compares a technique's frame with the reference's.
pub fn compare_with(
    reference: &Frame,
    test: &Frame,
    options: &CompareOptions,
) -> Result<Comparison, MetricsError> {
    let _ = (reference, test, options);
    todo!()
}

/// Colour error on the pixels where `mask` is true; `None` if it has no pixel to compare.
pub fn compare_color(
    reference: &Image<Vec3>,
    test: &Image<Vec3>,
    mask: &Image<bool>,
    pixels_per_degree: f32,
) -> Result<Option<ColorError>, MetricsError> {
    let _ = (reference, test, mask, pixels_per_degree);
    todo!()
}

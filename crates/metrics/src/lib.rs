//! Frames in, error maps and statistics out: pure functions.
//!
//! [`compare()`] judges a technique's picture against the reference's, [`vertex_report`] its search,
//! [`temporal()`] its steadiness, [`motion_error`] its vectors of motion; [`stats`] summarizes samples; [`maps`] and [`mod@flip`] give
//! per-pixel errors. Every mean divides by the number of pixels in its mask and accumulates in
//! `f64`; an empty mask gives `None`.

mod color;
pub mod compare;
pub mod coverage;
mod edges;
mod filter;
pub mod flip;
pub mod maps;
mod more;
mod motion;
mod offset;
mod pixel;
pub mod record;
mod ssim;
pub mod stats;
pub mod temporal;
pub mod vertices;

pub use compare::{
    CompareOptions, compare, compare_color, compare_with, crack_pixels, object_agreement,
};
pub use flip::{FlipStats, flip};
pub use maps::{
    Colormap, CoverageClass, MapKind, color_bar, colorize, colorize_coverage, error_map,
};
pub use more::More;
pub use motion::{
    MirrorMotion, MotionError, MotionPart, MotionPicture, MotionSamples, TrueMotion, motion_error,
    motion_map, reprojected,
};
pub use offset::offset_px;
pub use pixel::pixel_angle_deg;
pub use record::{ColorError, Comparison, Coverage, Mismatch, NonFinite, Region, Regions};
pub use stats::{PairedDifference, Summary, Timing, paired};
pub use temporal::{Jitter, Temporal, temporal};
pub use vertices::{
    Discard, FoundCount, OffsetShare, SolutionCount, SolutionsByK, VertexReport, vertex_errors,
    vertex_report,
};

use thiserror::Error;

/// Why two results cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MetricsError {
    /// Pictures of different sizes.
    #[error("{what} is {test:?} pixels where the reference is {reference:?}")]
    Size {
        /// Which layer or mask.
        what: &'static str,
        /// Its size in the reference.
        reference: [u32; 2],
        /// Its size here.
        test: [u32; 2],
    },
    /// A layer that the metric needs is not there.
    #[error("the {which} has no `{layer}` layer")]
    MissingLayer {
        /// `reference` or `technique`.
        which: &'static str,
        /// The layer's name.
        layer: &'static str,
    },
    /// Results and truth that do not belong to the same search.
    #[error("results for {results} searched vertices, truth for {truth}")]
    Length {
        /// Groups of results.
        results: usize,
        /// Entries of the truth.
        truth: usize,
    },
}

impl MetricsError {
    fn same_size(
        what: &'static str,
        reference: [u32; 2],
        test: [u32; 2],
    ) -> Result<(), MetricsError> {
        if reference == test {
            Ok(())
        } else {
            Err(MetricsError::Size {
                what,
                reference,
                test,
            })
        }
    }
}

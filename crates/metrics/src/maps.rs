//! Error maps: where a picture differs, and how that is painted.

use catoptric_frame::{Frame, Image};

use crate::MetricsError;

/// What an error map shows. NaN wherever the quantity does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// Mean over the channels of `|test − reference|`, mirror pixels.
    AbsColor,
    /// Mean over the channels of `test − reference`, mirror pixels.
    SignedColor,
    /// Angular error in degrees, mirror pixels where both see the same object.
    Angular,
    /// 1 where the ids differ, 0 where they agree, mirror pixels.
    IdMismatch,
    /// The code of a [`CoverageClass`], mirror pixels.
    Coverage,
    /// FLIP-LDR, mirror pixels.
    Flip,
}

/// What a coverage map distinguishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum CoverageClass {
    /// Both see the same.
    Agree = 0,
    /// The reference sees an object, the technique the background.
    Missing = 1,
    /// The technique sees an object, the reference the background.
    Extra = 2,
    /// Two different objects.
    WrongId = 3,
    /// Missing, in a crack.
    Crack = 4,
    /// The technique has no answer.
    Unresolved = 5,
}

/// Colours for a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colormap {
    /// Black through purple to light yellow: magnitudes.
    Magma,
    /// Blue through grey to red: signed values, with the middle of the range neutral.
    CoolWarm,
}

/// The map of one quantity.
pub fn error_map(
    kind: MapKind,
    reference: &Frame,
    test: &Frame,
) -> Result<Image<f32>, MetricsError> {
    let _ = (kind, reference, test);
    todo!()
}

/// Paints a map: `range[0]` gets the first colour, `range[1]` the last, NaN neutral grey.
pub fn colorize(map: &Image<f32>, range: [f32; 2], colormap: Colormap) -> Image<[u8; 3]> {
    let _ = (range, colormap);
    map.map(|_| [0; 3])
}

/// Paints a map of [`MapKind::Coverage`] in the colours of its classes.
pub fn colorize_coverage(map: &Image<f32>) -> Image<[u8; 3]> {
    map.map(|_| [0; 3])
}

/// A horizontal strip of the colour map, low values left, with `ticks` evenly spaced tick marks
/// from end to end along its lower edge.
pub fn color_bar(colormap: Colormap, size: [u32; 2], ticks: u32) -> Image<[u8; 3]> {
    let _ = (colormap, ticks);
    Image::filled(size, [0; 3])
}

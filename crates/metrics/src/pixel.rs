//! The error that is left where answers are whole pixels.
//!
//! A search in an image of the mirror answers with a pixel, not with a place inside it. What such
//! an answer shows at the pixel's centre may then be anything that the mirror shows within that
//! pixel.

use catoptric_frame::Frame;

use crate::MetricsError;
use crate::coverage::{Layers, angle_deg};
use crate::stats::Summary;

/// Places in a pixel, as offsets from its centre in pixels: one half of a grid of 4 × 4. The other
/// half lies opposite and makes the same angles.
const PLACES: [(f64, f64); 8] = [
    (0.125, 0.125),
    (0.375, 0.125),
    (0.125, 0.375),
    (0.375, 0.375),
    (-0.125, 0.125),
    (-0.375, 0.125),
    (-0.125, 0.375),
    (-0.375, 0.375),
];

/// Angles at the mirror point, in degrees, between what a mirror pixel's centre shows and what
/// other places in the same pixel show, over all pixels and places alike. No search that answers in
/// whole pixels has smaller angular errors, unless errors average out between vertices far apart.
/// Hits between pixel centres are interpolated, so only pixels count whose right and lower
/// neighbours show the same object; `None` without any.
///
/// # Errors
/// The frame lacks a layer.
pub fn pixel_angle_deg(reference: &Frame) -> Result<Option<Summary>, MetricsError> {
    let layers = Layers::new(reference, reference)?;
    let width = layers.size[0] as usize;
    let angles = layers.mirror_pixels().flat_map(|index| {
        let to = |other: usize| layers.step(index, other);
        let on_right = (index + 1) % width != 0;
        let steps = on_right
            .then(|| to(index + 1))
            .flatten()
            .zip(to(index + width));
        let hit = layers.hits(index)[0];
        steps.into_iter().flat_map(move |(right, down)| {
            PLACES.map(|(x, y)| angle_deg(hit, hit + x * right + y * down))
        })
    });
    Ok(Summary::of(angles.filter(|angle| angle.is_finite())))
}

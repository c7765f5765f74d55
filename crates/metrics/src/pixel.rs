//! What an answer in whole pixels is off by.
//!
//! A search over a picture of the mirror answers with a pixel, not with the place in it. What such
//! an answer shows at the pixel's centre is then any of what the mirror shows across that pixel.

use catoptric_frame::Frame;

use crate::MetricsError;
use crate::coverage::{Layers, angle_deg};
use crate::stats::Summary;

/// Places in a pixel, as offsets from its centre in pixels, to one side of it: a grid of 4 × 4 of
/// which the other half, being opposite, makes the same angles.
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

/// Angles at the mirror point between what a mirror pixel's centre shows and what other places of
/// the same pixel show, in degrees, over all pixels and places alike: the floor below which
/// answers in whole pixels take no error of the angles, unless errors average out between vertices
/// far apart. Hits between pixel centres are interpolated, so that only pixels count whose right
/// and lower neighbours show the same object; `None` without any.
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

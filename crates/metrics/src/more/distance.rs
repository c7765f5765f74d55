//! Error of the length of the reflected ray. A point on the right ray that is too near or too far has
//! no angular error, and yet is wrong for anything that filters or reprojects reflections by its
//! distance.

use crate::coverage::Layers;
use crate::stats::Summary;

/// Median of |t − f| / f over the mirror pixels where both see the same object; f and t are the
/// distances of the reference's and the technique's hit from the reference's mirror point. `None`
/// without such pixels.
pub(super) fn of(layers: &Layers<'_>) -> Option<f64> {
    let errors = layers.mirror_pixels().filter_map(|index| {
        let [reference, test] = layers.ids(index);
        let [f, t] = layers.hits(index).map(|hit| hit.length());
        (reference != 0 && reference == test).then_some((t - f).abs() / f)
    });
    Some(Summary::of(errors.filter(|error| error.is_finite()))?.p50)
}

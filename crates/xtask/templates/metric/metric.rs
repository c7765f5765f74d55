//! TEMPLATE: what it measures, and why that matters.

use crate::coverage::Layers;

/// TEMPLATE: what the number is. Here: the share of the mirror pixels where both show a surface.
/// `None` without mirror pixels.
pub(super) fn of(layers: &Layers<'_>) -> Option<f64> {
    let [mut both, mut all] = [0.0; 2];
    for index in layers.mirror_pixels() {
        all += 1.0;
        if layers.show(index) == [true, true] {
            both += 1.0;
        }
    }
    (all > 0.0).then_some(both / all)
}

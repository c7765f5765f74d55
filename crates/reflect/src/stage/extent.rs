//! How far things can be from each other.

use catoptric_scene::Scene;
use glam::DVec3;

/// No vertex is farther from a mirror point: the diagonal of the box around everything, and a
/// hundredth of it.
pub(crate) fn diagonal(scene: &Scene) -> f32 {
    let Some((low, high)) = bounds(scene) else {
        return 1.0;
    };
    ((high - low).length() * MARGIN).max(LEAST_DISTANCE) as f32
}

/// Nothing is farther from a point, wherever that lies: the distance to the far corner of the box
/// around everything, and a hundredth of it.
pub(crate) fn beyond(scene: &Scene, point: DVec3) -> f32 {
    let Some((low, high)) = bounds(scene) else {
        return 1.0;
    };
    let corner = (point - low).abs().max((high - point).abs());
    (corner.length() * MARGIN).max(LEAST_DISTANCE) as f32
}

/// Factor by which a distance is taken larger, to be sure of it in single precision.
const MARGIN: f64 = 1.01;
/// A scene without extent is taken to be so large.
const LEAST_DISTANCE: f64 = 1e-6;

/// The box around everything; `None` in an empty scene.
fn bounds(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for mirror in &scene.mirrors {
        let (a, b) = mirror.shape.bounds();
        low = low.min(a);
        high = high.max(b);
    }
    for position in scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions)
    {
        low = low.min(position.as_dvec3());
        high = high.max(position.as_dvec3());
    }
    low.cmple(high).all().then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_beyond_from_wherever_it_is_seen() {
        let scene = crate::testing::scene("box");
        let diagonal = f64::from(diagonal(&scene));
        let (low, high) = bounds(&scene).expect("it has walls");
        let inside = f64::from(beyond(&scene, 0.5 * (low + high)));
        assert!((inside - 0.5 * diagonal).abs() < 1e-6 * diagonal);
        let far_off = high + DVec3::splat(100.0);
        assert!(f64::from(beyond(&scene, far_off)) > far_off.distance(low));
    }
}

//! Where a line meets the unit sphere, of which spheres, ellipsoids and bowls are images.

use glam::DVec3;

/// Both roots, ascending, of `|origin + t · dir| = 1`; `None` where the line misses.
///
/// The discriminant comes from the line's distance to the centre and the smaller root from the
/// product of both, so neither cancels for far origins or origins on the surface.
pub(super) fn roots(origin: DVec3, dir: DVec3) -> Option<[f64; 2]> {
    let a = dir.length_squared();
    let b = origin.dot(dir);
    let nearest = origin - dir * (b / a);
    let inside = 1.0 - nearest.length_squared();
    if inside.is_nan() || inside < 0.0 {
        return None;
    }
    let distance = origin.length();
    let c = (distance - 1.0) * (distance + 1.0);
    let q = -(b + (a * inside).sqrt().copysign(b));
    let (first, second) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
    Some(if first <= second {
        [first, second]
    } else {
        [second, first]
    })
}

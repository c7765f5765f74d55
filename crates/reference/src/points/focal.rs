//! Focal points: where the beam that a mirror reflects converges.
//!
//! Around a reflected ray, the reflected rays of the neighbouring eye rays span a small area across it.
//! This area vanishes at up to two distances t: the roots of det(Pu + t ru, Pv + t rv, r) = 0, for the
//! points P, the directions r and their derivatives along two directions across the eye ray.

use catoptric_scene::Shape;
use glam::DVec3;

/// How many focal points lie between a mirror's point and the vertex that it reflects to the eye; `None`
/// where it is not known: on a mesh, and where the mirror ends beside the point or hides it.
pub(super) fn before(shape: &Shape, eye: DVec3, point: DVec3, vertex: DVec3) -> Option<u8> {
    /// Angle between neighbouring eye rays, radians.
    const ASIDE: f64 = 1e-6;
    let offset = point - eye;
    let distance = offset.length();
    let ahead = offset / distance;
    let (across, down) = ahead.any_orthonormal_pair();
    let ray = |aside: DVec3| {
        let dir = (ahead + aside).normalize();
        let hit = shape.intersect(eye, dir, 0.0)?;
        let near = hit.position.distance(point) < 1e-2 * distance;
        near.then(|| (hit.position, dir.reflect(hit.normal)))
    };
    let along = |way: DVec3| {
        let ((p, r), (q, s)) = (ray(ASIDE * way)?, ray(-ASIDE * way)?);
        Some((p - q, r - s))
    };
    let (_, direction) = ray(DVec3::ZERO)?;
    let (point_u, turn_u) = along(across)?;
    let (point_v, turn_v) = along(down)?;
    let a = turn_u.cross(turn_v).dot(direction);
    let b = (turn_u.cross(point_v) + point_u.cross(turn_v)).dot(direction);
    let c = point_u.cross(point_v).dot(direction);
    // Real, but for rounding where both are equal.
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + root.copysign(b));
    let t = vertex.distance(point);
    let before = [q / a, c / q]
        .into_iter()
        .filter(|focus| *focus > 0.0 && *focus < t);
    Some(before.count() as u8)
}

#[cfg(test)]
mod tests {
    use catoptric_scene::shape::{Bowl, Sphere};

    use super::*;

    #[test]
    fn a_convex_mirror_has_no_focal_point_ahead() {
        let shape = Shape::Sphere(Sphere {
            center: DVec3::ZERO,
            radius: 1.0,
        });
        let eye = DVec3::new(0.3, 0.2, 4.0);
        for at in [
            DVec3::Z,
            DVec3::new(0.6, 0.0, 0.8),
            DVec3::new(0.0, -0.8, 0.6),
        ] {
            let direction = (at - eye).normalize().reflect(at);
            for t in [0.1, 1.0, 100.0] {
                assert_eq!(before(&shape, eye, at, at + t * direction), Some(0));
            }
        }
    }

    #[test]
    fn a_bowl_has_the_two_of_coddington() {
        // 1/a + 1/b = 2 cos i / R and 2 / (R cos i).
        let radius = 1.5;
        let bowl = Bowl {
            center: DVec3::ZERO,
            radius,
            axis: DVec3::NEG_Z,
            half_angle: 1.0,
        };
        let shape = Shape::Bowl(bowl);
        let eye = DVec3::new(0.9, 0.2, 4.0);
        let at = radius * DVec3::new(0.3, -0.2, -1.0).normalize();
        let normal = -at / radius;
        let to_eye = eye - at;
        let cosine = to_eye.normalize().dot(normal);
        let direction = (-to_eye).normalize().reflect(normal);
        let focus = |bend: f64| 1.0 / (2.0 * bend / radius - 1.0 / to_eye.length());
        let [near, far] = [focus(1.0 / cosine), focus(cosine)];
        assert!(near > 0.1 && far > near + 1e-3);
        let count = |t: f64| before(&shape, eye, at, at + t * direction);
        assert_eq!(count(near - 1e-4), Some(0));
        assert_eq!(count(near + 1e-4), Some(1));
        assert_eq!(count(far - 1e-4), Some(1));
        assert_eq!(count(far + 1e-4), Some(2));
    }
}

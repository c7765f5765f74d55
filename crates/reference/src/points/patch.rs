//! Surfaces by two parameters, with their derivatives and bounds of these.

use glam::{DVec2, DVec3};

/// A smooth surface over a rectangle of parameters.
pub(super) trait Patch: Sync {
    /// Least and greatest parameters.
    fn domain(&self) -> [DVec2; 2];

    /// Parts along each parameter to begin with, about square in parameters.
    fn parts(&self) -> [u32; 2];

    /// Point and derivatives at parameters.
    fn at(&self, q: DVec2) -> Jet;

    /// What no point of the surface exceeds.
    fn bounds(&self) -> Bounds;
}

/// A point of a surface and its derivatives by the parameters `u` and `v`.
pub(super) struct Jet {
    pub point: DVec3,
    pub u: DVec3,
    pub v: DVec3,
    pub uu: DVec3,
    pub uv: DVec3,
    pub vv: DVec3,
    /// Perpendicular to `u` and `v`, on the reflecting side, of any length.
    pub normal: DVec3,
}

/// Upper bounds of the norms of derivatives, as linear, bilinear and trilinear maps of the
/// parameters.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub first: f64,
    pub second: f64,
    pub third: f64,
    /// Of the first derivative of [`Jet::normal`].
    pub normal: f64,
}

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Derivatives against central differences; bounds against samples.
    pub(in crate::points) fn check(patch: &impl Patch) {
        let ([low, high], bounds) = (patch.domain(), patch.bounds());
        let step = 1e-4;
        for index in 0..400 {
            let share = DVec2::new(
                (f64::from(index) * 0.618_034).fract(),
                (f64::from(index) * 0.414_214).fract(),
            );
            let q = low + share * (high - low);
            let jet = patch.at(q);
            let (du, dv) = (DVec2::new(step, 0.0), DVec2::new(0.0, step));
            let slope = |by: DVec2, of: fn(&Jet) -> DVec3| {
                (of(&patch.at(q + by)) - of(&patch.at(q - by))) / (2.0 * step)
            };
            for (exact, found) in [
                (jet.u, slope(du, |jet| jet.point)),
                (jet.v, slope(dv, |jet| jet.point)),
                (jet.uu, slope(du, |jet| jet.u)),
                (jet.uv, slope(dv, |jet| jet.u)),
                (jet.uv, slope(du, |jet| jet.v)),
                (jet.vv, slope(dv, |jet| jet.v)),
            ] {
                assert!(exact.distance(found) < 1e-6, "{exact} {found}");
            }
            assert!(jet.normal.dot(jet.u).abs() < 1e-12 && jet.normal.dot(jet.v).abs() < 1e-12);
            assert!(jet.u.cross(jet.v).dot(jet.normal) != 0.0);
            // Along directions all around, which gives the norms of symmetric maps.
            for turn in 0..16 {
                let way = DVec2::from_angle(TAU * f64::from(turn) / 16.0);
                let second = |jet: &Jet| {
                    way.x * way.x * jet.uu + 2.0 * way.x * way.y * jet.uv + way.y * way.y * jet.vv
                };
                let first = way.x * jet.u + way.y * jet.v;
                let change = |of: &dyn Fn(&Jet) -> DVec3| {
                    (of(&patch.at(q + step * way)) - of(&patch.at(q - step * way))) / (2.0 * step)
                };
                for (found, bound) in [
                    (first, bounds.first),
                    (second(&jet), bounds.second),
                    (change(&second), bounds.third),
                    (change(&|jet| jet.normal), bounds.normal),
                ] {
                    assert!(found.length() <= bound + 1e-6, "{found} {bound}");
                }
            }
        }
    }
}

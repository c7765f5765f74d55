//! Surfaces by two parameters, with their derivatives and bounds of these.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3};

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

/// A torus; `u` is the arc length around its outer equator, `v` around its tube.
pub(super) struct Torus {
    pub center: DVec3,
    pub axis: DVec3,
    pub major: f64,
    pub minor: f64,
}

impl Patch for Torus {
    fn domain(&self) -> [DVec2; 2] {
        [
            DVec2::ZERO,
            TAU * DVec2::new(self.major + self.minor, self.minor),
        ]
    }

    fn parts(&self) -> [u32; 2] {
        let around = (8.0 * (self.major + self.minor) / self.minor).ceil();
        [around.min(512.0) as u32, 8]
    }

    fn at(&self, q: DVec2) -> Jet {
        let outer = self.major + self.minor;
        let side = self.axis.any_orthonormal_vector();
        let other = self.axis.cross(side);
        let (sin, cos) = (q.x / outer).sin_cos();
        let (outward, along) = (side * cos + other * sin, other * cos - side * sin);
        let (sin, cos) = (q.y / self.minor).sin_cos();
        let normal = outward * cos + self.axis * sin;
        let rising = self.axis * cos - outward * sin;
        let radius = self.major + self.minor * cos;
        Jet {
            point: self.center + self.major * outward + self.minor * normal,
            u: along * (radius / outer),
            v: rising,
            uu: outward * (-radius / (outer * outer)),
            uv: along * (-sin / outer),
            vv: normal / -self.minor,
            normal,
        }
    }

    fn bounds(&self) -> Bounds {
        let (outer, tube) = (1.0 / (self.major + self.minor), 1.0 / self.minor);
        Bounds {
            first: 1.0,
            second: outer + tube,
            // Each of the four kinds of third derivatives at its largest, weighted by the largest
            // value of 3 c² s = 2/√3 for the mixed ones.
            third: outer * outer * (1.0 + 2.0 / 3f64.sqrt())
                + tube * (2.0 / 3f64.sqrt() * outer + tube),
            normal: tube,
        }
    }
}

/// A saddle; `u` and `v` are the places along its width and its height.
pub(super) struct Saddle {
    pub center: DVec3,
    /// Right, up and normal.
    pub frame: DMat3,
    pub half: DVec2,
    pub curvature: DVec2,
}

impl Patch for Saddle {
    fn domain(&self) -> [DVec2; 2] {
        [-self.half, self.half]
    }

    fn parts(&self) -> [u32; 2] {
        let side = self.half.max_element() / 8.0;
        [self.half.x, self.half.y].map(|half| (half / side).ceil() as u32)
    }

    fn at(&self, q: DVec2) -> Jet {
        let slope = self.curvature * q;
        let height = slope.dot(q) / 2.0;
        let [right, up, normal] = [self.frame.x_axis, self.frame.y_axis, self.frame.z_axis];
        Jet {
            point: self.center + self.frame * q.extend(height),
            u: right + slope.x * normal,
            v: up + slope.y * normal,
            uu: self.curvature.x * normal,
            uv: DVec3::ZERO,
            vv: self.curvature.y * normal,
            normal: normal - slope.x * right - slope.y * up,
        }
    }

    fn bounds(&self) -> Bounds {
        let steepest = (self.curvature * self.half).length();
        let bend = self.curvature.abs().max_element();
        Bounds {
            first: (1.0 + steepest * steepest).sqrt(),
            second: bend,
            third: 0.0,
            normal: bend,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives against central differences; bounds against samples.
    fn check(patch: &impl Patch) {
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

    #[test]
    fn derivatives_and_their_bounds_are_right() {
        let frame = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(1.1);
        check(&Torus {
            center: DVec3::ONE,
            axis: frame.y_axis,
            major: 1.2,
            minor: 0.5,
        });
        check(&Saddle {
            center: DVec3::ONE,
            frame,
            half: DVec2::new(1.0, 0.6),
            curvature: DVec2::new(0.9, -0.5),
        });
    }
}

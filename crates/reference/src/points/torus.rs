//! All points of a torus that reflect a vertex, as stationary points of the way over it.

use std::f64::consts::TAU;

use catoptric_frame::VertexClass;
use catoptric_scene::shape::Torus;
use glam::{DVec2, DVec3};

use super::patch::{Bounds, Jet, Patch};
use super::solutions::{ExactPoints, Solutions, seen};
use super::stationary;

impl ExactPoints for Torus {
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let solutions = stationary::reflection_points(self, eye, vertex, seen(self, eye));
        match solutions.class {
            VertexClass::Unreflected => Solutions::none(VertexClass::Hidden),
            _ => solutions,
        }
    }
}

/// `u` is the arc length around the outer equator, `v` around the tube.
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

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::super::patch::tests::check;
    use super::*;

    #[test]
    fn derivatives_and_their_bounds_are_right() {
        let frame = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(1.1);
        check(&Torus {
            center: DVec3::ONE,
            axis: frame.y_axis,
            major: 1.2,
            minor: 0.5,
        });
    }
}

//! All points of a saddle that reflect a vertex, as stationary points of the way over it.

use catoptric_scene::shape::Saddle;
use glam::{DMat3, DVec2, DVec3};

use super::patch::{Bounds, Jet, Patch};
use super::solutions::{ExactPoints, Solutions, seen};
use super::stationary;

impl ExactPoints for Saddle {
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        stationary::reflection_points(self, eye, vertex, seen(self, eye))
    }
}

/// `u` and `v` are the places along the width and the height.
impl Patch for Saddle {
    fn domain(&self) -> [DVec2; 2] {
        let half = self.size / 2.0;
        [-half, half]
    }

    fn parts(&self) -> [u32; 2] {
        let half = self.size / 2.0;
        let side = half.max_element() / 8.0;
        [half.x, half.y].map(|half| (half / side).ceil() as u32)
    }

    fn at(&self, q: DVec2) -> Jet {
        let slope = self.curvature * q;
        let height = slope.dot(q) / 2.0;
        let [right, up, normal] = [self.up.cross(self.normal), self.up, self.normal];
        let frame = DMat3::from_cols(right, up, normal);
        Jet {
            point: self.center + frame * q.extend(height),
            u: right + slope.x * normal,
            v: up + slope.y * normal,
            uu: self.curvature.x * normal,
            uv: DVec3::ZERO,
            vv: self.curvature.y * normal,
            normal: normal - slope.x * right - slope.y * up,
        }
    }

    fn bounds(&self) -> Bounds {
        let steepest = (self.curvature * self.size / 2.0).length();
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
    use super::super::patch::tests::check;
    use super::*;

    #[test]
    fn derivatives_and_their_bounds_are_right() {
        let frame = DMat3::from_rotation_x(0.4) * DMat3::from_rotation_y(1.1);
        check(&Saddle {
            center: DVec3::ONE,
            normal: frame.z_axis,
            up: frame.y_axis,
            size: DVec2::new(2.0, 1.2),
            curvature: DVec2::new(0.9, -0.5),
        });
    }
}

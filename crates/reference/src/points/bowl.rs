//! The points of a bowl that reflect a vertex: those of the whole sphere's inside, cut by the rim.

use catoptric_frame::VertexClass;
use catoptric_scene::shape::Bowl;
use glam::DVec3;

use super::alhazen::solve;
use super::solutions::{ExactPoints, Solutions, seen};

impl ExactPoints for Bowl {
    /// If eye, vertex and centre are on one line, a whole ring of points may reflect the vertex; two
    /// of them are given, of which one is the ring's nearest to the middle of the cap. If eye and
    /// vertex are both in the centre, every point reflects, and the middle is given.
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let Self {
            center,
            radius,
            axis,
            half_angle,
        } = *self;
        if eye == center && vertex == center {
            return Solutions::at(vec![center + radius * axis]);
        }
        let rim = half_angle.cos();
        let points = solve(center, radius, eye, vertex, -1.0, axis);
        let solutions =
            Solutions::within(points, |point| ((point - center) / radius).dot(axis) >= rim);
        match solutions.class {
            VertexClass::Unreflected if !seen(self, eye)(vertex) => {
                Solutions::none(VertexClass::Hidden)
            }
            _ => solutions,
        }
    }
}

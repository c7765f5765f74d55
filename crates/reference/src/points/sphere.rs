//! The point of a sphere that reflects a vertex to an eye outside.

use catoptric_scene::shape::Sphere;
use glam::DVec3;

use super::alhazen::solve;
use super::solutions::{ExactPoints, Solutions};

impl ExactPoints for Sphere {
    /// One, or none where the straight way from eye to vertex is blocked.
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let points = solve(self.center, self.radius, eye, vertex, 1.0, DVec3::ZERO);
        Solutions::within(points, |_| true)
    }
}

//! The point of a flat mirror that reflects a vertex: where the line to the vertex's mirror image
//! crosses it.

use catoptric_frame::VertexClass;
use catoptric_scene::shape::Plane;
use glam::DVec3;

use super::solutions::{ExactPoints, Solutions};

impl ExactPoints for Plane {
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let Self {
            center,
            normal,
            up,
            size,
        } = *self;
        let (eye_height, vertex_height) =
            ((eye - center).dot(normal), (vertex - center).dot(normal));
        if eye_height <= 0.0 || vertex_height <= 0.0 {
            return Solutions::none(VertexClass::Hidden);
        }
        let share = eye_height / (eye_height + vertex_height);
        let foot = |point: DVec3, height: f64| point - height * normal;
        let point = foot(eye, eye_height).lerp(foot(vertex, vertex_height), share);
        let right = up.cross(normal);
        Solutions::within(vec![point], |point| {
            let offset = point - center;
            offset.dot(right).abs() <= size.x / 2.0 && offset.dot(up).abs() <= size.y / 2.0
        })
    }
}

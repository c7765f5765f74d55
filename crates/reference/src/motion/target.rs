//! What a mirror shows: something that may move.

use glam::DVec3;

/// What is reflected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point of an object, which moves with it.
    Point {
        /// Index into the scene's objects.
        object: usize,
        /// Index into the object's triangles.
        triangle: usize,
        /// Weights of the triangle's corners, summing to 1.
        weights: DVec3,
    },
    /// The background in a unit direction.
    Direction(DVec3),
}

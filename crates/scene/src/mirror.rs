//! Mirrors: a name, a shape, and how it is drawn.

use glam::DVec3;

use crate::shape::Shape;

/// A named mirror.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Unique within the scene.
    pub name: String,
    /// The reflecting surface, world space.
    pub shape: Shape,
    /// Segments around the proxy, half as many rings. Unused for meshes.
    pub tessellation: u32,
    /// World-space centres of the cube maps that a technique may trace its reflections in, the most
    /// useful first; mostly empty.
    pub cubemaps: Vec<DVec3>,
}

//! Mirrors: a name, a shape, and how it is drawn.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::pose::Pose;
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
    /// Closed meshes, world space, from which the pieces of a mesh mirror were cut. A technique that
    /// needs a closed surface that its centre sees exactly once all around takes from them what an open
    /// mirror lacks (Estalella et al. 2005, §6.2). Mostly empty; no picture of the truth depends on
    /// them.
    pub proxies: Vec<Mesh>,
    /// How it has moved since the first frame. What is fixed to the mirror, such as a scratch, has moved
    /// with it, even if the surface looks the same, as that of a turned ball does.
    pub pose: Pose,
}

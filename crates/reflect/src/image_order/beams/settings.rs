//! What all kernels of the beams read.

use encase::ShaderType;
use glam::UVec2;

/// Distance, as a share of the scene's extent, within which a ray starts on the plane of a triangle: a few
/// rounding steps of single precision.
pub(super) const TOUCHING: f32 = 1e-6;

/// Twin of `Settings` in `beams/node.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Settings {
    pub wider: f32,
    pub tiles: UVec2,
    pub triangles: u32,
    pub first_cluster: u32,
    pub cluster_count: u32,
    pub room: u32,
    pub is_first: u32,
    pub mirror_triangles: u32,
    pub touching: f32,
}

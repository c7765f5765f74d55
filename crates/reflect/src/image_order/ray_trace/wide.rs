//! obvhs's compressed wide hierarchy, uploaded as it is, with the triangles copied in its order.

use std::time::Duration;

use catoptric_scene::Scene;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::triangle::Triangle;

use crate::error::ReflectError;
use crate::gpu::{Gpu, storage_bytes, storage_zeros};

/// Levels that the shader's stack holds (`ray_trace.wesl`): one entry each at most.
const STACK: usize = 48;

/// The scene's triangles as the shader reads them.
pub(super) struct Wide {
    pub(super) nodes: wgpu::Buffer,
    /// 48 bytes each, in the hierarchy's order.
    pub(super) triangles: wgpu::Buffer,
}

impl Wide {
    /// Builds the hierarchy of all objects, on the CPU.
    pub(super) fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, ReflectError> {
        let meshes = scene.objects.iter().map(|object| &object.mesh);
        let triangles: Vec<Triangle> = meshes
            .flat_map(|mesh| {
                let corner = |vertex: u32| mesh.positions[vertex as usize].into();
                let triangles = mesh.triangles.iter();
                triangles.map(move |triangle| {
                    let [v0, v1, v2] = triangle.map(corner);
                    Triangle { v0, v1, v2 }
                })
            })
            .collect();
        if triangles.is_empty() {
            return Ok(Self {
                nodes: storage_zeros(gpu, 80),
                triangles: storage_zeros(gpu, 48),
            });
        }
        let params = BvhBuildParams::medium_build();
        let hierarchy = build_cwbvh_from_tris(&triangles, params, &mut Duration::default());
        let depth = depth(&hierarchy.nodes);
        if depth > STACK {
            return Err(ReflectError::Deep {
                depth,
                limit: STACK,
            });
        }
        let order = hierarchy.primitive_indices.iter();
        let ordered: Vec<[f32; 12]> = order
            .map(|&index| {
                let Triangle { v0, v1, v2 } = triangles[index as usize];
                let [a, b, c] = [v0, v1, v2].map(Vec3::from);
                let index = f32::from_bits(index);
                [a.x, a.y, a.z, index, b.x, b.y, b.z, 0.0, c.x, c.y, c.z, 0.0]
            })
            .collect();
        let nodes: &[u8] = bytemuck::cast_slice(&hierarchy.nodes);
        let ordered: &[u8] = bytemuck::cast_slice(&ordered);
        gpu.check_binding(nodes.len().max(ordered.len()) as u64)?;
        Ok(Self {
            nodes: storage_bytes(gpu, nodes),
            triangles: storage_bytes(gpu, ordered),
        })
    }
}

/// Levels of nodes.
fn depth(nodes: &[CwBvhNode]) -> usize {
    let mut deepest = 0;
    let mut waiting = vec![(0, 1)];
    while let Some((index, depth)) = waiting.pop() {
        deepest = deepest.max(depth);
        let node: &CwBvhNode = &nodes[index];
        let inner = (0..8).filter(|child| !node.is_child_empty(*child) && !node.is_leaf(*child));
        waiting.extend(inner.map(|child| (node.child_node_index(child) as usize, depth + 1)));
    }
    deepest
}

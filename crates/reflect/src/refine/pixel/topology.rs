//! The edges of a scene's triangles, each once, whatever the number of triangles that share it.

use std::collections::HashMap;

use catoptric_scene::Scene;
use glam::{UVec2, UVec3};

use super::records::{NONE, Working};
use crate::stage::geometry::Geometry;

/// Weight 1 of a packed place. Twin of `WHOLE` in `shared/triangle.wesl`.
const WHOLE: u32 = 1 << 14;

/// Which edges and triangles there are; nothing that moves changes it.
pub(super) struct Topology {
    pub vertices: u32,
    /// Ends, the lower vertex first.
    pub edges: Vec<UVec2>,
    /// As the first level works on them.
    pub triangles: Vec<Working>,
}

impl Topology {
    /// Vertices, edges and triangles.
    pub(super) fn counts(&self) -> [u32; 3] {
        let [edges, triangles] = [self.edges.len(), self.triangles.len()];
        [self.vertices, edges as u32, triangles as u32]
    }

    pub(super) fn new(scene: &Scene) -> Self {
        let geometry = Geometry::new(scene);
        let corners: Vec<u32> = geometry
            .corners
            .iter()
            .map(|corner| corner.vertex)
            .collect();
        Self::of(geometry.positions.len() as u32, &corners)
    }

    /// Of triangles by three corners each.
    fn of(vertices: u32, corners: &[u32]) -> Self {
        let mut numbers: HashMap<[u32; 2], u32> = HashMap::new();
        let mut edges = Vec::new();
        let mut number = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            *numbers.entry(ends).or_insert_with(|| {
                edges.push(UVec2::from_array(ends));
                edges.len() as u32 - 1
            })
        };
        let triangles = corners.chunks_exact(3).zip(0..);
        let triangles = triangles.map(|(corners, source)| {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            Working {
                points: UVec3::new(a, b, c),
                source,
                places: UVec3::new(0, WHOLE, WHOLE << 16),
                level: 0,
                edges: UVec3::new(number(a, b), number(b, c), number(c, a)),
                center: NONE,
            }
        });
        let triangles = triangles.collect();
        Self {
            vertices,
            edges,
            triangles,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_share_an_edge_whichever_way_they_go_round() {
        let topology = Topology::of(4, &[0, 1, 2, 2, 1, 3]);
        assert_eq!(topology.edges.len(), 5);
        let [one, other] = [topology.triangles[0].edges, topology.triangles[1].edges];
        assert_eq!(one.y, other.x);
        assert_eq!(topology.edges[one.y as usize], UVec2::new(1, 2));
    }
}

//! T-junctions: corners of drawn triangles that lie inside an edge of another (Szabo 2013,
//! Fig. 6.5). Where the corner's reflection is off the straight edge, a crack opens.

use std::collections::HashSet;

use catoptric_scene::Scene;
use glam::Vec3;

/// A point of an object's surface: neighbours split their common edge at bit-identical points.
type Point = (u32, [u32; 3]);

/// The corners and edges of drawn triangles.
#[derive(Debug, Default)]
pub(in crate::refine) struct Edges {
    corners: HashSet<Point>,
    edges: Vec<(u32, [Vec3; 2])>,
}

/// The object of each triangle of a scene, by index.
pub(in crate::refine) fn objects(scene: &Scene) -> Vec<u32> {
    let objects = (0..).zip(&scene.objects);
    objects
        .flat_map(|(index, object)| object.mesh.triangles.iter().map(move |_| index))
        .collect()
}

fn point(object: u32, position: Vec3) -> Point {
    (object, position.to_array().map(f32::to_bits))
}

impl Edges {
    /// Takes a triangle in.
    pub(in crate::refine) fn add(&mut self, object: u32, corners: [Vec3; 3]) {
        let [a, b, c] = corners;
        self.corners
            .extend(corners.map(|corner| point(object, corner)));
        self.edges
            .extend([[a, b], [b, c], [c, a]].map(|edge| (object, edge)));
    }

    /// Number of corners inside an edge; an edge may have been split `depth` times on its other
    /// side.
    pub(in crate::refine) fn t_junctions(&self, depth: u32) -> u64 {
        let mut found = HashSet::new();
        for (object, edge) in &self.edges {
            self.inside(*object, *edge, depth, &mut found);
        }
        found.len() as u64
    }

    fn inside(&self, object: u32, [a, b]: [Vec3; 2], depth: u32, found: &mut HashSet<Point>) {
        let middle = (a + b) * 0.5;
        let place = point(object, middle);
        if depth == 0 || middle == a || middle == b || !self.corners.contains(&place) {
            return;
        }
        found.insert(place);
        self.inside(object, [a, middle], depth - 1, found);
        self.inside(object, [middle, b], depth - 1, found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: Vec3 = Vec3::ZERO;
    const B: Vec3 = Vec3::X;
    const C: Vec3 = Vec3::Y;
    const D: Vec3 = Vec3::new(1.0, 1.0, 0.0);

    fn halves(edges: &mut Edges, [a, b, c]: [Vec3; 3]) {
        let [ab, bc, ca] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
        for child in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            edges.add(0, child);
        }
    }

    #[test]
    fn a_split_triangle_beside_a_whole_one_makes_one() {
        let mut edges = Edges::default();
        edges.add(0, [A, B, C]);
        edges.add(0, [B, D, C]);
        assert_eq!(edges.t_junctions(3), 0);
        let mut edges = Edges::default();
        halves(&mut edges, [A, B, C]);
        edges.add(0, [B, D, C]);
        assert_eq!(edges.t_junctions(3), 1);
    }

    #[test]
    fn triangles_split_alike_make_none_and_twice_split_ones_three() {
        let mut edges = Edges::default();
        halves(&mut edges, [A, B, C]);
        halves(&mut edges, [B, D, C]);
        assert_eq!(edges.t_junctions(3), 0);
        let mut edges = Edges::default();
        edges.add(0, [B, D, C]);
        let [ab, bc, ca] = [(A + B) * 0.5, (B + C) * 0.5, (C + A) * 0.5];
        for child in [[A, ab, ca], [ab, B, bc], [ca, bc, C], [ab, bc, ca]] {
            halves(&mut edges, child);
        }
        assert_eq!(edges.t_junctions(3), 3);
    }

    #[test]
    fn another_object_does_not_count() {
        let mut edges = Edges::default();
        edges.add(0, [A, B, C]);
        edges.add(1, [(B + C) * 0.5, D, B]);
        assert_eq!(edges.t_junctions(3), 0);
    }
}

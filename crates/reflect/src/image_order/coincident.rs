//! Coincident triangles, of which rays meet the first alone. Those of one object coincide in every frame and are
//! left out once and for all. Those of several objects may part; as long as they coincide, all but the first are
//! collapsed to points.

use catoptric_scene::{Scene, first_of_coincident};
use glam::Vec3;

/// A place in a list of triangles: the vertices, counted over all objects, and the triangle's index among the
/// scene's.
pub(super) type Slot = [u32; 4];

/// World-space positions of all objects' vertices.
pub(super) fn positions(scene: &Scene) -> Vec<Vec3> {
    let meshes = scene.objects.iter().map(|object| &object.mesh);
    meshes.flat_map(|mesh| &mesh.positions).copied().collect()
}

/// All objects' triangles in order, indices counted from `first`; of those of one object that coincide the first
/// is there alone.
pub(super) fn slots(scene: &Scene, first: u32) -> Vec<Slot> {
    let mut slots = Vec::new();
    let (mut first_vertex, mut first_triangle) = (0, first);
    for object in &scene.objects {
        let mesh = &object.mesh;
        let corners = |index: usize| {
            let triangle: [u32; 3] = mesh.triangles[index];
            triangle.map(|vertex| mesh.positions[vertex as usize])
        };
        let seen = first_of_coincident(mesh.triangles.len(), |index| (corners(index), false));
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            if seen[index] {
                let [a, b, c] = triangle.map(|vertex| first_vertex + vertex);
                slots.push([a, b, c, first_triangle + index as u32]);
            }
        }
        first_vertex += mesh.positions.len() as u32;
        first_triangle += mesh.triangles.len() as u32;
    }
    slots
}

/// The same places in the same order, but where triangles of several objects coincide in this frame all but the
/// first are points, which no ray meets; `None` where none coincide. Those with an index below `first` are no
/// objects' and stay.
pub(super) fn without_coincident(scene: &Scene, slots: &[Slot], first: u32) -> Option<Vec<Slot>> {
    let positions = positions(scene);
    let mut order: Vec<usize> = (0..slots.len()).collect();
    order.retain(|place| slots[*place][3] >= first);
    order.sort_unstable_by_key(|place| slots[*place][3]);
    let is_first = first_of_coincident(order.len(), |index| {
        let [a, b, c, _] = slots[order[index]];
        ([a, b, c].map(|vertex| positions[vertex as usize]), false)
    });
    let mut seen = slots.to_vec();
    for (place, is_first) in order.iter().zip(&is_first) {
        if !is_first {
            let [a, _, _, triangle] = slots[*place];
            seen[*place] = [a, a, a, triangle];
        }
    }
    is_first.contains(&false).then_some(seen)
}

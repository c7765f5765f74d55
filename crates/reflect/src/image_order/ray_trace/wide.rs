//! obvhs's compressed wide hierarchy, uploaded as it is, with the triangles copied in its order.

use catoptric_scene::{Random, Scene, first_of_coincident};
use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::error::ReflectError;
use crate::gpu::{Gpu, storage_bytes};

/// Levels that the shader's stack holds (`ray_trace/trace.wesl`): one entry each at most.
const STACK: usize = 48;

/// Share of the scene's extent by which boxes grow at most: as much as f32 rounds.
pub(super) const GROWTH: f32 = 1.0 / 4_194_304.0;

/// Most levels of a binary hierarchy that is folded, which takes a recursive call for each level.
const DEEPEST: usize = 1000;

/// Triangles of a leaf at most, as nodes have room for.
const LEAF: u32 = 3;

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
        let triangles: Vec<[Vec3; 3]> = meshes
            .flat_map(|mesh| {
                let triangles = mesh.triangles.iter();
                triangles.map(|triangle| triangle.map(|vertex| mesh.positions[vertex as usize]))
            })
            .collect();
        // Of coincident triangles the first is seen.
        let first = first_of_coincident(triangles.len(), |index| (triangles[index], false));
        let seen: Vec<u32> = (0..)
            .zip(&first)
            .filter_map(|(index, first)| first.then_some(index))
            .collect();
        let corners: Vec<_> = seen
            .iter()
            .map(|index| triangles[*index as usize])
            .collect();
        let folded = Folded::new(&corners);
        let ordered: Vec<[f32; 12]> = (folded.order.iter())
            .map(|&place| {
                let index = seen[place as usize];
                let [a, b, c] = triangles[index as usize];
                let index = f32::from_bits(index);
                [a.x, a.y, a.z, index, b.x, b.y, b.z, 0.0, c.x, c.y, c.z, 0.0]
            })
            .collect();
        let ordered: &[u8] = bytemuck::cast_slice(&ordered);
        Ok(Self {
            nodes: storage_bytes(gpu, bytemuck::cast_slice(&folded.nodes)),
            triangles: storage_bytes(gpu, ordered),
        })
    }
}

/// A hierarchy over triangles.
pub(super) struct Folded {
    /// The root first; never empty.
    pub(super) nodes: Vec<CwBvhNode>,
    /// Indices of the triangles, in the hierarchy's order.
    pub(super) order: Vec<u32>,
}

impl Folded {
    /// Over triangles by their corners.
    pub(super) fn new(triangles: &[[Vec3; 3]]) -> Self {
        if triangles.is_empty() {
            return Self {
                nodes: vec![CwBvhNode::default()],
                order: Vec::new(),
            };
        }
        let boxes = triangles
            .iter()
            .map(|[a, b, c]| Aabb::new(a.min(*b).min(*c).into(), a.max(*b).max(*c).into()));
        let hierarchy = hierarchy(boxes.collect());
        Self {
            nodes: hierarchy.nodes,
            order: hierarchy.primitive_indices,
        }
    }

    /// The indices of the nodes, level by level, the root's first.
    pub(super) fn levels(&self) -> Vec<Vec<u32>> {
        let mut levels = vec![vec![0]];
        loop {
            let last = levels.last().into_iter().flatten();
            let next: Vec<u32> = last
                .flat_map(|node| children(&self.nodes, *node as usize))
                .map(|child| child as u32)
                .collect();
            if next.is_empty() {
                return levels;
            }
            levels.push(next);
        }
    }
}

/// The nodes below a node.
fn children(nodes: &[CwBvhNode], index: usize) -> Vec<usize> {
    let node = &nodes[index];
    let inner = (0..8).filter(|child| !node.is_child_empty(*child) && !node.is_leaf(*child));
    inner
        .map(|child| node.child_node_index(child) as usize)
        .collect()
}

/// A hierarchy of at most [`STACK`] levels over boxes.
fn hierarchy(mut boxes: Vec<Aabb>) -> CwBvh {
    // Boxes that are alike, or lie evenly in a row, are as near to each other as to any other: PLOC
    // would join two of them at a time. So each grows a little, by chance.
    let all = boxes
        .iter()
        .fold(Aabb::INVALID, |all, aabb| all.union(aabb));
    let most = (GROWTH * all.diagonal().length()).max(f32::MIN_POSITIVE);
    let mut random = Random::new(0);
    for aabb in &mut boxes {
        let by = Vec3A::from_array([(); 3].map(|()| most * random.unit() as f32));
        *aabb = Aabb::new(aabb.min - by, aabb.max + by);
    }
    let mut binary = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::Medium,
        &boxes,
        (0..boxes.len() as u32).collect(),
        SortPrecision::U64,
        3,
    );
    ReinsertionOptimizer::default().run(&mut binary, 0.05, None);
    let fold = |binary: &Bvh2| bvh2_to_cwbvh(binary, LEAF, true, false);
    if binary_levels(&binary) <= DEEPEST {
        let wide = fold(&binary);
        if levels(&wide.nodes) <= STACK {
            return wide;
        }
    }
    fold(&balanced(&boxes))
}

/// A binary hierarchy with as few levels as there can be, however boxes lie in each other.
fn balanced(boxes: &[Aabb]) -> Bvh2 {
    let mut bvh = Bvh2::zeroed(boxes.len());
    bvh.nodes.truncate(1);
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    // A node, and which part of `order` is below it.
    let mut open = vec![(0, 0..boxes.len())];
    while let Some((node, range)) = open.pop() {
        let below = &mut order[range.clone()];
        let aabb = below.iter().fold(Aabb::INVALID, |all, index| {
            all.union(&boxes[*index as usize])
        });
        if range.len() == 1 {
            bvh.nodes[node] = Bvh2Node::new(aabb, 1, range.start as u32);
            continue;
        }
        let axis = aabb.largest_axis();
        let middle = range.len() / 2;
        below.select_nth_unstable_by(middle, |a, b| {
            let center = |index: &u32| boxes[*index as usize].center()[axis];
            center(a).total_cmp(&center(b))
        });
        let first = bvh.nodes.len();
        bvh.nodes.extend([Bvh2Node::default(); 2]);
        bvh.nodes[node] = Bvh2Node::new(aabb, 0, first as u32);
        let middle = range.start + middle;
        open.extend([(first, range.start..middle), (first + 1, middle..range.end)]);
    }
    bvh.primitive_indices = order;
    bvh
}

/// Levels of nodes.
fn levels(nodes: &[CwBvhNode]) -> usize {
    deepest(|index| children(nodes, index))
}

/// Levels of nodes of a binary hierarchy.
fn binary_levels(bvh: &Bvh2) -> usize {
    deepest(|index: usize| {
        let node = &bvh.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            vec![]
        } else {
            vec![first, first + 1]
        }
    })
}

/// Levels of a tree, by the children of each node; 0 is the root.
fn deepest(children: impl Fn(usize) -> Vec<usize>) -> usize {
    let mut deepest = 0;
    let mut waiting = vec![(0, 1)];
    while let Some((index, level)) = waiting.pop() {
        deepest = deepest.max(level);
        waiting.extend(children(index).into_iter().map(|child| (child, level + 1)));
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(center: f32, half: f32) -> Aabb {
        Aabb::new(Vec3A::splat(center - half), Vec3A::splat(center + half))
    }

    #[test]
    fn hierarchies_fit_the_shaders_stack() {
        let many = 20_000;
        let alike = vec![cube(0.0, 1.0); many];
        let row = (0..many).map(|index| cube(index as f32, 0.5)).collect();
        // Each twice as large as all before it together: no sum of areas is less than in a chain.
        let nested = (-110..110)
            .map(|power| cube(0.0, 2f32.powi(power / 2)))
            .collect();
        let onion = (0..many)
            .map(|index| cube(0.0, 1.01f32.powi(index as i32 % 4000)))
            .collect();
        for (name, boxes) in [
            ("alike", alike),
            ("row", row),
            ("nested", nested),
            ("onion", onion),
        ] {
            let boxes: Vec<_> = boxes;
            let count = boxes.len();
            let start = std::time::Instant::now();
            let wide = hierarchy(boxes);
            println!(
                "{name}: {} levels, {:?}",
                levels(&wide.nodes),
                start.elapsed()
            );
            assert!(levels(&wide.nodes) <= STACK, "{name}");
            let mut all = wide.primitive_indices;
            all.sort_unstable();
            assert!(all.into_iter().eq(0..count as u32), "{name}");
        }
    }

    #[test]
    fn a_balanced_hierarchy_is_as_shallow_as_can_be_and_whole() {
        for count in [1_usize, 2, 3, 1000] {
            let boxes: Vec<_> = (0..count).map(|index| cube(index as f32, 1.0)).collect();
            let bvh = balanced(&boxes);
            assert!(binary_levels(&bvh) <= 1 + count.next_power_of_two().ilog2() as usize);
            let mut all = fold_all(&bvh);
            all.sort_unstable();
            assert!(all.into_iter().eq(0..count as u32), "{count}");
        }
    }

    fn fold_all(bvh: &Bvh2) -> Vec<u32> {
        bvh2_to_cwbvh(bvh, LEAF, true, false).primitive_indices
    }
}

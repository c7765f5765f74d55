//! The binary hierarchy, folded into nodes of eight children.
//!
//! Which nodes of the binary hierarchy stay, and which become leaves, is chosen to make the
//! expected cost of a random ray least (surface area heuristic), by dynamic programming after
//! Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
//! BVHs", HPG 2017, section 3.1.

use glam::Vec3;
use obvhs::bvh2::Bvh2;

use super::leaf::Block;

/// Children of a node.
pub(super) const LANES: usize = 8;

/// Cost of testing a leaf, in tests of a node; between 0.5 and 2 it changes next to nothing.
const LEAF_COST: f32 = 1.0;

/// What is below a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Child(pub(super) u32);

/// A child, told apart.
pub(super) enum Kind {
    /// Index of a node.
    Node(usize),
    /// Index of a block of triangles.
    Leaf(usize),
}

impl Child {
    const LEAF: u32 = 1 << 31;
    /// Never entered: its box is inside out.
    const NONE: Self = Self(Self::LEAF);

    #[inline(always)]
    pub(super) fn kind(self) -> Kind {
        let index = (self.0 & !Self::LEAF) as usize;
        if self.0 & Self::LEAF == 0 {
            Kind::Node(index)
        } else {
            Kind::Leaf(index)
        }
    }
}

/// Eight boxes, in four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Node {
    /// Boxes relative to the hierarchy's centre, by axis, side (low, high) and child.
    pub(super) planes: [[[f32; LANES]; 2]; 3],
    pub(super) children: [Child; LANES],
}

/// Nodes of eight children.
#[derive(Clone, Debug)]
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) root: Child,
    /// Most children that ever wait on the traversal stack.
    pub(super) stack: usize,
}

impl Default for Wide {
    /// A hierarchy of nothing.
    fn default() -> Self {
        Self {
            nodes: vec![Node::EMPTY],
            root: Child(0),
            stack: 0,
        }
    }
}

impl Node {
    const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]]; 3],
        children: [Child::NONE; LANES],
    };
}

/// What becomes of a node of the binary hierarchy that is a root among `roots` siblings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Choice {
    /// Its triangles become a leaf, at most [`Block::TRIANGLES`].
    #[default]
    Leaf,
    /// A node of its own.
    Node,
    /// Its two children take its place; the first gets this many of its child slots.
    Open(u8),
}

/// Least cost of a subtree, and the choice that gives it: `[k]` if it may take `k + 1` child slots.
#[derive(Clone, Copy, Default)]
struct Plan {
    cost: [f32; LANES],
    choice: [Choice; LANES],
    /// How the child slots are shared out if it becomes a node of its own.
    own: u8,
    triangles: u32,
}

/// Folds a hierarchy with a box a leaf; blocks are in the order in which they are reached.
pub(super) fn fold(bvh: &Bvh2, triangles: &[[Vec3; 3]]) -> (Wide, Vec<Block>) {
    let plans = plan(bvh);
    let mut wide = Wide {
        nodes: Vec::new(),
        root: Child(0),
        stack: 0,
    };
    let mut blocks = Vec::new();
    // A node of the binary hierarchy, and where its index goes: parent, place, and how many wait.
    let mut open = vec![(0, None, 0)];
    while let Some((index, parent, waiting)) = open.pop() {
        let child = if plans[index].choice[0] == Choice::Leaf {
            blocks.push(leaf(bvh, index, triangles));
            Child(Child::LEAF | (blocks.len() - 1) as u32)
        } else {
            let mut places = Vec::with_capacity(LANES);
            let shared = Choice::Open(plans[index].own);
            share(bvh, &plans, index, LANES, shared, &mut places);
            let mut node = Node::EMPTY;
            let own = wide.nodes.len();
            for (place, below) in places.iter().enumerate() {
                let aabb = bvh.nodes[*below].aabb();
                for axis in 0..3 {
                    node.planes[axis][0][place] = aabb.min[axis];
                    node.planes[axis][1][place] = aabb.max[axis];
                }
                open.push((*below, Some((own, place)), waiting + places.len() - 1));
            }
            wide.stack = wide.stack.max(waiting + places.len());
            wide.nodes.push(node);
            Child(own as u32)
        };
        match parent {
            Some((parent, place)) => {
                let parent: &mut Node = &mut wide.nodes[parent];
                parent.children[place] = child;
            }
            None => wide.root = child,
        }
    }
    (wide, blocks)
}

/// The triangles below a node; one that was split is there once.
fn leaf(bvh: &Bvh2, index: usize, triangles: &[[Vec3; 3]]) -> Block {
    let mut below = Vec::with_capacity(Block::TRIANGLES);
    let mut open = vec![index];
    while let Some(index) = open.pop() {
        let node = &bvh.nodes[index];
        let first = node.first_index as usize;
        if node.is_leaf() {
            below.extend(&bvh.primitive_indices[first..first + node.prim_count as usize]);
        } else {
            open.extend([first, first + 1]);
        }
    }
    below.sort_unstable();
    below.dedup();
    Block::new(&below, triangles)
}

/// Collects the children of a wide node.
fn share(
    bvh: &Bvh2,
    plans: &[Plan],
    index: usize,
    places: usize,
    choice: Choice,
    into: &mut Vec<usize>,
) {
    match choice {
        Choice::Leaf | Choice::Node => into.push(index),
        Choice::Open(left) => {
            let left = usize::from(left);
            let first = bvh.nodes[index].first_index as usize;
            for (child, places) in [(first, left), (first + 1, places - left)] {
                share(
                    bvh,
                    plans,
                    child,
                    places,
                    plans[child].choice[places - 1],
                    into,
                );
            }
        }
    }
}

/// The best plan for every node of the binary hierarchy.
fn plan(bvh: &Bvh2) -> Vec<Plan> {
    let mut order = Vec::with_capacity(bvh.nodes.len());
    let mut open = vec![0];
    while let Some(index) = open.pop() {
        order.push(index);
        let node = &bvh.nodes[index];
        if !node.is_leaf() {
            let first = node.first_index as usize;
            open.extend([first, first + 1]);
        }
    }
    let mut plans = vec![Plan::default(); bvh.nodes.len()];
    for index in order.into_iter().rev() {
        let node = &bvh.nodes[index];
        let area = node.aabb().half_area();
        let first = node.first_index as usize;
        if node.is_leaf() {
            plans[index] = Plan {
                cost: [area * LEAF_COST; LANES],
                triangles: node.prim_count,
                ..Plan::default()
            };
            continue;
        }
        let (left, right) = (&plans[first], &plans[first + 1]);
        let split = |places: usize| {
            let cost = |share: usize| left.cost[share - 1] + right.cost[places - share - 1];
            let best = (1..places).min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
            let best = best.expect("at least two places");
            (cost(best), best as u8)
        };
        let triangles = left.triangles + right.triangles;
        let (below, own) = split(LANES);
        let mut plan = Plan {
            own,
            triangles,
            ..Plan::default()
        };
        plan.cost[0] = area + below;
        plan.choice[0] = Choice::Node;
        if triangles as usize <= Block::TRIANGLES && area * LEAF_COST <= plan.cost[0] {
            plan.cost[0] = area * LEAF_COST;
            plan.choice[0] = Choice::Leaf;
        }
        for places in 2..=LANES {
            let (cost, share) = split(places);
            plan.cost[places - 1] = plan.cost[places - 2];
            plan.choice[places - 1] = plan.choice[places - 2];
            if cost < plan.cost[places - 2] {
                plan.cost[places - 1] = cost;
                plan.choice[places - 1] = Choice::Open(share);
            }
        }
        plans[index] = plan;
    }
    plans
}

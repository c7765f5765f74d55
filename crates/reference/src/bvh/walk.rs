//! From the root to the nearest triangle, one ray at a time.

use std::ops::Range;

use fearless_simd::{Simd, SimdBase, f32x8, prelude::*};
use glam::{DVec3, Vec3};

use super::leaf::{Block, Sheared};
use super::wide::{Child, Kind, LANES, Wide};

/// Entries that may wait without a heap allocation; 66 444 triangles of architecture need 71.
const STACK: usize = 128;

/// Distances are the same if they are apart by no more than this share of the triangles' extent, or
/// of themselves: some thousand rounding steps of f64, and far below what f32 resolves.
pub(super) const EQUAL: f64 = 1e-12;

/// A hierarchy over triangles.
pub(super) struct Tree {
    pub(super) wide: Wide,
    pub(super) blocks: Vec<Block>,
    /// Middle of the triangles' bounding box, world space; `wide` is relative to it.
    pub(super) center: DVec3,
    /// Half the diagonal of that box.
    pub(super) radius: f64,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Index into the triangles the hierarchy was built from.
    pub triangle: u32,
    /// Distance along the (unit) ray, world units.
    pub t: f64,
    /// Weights of the corners, summing to 1.
    pub barycentric: DVec3,
    /// The triangle's corners, world space.
    pub corners: [DVec3; 3],
}

/// A ray, and between which distances it may hit.
pub(super) struct Query {
    pub(super) origin: DVec3,
    pub(super) dir: DVec3,
    pub(super) within: Range<f64>,
}

/// The nearest triangle.
pub(super) struct Found {
    pub(super) hit: TriangleHit,
    /// Distances that are no more than this apart are the same ([`EQUAL`]).
    pub(super) equal: f64,
    /// Another triangle may be hit at the same distance.
    pub(super) tied: bool,
}

/// What a ray takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Nodes of eight boxes tested.
    pub nodes: u32,
    /// Blocks of four triangles tested.
    pub blocks: u32,
    /// Of the blocks, those with a triangle that the whole line meets.
    pub met: u32,
}

/// Is told of every test of a node or block.
pub(super) trait Observer {
    fn node(&mut self) {}
    fn block(&mut self) {}
    fn met(&mut self) {}
}

impl Observer for () {}

impl Observer for Work {
    fn node(&mut self) {
        self.nodes += 1;
    }
    fn block(&mut self) {
        self.blocks += 1;
    }
    fn met(&mut self) {
        self.met += 1;
    }
}

/// Distance in the upper half, child in the lower: in the order of distance.
#[inline(always)]
fn waiting(near: f32, child: Child) -> u64 {
    (u64::from(near.to_bits()) << 32) | u64::from(child.0)
}

/// Nearest triangle of `tree` that the ray hits, of those that are accepted by their index.
#[inline(always)]
pub(super) fn nearest<S: Simd, O: Observer>(
    simd: S,
    tree: &Tree,
    query: &Query,
    observer: &mut O,
    accepts: &impl Fn(u32) -> bool,
) -> Option<Found> {
    let mut small = [0; STACK];
    let mut large;
    let stack: &mut [u64] = if tree.wide.stack <= STACK {
        &mut small
    } else {
        large = vec![0; tree.wide.stack];
        &mut large
    };
    let to_center = tree.center - query.origin;
    // A ray that meets the bounding sphere at all meets it no earlier than here.
    let skip = (to_center.dot(query.dir) - tree.radius * 1.001).max(0.0);
    let start = (skip * query.dir - to_center).as_vec3();
    let dir = query.dir.as_vec3();
    let inverse = Vec3::new(inverse(dir.x), inverse(dir.y), inverse(dir.z));
    let shift = -start * inverse;
    let axes = [
        Axis::new(simd, inverse.x, shift.x),
        Axis::new(simd, inverse.y, shift.y),
        Axis::new(simd, inverse.z, shift.z),
    ];
    let sheared = Sheared::new(simd, query.origin, query.dir);

    // The best so far: distance, index among all triangles, block and lane, weights.
    let mut nearest = query.within.end;
    let mut triangle = 0;
    let mut place = None;
    let mut barycentric = DVec3::ZERO;
    let mut tied = false;
    let equal = EQUAL * (tree.radius + skip);
    let mut limit = above(query.within.end - skip);
    let mut waits = 0;
    let mut child = tree.wide.root;
    loop {
        match child.kind() {
            Kind::Node(index) => {
                observer.node();
                let node = &tree.wide.nodes[index];
                let [x, y, z] = &node.planes;
                let near = axes[0]
                    .near(simd, x)
                    .max(axes[1].near(simd, y))
                    .max(axes[2].near(simd, z).max(f32x8::splat(simd, 0.0)));
                let far = axes[0]
                    .far(simd, x)
                    .min(axes[1].far(simd, y))
                    .min(axes[2].far(simd, z).min(f32x8::splat(simd, limit)));
                let mut bits = near.simd_le(far).to_bitmask();
                if bits != 0 {
                    let near: [f32; LANES] = near.into();
                    let first = bits.trailing_zeros() as usize % LANES;
                    bits &= bits - 1;
                    if bits == 0 {
                        child = node.children[first];
                        continue;
                    }
                    let base = waits;
                    stack[waits] = waiting(near[first], node.children[first]);
                    waits += 1;
                    while bits != 0 {
                        let lane = bits.trailing_zeros() as usize % LANES;
                        bits &= bits - 1;
                        // Nearer children lie nearer the top.
                        let entry = waiting(near[lane], node.children[lane]);
                        let mut at = waits;
                        while at > base && stack[at - 1] < entry {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = entry;
                        waits += 1;
                    }
                }
            }
            Kind::Leaf(index) => {
                observer.block();
                let block = &tree.blocks[index];
                if let Some((mut bits, lanes)) = sheared.intersect(simd, block) {
                    observer.met();
                    while bits != 0 {
                        let lane = bits.trailing_zeros() as usize % Block::TRIANGLES;
                        bits &= bits - 1;
                        let (t, candidate) = (lanes.t[lane], block.original[lane]);
                        if !(t > query.within.start && accepts(candidate)) {
                            continue;
                        }
                        let other = place.is_some() && candidate != triangle;
                        tied |= other && (t - nearest).abs() <= equal;
                        if t < nearest || t == nearest && candidate < triangle {
                            let [u, v, w] = lanes.barycentric;
                            nearest = t;
                            triangle = candidate;
                            place = Some((index, lane));
                            barycentric = DVec3::new(u[lane], v[lane], w[lane]);
                            limit = above(t - skip);
                        }
                    }
                }
            }
        }
        loop {
            if waits == 0 {
                return place.map(|(block, lane)| Found {
                    hit: TriangleHit {
                        triangle,
                        t: nearest,
                        barycentric,
                        corners: tree.blocks[block].corners(lane),
                    },
                    equal,
                    tied,
                });
            }
            waits -= 1;
            let entry = stack[waits];
            if f32::from_bits((entry >> 32) as u32) <= limit {
                child = Child(entry as u32);
                break;
            }
        }
    }
}

/// One axis of a ray's way through boxes: distance = plane × scale + shift.
struct Axis<S: Simd> {
    scale: f32x8<S>,
    shift: f32x8<S>,
    /// Which side of a box is met first: 0 or 1.
    first: usize,
}

impl<S: Simd> Axis<S> {
    #[inline(always)]
    fn new(simd: S, scale: f32, shift: f32) -> Self {
        Self {
            scale: f32x8::splat(simd, scale),
            shift: f32x8::splat(simd, shift),
            first: usize::from(scale < 0.0),
        }
    }

    #[inline(always)]
    fn near(&self, simd: S, sides: &[[f32; LANES]; 2]) -> f32x8<S> {
        f32x8::simd_from(simd, sides[self.first & 1]).mul_add(self.scale, self.shift)
    }

    #[inline(always)]
    fn far(&self, simd: S, sides: &[[f32; LANES]; 2]) -> f32x8<S> {
        f32x8::simd_from(simd, sides[(self.first ^ 1) & 1]).mul_add(self.scale, self.shift)
    }
}

/// 1 ÷ a component of a direction, finite.
#[inline(always)]
fn inverse(component: f32) -> f32 {
    1.0 / if component.abs() < f32::EPSILON {
        f32::EPSILON.copysign(component)
    } else {
        component
    }
}

/// An f32 not below `t`, where that is not negative (else no box is entered anyway).
#[inline(always)]
fn above(t: f64) -> f32 {
    t as f32 * (1.0 + f32::EPSILON)
}

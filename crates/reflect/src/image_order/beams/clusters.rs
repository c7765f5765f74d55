//! Neighbouring triangles in clusters, made once. If no ray of a node may meet a cluster's box, the node
//! need not test the cluster's triangles.

use catoptric_scene::Scene;
use glam::Vec3;

use crate::image_order::coincident::{self, Slot};

/// Triangles of a cluster; only the last one has fewer. Twin of `CLUSTER` in `beams/node.wesl`.
pub(super) const CLUSTER: usize = 32;

/// More triangles than this are halved along the longest side of their box; for fewer, the best cut along
/// any axis is found.
const MANY: usize = 1 << 15;

/// The places of all triangles, one cluster after the other. Indices count the mirrors' triangles first,
/// then those of the objects.
pub(super) fn clusters(scene: &Scene, mirrors: &[[Vec3; 3]]) -> Vec<Slot> {
    let of_objects = coincident::slots(scene, mirrors.len() as u32);
    let positions = coincident::positions(scene);
    let of_object = |[a, b, c, _]: &Slot| [*a, *b, *c].map(|vertex| positions[vertex as usize]);
    let mirror = |index: usize| [0, 0, 0, index as u32];
    let mut slots: Vec<Slot> = (0..mirrors.len()).map(mirror).collect();
    let corners = mirrors
        .iter()
        .copied()
        .chain(of_objects.iter().map(of_object));
    let boxes: Vec<Bounds> = corners.map(Bounds::of).collect();
    slots.extend(&of_objects);
    in_clusters(&slots, &boxes)
}

/// The places of all triangles of a list, one cluster after the other.
pub(super) fn of_triangles(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Slot> {
    let slots = triangles.iter().zip(0..);
    let slots: Vec<Slot> = slots
        .map(|([a, b, c], index)| [*a, *b, *c, index])
        .collect();
    let corners = |triangle: &[u32; 3]| triangle.map(|vertex| positions[vertex as usize]);
    let boxes: Vec<_> = triangles
        .iter()
        .map(|triangle| Bounds::of(corners(triangle)))
        .collect();
    in_clusters(&slots, &boxes)
}

/// The places of triangles that lie in these boxes, one cluster after the other.
fn in_clusters(slots: &[Slot], boxes: &[Bounds]) -> Vec<Slot> {
    let mut order: Vec<u32> = (0..slots.len() as u32).collect();
    sort(&mut order, boxes);
    order.iter().map(|index| slots[*index as usize]).collect()
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    const NOTHING: Self = Self {
        low: Vec3::INFINITY,
        high: Vec3::NEG_INFINITY,
    };

    fn of([a, b, c]: [Vec3; 3]) -> Self {
        Self {
            low: a.min(b).min(c),
            high: a.max(b).max(c),
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Twice the centre.
    fn middle(self) -> Vec3 {
        self.low + self.high
    }

    /// Half the surface.
    fn area(self) -> f32 {
        let [x, y, z] = (self.high - self.low).to_array();
        x * y + y * z + z * x
    }
}

/// Puts triangles into an order whose runs of [`CLUSTER`] lie close together: the list is cut in two at
/// such a run's end, and each part again.
fn sort(order: &mut [u32], boxes: &[Bounds]) {
    let mut open = vec![order];
    while let Some(part) = open.pop() {
        if part.len() <= CLUSTER {
            continue;
        }
        let at = if part.len() > MANY {
            halve(part, boxes)
        } else {
            cut(part, boxes)
        };
        let (left, right) = part.split_at_mut(at);
        open.extend([left, right]);
    }
}

/// Orders triangles by their centres along an axis as far as two halves are concerned; the answer is
/// where the second one begins.
fn halve(part: &mut [u32], boxes: &[Bounds]) -> usize {
    let middle = |index: &u32| boxes[*index as usize].middle();
    let all = part.iter().fold(Bounds::NOTHING, |all, index| {
        let point = middle(index);
        all.and(Bounds {
            low: point,
            high: point,
        })
    });
    let axis = (all.high - all.low).max_position();
    let at = (part.len() / 2).next_multiple_of(CLUSTER);
    part.select_nth_unstable_by(at, |a, b| {
        (middle(a)[axis].total_cmp(&middle(b)[axis])).then(a.cmp(b))
    });
    at
}

/// Orders triangles by their centres along the axis with the best cut; the answer is where the second
/// part begins. The best cut leaves the least sum of surface times number.
fn cut(part: &mut [u32], boxes: &[Bounds]) -> usize {
    let by = |axis: usize| {
        move |a: &u32, b: &u32| {
            let middle = |index: &u32| boxes[*index as usize].middle()[axis];
            middle(a).total_cmp(&middle(b)).then(a.cmp(b))
        }
    };
    let mut best = (f32::INFINITY, 0, CLUSTER);
    let mut behind = vec![0.0; part.len().div_ceil(CLUSTER)];
    for axis in 0..3 {
        part.sort_unstable_by(by(axis));
        let runs = || part.chunks(CLUSTER).enumerate();
        let joined = |all: Bounds, run: &[u32]| {
            (run.iter()).fold(all, |all, index| all.and(boxes[*index as usize]))
        };
        let mut all = Bounds::NOTHING;
        for (place, run) in runs().rev() {
            all = joined(all, run);
            behind[place] = all.area() * (part.len() - place * CLUSTER) as f32;
        }
        let mut all = Bounds::NOTHING;
        for (place, run) in runs().take(behind.len() - 1) {
            all = joined(all, run);
            let at = (place + 1) * CLUSTER;
            let cost = all.area() * at as f32 + behind[place + 1];
            if cost < best.0 {
                best = (cost, axis, at);
            }
        }
    }
    let (_, axis, at) = best;
    if axis != 2 {
        part.sort_unstable_by(by(axis));
    }
    at
}

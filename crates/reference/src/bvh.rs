//! Triangles in a bounding volume hierarchy, hit by a watertight test in f64.
//!
//! obvhs builds the hierarchy: PLOC with reinsertion, large triangles split beforehand. It is
//! folded into nodes of eight children and walked with vector instructions, f32 for boxes and f64
//! for triangles, in the widest form that the processor at hand has. Boxes are enlarged so that no
//! f32 rounding can lose a triangle, and rays are moved up to the triangles' bounding sphere
//! before they are rounded, so that far origins cost no precision. Whether and where a triangle is
//! hit is decided in f64, watertight (Woop, Benthin and Wald 2013).
//!
//! The answer depends on the triangles and the ray alone: not on the shape of the hierarchy, nor
//! on the processor (arithmetic that decides is never fused). Of triangles hit at the same
//! distance, to rounding (`EQUAL`), the first wins.

mod leaf;
#[cfg(test)]
mod tests;
mod walk;
mod wide;

use std::ops::Range;

use catoptric_scene::Random;
use fearless_simd::{Level, dispatch};
use glam::{DVec3, Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use obvhs::splits::split_aabbs_preset;
use obvhs::triangle::Triangle;

pub use walk::{TriangleHit, Work};

/// Boxes grow by this share of the triangles' extent: some 30 rounding steps of f32. (No component
/// of a direction counts as smaller than f32's epsilon; this is also enough for rays that run
/// along an axis inside a flat box.)
const PADDING: f64 = 4e-6;

/// Triangles in a hierarchy.
pub struct TriangleBvh {
    tree: walk::Tree,
    triangles: usize,
    level: Level,
}

impl TriangleBvh {
    /// Builds a hierarchy over triangles with finite corners; none at all is fine.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for corner in triangles.iter().flatten() {
            low = low.min(corner.as_dvec3());
            high = high.max(corner.as_dvec3());
        }
        if triangles.is_empty() {
            (low, high) = (DVec3::ZERO, DVec3::ZERO);
        }
        let center = (low + high) / 2.0;
        let radius = (high - low).length() / 2.0;
        let (wide, blocks) = if triangles.is_empty() {
            Default::default()
        } else {
            wide::fold(&build(triangles, center, radius), triangles)
        };
        Self {
            tree: walk::Tree {
                wide,
                blocks,
                center,
                radius,
            },
            triangles: triangles.len(),
            level: Level::new(),
        }
    }

    /// Half the diagonal of the bounding box of all triangles, world units.
    pub fn radius(&self) -> f64 {
        self.tree.radius
    }

    /// Nearest triangle with `t_min < t < t_max` along the ray (`dir` of unit length), whichever
    /// way it faces.
    pub fn intersect(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        t_max: f64,
    ) -> Option<TriangleHit> {
        self.search(origin, dir, t_min..t_max, &mut ())
    }

    /// Nearest triangle with `t_min < t < t_max` along the ray (`dir` of unit length) among those
    /// that are accepted by their index.
    pub fn intersect_among(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        t_max: f64,
        accepts: impl Fn(u32) -> bool,
    ) -> Option<TriangleHit> {
        let query = walk::Query {
            origin,
            dir,
            within: t_min..t_max,
        };
        let found = dispatch!(self.level, simd => walk::nearest(simd, &self.tree, &query, &mut (), &accepts));
        found.map(|found| found.hit)
    }

    /// As [`Self::intersect`], and what it takes.
    pub fn intersect_counted(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        t_max: f64,
    ) -> (Option<TriangleHit>, Work) {
        let mut work = Work::default();
        let hit = self.search(origin, dir, t_min..t_max, &mut work);
        (hit, work)
    }

    fn search<O: walk::Observer>(
        &self,
        origin: DVec3,
        dir: DVec3,
        within: Range<f64>,
        observer: &mut O,
    ) -> Option<TriangleHit> {
        let query = walk::Query {
            origin,
            dir,
            within,
        };
        let all = |_| true;
        let found =
            dispatch!(self.level, simd => walk::nearest(simd, &self.tree, &query, observer, &all))?;
        let mut hit = found.hit;
        if found.tied {
            // Each time a lower index, so that it ends.
            let last = (found.hit.t + found.equal).next_up().min(query.within.end);
            let first = query.within.start;
            while let Some(other) =
                self.intersect_among(origin, dir, first, last, |index| index < hit.triangle)
            {
                hit = other;
            }
        }
        Some(hit)
    }
}

/// The binary hierarchy, relative to the centre, where f32 is finest: one box a leaf.
fn build(triangles: &[[Vec3; 3]], center: DVec3, radius: f64) -> Bvh2 {
    let triangles: Vec<Triangle> = triangles
        .iter()
        .map(|corners| {
            let [v0, v1, v2] =
                corners.map(|corner| Vec3A::from((corner.as_dvec3() - center).as_vec3()));
            Triangle { v0, v1, v2 }
        })
        .collect();
    let mut boxes: Vec<Aabb> = triangles
        .iter()
        .map(|triangle| Aabb::from_points(&[triangle.v0, triangle.v1, triangle.v2]))
        .collect();
    let mut indices: Vec<u32> = (0..triangles.len() as u32).collect();
    let areas = || boxes.iter().map(Aabb::half_area);
    let mean = areas().sum::<f32>() / boxes.len() as f32;
    let largest = areas().fold(0.0, f32::max);
    split_aabbs_preset(&mut boxes, &mut indices, &triangles, mean, largest);
    // Where boxes are alike, or lie evenly in a row, each is as near to its neighbours as to any
    // other: PLOC would join two of them at a time. So each grows a little more, by chance.
    let mut random = Random::new(0);
    let padding = ((radius * PADDING) as f32).max(f32::MIN_POSITIVE);
    for aabb in &mut boxes {
        let more = [(); 3].map(|()| 1.0 + random.unit() as f32);
        let padding = padding * Vec3A::from_array(more);
        *aabb = Aabb::new(aabb.min - padding, aabb.max + padding);
    }
    let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
        PlocSearchDistance::Medium,
        &boxes,
        indices,
        SortPrecision::U64,
        3,
    );
    ReinsertionOptimizer::default().run(&mut bvh, 0.2, None);
    bvh
}

impl std::fmt::Debug for TriangleBvh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TriangleBvh")
            .field("triangles", &self.triangles)
            .field("center", &self.tree.center)
            .field("radius", &self.tree.radius)
            .finish_non_exhaustive()
    }
}

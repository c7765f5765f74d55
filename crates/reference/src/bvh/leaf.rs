//! Four triangles at once against a ray, watertight, in f64.
//!
//! After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013: space is
//! sheared so that the ray runs along an axis; each corner is projected by the same operations
//! whichever triangle it belongs to, and the sign of an edge function is exactly opposite for the
//! two triangles at an edge, so that no ray slips between them. Products and differences are plain:
//! a fused multiply-add would break that symmetry.

use fearless_simd::{Simd, SimdBase, f64x4, prelude::*};
use glam::{DVec3, Vec3};

/// Triangles side by side; lanes that are not used hold NaN, which no ray hits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// World-space coordinates, by corner, axis and triangle.
    corners: [[[f32; 4]; 3]; 3],
    /// Indices into the triangles that the hierarchy was built from.
    pub(super) original: [u32; 4],
}

impl Block {
    /// Triangles side by side.
    pub(super) const TRIANGLES: usize = 4;

    /// At most [`Self::TRIANGLES`], by their indices.
    pub(super) fn new(indices: &[u32], triangles: &[[Vec3; 3]]) -> Self {
        let mut block = Self {
            corners: [[[f32::NAN; 4]; 3]; 3],
            original: [0; 4],
        };
        for (lane, index) in indices.iter().enumerate() {
            for (corner, position) in triangles[*index as usize].iter().enumerate() {
                for axis in 0..3 {
                    block.corners[corner][axis][lane] = position[axis];
                }
            }
            block.original[lane] = *index;
        }
        block
    }

    /// The corners of one triangle.
    pub(super) fn corners(&self, lane: usize) -> [DVec3; 3] {
        self.corners
            .map(|corner| DVec3::from_array(corner.map(|axis| f64::from(axis[lane]))))
    }
}

/// A ray, and the shear that turns it into an axis.
pub(super) struct Sheared<S: Simd> {
    /// The order of the axes: last is the one along which the ray runs most.
    axes: [usize; 3],
    /// The ray's origin, in that order of axes.
    origin: [f64x4<S>; 3],
    /// How far the two others move along the ray when the last moves by one.
    slope: [f64x4<S>; 2],
    /// The ray's direction along the last axis.
    along: f64x4<S>,
}

/// Four lanes of a test.
pub(super) struct Lanes {
    pub(super) t: [f64; 4],
    /// Weights of the corners.
    pub(super) barycentric: [[f64; 4]; 3],
}

impl<S: Simd> Sheared<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, origin: DVec3, dir: DVec3) -> Self {
        let (origin, dir) = (origin.to_array(), dir.to_array());
        let mut last = usize::from(dir[1].abs() > dir[0].abs());
        if dir[2].abs() > dir[last].abs() {
            last = 2;
        }
        // The order of the others does not matter: in each, all corners are treated alike.
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][last];
        let [x, y, z] = axes;
        Self {
            axes,
            origin: [
                f64x4::splat(simd, origin[x]),
                f64x4::splat(simd, origin[y]),
                f64x4::splat(simd, origin[z]),
            ],
            slope: [
                f64x4::splat(simd, dir[x] / dir[z]),
                f64x4::splat(simd, dir[y] / dir[z]),
            ],
            along: f64x4::splat(simd, dir[z]),
        }
    }

    /// Four corners: across the ray, and along its last axis.
    #[inline(always)]
    fn project(&self, simd: S, corners: &[[f32; 4]; 3]) -> (f64x4<S>, f64x4<S>, f64x4<S>) {
        let [x, y, z] = self.axes;
        let x = widen(simd, &corners[x]) - self.origin[0];
        let y = widen(simd, &corners[y]) - self.origin[1];
        let z = widen(simd, &corners[z]) - self.origin[2];
        (x - self.slope[0] * z, y - self.slope[1] * z, z)
    }

    /// Lanes whose triangle the whole line meets (as bits), and where. Edges and corners belong to
    /// all their triangles. A triangle seen edge-on has NaN there.
    #[inline(always)]
    pub(super) fn intersect(&self, simd: S, block: &Block) -> Option<(u64, Lanes)> {
        let (ax, ay, az) = self.project(simd, &block.corners[0]);
        let (bx, by, bz) = self.project(simd, &block.corners[1]);
        let (cx, cy, cz) = self.project(simd, &block.corners[2]);
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let zero = f64x4::splat(simd, 0.0);
        let inside = u.min(v).min(w).simd_ge(zero) | u.max(v).max(w).simd_le(zero);
        let bits = inside.to_bitmask();
        if bits == 0 {
            return None;
        }
        let sum = u + v + w;
        let (u, v, w) = (u / sum, v / sum, w / sum);
        let t = (u * az + v * bz + w * cz) / self.along;
        let lanes = Lanes {
            t: t.into(),
            barycentric: [u.into(), v.into(), w.into()],
        };
        Some((bits, lanes))
    }
}

#[inline(always)]
fn widen<S: Simd>(simd: S, [a, b, c, d]: &[f32; 4]) -> f64x4<S> {
    f64x4::simd_from(
        simd,
        [f64::from(*a), f64::from(*b), f64::from(*c), f64::from(*d)],
    )
}

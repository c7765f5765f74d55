//! Triangle meshes in world space, and what they are painted with.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3};

use crate::texture::Texture;

/// A triangle mesh with unique positions and per-corner attributes.
///
/// Positions are merged when bitwise equal after the transform, so that a search visits each
/// once. Attributes are stored per triangle corner, in the order of `triangles`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Unique world-space positions.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Unit shading normals a corner; empty where the mesh has none (always full for mirrors).
    pub normals: Vec<[Vec3; 3]>,
    /// Texture coordinates a corner, v = 0 at the picture's bottom; empty where there are none.
    pub uvs: Vec<[Vec2; 3]>,
    /// Linear RGB a corner; empty unless a material is [`Paint::Vertex`].
    pub colors: Vec<[Vec3; 3]>,
    /// Index into `materials`, one a triangle.
    pub material: Vec<u32>,
    /// At least one where there are triangles.
    pub materials: Vec<Material>,
}

impl Mesh {
    /// Corners of the smallest axis-parallel box around all positions; `None` without positions.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let first = *self.positions.first()?;
        Some(
            self.positions
                .iter()
                .fold((first, first), |(low, high), p| (low.min(*p), high.max(*p))),
        )
    }

    /// True where each edge joins exactly two triangles of opposite edge direction.
    pub fn is_closed(&self) -> bool {
        let mut edges = HashMap::new();
        for &[a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (key, sign) = if from < to {
                    ((from, to), 1i64)
                } else {
                    ((to, from), -1)
                };
                let (count, sum) = edges.entry(key).or_insert((0u32, 0i64));
                *count += 1;
                *sum += sign;
            }
        }
        !edges.is_empty() && edges.values().all(|(count, sum)| *count == 2 && *sum == 0)
    }

    /// How often the surface winds around a point: ±1 inside a closed surface, 0 outside.
    pub fn winding_number(&self, point: DVec3) -> f64 {
        let solid_angle = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| self.positions[i as usize].as_dvec3() - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let numerator = a.dot(b.cross(c));
            let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * numerator.atan2(denominator)
        };
        self.triangles.iter().map(solid_angle).sum::<f64>() / (4.0 * PI)
    }
}

/// A named paint.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// From the MTL file, or the object's name.
    pub name: String,
    /// The surface's own colour.
    pub paint: Paint,
}

/// The colour of an unlit surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    /// One linear RGB colour.
    Color(Vec3),
    /// `a` where ⌊u·cells⌋ + ⌊v·cells⌋ is even, else `b`.
    Checker {
        /// Colour of the even cells.
        a: Vec3,
        /// Colour of the odd cells.
        b: Vec3,
        /// Cells along each of u and v in [0, 1].
        cells: u32,
    },
    /// `tint` times a texture.
    Texture {
        /// Linear RGB factor (Kd).
        tint: Vec3,
        /// The picture.
        image: Arc<Texture>,
    },
    /// The interpolated corner colours.
    Vertex,
}

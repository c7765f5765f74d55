//! Triangle meshes in world space, and what they are painted with.

use std::sync::Arc;

use glam::{Vec2, Vec3};

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

/// A picture decoded to linear RGB, to be sampled bilinearly at its finest level with repeat.
///
/// Texel (0, 0) is the top left; texture coordinate v = 0 is the bottom edge: the texel centre
/// of column `i`, row `j` is at `u = (i + ½)/width`, `v = 1 − (j + ½)/height`.
#[derive(Debug, PartialEq)]
pub struct Texture {
    /// Texels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear RGB, rows from the top.
    pub texels: Vec<Vec3>,
}

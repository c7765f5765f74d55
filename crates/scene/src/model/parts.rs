//! What model files hold: parts, their materials, cameras.

use glam::{DMat4, DVec3, Vec2, Vec3};

use crate::geometry::Geometry;
use crate::mtl::DEFAULT_COLOR;
use crate::picture::PictureSource;

/// What a model file holds.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Meshes, each of one material, in the file's order.
    pub parts: Vec<Part>,
    /// Places to look from.
    pub cameras: Vec<ModelCamera>,
    /// What of the file is not taken over, a sentence each, with its name.
    pub left_out: Vec<String>,
}

/// A mesh of one material, in the model's space.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// As the file calls it; may be empty.
    pub name: String,
    /// Its triangles.
    pub mesh: Triangles,
    /// Its material.
    pub surface: Surface,
}

/// Triangles with what the file says of their corners.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// Positions, not merged.
    pub positions: Vec<DVec3>,
    /// Three indices into `positions` a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Shading normals a corner; empty where there are none.
    pub normals: Vec<[DVec3; 3]>,
    /// Texture coordinates a corner, v = 0 at the picture's bottom; empty where there are none.
    pub uvs: Vec<[Vec2; 3]>,
    /// Linear RGB a corner; empty where there are none.
    pub colors: Vec<[Vec3; 3]>,
}

/// What is known of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// As the file calls it; may be empty.
    pub name: String,
    /// Linear RGB; multiplies the picture where there is one.
    pub color: Vec3,
    /// A picture of its colour.
    pub picture: Option<PictureSource>,
    /// Whether it is a metal, by what the file says.
    pub metal: bool,
    /// Roughness as artists give it, 0 to 1.
    pub roughness: f64,
}

/// A camera with perspective.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelCamera {
    /// As the file calls it; may be empty.
    pub name: String,
    /// Where it stands.
    pub eye: DVec3,
    /// Unit direction of view.
    pub forward: DVec3,
    /// Unit direction that is up in the picture.
    pub up: DVec3,
    /// Vertical angle, degrees.
    pub fov_y: f64,
    /// Width by height of the picture, where it is given.
    pub aspect: Option<f64>,
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            name: String::new(),
            color: DEFAULT_COLOR,
            picture: None,
            metal: false,
            roughness: 1.0,
        }
    }
}

impl Triangles {
    /// Moves all positions by an affine map, and turns normals with them. A map that mirrors turns the
    /// triangles over, so that they stay counter-clockwise from outside.
    pub fn transform(&mut self, matrix: &DMat4) {
        if *matrix == DMat4::IDENTITY {
            return;
        }
        for position in &mut self.positions {
            *position = matrix.transform_point3(*position);
        }
        let linear = glam::DMat3::from_mat4(*matrix);
        let to_normal = linear.inverse().transpose();
        for normal in self.normals.as_flattened_mut() {
            *normal = (to_normal * *normal).normalize_or_zero();
        }
        if linear.determinant() < 0.0 {
            self.turn_over();
        }
    }

    /// The same triangles seen from behind.
    pub fn turn_over(&mut self) {
        self.triangles.iter_mut().for_each(|three| three.swap(1, 2));
        self.normals.iter_mut().for_each(|three| three.swap(1, 2));
        self.uvs.iter_mut().for_each(|three| three.swap(1, 2));
        self.colors.iter_mut().for_each(|three| three.swap(1, 2));
    }
}

impl From<Geometry> for Triangles {
    fn from(geometry: Geometry) -> Self {
        // Normals that only some corners have are left to be made anew.
        let normals = match geometry.bare.as_flattened().contains(&true) {
            true => Vec::new(),
            false => geometry.normals,
        };
        Self {
            positions: geometry.positions,
            triangles: geometry.triangles,
            normals,
            uvs: geometry.uvs,
            colors: geometry.colors,
        }
    }
}

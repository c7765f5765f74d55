//! What a shape is made of.

use catoptric_scene::model::PictureSource;
use glam::Vec3;

/// What a shape is made of.
#[derive(Clone)]
pub struct Material {
    pub name: String,
    pub color: Texture,
    pub is_mirror: bool,
    /// Its surface is not shown (`interface`).
    pub is_invisible: bool,
}

/// A colour on a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// The same everywhere.
    Color(Vec3),
    /// Two colours in cells.
    Checker { a: Vec3, b: Vec3, cells: u32 },
    /// A picture.
    Picture {
        tint: Vec3,
        source: PictureSource,
        /// Factors and offsets of texture coordinates.
        scale: [f32; 2],
        offset: [f32; 2],
    },
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            color: Texture::Color(GRAY),
            is_mirror: false,
            is_invisible: false,
        }
    }
}

/// Reflectance of PBRT's `diffuse`.
pub const GRAY: Vec3 = Vec3::splat(0.5);

impl Texture {
    /// One colour in its place.
    pub fn mean(&self) -> Vec3 {
        match self {
            Self::Color(color) | Self::Picture { tint: color, .. } => *color,
            Self::Checker { a, b, .. } => (*a + *b) / 2.0,
        }
    }

    /// Multiplied by a colour.
    pub fn tinted(self, by: Vec3) -> Self {
        match self {
            Self::Color(color) => Self::Color(color * by),
            Self::Checker { a, b, cells } => Self::Checker {
                a: a * by,
                b: b * by,
                cells,
            },
            Self::Picture {
                tint,
                source,
                scale,
                offset,
            } => Self::Picture {
                tint: tint * by,
                source,
                scale,
                offset,
            },
        }
    }
}

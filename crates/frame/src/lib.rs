//! What a renderer hands over: typed image layers and the other result types that the reference
//! and the GPU techniques both fill.
//!
//! Image coordinates: x right, y down, row 0 on top; pixel `(i, j)` has its centre at
//! `(i + ½, j + ½)`. World-space positions, linear RGB, everything `f32`.

mod atomic;
mod channels;
mod error;
pub mod exr;
pub mod image;
pub mod layers;
mod names;
pub mod png;
pub mod results;
mod unfinished;

pub use atomic::{check_writable, write_together, write_whole};
pub use channels::Channels;
pub use error::FrameError;
pub use image::Image;
pub use png::{png16, write_png, write_png_rgb8};
pub use results::{Traced, Triangles, TrueVertex, VertexClass, VertexResult, VertexState, Work};
pub use unfinished::{Provisional, abandon_writes, create_folders, is_abandoned, sweep};

use glam::{Vec2, Vec3};

/// The layers of one picture. All images have the same size.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Linear RGB.
    pub color: Image<Vec3>,
    /// What the eye ray meets first; `None` in pictures that carry only colour.
    pub primary: Option<Primary>,
    /// What the reflected ray meets; `None` in pictures that carry only colour.
    pub reflected: Option<Reflected>,
    /// Where the reflections were a frame before; `None` where that was not asked, or where there is
    /// no frame before.
    pub motion: Option<Motion>,
    /// Names of the ids in the id layers, ids ascending.
    pub names: Vec<Name>,
}

/// What the eye ray meets first: an object or a mirror.
#[derive(Clone, Debug, PartialEq)]
pub struct Primary {
    /// Id of the first surface, 0 for none.
    pub id: Image<u32>,
    /// World-space point; 0 where there is none.
    pub position: Image<Vec3>,
    /// Unit world-space normal: a mirror's on its reflecting side (the shading normal of a mesh),
    /// an object's geometric one turned towards the eye; 0 where there is none.
    pub normal: Image<Vec3>,
}

/// What the reflected ray of each mirror pixel meets first (under truth `full`: last).
#[derive(Clone, Debug, PartialEq)]
pub struct Reflected {
    /// What is known about the pixel's reflection.
    pub status: Image<Status>,
    /// Id of the surface met; 0 for background, no mirror, unresolved.
    pub id: Image<u32>,
    /// World-space point of the surface met; 0 where there is none.
    pub position: Image<Vec3>,
    /// Distance from the mirror point; 0 where nothing is met.
    pub distance: Image<f32>,
    /// Mirror bounces until that surface; only under truth `full`.
    pub bounces: Option<Image<u32>>,
}

/// For each mirror pixel, where the point that it reflects now was seen in the frame before.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// From the pixel's centre to where the reflection of the same point was, in pixels, +x right, +y
    /// down; 0 where it is not known.
    pub vector: Image<Vec2>,
    /// Whether the vector is known.
    pub valid: Image<bool>,
    /// Whether something else hid the point from the mirror in the frame before, so that its colour was not
    /// there. `None` where that is not known.
    pub disoccluded: Option<Image<bool>>,
    /// The same in another program's convention; written to files, never read from them.
    pub converted: Option<Converted>,
}

/// Motion as another program reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct Converted {
    /// The vectors in that program's unit and signs.
    pub vector: Image<Vec2>,
    /// Distance of the virtual image behind the mirror's point along the eye ray, world units; negative in
    /// front of it, 0 where there is none.
    pub virtual_distance: Image<f32>,
}

/// What is known about the reflection at a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// The first surface is no mirror.
    #[default]
    NotMirror = 0,
    /// A mirror pixel whose reflection is known: an id, or 0 for the background.
    Resolved = 1,
    /// A mirror pixel for which the technique found no answer.
    Unresolved = 2,
    /// A mirror pixel whose shading normal sends the ray below the geometric surface: counted
    /// apart, id and position 0.
    Below = 3,
    /// The mirror's opaque black back.
    Back = 4,
}

/// An id's name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// As in the id layers, from 1.
    pub id: u32,
    /// As in the scene file.
    pub name: String,
    /// True for mirrors.
    pub mirror: bool,
}

//! Pictures: what each pixel's eye ray meets, and what it sees reflected there.
//!
//! Colours are unlit. A mirror that is met on its back is opaque black ([`Status::Back`]). A
//! reflected ray that would start below the geometric surface of a mesh mirror is not traced
//! and its pixel is black ([`Status::Below`]).

use catoptric_frame::{Frame, Status};
use catoptric_scene::View;
use glam::{DVec2, DVec3, Vec3};

use crate::tracer::{Hit, Tracer};

/// Which reflections a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// Reflected rays see everything but mirrors, which none of them meets: what all four papers
    /// assume.
    FirstBounce,
    /// Mirrors in mirrors.
    Full {
        /// Most reflections on one path; 0 counts as 1. A mirror met after the last of them is
        /// the last surface of its path, and black.
        bounces: u32,
    },
}

/// What to render.
#[derive(Clone, Copy)]
pub struct RenderOptions<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Which reflections.
    pub truth: Truth,
    /// Colour is the mean of a regular grid of `samples` × `samples` rays a pixel; 1 (and 0) is
    /// the pixel centre alone. All other layers are always of the pixel centre.
    pub samples: u32,
    /// Called after each row, from any thread, with the number of rows finished and of all rows.
    pub progress: Option<&'a (dyn Fn(u32, u32) + Sync)>,
}

impl RenderOptions<'_> {
    /// Pixel centres, silently.
    pub fn new(size: [u32; 2], truth: Truth) -> Self {
        Self { size, truth, samples: 1, progress: None }
    }
}

/// What one eye ray sees, in f64.
#[derive(Clone, Copy, Debug)]
pub struct PixelTrace {
    /// Unit direction of the eye ray.
    pub direction: DVec3,
    /// The first surface along the eye ray.
    pub primary: Option<Hit>,
    /// What is reflected; `None` where the first surface is no mirror.
    pub reflection: Option<Reflection>,
    /// Linear RGB.
    pub color: Vec3,
}

/// What a mirror pixel reflects.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    /// Never [`Status::NotMirror`] nor [`Status::Unresolved`].
    pub status: Status,
    /// Unit direction of the first reflected ray; where `status` is `Back` or `Below` (at the
    /// first mirror), zero.
    pub direction: DVec3,
    /// The surface met: the first, under [`Truth::Full`] the last; `None` for the background.
    pub hit: Option<Hit>,
    /// Reflections on the way to `hit` or to the background.
    pub bounces: u32,
}

impl Tracer {
    /// Renders all layers, in parallel.
    pub fn render(&self, options: &RenderOptions) -> Frame {
        todo!("{:?}", options.size)
    }

    /// What the eye ray through image coordinates `at` sees.
    pub fn reflect_pixel(&self, view: &View, at: DVec2, truth: Truth) -> PixelTrace {
        todo!("{view:?} {at} {truth:?}")
    }
}

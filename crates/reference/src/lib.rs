//! The CPU truth that every technique is judged against.
//!
//! - [`Tracer`]: a ray tracer. Triangles lie in a bounding volume hierarchy (obvhs) and are hit
//!   by a watertight test in f64 ([`bvh`]); analytic mirrors are met exactly, in f64.
//!   [`Tracer::render`] fills all layers of a [`catoptric_frame::Frame`]; single rays are
//!   answered in f64 by [`Tracer::trace`] and [`Tracer::reflect_pixel`].
//! - [`Follow`]: where, a frame before, was what a mirror pixel shows now ([`motion`]).
//! - [`reflection_points`]: all points of a mirror at which an eye sees a vertex reflected,
//!   without a search: in closed form or as the minimum of a convex function ([`points`]).
//!
//! Nothing here knows the GPU techniques, and they know nothing of this crate: a mistake shared
//! by both would cancel itself out.
//!
//! Spaces and units: world space, right-handed, +y up; distances along unit rays; linear RGB;
//! image coordinates with pixel centres at +½.

pub mod bvh;
mod check;
pub mod error;
pub mod motion;
mod paint;
pub mod points;
pub mod render;
pub mod tracer;
mod triangles;

pub use error::{NotAvailable, ReferenceError};
pub use motion::{Follow, Followed, Lost, Seen, Target};
pub use points::{
    Solutions, in_view, points_in_view, reflection_points, reflections, true_vertices,
    true_vertices_watched,
};
pub use render::{PixelTrace, Reflection, RenderOptions, Truth};
pub use tracer::{Hit, RayStart, Surface, Tracer};

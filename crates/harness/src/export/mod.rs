//! A scene for another renderer.

pub mod mitsuba;
mod ply;
mod sides;
pub mod vectors;

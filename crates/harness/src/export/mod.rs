//! A scene for another renderer.

pub mod mitsuba;
pub(crate) mod ply;
mod sides;
pub mod vectors;

pub(crate) use sides::SHEET;

//! Diagrams as SVG: in a page they take its text colour, as files they are light or dark by
//! themselves.
//!
//! [`Plot`] says what to show; axes, grid and lines are drawn by plotters, markers, their names,
//! the names along an axis and the legend are set by `svg`.

mod axis;
mod data;
mod draw;
mod names;
mod svg;

pub use axis::{Axis, Scale};
pub use data::{Curve, Mark, Plot, SERIES, TALL};

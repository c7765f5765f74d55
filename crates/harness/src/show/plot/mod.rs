//! Diagrams as SVG: in a page they take its text colour, as files they are light or dark by
//! themselves.
//!
//! [`Plot`] says what to show, `axis` where a value stands and which ticks there are. `draw` makes
//! the grid, the axes and the lines, `names` the names along an axis; `svg` adds the markers, their
//! names and the legend.

mod axis;
mod data;
mod draw;
mod names;
mod svg;

pub use axis::{Axis, Scale};
pub use data::{Curve, Mark, Plot, SERIES, TALL};

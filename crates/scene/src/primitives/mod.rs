//! Primitive surfaces in their own space, counter-clockwise seen from outside.

mod flat;
mod points;
mod round;
mod teapot;
mod teapot_data;

pub(crate) use flat::{cuboid, grid, triangles};
pub(crate) use points::{Inverse, inverse_points};
pub(crate) use round::{lathe, sphere, torus};
pub(crate) use teapot::teapot;

//! What makes rows: set up, load, trace the reference, render, compare, time, record.

pub mod compare;
mod fill;
pub mod interrupt;
pub mod load;
pub mod measure;
mod motion;
pub mod progress;
mod provenance;
pub mod render;
pub mod sampling;
pub mod setup;
pub mod truth;
mod vectors;

pub use measure::{Measured, measure};
pub use setup::{Setup, Wanted, product};

//! Our tracer against pictures that another renderer made of the same scenes.

pub mod case;
mod color;
pub mod layer;
mod limits;
mod masks;
mod measure;
mod ours;
mod theirs;
pub mod verdict;

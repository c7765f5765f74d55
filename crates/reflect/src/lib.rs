//! The GPU side: techniques that draw reflections on curved mirrors in real time.

pub mod gpu;
pub mod shaders;

pub use gpu::{AdapterInfo, Gpu, GpuError, Prefer, adapters};

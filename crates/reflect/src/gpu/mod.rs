//! The graphics device and what is made on it: adapters, buffers, textures, pipelines, linked shaders,
//! the recording of passes and their times. Knows nothing of mirrors, and imports nothing else of
//! this crate.

mod adapters;
mod bindings;
mod budget;
mod buffers;
mod clock;
mod device;
mod error;
mod limits;
mod pipelines;
mod read;
mod recorder;
mod self_test;
pub mod shaders;
mod stamps;
mod textures;

pub use adapters::{AdapterInfo, Prefer, adapters};
pub(crate) use bindings::{Slot, group, layout};
pub(crate) use buffers::{
    buffer, set_storage, set_uniform, storage, storage_bytes, storage_zeros, uniform,
};
pub use clock::FrameTime;
pub(crate) use clock::Timer;
pub use device::Gpu;
pub use error::{BuildError, GpuError};
pub(crate) use pipelines::{
    Kernel, Module, RasterEntries, RasterTargets, compute, compute_unset, dispatch_size, module,
    raster, raster_to,
};
pub(crate) use recorder::{Begin, Recorder};
pub use self_test::SelfTest;
pub(crate) use textures::{
    DEPTH, FLOAT4, image_with_levels, level_view, pyramid, target, texture_array,
    texture_of_numbers, texture_with, view,
};

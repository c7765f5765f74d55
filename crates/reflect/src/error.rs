//! Why a technique cannot render.

use thiserror::Error;

use crate::gpu::BuildError;

/// Why a technique cannot render.
#[derive(Debug, Error)]
pub enum ReflectError {
    /// A shader that does not link, or a buffer that the device cannot hold.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// No image of this size.
    #[error("resolution {}x{}: the adapter takes 1 to {limit} pixels a side", size[0], size[1])]
    Size {
        /// Width and height, pixels.
        size: [u32; 2],
        /// Longest side, pixels.
        limit: u32,
    },
    /// An option that this adapter cannot serve.
    #[error("the adapter {0}")]
    Adapter(&'static str),
    /// A frame of a scene that was not prepared for.
    #[error("the scene has other vertices, triangles or mirrors than the one prepared for")]
    OtherScene,
}

//! The GPU side: techniques that draw reflections on curved mirrors in real time.
//!
//! `parse` a technique name, ask `supports`, `prepare` it for a scene and size, then `render`
//! (all layers and counters) or `time_frame` (what an application would draw).

pub mod gpu;
mod object_order;
pub mod registry;
pub mod shaders;
pub mod spec;
pub mod timing;
mod uniforms;

pub use gpu::{AdapterInfo, Gpu, GpuError, Prefer, adapters};
pub use object_order::Prepared;
pub use registry::{OptionInfo, TechniqueInfo, list};
pub use spec::{Spec, SpecError, parse};
pub use timing::{FrameTime, SelfTest};

use catoptric_frame::{Frame, Triangles, VertexResult, Work};
use catoptric_scene::Scene;
use thiserror::Error;

/// Why a technique cannot render.
#[derive(Debug, Error)]
pub enum ReflectError {
    /// A shader does not link: a bug.
    #[error("shader: {0}")]
    Shader(String),
    /// No image of this size.
    #[error("resolution {}x{}: the adapter takes 1 to {limit} pixels a side", size[0], size[1])]
    Size {
        /// Width and height.
        size: [u32; 2],
        /// Longest side.
        limit: u32,
    },
    /// More geometry or texels than one buffer holds.
    #[error("the scene needs a buffer of {bytes} bytes, the device takes {limit}")]
    TooLarge {
        /// Needed.
        bytes: u64,
        /// Possible.
        limit: u64,
    },
}

/// Whether a technique can draw a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Support {
    /// It can.
    Yes,
    /// It cannot, for this reason.
    No(String),
}

/// A rendered frame and all that was counted on the way.
#[derive(Clone, Debug)]
pub struct Output {
    /// All layers.
    pub frame: Frame,
    /// By mirror, object, vertex; `None` for techniques that search no vertices.
    pub vertices: Option<Vec<VertexResult>>,
    /// Triangles of the virtual geometry.
    pub triangles: Triangles,
    /// Means per searched vertex.
    pub work: Work,
}

/// Whether `spec` can draw `scene`.
pub fn supports(_spec: &Spec, scene: &Scene) -> Support {
    if scene.mirrors.is_empty() {
        Support::No("the scene has no mirror".to_owned())
    } else {
        Support::Yes
    }
}

/// Makes a technique ready for a scene and an image size.
///
/// # Errors
/// A size or scene that the device cannot hold.
pub fn prepare<'g>(
    gpu: &'g Gpu,
    spec: &Spec,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Prepared<'g>, ReflectError> {
    Prepared::new(gpu, spec, scene, size)
}

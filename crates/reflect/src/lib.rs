//! The GPU side: techniques that draw reflections on curved mirrors in real time.
//!
//! `parse` a technique name, ask `supports`, `prepare` it for a scene and size, then `render`
//! (all layers and counters) or `time_frame` (what an application would draw).
//!
//! Where things go:
//! * a new search: a file in `search/`, a shader of the same name, an entry in
//!   `registry/`;
//! * a new refinement: likewise in `refine/`;
//! * a new technique of image order: likewise in `image_order/`.
//!
//! `object_order.rs` puts searches and refinements together; `stage.rs` has the passes that all
//! techniques share. `twin/` runs shader arithmetic on the CPU, for tests.

mod composite;
mod data;
mod gbuffer;
mod geometry;
pub mod gpu;
mod image_order;
mod object_order;
mod path;
mod points;
mod primary;
mod raster;
mod recorder;
mod refine;
pub mod registry;
mod resources;
mod search;
pub mod shaders;
pub mod spec;
mod stage;
mod technique;
#[cfg(test)]
mod testing;
pub mod timing;
#[cfg(test)]
mod twin;
mod world;

pub use gpu::{AdapterInfo, Gpu, GpuError, Prefer, adapters};
pub use path::{Visit, path};
pub use registry::{Family, OptionInfo, TechniqueInfo, Values, list};
pub use search::reflector_cubemap::walk::{CubemapAnswer, CubemapStep, CubemapWalk};
pub use spec::{Options, Spec, SpecError, parse};
pub use technique::{DistanceLevel, Output, Prepared};
pub use timing::{FrameTime, SelfTest};

use catoptric_scene::Scene;
use thiserror::Error;

use registry::Maker;

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
    /// A hierarchy of rays to trace that is deeper than the shader's stack.
    #[error("the scene's ray-tracing hierarchy has {depth} levels, the shader takes {limit}")]
    Deep {
        /// Levels of nodes.
        depth: usize,
        /// As many as may wait.
        limit: usize,
    },
    /// An option that this adapter cannot serve.
    #[error("the adapter {0}")]
    Adapter(&'static str),
    /// A frame of a scene that was not prepared for.
    #[error("the scene has other vertices, triangles or mirrors than the one prepared for")]
    OtherScene,
}

/// Whether a technique can draw a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Support {
    /// It can.
    Yes,
    /// It cannot, for this reason.
    No(String),
}

/// Whether `spec` can draw `scene`.
pub fn supports(spec: &Spec, scene: &Scene) -> Support {
    if scene.mirrors.is_empty() {
        return Support::No("the scene has no mirror".to_owned());
    }
    let parts = [Some(&spec.options), spec.refinement.as_ref()];
    let objection = parts
        .into_iter()
        .flatten()
        .find_map(|options| (options.info().objection)(options, scene));
    objection.map_or(Support::Yes, Support::No)
}

/// Makes a technique ready for a scene and an image size.
///
/// # Errors
/// A size or scene that the device cannot hold.
///
/// # Panics
/// On a `Spec` that [`parse`] would not have made.
pub fn prepare<'g>(
    gpu: &'g Gpu,
    spec: &Spec,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Prepared<'g>, ReflectError> {
    let refinement = spec.refinement.as_ref().map(|options| options.info().maker);
    let technique = match (spec.options.info().maker, refinement) {
        (Maker::Search(search), None) => {
            object_order::prepare(gpu, (search, refine::none::make), spec, scene, size)
        }
        (Maker::Search(search), Some(Maker::Refinement(refine))) => {
            object_order::prepare(gpu, (search, refine), spec, scene, size)
        }
        (Maker::ImageOrder(make), None) => image_order::prepare(gpu, make, spec, scene, size),
        parts => unreachable!("a parsed technique is never {parts:?}"),
    }?;
    Ok(Prepared::new(gpu, technique))
}

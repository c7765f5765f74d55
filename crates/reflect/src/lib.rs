//! The GPU side: techniques that draw reflections on curved mirrors in real time.
//!
//! `parse` a technique name, ask `supports`, `prepare` it for a scene and size, then `render`
//! (all layers and counters) or `time_frame` (what an application would draw).
//!
//! The rooms, each built on those before it:
//! * `gpu/`: device, buffers, pipelines, shader linking, recorder, clock; knows nothing of mirrors;
//! * `stage/`: what every technique stands on;
//! * `technique.rs`: what a technique is to the rest;
//! * `search/`, `refine/`, `image_order/`: a folder for each technique, with its CPU twin;
//!   `object_order.rs` puts searches and refinements together;
//! * `registry.rs`: the list of all techniques; `spec.rs`: the grammar of their names.

mod error;
mod gpu;
mod image_order;
mod object_order;
mod prepared;
mod refine;
pub mod registry;
mod search;
mod spec;
mod stage;
mod technique;
#[cfg(test)]
mod testing;

pub use error::ReflectError;
pub use gpu::{AdapterInfo, FrameTime, Gpu, GpuError, Prefer, SelfTest, adapters, shaders};
pub use prepared::Prepared;
pub use registry::{Family, OptionInfo, TechniqueInfo, Values, list};
pub use search::path::{Visit, path};
pub use search::reflector_cubemap::twin::{CubemapAnswer, CubemapStep, CubemapWalk};
pub use spec::{Options, Spec, SpecError, parse};
pub use technique::{DistanceLevel, Output};

use catoptric_scene::Scene;
use registry::Maker;

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

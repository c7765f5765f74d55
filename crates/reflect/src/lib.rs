//! The GPU side: techniques that draw reflections on curved mirrors in real time.
//!
//! `parse` a technique name, ask `supports`, `prepare` it for a scene and size, then `render`
//! (all layers and counters) or `time_frame` (what an application would draw).
//!
//! [`embed`] is apart: one technique, `beams`, for a renderer that has its own device, G-buffer and triangles.
//!
//! The modules, each built on those before it:
//! * `gpu/`: device, buffers, pipelines, shader linking, recorder, clock; knows nothing of mirrors;
//! * `stage/`: what every technique stands on;
//! * `technique.rs`: what a technique is to the rest;
//! * `search/`, `refine/`, `image_order/`, `motion/`: a folder for each technique, some with a CPU twin;
//!   `object_order.rs` puts searches and refinements together;
//! * `registry.rs`: the list of all techniques; `spec.rs`: the grammar of their names.

mod diagnostics;
mod error;
mod gpu;
mod image_order;
mod motion;
mod object_order;
mod options;
mod prepared;
mod refine;
mod registry;
mod search;
mod spec;
mod stage;
mod technique;
#[cfg(test)]
mod testing;

pub use diagnostics::{Answer, DistanceLevel, Question, Visit};
pub use error::ReflectError;
pub use gpu::{AdapterInfo, FrameTime, Gpu, GpuError, Prefer, SelfTest, adapters, shaders};
pub use image_order::beams::embed;
pub use options::{OptionInfo, Values};
pub use prepared::Prepared;
pub use registry::list;
pub use search::reflector_cubemap::twin::{CubemapAnswer, CubemapStep, CubemapWalk};
pub use spec::{Options, Spec, SpecError};
pub use stage::STAGE_PASSES;
pub use technique::{Family, Output, Properties, TechniqueInfo};

/// The graphics library that [`embed`] speaks of.
pub use wgpu;

use catoptric_scene::Scene;

use registry::Asked;

/// Whether a technique can draw a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Support {
    /// It can.
    Yes,
    /// It cannot, for this reason.
    No(String),
}

/// Parses the name of a technique: `SEARCH[(options)][+REFINE[(options)]]` or `NAME[(options)]`.
///
/// # Errors
/// Unknown names, options and values, with the nearest known one; options given twice.
pub fn parse(text: &str) -> Result<Spec, SpecError> {
    spec::parse(&list(), text)
}

/// Whether `spec` can draw `scene`.
pub fn supports(spec: &Spec, scene: &Scene) -> Support {
    if scene.mirrors.is_empty() {
        return Support::No("the scene has no mirror".to_owned());
    }
    let objection = match registry::asked(spec) {
        Asked::ObjectOrder(search, refinement) => {
            (search.objection(scene)).or_else(|| refinement.objection(scene))
        }
        Asked::ImageOrder(technique) => technique.objection(scene),
        Asked::Motion(estimator) => estimator.objection(scene),
    };
    objection.map_or(Support::Yes, Support::No)
}

/// Makes a technique ready for a scene and an image size.
///
/// # Errors
/// A size or scene that the device cannot hold; whatever fails on the device.
pub fn prepare<'g>(
    gpu: &'g Gpu,
    spec: &Spec,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Prepared<'g>, ReflectError> {
    gpu.begin();
    let technique = match registry::asked(spec) {
        Asked::ObjectOrder(search, refinement) => {
            object_order::prepare(gpu, search, refinement.as_ref(), scene, size)
        }
        Asked::ImageOrder(technique) => image_order::prepare(gpu, &technique, scene, size),
        Asked::Motion(estimator) => motion::prepare(gpu, &estimator, scene, size),
    }?;
    let prepared = Prepared::new(gpu, technique);
    gpu.check().map_err(ReflectError::Build)?;
    Ok(prepared)
}

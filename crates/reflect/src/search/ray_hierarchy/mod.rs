//! Search in a hierarchy of reflected rays (Szabo 2013, chapter 4; after Roger et al. 2007).
//!
//! A pyramid of bounding spheres and cones is made from the G-buffer (pass `hierarchy`), and each
//! vertex descends into cones that contain it. Kept as published, with its flaws: the cones bound
//! the rays of pixel centres, so that the space between neighbouring blocks belongs to no cone
//! ("holes"); the first leaf met is the answer; a search that fails hands over a stand-in. The
//! misprint of the reflected ray (§4.2, negative of the reflection) is corrected.
//!
//! Counted: a step is a texel taken from the stack, a node test a containment test, an evaluation a
//! distance from a ray.

pub(crate) mod pyramid;
#[cfg(test)]
mod twin;

use std::cell::Cell;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, group, layout, uniform, view};
use crate::stage::Stage;
use crate::stage::data::RepairUniform;
use crate::stage::points::Points;
use crate::technique::Variant;

use super::{Context, Pipelines, Search};
use pyramid::Pyramid;

struct RayHierarchy {
    pyramid: Pyramid,
    /// The mirror (an index) whose pyramid this frame has made last: one pyramid serves all
    /// mirrors in turn.
    built: Cell<Option<usize>>,
    pipelines: Pipelines,
    /// Group 3: pyramid and repair.
    own: wgpu::BindGroup,
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    let Context {
        gpu,
        options,
        stage,
        ..
    } = context;
    let pyramid = Pyramid::new(gpu, stage)?;
    let repair = uniform(
        gpu,
        &RepairUniform {
            cone: options.number("cone") as f32,
            sphere: options.number("sphere") as f32,
            stop: options.whole("stop"),
        },
    );
    let own_layout = layout(
        gpu,
        "pyramid",
        &[Slot::Texture, Slot::Texture, Slot::Uniform],
    );
    let (spheres, cones) = (view(&pyramid.spheres), view(&pyramid.cones));
    let own = [
        wgpu::BindingResource::TextureView(&spheres),
        wgpu::BindingResource::TextureView(&cones),
        repair.as_entire_binding(),
    ];
    let features: Vec<_> = ["enlarge", "stop"]
        .into_iter()
        .filter(|repair| options.is("repair", repair))
        .collect();
    Ok(Box::new(RayHierarchy {
        built: Cell::new(None),
        pipelines: Pipelines::new(context, "ray_hierarchy/search", &features, &own_layout)?,
        own: group(gpu, &own_layout, &own),
        pyramid,
    }))
}

impl Search for RayHierarchy {
    fn update(&mut self, _gpu: &Gpu, _stage: &Stage) {}

    fn begin_frame(&mut self, _gpu: &Gpu) {
        self.built.set(None);
    }

    /// The pyramid is made when a mirror is searched first.
    fn record_build(&self, _frame: &mut Recorder<'_>, _stage: &Stage) {}

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        if self.built.replace(Some(mirror)) != Some(mirror) {
            self.pyramid.record(frame, stage, mirror);
        }
        let on = &stage.gbuffer.mirror_groups[mirror];
        (self.pipelines).record(frame, (stage, on), points, &self.own, variant);
    }

    fn has_holes(&self) -> bool {
        true
    }
}

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

use catoptric_scene::Scene;
use encase::ShaderType;

use super::{Context, Pipelines, Recipe, Search, Sheet};
use crate::error::ReflectError;
use crate::gpu::{Recorder, Slot, group, layout, uniform, view};
use crate::options::{options, words};
use crate::stage::Stage;
use crate::stage::options::{Hidden, SearchOptions};
use crate::stage::points::Points;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named, Properties};
use pyramid::Pyramid;

words! {
    /// What is done about holes between the cones.
    pub(crate) enum Repair {
        None = "none",
        /// Enlarged cones and spheres.
        Enlarge = "enlarge",
        /// An answer from a level above the base.
        Stop = "stop",
    }
}

words! {
    /// What is repeated with enlarged cones and spheres. The thesis (§4.2) leaves it open: "the last
    /// search step is repeated".
    pub(crate) enum Again {
        /// The whole search, where it has failed. The reading whose cost and error fit what the
        /// thesis prints.
        Search = "search",
        /// The test of the children at every hole on the way.
        Hole = "hole",
        /// The test of the children of the texel after which the stack is empty.
        Last = "last",
    }
}

options! {
    /// The search, as its options describe it.
    pub(crate) struct RayHierarchy {
        /// what is done about holes between the cones: nothing, a repetition with enlarged cones
        /// and spheres, or an answer from a level above the base
        repair: Repair,
        /// what is repeated: a search that failed, the test at every hole on the way, or the test
        /// at the last texel of a search that failed (repair=enlarge)
        again: Again,
        /// factor on the cones' half angles (repair=enlarge)
        cone: f64 = 1.5 in 1.0..=100.0,
        /// factor on the spheres' radii (repair=enlarge)
        sphere: f64 = 2.0 in 1.0..=100.0,
        /// level whose sphere centre is the answer, the pixels being level 0 (repair=stop)
        stop: u32 = 3 in 1..=14,
    }
}

impl Named for RayHierarchy {
    const INFO: Info = Info {
        name: "ray-hierarchy",
        what: "cone and sphere pyramid over the reflected rays",
        paper: "Szabo 2013",
    };
}

/// Twin of `Repair` in `ray_hierarchy/search.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct RepairUniform {
    cone: f32,
    sphere: f32,
    stop: u32,
}

impl Recipe for RayHierarchy {
    fn objection(&self, common: &SearchOptions, _: &Scene) -> Option<String> {
        let reason = "hidden=extend: a hidden vertex lies in no cone of the hierarchy, only a search that \
                      walks on the mirror can continue it";
        (common.hidden == Hidden::Extend).then(|| reason.to_owned())
    }

    fn properties(&self) -> Properties {
        Properties {
            has_holes: true,
            ..Properties::default()
        }
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let pyramid = Pyramid::new(gpu, stage)?;
        let repair = RepairUniform {
            cone: self.cone as f32,
            sphere: self.sphere as f32,
            stop: self.stop,
        };
        let repair = uniform(gpu, &repair);
        let slots = [Slot::Texture, Slot::Texture, Slot::Uniform];
        let own_layout = layout(gpu, "pyramid", &slots);
        let (spheres, cones) = (view(&pyramid.spheres), view(&pyramid.cones));
        let own = [
            wgpu::BindingResource::TextureView(&spheres),
            wgpu::BindingResource::TextureView(&cones),
            repair.as_entire_binding(),
        ];
        let features: &[&str] = match self.repair {
            Repair::None => &[],
            Repair::Enlarge => match self.again {
                Again::Search => &["enlarge_search"],
                Again::Hole => &["enlarge_hole"],
                Again::Last => &["enlarge_last"],
            },
            Repair::Stop => &["stop"],
        };
        Ok(Box::new(Descent {
            pipelines: Pipelines::new(context, "ray_hierarchy/search", features, &own_layout)?,
            own: group(gpu, &own_layout, &own),
            pyramid,
        }))
    }
}

/// The search, ready for a scene.
struct Descent {
    /// One serves all mirrors in turn.
    pyramid: Pyramid,
    pipelines: Pipelines,
    /// Group 3: pyramid and repair.
    own: wgpu::BindGroup,
}

impl Search for Descent {
    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        self.pyramid.record(frame, stage, mirror);
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    ) {
        (self.pipelines).record(frame, (stage, sheet.mirror), points, &self.own, variant);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn the_repair_lies_as_the_shader_reads_it() {
        assert_layout!(
            RepairUniform { cone, sphere, stop },
            "ray_hierarchy/search",
            &["enlarge_search", "stop"],
            "Repair"
        );
    }
}

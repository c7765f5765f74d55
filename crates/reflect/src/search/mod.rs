//! Searches: a reflection point for every vertex. One folder a search, named as its shader.
//!
//! A search reads the mirror's maps (or some of its own) and answers for any batch of
//! [`Points`]: the scene's vertices, a refinement's new points, a grid's corners.

pub(crate) mod linear;
pub(crate) mod newton;
pub(crate) mod path;
pub(crate) mod ray_hierarchy;
pub(crate) mod reflector_cubemap;
pub(crate) mod sheet;
mod start;
pub(crate) mod swept_boxes;

use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Kernel, Recorder, compute, module};
use crate::options::{Options, Settled};
use crate::stage::Stage;
use crate::stage::options::{Hidden, SearchOptions};
use crate::stage::points::Points;
use crate::stage::variant::Variant;
use crate::technique::Properties;
pub(crate) use sheet::Sheet;

/// A search with its options settled, not yet made ready for a scene.
pub(crate) trait Recipe {
    /// Why the mirrors of a scene cannot be searched.
    fn objection(&self, _common: &SearchOptions, _scene: &Scene) -> Option<String> {
        None
    }

    /// What it is like.
    fn properties(&self) -> Properties {
        Properties::default()
    }

    /// Makes it ready for a scene.
    ///
    /// # Errors
    /// A scene or an image that the device cannot hold.
    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError>;
}

/// A search as a name asks for it.
pub(crate) struct Asked {
    pub recipe: Box<dyn Recipe>,
    pub common: SearchOptions,
}

impl Asked {
    /// The search `T`.
    pub(crate) fn read<T: Options + Recipe + 'static>(values: &mut Settled<'_>) -> Self {
        Self {
            recipe: Box::new(T::read(values)),
            common: SearchOptions::read(values),
        }
    }

    /// What it is like.
    pub(crate) fn properties(&self) -> Properties {
        Properties {
            continues_hidden: self.common.hidden == Hidden::Extend,
            ..self.recipe.properties()
        }
    }

    /// Why the mirrors of a scene cannot be searched.
    pub(crate) fn objection(&self, scene: &Scene) -> Option<String> {
        self.recipe.objection(&self.common, scene)
    }
}

/// A search that stands ready for one scene and image size. One that reads nothing but the stage's
/// maps only records its search.
pub(crate) trait Search {
    /// Takes over what moved; the stage has been updated already.
    fn update(&mut self, _: &Gpu, _: &Stage) {}

    /// Whether it reads the stage's maps.
    fn reads_maps(&self) -> bool {
        true
    }

    /// How many reflections of a vertex it tells apart on a mirror (an index).
    fn sheets(&self, _mirror: usize) -> usize {
        1
    }

    /// Records what is made once a frame from the maps of a mirror (an index), before any search on
    /// it.
    fn record_build(&self, _: &mut Recorder<'_>, _: &Stage, _mirror: usize) {}

    /// Records the search of a batch on one sheet of a mirror, as the pass `search`. It is the mirror
    /// of the latest [`Search::record_build`].
    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    );

    /// Records the search of the same points on all sheets of a mirror, a batch each, one sheet after the
    /// other if not all at once.
    fn record_sheets(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheets: &[Sheet],
        batches: &[&Points],
        variant: Variant,
    ) {
        for (sheet, points) in sheets.iter().zip(batches) {
            self.record_search(frame, stage, *sheet, points, variant);
        }
    }
}

/// What every search is made from.
pub(crate) struct Context<'a> {
    pub gpu: &'a Gpu,
    pub stage: &'a Stage,
    /// Vertices that the mirror does not reflect are continued (`hidden=extend`): those behind the tangent plane, and for
    /// some searches those that are reflected beyond the rim.
    pub extends: bool,
    /// Of [`Points::group`].
    pub points_layout: &'a wgpu::BindGroupLayout,
    /// What the shader of [`Variant::AllLayers`] tells beside its answers.
    pub instrumentation: Instrumentation,
}

/// What a search can tell of itself, and the shader feature for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Instrumentation {
    /// What each search took.
    Efforts,
    /// Where a single search went: see [`crate::path()`].
    Path,
}

impl Instrumentation {
    /// The feature's name.
    pub(crate) fn feature(self) -> &'static str {
        match self {
            Self::Efforts => "count",
            Self::Path => "path",
        }
    }
}

/// A search's shader, ready for both variants of a frame.
struct Pipelines {
    plain: Kernel,
    /// Tells what [`Context::instrumentation`] asks for.
    telling: Kernel,
}

impl Pipelines {
    /// Of a program with an entry point `search`; `own` is the layout of its group 3.
    fn new(
        context: &Context<'_>,
        program: &str,
        features: &[&str],
        own: &wgpu::BindGroupLayout,
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let pipeline = |features: &[&str]| -> Result<_, ReflectError> {
            let layouts = [
                Some(&stage.world.view_layout),
                Some(&stage.gbuffer.mirror_layout),
                Some(context.points_layout),
                Some(own),
            ];
            let module = module(gpu, program, features)?;
            Ok(compute(gpu, &module, "search", &layouts))
        };
        let telling = [features, &[context.instrumentation.feature()]].concat();
        Ok(Self {
            plain: pipeline(features)?,
            telling: pipeline(&telling)?,
        })
    }

    /// Records the pass `search`: one thread a point.
    fn record(
        &self,
        frame: &mut Recorder<'_>,
        (stage, mirror): (&Stage, usize),
        points: &Points,
        own: &wgpu::BindGroup,
        variant: Variant,
    ) {
        let kernel = match variant {
            Variant::AllLayers => &self.telling,
            Variant::Color => &self.plain,
        };
        frame.compute("search", |pass| {
            pass.set_pipeline(kernel);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &points.group, &[]);
            pass.set_bind_group(3, own, &[]);
            points.run(pass, kernel);
        });
    }
}

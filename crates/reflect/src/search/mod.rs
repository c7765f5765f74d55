//! Searches: a reflection point for every vertex. One file a search, named as its shader.
//!
//! A search reads the mirror G-buffer (or maps of its own) and answers for any batch of
//! [`Points`]: the scene's vertices, a refinement's new points, a grid's corners.

pub(crate) mod linear;
pub(crate) mod ray_hierarchy;
pub(crate) mod reflector_cubemap;

use crate::ReflectError;
use crate::gpu::Gpu;
use crate::points::Points;
use crate::recorder::Recorder;
use crate::spec::Options;
use crate::stage::Stage;
use crate::technique::Variant;

/// A search that stands ready for one scene and image size.
pub(crate) trait Search {
    /// Takes over what moved; the stage has been updated already.
    fn update(&mut self, gpu: &Gpu, stage: &Stage);

    /// Called before each frame is recorded.
    fn begin_frame(&mut self, gpu: &Gpu);

    /// Records what is made once a frame from the G-buffer, before any search.
    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage);

    /// Records the search of a batch on one mirror, as the pass `search`.
    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    );

    /// Whether an answer of the previous frame helps to find this frame's.
    fn uses_previous(&self) -> bool {
        false
    }

    /// Whether the search reports holes and enlargements.
    fn has_holes(&self) -> bool {
        false
    }
}

/// What every search is made from.
pub(crate) struct Context<'a> {
    pub gpu: &'a Gpu,
    pub options: &'a Options,
    pub stage: &'a Stage,
    /// Of [`Points::group`].
    pub points_layout: &'a wgpu::BindGroupLayout,
    /// What the shader of [`Variant::AllLayers`] tells beside its answers.
    pub account: Account,
}

/// What a search can tell of itself, and the shader feature for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Account {
    /// What each search took.
    Efforts,
    /// Where a single search went: see [`crate::path()`].
    Path,
}

impl Account {
    /// The feature's name.
    pub(crate) fn feature(self) -> &'static str {
        match self {
            Self::Efforts => "count",
            Self::Path => "path",
        }
    }
}

/// Makes a search by its name.
pub(crate) type Make = fn(&Context<'_>) -> Result<Box<dyn Search>, ReflectError>;

//! Refinements: which points a search is asked for, and the triangles drawn from its answers.
//! One file a refinement, named as its shader. Any search goes with any refinement.

pub(crate) mod adaptive;
pub(crate) mod full;
pub(crate) mod grid;
pub(crate) mod none;
mod originals;
pub(crate) mod tessellation;

use catoptric_frame::{Triangles, VertexResult};
use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::search::Search;
use crate::spec::{Options, Spec};
use crate::stage::Stage;
use crate::stage::points::Efforts;
use crate::technique::Variant;

/// A refinement that stands ready for one scene and image size.
pub(crate) trait Refine {
    /// Takes over what moved; stage and search have been updated already.
    fn update(&mut self, gpu: &Gpu, stage: &Stage);

    /// Called before each frame is recorded; `warm`: the previous frame's answers help the search.
    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool);

    /// Records, for one mirror, the searches and the virtual triangles.
    fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        mirror: usize,
        variant: Variant,
    );

    /// Answers for the scene's vertices in the last frame, mirrors outer.
    fn vertices(&self, gpu: &Gpu, stage: &Stage, search: &dyn Search) -> Vec<VertexResult>;

    /// All searches of the last frame.
    fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts;

    /// All triangles of the last frame.
    fn triangles(&self, gpu: &Gpu, stage: &Stage) -> Triangles;

    /// Corners of the last frame's drawn triangles that lie inside an edge of another; `None` for
    /// refinements that split no triangle.
    fn t_junctions(&self, _gpu: &Gpu, _stage: &Stage, _search: &dyn Search) -> Option<u64> {
        None
    }

    /// What else the reader of its numbers should know, in sentences.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// What every refinement is made from.
pub(crate) struct Context<'a> {
    pub gpu: &'a Gpu,
    /// Of the search, as asked for: `depth`, `hidden`.
    pub search_options: &'a Options,
    /// Those that the search is made with: see [`searched_options`].
    pub searched_options: &'a Options,
    /// The refinement's own; `None` without one.
    pub options: Option<&'a Options>,
    pub stage: &'a Stage,
    /// Of `Points::group`.
    pub points_layout: &'a wgpu::BindGroupLayout,
}

/// The options that a search is made with. The corners of a grid's cells are continued behind the
/// tangent plane wherever the search can do so: a vertex that is reflected needs those of its
/// cell's corners too that are not. Where there is no cell, it is the search as asked for.
pub(crate) fn searched_options(spec: &Spec, scene: &Scene) -> Options {
    let continued = spec.options.with("hidden", "extend");
    let is_grid =
        |refinement: &Options| refinement.info().name == "+grid" && !grid::is_bypassed(refinement);
    let can = (spec.options.info().objection)(&continued, scene).is_none();
    match spec.refinement.as_ref().is_some_and(is_grid) && can {
        true => continued,
        false => spec.options.clone(),
    }
}

/// Makes a refinement by its name.
pub(crate) type Make = fn(&Context<'_>) -> Result<Box<dyn Refine>, ReflectError>;

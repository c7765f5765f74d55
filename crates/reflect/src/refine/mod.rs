//! Refinements: which points a search is asked for, and the triangles drawn from its answers.
//! One folder a refinement, named as its shader. Any search goes with any refinement.

pub(crate) mod adaptive;
pub(crate) mod full;
pub(crate) mod grid;
pub(crate) mod none;
pub(crate) mod pixel;
mod scene_vertices;
mod split;
mod step;
pub(crate) mod tessellation;

use catoptric_frame::{Triangles, VertexResult};
use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::SearchOptions;
use crate::stage::points::Efforts;
use crate::stage::variant::Variant;
use crate::technique::Properties;

/// A refinement with its options settled, not yet made ready for a scene.
pub(crate) trait Recipe {
    /// Why it cannot draw a scene.
    fn objection(&self, _scene: &Scene) -> Option<String> {
        None
    }

    /// What it is like.
    fn properties(&self) -> Properties {
        Properties::default()
    }

    /// Whether points behind the tangent plane are to be continued, whatever is drawn of them,
    /// wherever the search can do so.
    fn wants_continued(&self) -> bool {
        false
    }

    /// Makes it ready for a scene.
    ///
    /// # Errors
    /// A scene or an image that the device cannot hold.
    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError>;
}

/// A refinement that stands ready for one scene and image size.
pub(crate) trait Refine {
    /// Takes over what moved; stage and search have been updated already.
    fn update(&mut self, _: &Gpu, _: &Stage) {}

    /// Called before each frame is recorded; `warm`: the previous frame's answers help the search.
    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool);

    /// Whether the last frame wanted more room than there was. It was not drawn whole then: more room has
    /// been made, and it is to be recorded anew.
    ///
    /// # Errors
    /// What the device cannot hold.
    fn outgrown(&mut self, _: &Gpu, _: &Stage) -> Result<bool, ReflectError> {
        Ok(false)
    }

    /// Whether it reads the stage's maps, whatever the search does.
    fn reads_maps(&self) -> bool {
        false
    }

    /// Records, for one sheet of a mirror, the searches and the virtual triangles.
    fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    );

    /// Answers for the scene's vertices in the last frame, mirrors outer; those of a vertex on all sheets
    /// of a mirror in a row.
    fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult>;

    /// All searches of the last frame.
    fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts;

    /// All triangles of the last frame.
    fn triangles(&self, gpu: &Gpu, stage: &Stage) -> Triangles;

    /// What the last frame's drawn triangles are like; `None` for refinements that split no triangle.
    fn surface(&self, _gpu: &Gpu, _stage: &Stage, _search: &dyn Search) -> Option<Surface> {
        None
    }

    /// What else the reader of its numbers should know, in sentences.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }
}

/// What the drawn triangles of a frame are like, all sheets together.
pub(crate) struct Surface {
    /// Corners that lie inside an edge of another triangle.
    pub t_junctions: u64,
    /// As [`Output::levels`](crate::Output::levels).
    pub levels: Vec<u8>,
}

/// What every refinement is made from.
pub(crate) struct Context<'a> {
    pub gpu: &'a Gpu,
    /// What is to be drawn.
    pub drawn: SearchOptions,
    /// What the search is like.
    pub search: Properties,
    /// All that it looks for, mirrors outer.
    pub sheets: &'a [Sheet],
    /// The search continues points behind the tangent plane.
    pub continued: bool,
    pub stage: &'a Stage,
    /// Of `Points::group`.
    pub points_layout: &'a wgpu::BindGroupLayout,
}

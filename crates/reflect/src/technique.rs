//! What a technique is to the rest: it records frames and hands over what it drew and counted.

use catoptric_frame::{Frame, Traced, Triangles, VertexResult, Work};
use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};

/// What a frame is rendered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variant {
    /// Accuracy: all layers, and the work is counted.
    AllLayers,
    /// Timing: colour and depth, as an application would.
    Color,
}

/// What was done before a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Built {
    /// Nothing that a reader of times must know of.
    Nothing,
    /// Something that the technique traces or looks up, without which there would be no frame.
    OnTheCpu,
}

/// A technique that stands ready for one scene and image size.
pub(crate) trait Technique {
    /// Takes over what moved; `scene` differs from the one prepared for in positions only: eye,
    /// vertices, mirrors.
    ///
    /// # Errors
    /// As when preparing.
    fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError>;

    /// Called before each frame is recorded.
    ///
    /// # Errors
    /// As when preparing.
    fn begin_frame(&mut self, gpu: &Gpu) -> Result<Built, ReflectError>;

    /// Records all passes of a frame.
    fn record(&self, frame: &mut Recorder<'_>, variant: Variant);

    /// Whether a frame is found more easily after another one.
    fn carries_over(&self) -> bool {
        false
    }

    /// Reads back what the last frame drew and counted; it was rendered in
    /// [`Variant::AllLayers`].
    fn output(&self, gpu: &Gpu) -> Output;

    /// The pyramid of the first mirror's cube maps of distance, texels first; `None` for techniques
    /// that have none.
    fn distance_levels(&self, _: &Gpu) -> Option<Vec<DistanceLevel>> {
        None
    }
}

/// A level of a pyramid over cube maps of world distance.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceLevel {
    /// Cells a side of a face.
    pub side: u32,
    /// Least and greatest distance in a cell, world units: by map, face (+x −x +y −y +z −z), row,
    /// column. The background counts as far as the scene's diagonal.
    pub ranges: Vec<[f32; 2]>,
}

/// A rendered frame and all that was counted on the way.
#[derive(Clone, Debug)]
pub struct Output {
    /// All layers.
    pub frame: Frame,
    /// Whether mirror pixels may be left without an answer; else that there is none counts as
    /// seeing nothing.
    pub may_be_unresolved: bool,
    /// By mirror, object, vertex; `None` for techniques that search no vertices.
    pub vertices: Option<Vec<VertexResult>>,
    /// Searches that were run, those of a refinement's new points included; 0 without a search.
    pub searched: u64,
    /// Triangles of the virtual geometry; `None` for techniques that have none.
    pub triangles: Option<Triangles>,
    /// Corners of drawn triangles inside an edge of another; `None` where no triangle is split.
    pub t_junctions: Option<u64>,
    /// Means per search that was run, or per mirror pixel.
    pub work: Work,
    /// What else the reader of these numbers should know, in sentences.
    pub notes: Vec<String>,
    /// Pixel by pixel, what following the reflected rays took; `None` for techniques that do not
    /// go along them step by step.
    pub traced: Option<Traced>,
}

//! Tessellation by pixels: an edge is split while its image is off the true curve by more than so many
//! pixels.
//!
//! The decision is made edge by edge, from what the triangles on both sides share, and the middle of an
//! edge is the same point for both: no crack can open. The edges' splits select a pattern for each
//! triangle. The edges of a scene follow from its connectivity alone ([`Topology`]); their parts are
//! numbered as they are made, so that no look-up is needed. Buffers have room for what is drawn, whatever
//! the level limit; a frame that needs more is made anew with more ([`Refine::outgrown`]).

mod kernels;
mod passes;
mod records;
#[cfg(test)]
mod tests;
mod topology;

use catoptric_frame::{Triangles, VertexResult};

use super::scene_vertices::SceneVertices;
use super::split::{Counts, Drawn, Splits};
use super::tessellation::DEEPEST;
use super::{Context, Recipe, Refine, Surface};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::options::options;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::Efforts;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named, Properties};
use passes::Passes;
use records::{Asked, Room};
use topology::Topology;

options! {
    /// The refinement, as its options describe it.
    pub(crate) struct Pixel {
        /// how far a drawn edge may be off the true curve at its middle and its quarters, and the inside
        /// of a triangle at its middle, in pixels
        error: f64 = 0.5 in 0.01..=64.0,
        /// how often an edge may be split
        level: u32 = 8 in 0..=DEEPEST,
    }
}

impl Named for Pixel {
    const INFO: Info = Info {
        name: "+pixel",
        what: "splits edges whose image is off by pixels; no cracks",
        paper: "this project",
    };
}

impl Recipe for Pixel {
    fn properties(&self) -> Properties {
        Properties {
            splits_triangles: true,
            ..Properties::NONE
        }
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
        Ok(Box::new(ByPixels::new(context, *self)?))
    }
}

/// The refinement, ready for a scene.
struct ByPixels {
    options: Pixel,
    topology: Topology,
    scene_vertices: SceneVertices,
    passes: Passes,
}

impl ByPixels {
    fn new(context: &Context<'_>, options: Pixel) -> Result<Self, ReflectError> {
        let topology = Topology::new(&context.stage.world.scene);
        let scene_vertices = SceneVertices::new(context);
        let room = Room::first(topology.counts());
        let asked = Asked {
            error: options.error as f32,
            level: options.level,
        };
        let passes = Passes::new(context, asked, &topology, room, &scene_vertices)?;
        Ok(Self {
            options,
            topology,
            scene_vertices,
            passes,
        })
    }
}

impl Refine for ByPixels {
    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool) {
        self.scene_vertices.begin_frame(gpu, stage, warm);
        self.passes.begin_frame(gpu);
    }

    /// Whether an edge between hidden ends passes the mirror is read from them.
    fn reads_maps(&self) -> bool {
        true
    }

    fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    ) {
        self.scene_vertices
            .record(frame, stage, search, sheet, variant);
        self.passes.record(frame, stage, search, sheet, variant);
        self.passes.draw(frame, stage, sheet, variant);
    }

    fn outgrown(&mut self, gpu: &Gpu, _stage: &Stage) -> Result<bool, ReflectError> {
        let wanted = self.passes.wanted(gpu);
        let Some(room) = self.passes.room().grown(wanted) else {
            return Ok(false);
        };
        self.passes
            .resize(gpu, &self.topology, room, &self.scene_vertices)?;
        Ok(true)
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        self.scene_vertices.vertices(gpu, stage)
    }

    fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        self.efforts_of_all(gpu, stage)
    }

    fn triangles(&self, gpu: &Gpu, stage: &Stage) -> Triangles {
        self.triangles_of_all(gpu, stage)
    }

    fn surface(&self, gpu: &Gpu, stage: &Stage, search: &dyn Search) -> Option<Surface> {
        self.surface_of_all(gpu, stage, search)
    }
}

impl Splits for ByPixels {
    fn level(&self) -> u32 {
        self.options.level
    }

    fn scene_vertices(&self) -> &SceneVertices {
        &self.scene_vertices
    }

    fn counts(&self, gpu: &Gpu) -> Counts {
        self.passes.counts(gpu)
    }

    fn visit_drawn(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        visit: &mut dyn FnMut(Drawn),
    ) {
        for (piece, corners) in self.passes.drawn(gpu, stage, search, sheet) {
            visit(Drawn {
                source: piece.source,
                level: piece.level,
                corners: corners.map(|corner| corner.position),
            });
        }
    }
}

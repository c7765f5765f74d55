//! Tessellation of the reflected geometry (Szabo 2013, chapter 5; Szabo CESCG, section 4.2).
//!
//! A loop on the GPU, without read-back: judge the triangles being worked on, finish them or split them into four,
//! search the new points, and again, until the level limit; then draw the finished triangles and those left over. Only
//! new points are searched, three a split triangle, where Alg. 3 of the CESCG paper searches all twelve corners of the
//! four parts anew: the answers are the same. A scene is processed in chunks of its triangles ([`Plan`]), each drawn
//! before the next. Slots come from prefix sums, so that neither pictures nor counts depend on the order in which
//! threads run.

mod buffers;
pub(super) mod junctions;
mod kernels;
mod passes;
mod plan;
mod records;
pub(crate) mod rule;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(test)]
mod twin;

use catoptric_frame::{Triangles, VertexResult};
use glam::Vec3;

use super::scene_vertices::SceneVertices;
use super::split::{Counts, Drawn, Splits};
use super::{Context, Refine, Surface};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::Hidden;
use crate::stage::points::{Efforts, Found};
use crate::stage::variant::Variant;
use passes::Passes;
pub(crate) use plan::DEEPEST;
use plan::Plan;
pub(super) use records::Piece;
pub(crate) use rule::Rule;

/// A finished triangle, on the CPU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaf {
    pub piece: Piece,
    /// World-space corners.
    pub corners: [Vec3; 3],
    /// What their searches came to: one of `Found::…`.
    #[cfg_attr(not(test), expect(dead_code, reason = "tests check `drawn` by them"))]
    pub states: [u32; 3],
    /// It is drawn: a corner is reflected and the others are, too, or would be beyond the rim of an open
    /// mirror; with `hidden=extend` the others may be anything but failed.
    pub drawn: bool,
}

/// A refinement by a [`Rule`].
pub(crate) struct Tessellation {
    /// `hidden=extend`.
    extends: bool,
    /// The search starts at the previous frame's answers.
    starts_warm: bool,
    plan: Plan,
    scene_vertices: SceneVertices,
    passes: Passes,
}

impl Tessellation {
    pub(crate) fn new(context: &Context<'_>, rule: Rule) -> Result<Self, ReflectError> {
        let binding = context.gpu.device.limits().max_storage_buffer_binding_size;
        Self::within(context, rule, binding)
    }

    /// As if a shader could see no buffer of more than `binding` bytes.
    fn within(context: &Context<'_>, rule: Rule, binding: u64) -> Result<Self, ReflectError> {
        let plan = Plan::new(context.stage.world.corners / 3, rule.level, binding);
        let scene_vertices = SceneVertices::new(context);
        let passes = Passes::new(context, rule, plan, &scene_vertices)?;
        Ok(Self {
            extends: context.drawn.hidden == Hidden::Extend,
            starts_warm: context.search.carries_over,
            plan,
            scene_vertices,
            passes,
        })
    }

    /// The finished triangles of a sheet in the last frame, chunk by chunk, made again: the
    /// buffers only ever hold one chunk.
    pub(crate) fn leaves(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        mut each: impl FnMut(Leaf),
    ) {
        let batch = &self.scene_vertices.batches[sheet.index];
        let answers = batch.read_found(gpu, stage.world.vertices());
        let vertices: Vec<_> = (stage.world.scene.objects.iter())
            .flat_map(|object| object.mesh.positions.iter().copied())
            .collect();
        let totals = gpu.read_buffer(self.passes.totals_buffer());
        gpu.run(|frame| {
            stage.record_maps(frame, sheet.mirror);
            search.record_build(frame, stage, sheet.mirror);
        });
        for chunk in 0..self.plan.chunks().count() {
            gpu.run(|frame| {
                let variant = Variant::Color;
                self.passes
                    .record(frame, stage, search, (sheet, chunk), variant);
            });
            let made = self.passes.read(gpu, self.plan.level);
            for piece in made.pieces {
                let of = |point: u32| {
                    let place = (point & !Piece::NEW) as usize;
                    if point & Piece::NEW == 0 {
                        (vertices[place], answers[place].state)
                    } else {
                        (made.points[place], made.found[place].state)
                    }
                };
                let corners = piece.points.to_array().map(of);
                let states = corners.map(|(_, state)| state);
                each(Leaf {
                    piece,
                    corners: corners.map(|(position, _)| position),
                    states,
                    drawn: self.is_drawn(states),
                });
            }
        }
        let buffer = self.passes.totals_buffer();
        gpu.queue.write_buffer(buffer, 0, &totals);
    }

    /// Twin of `usable` in `stage/virtual.wesl`, but for what lies behind the eye's plane.
    fn is_drawn(&self, states: [u32; 3]) -> bool {
        let goes = |state: &u32| match *state {
            Found::FAILED => false,
            Found::HIDDEN => self.extends,
            _ => true,
        };
        states.contains(&Found::FOUND) && states.iter().all(goes)
    }
}

impl Refine for Tessellation {
    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool) {
        self.scene_vertices.begin_frame(gpu, stage, warm);
        self.passes.begin_frame(gpu);
    }

    fn reads_maps(&self) -> bool {
        self.passes.judges()
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
        for chunk in 0..self.plan.chunks().count() {
            self.passes
                .record(frame, stage, search, (sheet, chunk), variant);
            self.passes.draw(frame, stage, sheet, variant);
        }
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

    fn notes(&self) -> Vec<String> {
        let cold = self.starts_warm && self.plan.level > 0;
        let note = "start=previous holds for the scene's vertices: the new points of a frame have \
                    no predecessors, and start where the search starts without a previous frame";
        cold.then(|| note.to_owned()).into_iter().collect()
    }
}

impl Splits for Tessellation {
    fn level(&self) -> u32 {
        self.plan.level
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
        self.leaves(gpu, stage, search, sheet, |leaf| {
            if leaf.drawn {
                visit(Drawn {
                    source: leaf.piece.source,
                    level: leaf.piece.level,
                    corners: leaf.corners,
                });
            }
        });
    }
}

//! The scene's own vertices, searched once a frame and sheet of a mirror: what every refinement starts
//! from.

use catoptric_frame::VertexResult;

use super::Context;
use crate::gpu::{Gpu, Recorder};
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::{Efforts, Points};
use crate::stage::variant::Variant;

/// One batch a sheet: all vertices of all objects.
pub(crate) struct SceneVertices {
    pub batches: Vec<Points>,
    pub sheets: Vec<Sheet>,
    /// The search tells of holes.
    has_holes: bool,
}

impl SceneVertices {
    pub(crate) fn new(context: &Context<'_>) -> Self {
        let world = &context.stage.world;
        let batch = |_| {
            let (layout, vertices) = (context.points_layout, world.vertices());
            Points::new(context.gpu, layout, &world.positions, vertices)
        };
        Self {
            batches: context.sheets.iter().map(batch).collect(),
            sheets: context.sheets.to_vec(),
            has_holes: context.search.has_holes,
        }
    }

    /// Before each frame; `warm`: the previous frame's answers help the search.
    pub(crate) fn begin_frame(&self, gpu: &Gpu, stage: &Stage, warm: bool) {
        for batch in &self.batches {
            batch.set_warm(gpu, stage.world.vertices(), warm);
        }
    }

    /// Records the search on one sheet; with the first sheet of a mirror, that on all of them.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    ) {
        if sheet.number == 0 {
            let of_mirror = |other: &&Sheet| other.mirror == sheet.mirror;
            let sheets: Vec<_> = self.sheets.iter().filter(of_mirror).copied().collect();
            let batches = sheets.iter().map(|sheet| &self.batches[sheet.index]);
            let batches: Vec<_> = batches.collect();
            search.record_sheets(frame, stage, &sheets, &batches, variant);
        }
    }

    /// Answers of the last frame, mirrors outer; those of a vertex on all sheets of a mirror in a row.
    pub(crate) fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        let batches: Vec<_> = self.batches.iter().collect();
        in_a_row(gpu, stage, &self.sheets, &batches, self.has_holes)
    }

    /// What the searches of the last frame took. A vertex counts once, whatever the number of its
    /// sheets.
    pub(crate) fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        let mut total = Efforts::default();
        for (sheet, batch) in self.sheets.iter().zip(&self.batches) {
            let mut efforts = batch.total(gpu, stage.world.vertices());
            efforts.searched *= u64::from(sheet.number == 0);
            total.add(efforts);
        }
        total
    }
}

/// The answers for the scene's vertices on each sheet, mirrors outer, those of a vertex on all sheets
/// of a mirror in a row.
pub(crate) fn in_a_row(
    gpu: &Gpu,
    stage: &Stage,
    sheets: &[Sheet],
    batches: &[&Points],
    has_holes: bool,
) -> Vec<VertexResult> {
    let places: Vec<_> = stage.world.places().collect();
    let mut all = Vec::new();
    for of_mirror in sheets.chunk_by(|a, b| a.mirror == b.mirror) {
        let id = stage.world.mirrors[of_mirror[0].mirror].id;
        let lists = of_mirror
            .iter()
            .map(|sheet| batches[sheet.index].results(gpu, id, &places, has_holes));
        let lists: Vec<_> = lists.collect();
        for vertex in 0..places.len() {
            all.extend(lists.iter().map(|list| list[vertex]));
        }
    }
    all
}

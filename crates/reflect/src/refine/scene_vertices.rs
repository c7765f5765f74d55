//! The scene's own vertices, searched once a frame and mirror: what every refinement starts from.

use catoptric_frame::VertexResult;

use super::Context;
use crate::gpu::{Gpu, Recorder};
use crate::search::Search;
use crate::stage::Stage;
use crate::stage::points::{Efforts, Points};
use crate::stage::variant::Variant;

/// One batch a mirror: all vertices of all objects.
pub(crate) struct SceneVertices {
    pub batches: Vec<Points>,
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
            batches: world.mirrors.iter().map(batch).collect(),
            has_holes: context.search.has_holes,
        }
    }

    /// Before each frame; `warm`: the previous frame's answers help the search.
    pub(crate) fn begin_frame(&self, gpu: &Gpu, stage: &Stage, warm: bool) {
        for batch in &self.batches {
            batch.set_warm(gpu, stage.world.vertices(), warm);
        }
    }

    /// Records the search on one mirror.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        mirror: usize,
        variant: Variant,
    ) {
        search.record_search(frame, stage, mirror, &self.batches[mirror], variant);
    }

    /// Answers of the last frame, mirrors outer.
    pub(crate) fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        let places: Vec<_> = stage.world.places().collect();
        let batches = stage.world.mirrors.iter().zip(&self.batches);
        batches
            .flat_map(|(mirror, batch)| batch.results(gpu, mirror.id, &places, self.has_holes))
            .collect()
    }

    /// What the searches of the last frame took.
    pub(crate) fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        let mut total = Efforts::default();
        for batch in &self.batches {
            total.add(batch.total(gpu, stage.world.vertices()));
        }
        total
    }
}

//! No refinement: the scene's own triangles, each vertex at its reflection point.

use catoptric_frame::{Triangles, VertexResult};

use super::{Context, Refine};
use crate::ReflectError;
use crate::gpu::Gpu;
use crate::points::{Efforts, Points};
use crate::raster::Raster;
use crate::recorder::Recorder;
use crate::resources::{Slot, group};
use crate::search::Search;
use crate::stage::Stage;
use crate::technique::Variant;

struct None {
    raster: Raster,
    /// One batch a mirror: all vertices.
    batches: Vec<Points>,
    found: Vec<wgpu::BindGroup>,
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
    let Context { gpu, stage, .. } = context;
    let world = &stage.world;
    let raster = Raster::new(gpu, context.search_options, stage, "virtual", &[Slot::Read])?;
    let vertices = world.vertices();
    let batches: Vec<_> = (world.mirrors.iter())
        .map(|_| Points::new(gpu, context.points_layout, &world.positions, vertices))
        .collect();
    let found = batches.iter().map(|batch| {
        let found = batch.found.as_entire_binding();
        group(gpu, &raster.own_layout, &[found])
    });
    Ok(Box::new(None {
        found: found.collect(),
        raster,
        batches,
    }))
}

impl Refine for None {
    fn update(&mut self, _gpu: &Gpu, _stage: &Stage) {}

    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool) {
        for batch in &self.batches {
            batch.set_warm(gpu, stage.world.vertices(), warm);
        }
    }

    fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        mirror: usize,
        variant: Variant,
    ) {
        search.record_search(frame, stage, mirror, &self.batches[mirror], variant);
        let found = &self.found[mirror];
        self.raster
            .record(frame, stage, mirror, found, variant, |pass| {
                pass.draw(0..stage.world.corners, 0..1);
            });
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage, search: &dyn Search) -> Vec<VertexResult> {
        let places: Vec<_> = stage.world.places().collect();
        let batches = stage.world.mirrors.iter().zip(&self.batches);
        batches
            .flat_map(|(mirror, batch)| batch.results(gpu, mirror.id, &places, search.has_holes()))
            .collect()
    }

    fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        let mut total = Efforts::default();
        for batch in &self.batches {
            total.add(batch.total(gpu, stage.world.vertices()));
        }
        total
    }

    fn triangles(&self, _gpu: &Gpu, stage: &Stage) -> Triangles {
        let drawn = u64::from(stage.world.corners / 3) * self.batches.len() as u64;
        Triangles {
            input: drawn,
            drawn,
            by_level: vec![drawn],
            unfinished: 0,
        }
    }
}

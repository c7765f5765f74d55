//! No refinement: the scene's own triangles, each vertex at its reflection point.

use catoptric_frame::{Triangles, VertexResult};

use super::scene_vertices::SceneVertices;
use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, group};
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::Efforts;
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;

/// No refinement.
pub(crate) struct Unrefined;

impl Recipe for Unrefined {
    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let slots = [Slot::Read];
        let raster = Raster::new(gpu, context.drawn, stage, "stage/virtual", &[], &slots)?;
        let scene_vertices = SceneVertices::new(context);
        let found = scene_vertices.batches.iter().map(|batch| {
            let found = batch.found.as_entire_binding();
            group(gpu, &raster.own_layout, &[found])
        });
        Ok(Box::new(AsItIs {
            found: found.collect(),
            raster,
            scene_vertices,
        }))
    }
}

/// The scene's own triangles, ready to be drawn.
struct AsItIs {
    raster: Raster,
    scene_vertices: SceneVertices,
    found: Vec<wgpu::BindGroup>,
}

impl Refine for AsItIs {
    fn begin_frame(&mut self, gpu: &Gpu, stage: &Stage, warm: bool) {
        self.scene_vertices.begin_frame(gpu, stage, warm);
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
        let found = &self.found[sheet.index];
        self.raster
            .record(frame, stage, sheet.mirror, found, variant, |pass| {
                pass.draw(self.raster.vertices(stage.world.corners / 3), 0..1);
            });
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        self.scene_vertices.vertices(gpu, stage)
    }

    fn efforts(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        self.scene_vertices.efforts(gpu, stage)
    }

    fn triangles(&self, _gpu: &Gpu, stage: &Stage) -> Triangles {
        let triangles = u64::from(stage.world.corners / 3);
        let drawn = triangles * self.scene_vertices.batches.len() as u64;
        Triangles {
            input: triangles * stage.world.mirrors.len() as u64,
            drawn,
            by_level: vec![drawn],
            unfinished: 0,
        }
    }
}

//! Object order: a reflection point for every vertex, then the triangles are drawn there
//! (Szabo 2013, Alg. 3.1): mirror G-buffer → search → refine → virtual triangles → composite.

use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::refine::{self, Refine};
use crate::search::{self, Account, Search};
use crate::spec::Spec;
use crate::stage::Stage;
use crate::stage::points::points_layout;
use crate::stage::raster::Raster;
use crate::technique::{Built, Output, Technique, Variant};

/// A search with a refinement.
struct ObjectOrder {
    stage: Stage,
    search: Box<dyn Search>,
    refine: Box<dyn Refine>,
    /// A frame has been rendered: its answers may serve the next.
    has_previous: bool,
}

/// Makes a search with its refinement ready for a scene.
pub(crate) fn prepare(
    gpu: &Gpu,
    (make_search, make_refine): (search::Make, refine::Make),
    spec: &Spec,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Box<dyn Technique>, ReflectError> {
    let stage = Stage::new(gpu, &spec.options, scene, size)?;
    let points_layout = points_layout(gpu);
    let searched_options = refine::searched_options(spec, scene);
    let search = make_search(&search::Context {
        gpu,
        options: &searched_options,
        stage: &stage,
        points_layout: &points_layout,
        account: Account::Efforts,
    })?;
    let refine = make_refine(&refine::Context {
        gpu,
        search_options: &spec.options,
        searched_options: &searched_options,
        options: spec.refinement.as_ref(),
        stage: &stage,
        points_layout: &points_layout,
    })?;
    Ok(Box::new(ObjectOrder {
        stage,
        search,
        refine,
        has_previous: false,
    }))
}

impl Technique for ObjectOrder {
    fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError> {
        self.stage.world.update(gpu, scene)?;
        self.search.update(gpu, &self.stage);
        self.refine.update(gpu, &self.stage);
        Ok(())
    }

    fn begin_frame(&mut self, gpu: &Gpu) -> Result<Built, ReflectError> {
        let warm = self.has_previous && self.search.uses_previous();
        self.search.begin_frame(gpu);
        self.refine.begin_frame(gpu, &self.stage, warm);
        self.has_previous = true;
        Ok(Built::Nothing)
    }

    fn record(&self, frame: &mut Recorder<'_>, variant: Variant) {
        // First of all, so that the clock of no later pass waits for it (`timing`).
        Raster::record_clear(frame, &self.stage, variant);
        self.stage.begin(frame, variant);
        self.search.record_build(frame, &self.stage);
        for mirror in 0..self.stage.world.mirrors.len() {
            let search = self.search.as_ref();
            self.refine
                .record(frame, &self.stage, search, mirror, variant);
        }
        self.stage.finish(frame);
    }

    fn carries_over(&self) -> bool {
        self.search.uses_previous()
    }

    fn output(&self, gpu: &Gpu) -> Output {
        let efforts = self.refine.efforts(gpu, &self.stage);
        let vertices = (self.refine).vertices(gpu, &self.stage, self.search.as_ref());
        let hierarchy = vertices.iter().any(|vertex| vertex.hole.is_some());
        Output {
            frame: self.stage.layers(gpu),
            may_be_unresolved: false,
            vertices: Some(vertices),
            searched: efforts.searched,
            triangles: Some(self.refine.triangles(gpu, &self.stage)),
            t_junctions: (self.refine).t_junctions(gpu, &self.stage, self.search.as_ref()),
            work: efforts.mean(hierarchy),
            notes: self.refine.notes(),
            traced: None,
        }
    }
}

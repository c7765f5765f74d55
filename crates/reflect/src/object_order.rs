//! Object order: a reflection point for every vertex, then the triangles are drawn there
//! (Szabo 2013, Alg. 3.1): mirror G-buffer → maps of each
//! mirror → search → refine → virtual triangles → composite.

use catoptric_scene::Scene;

use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder};
use crate::refine::{self, Refine};
use crate::search::path::path;
use crate::search::{self, Instrumentation, Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::{Hidden, SearchOptions};
use crate::stage::points::points_layout;
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;
use crate::technique::{Built, Output, Properties, Technique};

/// A search with a refinement.
struct ObjectOrder {
    asked: search::Asked,
    stage: Stage,
    search: Box<dyn Search>,
    /// All that the search looks for, mirrors outer.
    sheets: Vec<Sheet>,
    refine: Box<dyn Refine>,
    /// What the search is like.
    properties: Properties,
    /// A frame has been rendered: its answers may serve the next.
    has_previous: bool,
}

/// Makes a search with its refinement ready for a scene.
pub(crate) fn prepare(
    gpu: &Gpu,
    asked: search::Asked,
    refinement: &dyn refine::Recipe,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Box<dyn Technique>, ReflectError> {
    let search::Asked { recipe, common } = &asked;
    let stage = Stage::searched(gpu, common, scene, size)?;
    let points_layout = points_layout(gpu);
    let continued = SearchOptions {
        hidden: Hidden::Extend,
        ..*common
    };
    let continues = common.hidden == Hidden::Extend
        || refinement.wants_continued() && recipe.objection(&continued, scene).is_none();
    let properties = asked.properties();
    let search = recipe.make(&search::Context {
        gpu,
        stage: &stage,
        extends: continues,
        points_layout: &points_layout,
        instrumentation: Instrumentation::Efforts,
    })?;
    let sheets = Sheet::all(search.as_ref(), stage.world.mirrors.len());
    let refine = refinement.make(&refine::Context {
        gpu,
        drawn: *common,
        search: properties,
        sheets: &sheets,
        continued: continues,
        stage: &stage,
        points_layout: &points_layout,
    })?;
    Ok(Box::new(ObjectOrder {
        asked,
        stage,
        search,
        sheets,
        refine,
        properties,
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
        let warm = self.has_previous && self.properties.carries_over;
        self.refine.begin_frame(gpu, &self.stage, warm);
        self.has_previous = true;
        Ok(Built::Nothing)
    }

    fn record(&self, frame: &mut Recorder<'_>, variant: Variant) {
        // First of all, so that the clock of no later pass waits for it (`timing`).
        Raster::record_clear(frame, &self.stage, variant);
        self.stage.begin(frame, variant);
        let reads_maps = self.search.reads_maps() || self.refine.reads_maps();
        for mirror in 0..self.stage.world.mirrors.len() {
            let search = self.search.as_ref();
            if reads_maps {
                self.stage.record_maps(frame, mirror);
            }
            search.record_build(frame, &self.stage, mirror);
            for sheet in self.sheets.iter().filter(|sheet| sheet.mirror == mirror) {
                self.refine
                    .record(frame, &self.stage, search, *sheet, variant);
            }
        }
        self.stage.finish(frame);
    }

    fn outgrown(&mut self, gpu: &Gpu) -> Result<bool, ReflectError> {
        self.refine.outgrown(gpu, &self.stage)
    }

    fn carries_over(&self) -> bool {
        self.properties.carries_over
    }

    fn output(&self, gpu: &Gpu) -> Output {
        let efforts = self.refine.efforts(gpu, &self.stage);
        let surface = (self.refine).surface(gpu, &self.stage, self.search.as_ref());
        Output {
            frame: self.stage.layers(gpu, None),
            may_be_unresolved: false,
            vertices: Some(self.refine.vertices(gpu, &self.stage)),
            searched: efforts.searched,
            triangles: Some(self.refine.triangles(gpu, &self.stage)),
            t_junctions: surface.as_ref().map(|surface| surface.t_junctions),
            levels: surface.map(|surface| surface.levels),
            work: efforts.mean(self.properties.has_holes),
            notes: self.refine.notes(),
        }
    }

    fn answer(&self, gpu: &Gpu, question: Question) -> Result<Option<Answer>, ReflectError> {
        let Question::Path { point, mirror } = question else {
            return Ok(None);
        };
        let visits = path(gpu, &self.asked, &self.stage, point, mirror)?;
        Ok(Some(Answer::Path(visits)))
    }
}

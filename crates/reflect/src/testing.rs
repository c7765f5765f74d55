//! What tests of this crate share: the software adapter, and a search run on a scene's vertices.

use catoptric_scene::{LoadOptions, Scene};

use crate::gpu::{Gpu, Prefer, Recorder};
use crate::registry::Maker;
use crate::search::{Account, Context, Search};
use crate::spec::parse;
use crate::stage::Stage;
use crate::stage::points::{Points, points_layout};
use crate::technique::Variant;

/// The software adapter; `None` means skip. Panics instead of skipping where
/// `CATOPTRIC_REQUIRE_GPU=1` says that there must be one.
pub(crate) fn gpu_or_skip() -> Option<Gpu> {
    match Gpu::new(None, Prefer::Software) {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            let required = std::env::var("CATOPTRIC_REQUIRE_GPU").is_ok_and(|value| value == "1");
            assert!(!required, "CATOPTRIC_REQUIRE_GPU=1, and {error}");
            eprintln!("skipped: {error}");
            None
        }
    }
}

/// A built-in scene.
pub(crate) fn scene(name: &str) -> Scene {
    catoptric_scene::open(name, &LoadOptions::default()).expect("a built-in scene")
}

/// A search that has answered for all vertices of a scene, work counted.
pub(crate) struct Searched {
    pub stage: Stage,
    pub search: Box<dyn Search>,
    /// One batch a mirror: all vertices.
    pub batches: Vec<Points>,
}

impl Searched {
    /// Runs the search of a technique once.
    pub(crate) fn new(gpu: &Gpu, scene: &Scene, technique: &str, size: [u32; 2]) -> Self {
        let spec = parse(technique).expect("a technique");
        let Maker::Search(make) = spec.options.info().maker else {
            panic!("{technique} is no search")
        };
        let stage = Stage::new(gpu, &spec.options, scene, size).expect("fits the device");
        let points_layout = points_layout(gpu);
        let search = make(&Context {
            gpu,
            options: &spec.options,
            stage: &stage,
            points_layout: &points_layout,
            account: Account::Efforts,
        });
        let vertices = stage.world.vertices();
        let batch = |_| Points::new(gpu, &points_layout, &stage.world.positions, vertices);
        let mut searched = Self {
            batches: (0..stage.world.mirrors.len()).map(batch).collect(),
            search: search.expect("can be made"),
            stage,
        };
        searched.run(gpu);
        searched
    }

    /// Runs the search once more.
    pub(crate) fn run(&mut self, gpu: &Gpu) {
        self.search.begin_frame(gpu);
        gpu.run(|frame| {
            self.stage.begin(frame, Variant::AllLayers);
            self.search.record_build(frame, &self.stage);
            for (mirror, points) in self.batches.iter().enumerate() {
                let variant = Variant::AllLayers;
                self.search
                    .record_search(frame, &self.stage, mirror, points, variant);
            }
        });
    }
}

//! What tests of this crate share: the software adapter, and a search run on a scene's vertices.

use catoptric_scene::{LoadOptions, Scene};

use crate::error::ReflectError;
use crate::gpu::shaders::tests::parsed;
use crate::gpu::{Gpu, Prefer, Recorder};
use crate::options::{OptionInfo, Options};
use crate::parse;
use crate::refine;
use crate::registry::{Asked, asked};
use crate::search::{Context, Instrumentation, Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::{Hidden, StageOptions};
use crate::stage::points::{Points, points_layout};
use crate::stage::variant::Variant;

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

/// A scene on the GPU with the default options.
pub(crate) fn stage(gpu: &Gpu, scene: &Scene, size: [u32; 2]) -> Stage {
    let options = StageOptions::OWN.iter().map(OptionInfo::default_value);
    let options: Vec<_> = options.collect();
    let options = StageOptions::read(&mut options.iter().copied());
    Stage::new(gpu, options, scene, size).expect("fits the device")
}

/// A search that has answered for all vertices of a scene, work counted.
pub(crate) struct Searched {
    pub stage: Stage,
    pub search: Box<dyn Search>,
    /// Mirrors outer.
    pub sheets: Vec<Sheet>,
    /// One batch a sheet: all vertices.
    pub batches: Vec<Points>,
}

impl Searched {
    /// Runs the search of a technique once.
    pub(crate) fn new(gpu: &Gpu, scene: &Scene, technique: &str, size: [u32; 2]) -> Self {
        let spec = parse(technique).expect("a technique");
        let Asked::ObjectOrder(asked, _) = asked(&spec) else {
            panic!("{technique} is no search")
        };
        let stage = Stage::searched(gpu, &asked.common, scene, size).expect("fits the device");
        let points_layout = points_layout(gpu);
        let search = asked.recipe.make(&Context {
            gpu,
            stage: &stage,
            extends: asked.common.hidden == Hidden::Extend,
            points_layout: &points_layout,
            instrumentation: Instrumentation::Efforts,
        });
        let search = search.expect("can be made");
        let sheets = Sheet::all(search.as_ref(), stage.world.mirrors.len());
        let vertices = stage.world.vertices();
        let batch = |_| Points::new(gpu, &points_layout, &stage.world.positions, vertices);
        let mut searched = Self {
            batches: sheets.iter().map(batch).collect(),
            sheets,
            search,
            stage,
        };
        searched.run(gpu);
        searched
    }

    /// Makes what a refinement of `technique` needs, whose search this is.
    pub(crate) fn make<T>(
        &self,
        gpu: &Gpu,
        technique: &str,
        make: impl FnOnce(&refine::Context<'_>) -> Result<T, ReflectError>,
    ) -> T {
        let spec = parse(technique).expect("a technique");
        let Asked::ObjectOrder(asked, _) = asked(&spec) else {
            panic!("{technique} is no search")
        };
        let made = make(&refine::Context {
            gpu,
            drawn: asked.common,
            search: asked.recipe.properties(),
            sheets: &self.sheets,
            continued: asked.common.hidden == Hidden::Extend,
            stage: &self.stage,
            points_layout: &points_layout(gpu),
        });
        made.expect("fits the device")
    }

    /// Runs `record` on every sheet, with the maps and what the search builds standing ready.
    pub(crate) fn on_sheets(&self, gpu: &Gpu, record: impl Fn(&mut Recorder<'_>, Sheet)) {
        gpu.run(|frame| {
            for sheet in &self.sheets {
                self.stage.record_maps(frame, sheet.mirror);
                (self.search).record_build(frame, &self.stage, sheet.mirror);
                record(frame, *sheet);
            }
        });
    }

    /// Runs the search once more.
    pub(crate) fn run(&mut self, gpu: &Gpu) {
        gpu.run(|frame| {
            self.stage.begin(frame, Variant::AllLayers);
            for sheets in self.sheets.chunk_by(|a, b| a.mirror == b.mirror) {
                let mirror = sheets[0].mirror;
                self.stage.record_maps(frame, mirror);
                self.search.record_build(frame, &self.stage, mirror);
                let batches = sheets.iter().map(|sheet| &self.batches[sheet.index]);
                let batches: Vec<_> = batches.collect();
                let variant = Variant::AllLayers;
                self.search
                    .record_sheets(frame, &self.stage, sheets, &batches, variant);
            }
        });
    }
}

/// Names, offsets and size of a struct as a linked shader has it.
pub(crate) fn shader_layout(
    program: &str,
    features: &[&str],
    name: &str,
) -> (Vec<(String, u64)>, u64) {
    let module = parsed(program, features);
    let is_it = |ty: &naga::Type| {
        let full = ty.name.as_deref().unwrap_or_default();
        full == name || full.ends_with(&format!("_{name}"))
    };
    let found = module.types.iter().find(|(_, ty)| is_it(ty));
    let (_, ty) = found.unwrap_or_else(|| panic!("{program} has no struct {name}"));
    let naga::TypeInner::Struct { members, span } = &ty.inner else {
        panic!("{name} is no struct")
    };
    let member = |member: &naga::StructMember| {
        let name = member.name.clone().unwrap_or_default();
        (name, u64::from(member.offset))
    };
    (members.iter().map(member).collect(), u64::from(*span))
}

/// Checks a buffer struct against a struct of a linked shader, member by member.
macro_rules! assert_layout {
    ($ty:ident { $($field:ident),* $(,)? }, $program:expr, $features:expr, $name:literal $(,)?) => {{
        let _every_field = |value: $ty| { let $ty { $($field: _),* } = value; };
        let names = [$(stringify!($field)),*];
        let members: Vec<_> = (names.iter().enumerate())
            .map(|(index, name)| {
                (name.to_string(), <$ty as encase::ShaderType>::METADATA.offset(index))
            })
            .collect();
        let size = <$ty as encase::ShaderSize>::SHADER_SIZE.get();
        let expected = $crate::testing::shader_layout($program, $features, $name);
        assert_eq!((members, size), expected, "{}", $name);
    }};
}
pub(crate) use assert_layout;

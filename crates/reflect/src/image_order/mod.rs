//! Image order: for each mirror pixel, what its reflected ray meets. One folder a technique, named
//! as its shader: mirror G-buffer → technique → composite.

pub(crate) mod beams;
mod coincident;
pub(crate) mod cubemap_trace;
mod cubemaps;
pub(crate) mod environment_map;
mod per_pixel;
pub(crate) mod planar;
pub(crate) mod ray_trace;

use catoptric_frame::Work;
use catoptric_scene::Scene;

use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{Begin, Gpu, Recorder};
use crate::options::{Options, Settled};
use crate::stage::Stage;
use crate::stage::options::{StageOptions, Surface};
use crate::stage::variant::Variant;
use crate::technique::{Built, Output, Properties, Technique};

/// A technique of this family that stands ready for one scene and image size.
pub(crate) trait ImageOrder {
    /// Takes over what moved; the stage has been updated already.
    ///
    /// # Errors
    /// As when preparing.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError>;

    /// Called before each frame is recorded.
    ///
    /// # Errors
    /// As when preparing.
    fn begin_frame(&mut self, _: &Gpu, _: &Stage) -> Result<Built, ReflectError> {
        Ok(Built::Nothing)
    }

    /// Records the passes that fill `stage.reflections`, for all mirrors.
    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant);

    /// Work of the last frame: means per mirror pixel.
    fn work(&self, gpu: &Gpu, stage: &Stage) -> Work;

    /// Of each pixel of the last frame with all layers: the length of its path's last segment, world units,
    /// and the reflections on the path (first and second number of four; 0 where no ray was followed).
    /// `None` from a technique that follows no path past the first reflection.
    fn paths(&self, _: &Gpu) -> Option<Vec<[f32; 4]>> {
        None
    }

    /// What else the reader of the last frame's numbers should know, in sentences.
    fn notes(&self, _: &Gpu, _: &Stage) -> Vec<String> {
        Vec::new()
    }

    /// See [`Technique::answer`].
    fn answer(&self, _: &Gpu, _: &Stage, _: Question) -> Option<Answer> {
        None
    }
}

/// A technique of this family with its options settled, not yet made ready for a scene.
pub(crate) trait Recipe {
    /// Why it cannot draw a scene that has mirrors.
    fn objection(&self, _scene: &Scene) -> Option<String> {
        None
    }

    /// What it is like.
    fn properties(&self) -> Properties {
        Properties::default()
    }

    /// Makes it ready for a scene.
    ///
    /// # Errors
    /// A scene or an image that the device cannot hold, or what the adapter cannot do.
    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError>;
}

/// A technique of this family as a name asks for it.
pub(crate) struct Asked {
    recipe: Box<dyn Recipe>,
    common: StageOptions,
}

impl Asked {
    /// The technique `T`.
    pub(crate) fn read<T: Options + Recipe + 'static>(values: &mut Settled<'_>) -> Self {
        Self {
            recipe: Box::new(T::read(values)),
            common: Options::read(values),
        }
    }

    /// Why it cannot draw a scene that has mirrors.
    pub(crate) fn objection(&self, scene: &Scene) -> Option<String> {
        self.recipe.objection(scene)
    }

    /// What it is like.
    pub(crate) fn properties(&self) -> Properties {
        let properties = self.recipe.properties();
        Properties {
            // Rays from the corners of a mesh are not the reference's.
            is_control: properties.is_control && self.common.gbuffer == Surface::Exact,
            ..properties
        }
    }
}

/// Records a pass that draws reflections: colour and, with all layers, position and id. `depth` is
/// cleared and kept as the colours are.
fn draw_reflections(
    frame: &mut Recorder<'_>,
    name: &str,
    stage: &Stage,
    variant: Variant,
    begin: Begin,
    depth: Option<&wgpu::Texture>,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let targets = stage.reflections.views();
    let targets = targets.each_ref();
    let targets = match variant {
        Variant::AllLayers => &targets[..],
        Variant::Color => &targets[..1],
    };
    let depth = depth.map(|depth| (depth, begin));
    frame.render(name, targets, begin, depth, draw);
}

struct Whole {
    stage: Stage,
    technique: Box<dyn ImageOrder>,
    properties: Properties,
}

/// Makes a technique ready for a scene.
pub(crate) fn prepare(
    gpu: &Gpu,
    asked: &Asked,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Box<dyn Technique>, ReflectError> {
    let stage = Stage::new(gpu, asked.common, scene, size)?;
    let technique = asked.recipe.make(gpu, &stage)?;
    Ok(Box::new(Whole {
        stage,
        technique,
        properties: asked.properties(),
    }))
}

impl Technique for Whole {
    fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError> {
        self.stage.world.update(gpu, scene)?;
        self.technique.update(gpu, &self.stage)
    }

    fn begin_frame(&mut self, gpu: &Gpu) -> Result<Built, ReflectError> {
        self.technique.begin_frame(gpu, &self.stage)
    }

    fn record(&self, frame: &mut Recorder<'_>, variant: Variant) {
        self.stage.begin(frame, variant);
        self.technique.record(frame, &self.stage, variant);
        self.stage.finish(frame);
    }

    fn output(&self, gpu: &Gpu) -> Output {
        Output {
            frame: self.stage.layers(gpu, self.technique.paths(gpu).as_deref()),
            may_be_unresolved: self.properties.may_be_unresolved,
            vertices: None,
            searched: 0,
            triangles: None,
            t_junctions: None,
            levels: None,
            work: self.technique.work(gpu, &self.stage),
            notes: self.technique.notes(gpu, &self.stage),
        }
    }

    fn answer(&self, gpu: &Gpu, question: Question) -> Result<Option<Answer>, ReflectError> {
        Ok(self.technique.answer(gpu, &self.stage, question))
    }
}

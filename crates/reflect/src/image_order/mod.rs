//! Image order: for each mirror pixel, what its reflected ray meets. One file a technique, named
//! as its shader: mirror G-buffer → technique → composite.

pub(crate) mod cubemap_trace;
mod cubemaps;
pub(crate) mod environment_map;
mod per_pixel;
pub(crate) mod planar;
pub(crate) mod ray_trace;

use catoptric_frame::{Traced, Work};
use catoptric_scene::Scene;

use crate::error::ReflectError;
use crate::gpu::{Begin, Gpu, Recorder};
use crate::spec::{Options, Spec};
use crate::stage::Stage;
use crate::technique::{Built, DistanceLevel, Output, Technique, Variant};

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

    /// Whether there are rays that the technique can have no answer for.
    fn may_be_unresolved(&self) -> bool {
        false
    }

    /// Pixel by pixel, what the last frame's rays took; `None` where none are followed step by
    /// step.
    fn traced(&self, _: &Gpu, _: &Stage) -> Option<Traced> {
        None
    }

    /// What else the reader of the last frame's numbers should know, in sentences.
    fn notes(&self, _: &Gpu, _: &Stage) -> Vec<String> {
        Vec::new()
    }

    /// See [`Technique::distance_levels`].
    fn distance_levels(&self, _: &Gpu, _: &Stage) -> Option<Vec<DistanceLevel>> {
        None
    }
}

/// Makes a technique by its name.
pub(crate) type Make = fn(&Gpu, &Options, &Stage) -> Result<Box<dyn ImageOrder>, ReflectError>;

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
}

/// Makes a technique ready for a scene.
pub(crate) fn prepare(
    gpu: &Gpu,
    make: Make,
    spec: &Spec,
    scene: &Scene,
    size: [u32; 2],
) -> Result<Box<dyn Technique>, ReflectError> {
    let stage = Stage::new(gpu, &spec.options, scene, size)?;
    let technique = make(gpu, &spec.options, &stage)?;
    Ok(Box::new(Whole { stage, technique }))
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
            frame: self.stage.layers(gpu),
            may_be_unresolved: self.technique.may_be_unresolved(),
            vertices: None,
            searched: 0,
            triangles: None,
            t_junctions: None,
            work: self.technique.work(gpu, &self.stage),
            notes: self.technique.notes(gpu, &self.stage),
            traced: self.technique.traced(gpu, &self.stage),
        }
    }

    fn distance_levels(&self, gpu: &Gpu) -> Option<Vec<DistanceLevel>> {
        self.technique.distance_levels(gpu, &self.stage)
    }
}

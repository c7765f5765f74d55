//! An image-order technique to begin with: each mirror pixel shows the background that its reflected
//! ray would see if nothing stood in its way.

use catoptric_frame::Work;

use super::per_pixel::PerPixel;
use super::{ImageOrder, Recipe};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, group, layout, module};
use crate::options::options;
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct TemplateName {}
}

impl Named for TemplateName {
    const INFO: Info = Info {
        name: "template-name",
        what: "the background, as if there were no objects",
        paper: "this project",
    };
}

impl Recipe for TemplateName {
    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        let module = module(gpu, "template_name", &[])?;
        // What the shader reads beside the stage: nothing yet.
        let own_layout = layout(gpu, "own", &[]);
        Ok(Box::new(Ready {
            own: group(gpu, &own_layout, &[]),
            pass: PerPixel::new(gpu, stage, &module, &own_layout),
        }))
    }
}

/// The technique, ready for a scene.
struct Ready {
    pass: PerPixel,
    /// The shader's group 3, the same for all mirrors.
    own: wgpu::BindGroup,
}

impl ImageOrder for Ready {
    fn update(&mut self, _: &Gpu, _: &Stage) -> Result<(), ReflectError> {
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        let groups = stage.gbuffer.mirror_groups.iter().map(|_| &self.own);
        let targets = stage.reflections.views();
        (self.pass).record(frame, "background", (stage, variant), groups, &targets);
    }

    fn work(&self, _: &Gpu, _: &Stage) -> Work {
        Work::default()
    }
}

#[cfg(test)]
mod tests {
    use crate::parse;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn no_object_is_seen() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        let seen = ["template-name", "environment-map"].map(|technique| {
            let spec = parse(technique).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
            let frame = prepared.render().expect("renders").frame;
            let reflected = frame.reflected.expect("all layers");
            reflected.id.pixels().iter().filter(|id| **id != 0).count()
        });
        assert_eq!(seen[0], 0);
        assert!(seen[1] > 0);
    }
}

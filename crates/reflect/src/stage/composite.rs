//! The picture: objects and background as the eye sees them, reflections on the mirrors.

use crate::error::ReflectError;
use crate::gpu::{
    Begin, DEPTH, FLOAT4, Gpu, RasterTargets, Recorder, Slot, group, layout, module, raster,
    target, view,
};
use crate::stage::gbuffer::GBuffer;
use crate::stage::primary::Primary;
use crate::stage::world::World;

/// Name of the pass.
pub(super) const PASS: &str = "composite";

/// What a technique draws: the reflections, at the mirror's pixels.
pub(crate) struct Reflections {
    /// Linear RGB, 1; all 0 where nothing was drawn, so that the background is reflected.
    pub color: wgpu::Texture,
    /// World-space position and id of the object reflected; all 0 for the background; the id is
    /// −1 where the technique found no answer, −2 where a reflected ray after the first would start
    /// below the surface.
    pub position: wgpu::Texture,
    /// Depth among the reflections; its meaning is the technique's.
    pub depth: wgpu::Texture,
}

impl Reflections {
    pub(crate) fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self {
            color: target(gpu, "reflected color", size, FLOAT4),
            position: target(gpu, "reflected position", size, FLOAT4),
            depth: target(gpu, "reflected depth", size, DEPTH),
        }
    }

    /// Of colour and position, to draw into.
    pub(crate) fn views(&self) -> [wgpu::TextureView; 2] {
        [view(&self.color), view(&self.position)]
    }
}

/// The pass `composite`.
pub(crate) struct Composite {
    /// Linear RGB, 1.
    pub color: wgpu::Texture,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl Composite {
    pub(crate) fn new(
        gpu: &Gpu,
        world: &World,
        primary: &Primary,
        gbuffer: &GBuffer,
        reflections: &Reflections,
    ) -> Result<Self, ReflectError> {
        let layout = layout(gpu, "composite", &[Slot::Texture; 4]);
        let views = [
            &primary.color,
            &gbuffer.position,
            &gbuffer.normal,
            &reflections.color,
        ]
        .map(view);
        let resources: Vec<_> = views
            .iter()
            .map(wgpu::BindingResource::TextureView)
            .collect();
        let targets = RasterTargets {
            colors: 1,
            depth: false,
        };
        let layouts = [Some(&world.view_layout), Some(&layout)];
        let module = module(gpu, "stage/composite", &[])?;
        Ok(Self {
            color: target(gpu, "color", world.size, FLOAT4),
            pipeline: raster(gpu, &module, "color", targets, &layouts, &[]),
            group: group(gpu, &layout, &resources),
        })
    }

    pub(crate) fn record(&self, frame: &mut Recorder<'_>, world: &World) {
        let target = view(&self.color);
        frame.render(PASS, &[&target], Begin::Clear, None, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &world.view_group, &[]);
            pass.set_bind_group(1, &self.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}

#[cfg(test)]
mod tests {
    use catoptric_frame::Status;
    use glam::Vec3;

    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn under_the_reflections_a_mirror_is_what_is_asked_for() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        let frame = |under: &str| {
            let spec = crate::parse(&format!("linear(under={under})")).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [80, 60]).expect("fits");
            prepared.render().expect("a frame").frame
        };
        let [background, dark, solid] = ["background", "dark", "solid"].map(frame);
        let reflected = solid.reflected.as_ref().expect("layers");
        let (mut uncovered, mut covered) = (0, 0);
        for (pixel, status) in reflected.status.pixels().iter().enumerate() {
            if *status != Status::Resolved {
                continue;
            }
            let [of_background, of_dark, of_solid] =
                [&background, &dark, &solid].map(|frame| frame.color.pixels()[pixel]);
            if reflected.id.pixels()[pixel] == 0 {
                uncovered += 1;
                assert_eq!(of_dark, Vec3::ZERO);
                assert_eq!(of_solid, Vec3::splat(of_solid.x));
                assert!((0.1..=0.5).contains(&of_solid.x), "{of_solid}");
                assert_ne!(of_background.x, of_background.z);
            } else {
                covered += 1;
                assert_eq!((of_dark, of_solid), (of_background, of_background));
            }
        }
        assert!(uncovered > 500 && covered > 50, "{uncovered} {covered}");
    }
}

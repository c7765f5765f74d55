//! The picture: objects and background as the eye sees them, reflections on the mirrors.

use crate::error::ReflectError;
use crate::gpu::{
    Begin, DEPTH, FLOAT4, Gpu, RasterTargets, Recorder, Slot, group, layout, module, raster,
    target, view,
};
use crate::stage::gbuffer::GBuffer;
use crate::stage::primary::Primary;
use crate::stage::world::World;

/// What a technique draws: the reflections, at the mirror's pixels.
pub(crate) struct Reflections {
    /// Linear RGB, 1; all 0 where nothing was drawn, so that the background is reflected.
    pub color: wgpu::Texture,
    /// World-space position and id of the object reflected; all 0 for the background; the id is
    /// −1 where the technique found no answer.
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
        frame.render("composite", &[&target], Begin::Clear, None, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &world.view_group, &[]);
            pass.set_bind_group(1, &self.group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}

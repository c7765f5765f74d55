//! Unresolved pixels filled in passes after tracing: from their neighbours, or by the ray tracer.

use crate::ReflectError;
use crate::gpu::Gpu;
use crate::image_order::ray_trace::RayTrace;
use crate::image_order::{ImageOrder, draw_reflections};
use crate::recorder::{Begin, Recorder};
use crate::resources::{FLOAT4, RasterTargets, Slot, group, layout, module, raster, target, view};
use crate::stage::Stage;
use crate::technique::Variant;

/// The pass `fill`, and what it reads; where rays are traced instead it only takes over what is
/// resolved.
pub(crate) struct Fill {
    /// What tracing draws: linear RGB, and 1 for a surface, 0 for the background, −1 unresolved.
    pub color: wgpu::Texture,
    /// As [`crate::composite::Reflections::position`].
    pub position: wgpu::Texture,
    draw_color: wgpu::RenderPipeline,
    draw_layers: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    rays: Option<RayTrace>,
}

impl Fill {
    /// `trace`: by the ray tracer.
    pub(crate) fn new(gpu: &Gpu, stage: &Stage, trace: bool) -> Result<Self, ReflectError> {
        let color = target(gpu, "traced color", stage.world.size, FLOAT4);
        let position = target(gpu, "traced position", stage.world.size, FLOAT4);
        let own_layout = layout(gpu, "fill", &[Slot::Texture; 2]);
        let views = [view(&color), view(&position)];
        let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
        let module = module(gpu, "cubemap_fill", if trace { &["later"] } else { &[] })?;
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            None,
            Some(&own_layout),
        ];
        let pipeline = |entry, colors| {
            let targets = RasterTargets {
                colors,
                depth: false,
            };
            raster(gpu, &module, entry, targets, &layouts, &[])
        };
        Ok(Self {
            draw_color: pipeline("color", 1),
            draw_layers: pipeline("layers", 2),
            group: group(gpu, &own_layout, &resources),
            rays: trace
                .then(|| RayTrace::of_pixels(gpu, stage, &color))
                .transpose()?,
            color,
            position,
        })
    }

    /// Takes over what moved.
    pub(crate) fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.rays
            .as_mut()
            .map_or(Ok(()), |rays| rays.update(gpu, stage))
    }

    pub(crate) fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        let mut begin = Begin::Clear;
        for mirror in &stage.gbuffer.mirror_groups {
            draw_reflections(frame, "fill", stage, variant, begin, None, |pass| {
                pass.set_pipeline(match variant {
                    Variant::AllLayers => &self.draw_layers,
                    Variant::Color => &self.draw_color,
                });
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(3, &self.group, &[]);
                pass.draw(0..3, 0..1);
            });
            begin = Begin::Keep;
        }
        if let Some(rays) = &self.rays {
            rays.record(frame, stage, variant);
        }
    }
}

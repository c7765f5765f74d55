//! Unresolved pixels filled in passes after tracing: from their neighbours, or by the ray tracer.

use crate::error::ReflectError;
use crate::gpu::{FLOAT4, Gpu, Recorder, Slot, group, layout, module, target, view};
use crate::image_order::ImageOrder;
use crate::image_order::per_pixel::PerPixel;
use crate::image_order::ray_trace::Rays;
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// The pass `fill`, and what it reads; where rays are traced instead it only takes over what is
/// resolved.
pub(crate) struct Fill {
    /// What tracing draws: linear RGB, and 1 for a surface, 0 for the background, −1 unresolved.
    pub color: wgpu::Texture,
    /// As [`crate::stage::composite::Reflections::position`].
    pub position: wgpu::Texture,
    pass: PerPixel,
    group: wgpu::BindGroup,
    rays: Option<Rays>,
}

impl Fill {
    /// `trace`: by the ray tracer.
    pub(crate) fn new(gpu: &Gpu, stage: &Stage, trace: bool) -> Result<Self, ReflectError> {
        let color = target(gpu, "traced color", stage.world.size, FLOAT4);
        let position = target(gpu, "traced position", stage.world.size, FLOAT4);
        let own_layout = layout(gpu, "fill", &[Slot::Texture; 2]);
        let views = [view(&color), view(&position)];
        let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
        let module = module(
            gpu,
            "cubemap_trace/fill",
            if trace { &["later"] } else { &[] },
        )?;
        Ok(Self {
            pass: PerPixel::new(gpu, stage, &module, &own_layout),
            group: group(gpu, &own_layout, &resources),
            rays: trace
                .then(|| Rays::of_pixels(gpu, stage, &color))
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
        // The same for all mirrors.
        let groups = std::iter::repeat(&self.group);
        let targets = stage.reflections.views();
        (self.pass).record(frame, "fill", (stage, variant), groups, &targets);
        if let Some(rays) = &self.rays {
            rays.record(frame, stage, variant);
        }
    }
}

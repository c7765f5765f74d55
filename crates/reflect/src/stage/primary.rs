//! The scene without mirrors, as the eye sees it.

use crate::error::ReflectError;
use crate::gpu::{
    Begin, DEPTH, FLOAT4, Gpu, RasterTargets, Recorder, module, raster, target, view,
};
use crate::stage::variant::Variant;
use crate::stage::world::World;

/// Name of the pass.
pub(super) const PASS: &str = "primary";

/// The pass `primary` and its targets.
pub(crate) struct Primary {
    /// Linear RGB, 1; all 0 where there is no object.
    pub color: wgpu::Texture,
    /// World-space position and object id.
    pub position: wgpu::Texture,
    /// Unit geometric normal, turned towards the eye.
    pub normal: wgpu::Texture,
    /// Reversed depth, shared with the mirrors.
    pub depth: wgpu::Texture,
    draw_color: wgpu::RenderPipeline,
    draw_layers: wgpu::RenderPipeline,
}

impl Primary {
    pub(crate) fn new(gpu: &Gpu, world: &World) -> Result<Self, ReflectError> {
        let module = module(gpu, "stage/primary", &[])?;
        let layouts = [Some(&world.view_layout), None, Some(&world.surface_layout)];
        let pipeline = |entry, colors| {
            let targets = RasterTargets {
                colors,
                depth: true,
            };
            raster(gpu, &module, entry, targets, &layouts, &[])
        };
        let image = |label, format| target(gpu, label, world.size, format);
        Ok(Self {
            color: image("primary color", FLOAT4),
            position: image("primary position", FLOAT4),
            normal: image("primary normal", FLOAT4),
            depth: image("depth", DEPTH),
            draw_color: pipeline("color", 1),
            draw_layers: pipeline("layers", 2),
        })
    }

    pub(crate) fn record(&self, frame: &mut Recorder<'_>, world: &World, variant: Variant) {
        let draw = |pipeline| {
            move |pass: &mut wgpu::RenderPass<'_>| {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &world.view_group, &[]);
                pass.set_bind_group(2, &world.surface_group, &[]);
                pass.draw(0..world.corners, 0..1);
            }
        };
        let cleared = Some((&self.depth, Begin::Clear));
        if variant == Variant::AllLayers {
            let layers = [view(&self.position), view(&self.normal)];
            let layers = [&layers[0], &layers[1]];
            let draw = draw(&self.draw_layers);
            frame.render("primary layers", &layers, Begin::Clear, cleared, draw);
        }
        let draw = draw(&self.draw_color);
        frame.render(PASS, &[&view(&self.color)], Begin::Clear, cleared, draw);
    }
}

//! Rasterization of the virtual triangles onto the mirror's visible pixels.

use crate::error::ReflectError;
use crate::gpu::{Begin, Gpu, RasterTargets, Recorder, Slot, layout, module, raster, view};
use crate::stage::Stage;
use crate::stage::options::{Depth, Hidden, SearchOptions, Show};
use crate::stage::variant::Variant;

/// The pass `virtual`.
pub(crate) struct Raster {
    /// Group 3: what `program` reads beside view, mirror and surfaces.
    pub own_layout: wgpu::BindGroupLayout,
    color: wgpu::RenderPipeline,
    layers: wgpu::RenderPipeline,
}

impl Raster {
    /// `program` has the entries `vertex`, `color` and `layers`, knows the features
    /// `virtual_depth`, `extend`, `wireframe`, `levels` and those given, and reads `slots` as group
    /// 3.
    pub(crate) fn new(
        gpu: &Gpu,
        options: SearchOptions,
        stage: &Stage,
        program: &str,
        features: &[&str],
        slots: &[Slot],
    ) -> Result<Self, ReflectError> {
        let of_options = [
            (options.depth == Depth::Virtual, "virtual_depth"),
            (options.hidden == Hidden::Extend, "extend"),
            (options.show == Show::Wireframe, "wireframe"),
            (options.show == Show::Levels, "levels"),
        ];
        let of_options = of_options
            .into_iter()
            .filter_map(|(on, name)| on.then_some(name));
        let features: Vec<_> = of_options.chain(features.iter().copied()).collect();
        let module = module(gpu, program, &features)?;
        let own_layout = layout(gpu, program, slots);
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&stage.world.surface_layout),
            Some(&own_layout),
        ];
        let pipeline = |entry, colors| {
            let targets = RasterTargets {
                colors,
                depth: true,
            };
            raster(gpu, &module, entry, targets, &layouts, &[])
        };
        Ok(Self {
            color: pipeline("color", 1),
            layers: pipeline("layers", 2),
            own_layout,
        })
    }

    /// Records an empty frame of reflections.
    pub(crate) fn record_clear(frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        record(frame, stage, variant, Begin::Clear, |_| {});
    }

    /// Records triangles over the reflections drawn so far; `draw` finds all groups bound.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        own: &wgpu::BindGroup,
        variant: Variant,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        record(frame, stage, variant, Begin::Keep, |pass| {
            pass.set_pipeline(match variant {
                Variant::AllLayers => &self.layers,
                Variant::Color => &self.color,
            });
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, own, &[]);
            draw(pass);
        });
    }
}

fn record(
    frame: &mut Recorder<'_>,
    stage: &Stage,
    variant: Variant,
    begin: Begin,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let reflections = &stage.reflections;
    let targets = [view(&reflections.color), view(&reflections.position)];
    let targets = [&targets[0], &targets[1]];
    let targets = match variant {
        Variant::AllLayers => &targets[..],
        Variant::Color => &targets[..1],
    };
    let depth = Some((&reflections.depth, begin));
    frame.render("virtual", targets, begin, depth, draw);
}

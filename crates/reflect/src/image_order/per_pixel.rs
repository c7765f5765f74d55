//! Full-screen passes: one fragment a pixel, once for each mirror. Their shaders read the view (group
//! 0), the mirror's G-buffer (group 1) and what is the pass's own (group 3).

use crate::gpu::{Begin, Gpu, RasterTargets, Recorder, raster};
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// A pass by one entry point of a shader.
pub(super) struct Pass(wgpu::RenderPipeline);

impl Pass {
    /// `colors`: how many targets the entry point writes; `own_layout`: group 3.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &Stage,
        module: &wgpu::ShaderModule,
        (entry, colors): (&str, usize),
        own_layout: &wgpu::BindGroupLayout,
    ) -> Self {
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            None,
            Some(own_layout),
        ];
        let targets = RasterTargets {
            colors,
            depth: false,
        };
        Self(raster(gpu, module, entry, targets, &layouts, &[]))
    }

    /// Records it for each mirror with the group 3 that stands for it in `groups`; the targets are
    /// cleared before the first.
    pub(super) fn record<'a>(
        &self,
        frame: &mut Recorder<'_>,
        name: &str,
        stage: &Stage,
        groups: impl IntoIterator<Item = &'a wgpu::BindGroup>,
        targets: &[&wgpu::TextureView],
    ) {
        let mut begin = Begin::Clear;
        for (own, mirror) in groups.into_iter().zip(&stage.gbuffer.mirror_groups) {
            frame.render(name, targets, begin, None, |pass| {
                pass.set_pipeline(&self.0);
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(3, own, &[]);
                pass.draw(0..3, 0..1);
            });
            begin = Begin::Keep;
        }
    }
}

/// A pass that draws reflections, by a shader with the entry points `color` and, for all layers,
/// `layers`.
pub(super) struct PerPixel {
    color: Pass,
    layers: Pass,
}

impl PerPixel {
    /// `own_layout`: group 3.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &Stage,
        module: &wgpu::ShaderModule,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Self {
        let pass = |entry| Pass::new(gpu, stage, module, entry, own_layout);
        Self {
            color: pass(("color", 1)),
            layers: pass(("layers", 2)),
        }
    }

    /// As [`Pass::record`], into colour and, with all layers, position.
    pub(super) fn record<'a>(
        &self,
        frame: &mut Recorder<'_>,
        name: &str,
        (stage, variant): (&Stage, Variant),
        groups: impl IntoIterator<Item = &'a wgpu::BindGroup>,
        targets: &[wgpu::TextureView; 2],
    ) {
        let targets = targets.each_ref();
        match variant {
            Variant::AllLayers => self.layers.record(frame, name, stage, groups, &targets),
            Variant::Color => (self.color).record(frame, name, stage, groups, &targets[..1]),
        }
    }
}

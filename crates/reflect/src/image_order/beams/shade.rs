//! The nearest of what the parts of a tile met, and its colour (`beams/shade.wesl`).

use super::lists::Lists;
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, storage_zeros, uniform, view,
};
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// The pass `shade`.
pub(super) struct Shade {
    color: Kernel,
    layers: Kernel,
    /// For all slices but the last: keeps what is nearest so far.
    keep: Kernel,
    /// For the first slice, and for those after it.
    groups: [wgpu::BindGroup; 2],
    slices: usize,
}

impl Shade {
    /// # Errors
    /// Shaders that do not link: a bug. What the device cannot hold it notes itself.
    pub(super) fn new(gpu: &Gpu, stage: &Stage, lists: &Lists) -> Result<Self, ReflectError> {
        use Slot::{Image, Read, Uniform, Write};
        let own_layout = layout(gpu, "shade", &[Image, Image, Read, Read, Write, Uniform]);
        let [width, height] = stage.world.size.map(u64::from);
        let slices = lists.slices();
        let nearest = if slices > 1 { 16 * width * height } else { 0 };
        let nearest = storage_zeros(gpu, nearest);
        let color = view(&stage.reflections.color);
        let position = view(&stage.reflections.position);
        let groups = [0_u32, 1].map(|has_nearest| {
            let has_nearest = uniform(gpu, &has_nearest);
            let resources = [
                wgpu::BindingResource::TextureView(&color),
                wgpu::BindingResource::TextureView(&position),
                lists.parts_of_tiles.as_entire_binding(),
                lists.hits.as_entire_binding(),
                nearest.as_entire_binding(),
                has_nearest.as_entire_binding(),
            ];
            group(gpu, &own_layout, &resources)
        });
        let kernel = |entry: &str, features: &[&str]| -> Result<Kernel, ReflectError> {
            let layouts = [
                Some(&stage.world.view_layout),
                Some(&stage.gbuffer.mirror_layout),
                Some(&stage.world.surface_layout),
                Some(&own_layout),
            ];
            let module = module(gpu, "beams/shade", features)?;
            Ok(compute(gpu, &module, entry, &layouts))
        };
        Ok(Self {
            color: kernel("shade", &[])?,
            layers: kernel("shade", &["layers"])?,
            keep: kernel("keep", &[])?,
            groups,
            slices,
        })
    }

    /// Records the pass `shade`, after the tiles of a slice.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        slice: usize,
        variant: Variant,
    ) {
        let kernel = match variant {
            _ if slice + 1 < self.slices => &self.keep,
            Variant::AllLayers => &self.layers,
            Variant::Color => &self.color,
        };
        frame.compute("shade", |pass| {
            pass.set_pipeline(kernel);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[0], &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, &self.groups[usize::from(slice > 0)], &[]);
            let [x, y] = kernel.groups_over(stage.world.size);
            pass.dispatch_workgroups(x, y, 1);
        });
    }
}

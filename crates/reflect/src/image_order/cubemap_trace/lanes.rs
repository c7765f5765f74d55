//! Rays followed by compute shaders, 32 lanes a ray (Číž 2017, Alg. 3), which the thesis left
//! unfinished. The lanes of a ray agree by a mask, put together by the ballots of subgroups where the
//! adapter has these, else in workgroup memory.

use super::march;
use super::options::{Agreement, CubemapTrace};
use crate::error::ReflectError;
use crate::gpu::{
    Begin, Gpu, Kernel, Recorder, Slot, compute, group, layout, module, storage_zeros, view,
};
use crate::image_order::draw_reflections;
use crate::stage::Stage;
use crate::stage::variant::Variant;

/// The passes `list` and `trace`.
pub(crate) struct Lanes {
    reset: Kernel,
    gather: Kernel,
    trace: Kernel,
    /// Workgroups in x, y, z; number of pixels; the pixels of one mirror.
    list: wgpu::Buffer,
    write_list: wgpu::BindGroup,
    /// Group 2 of tracing: the list, and the images that are written.
    images: wgpu::BindGroup,
    agreement: String,
}

impl Lanes {
    /// `own_layout`: group 3; `effort`: as `march` draws it.
    pub(crate) fn new(
        gpu: &Gpu,
        options: &CubemapTrace,
        stage: &Stage,
        own_layout: &wgpu::BindGroupLayout,
        effort: &wgpu::Texture,
    ) -> Result<Self, ReflectError> {
        let [width, height] = stage.world.size.map(u64::from);
        let list = storage_zeros(gpu, 16 + 4 * width * height);
        let write_layout = layout(gpu, "mirror pixels", &[Slot::Write]);
        let slots = [Slot::Read, Slot::Image, Slot::Image, Slot::Image];
        let images_layout = layout(gpu, "traced images", &slots);
        let reflections = &stage.reflections;
        let views = [&reflections.color, &reflections.position, effort].map(view);
        let mut resources = vec![list.as_entire_binding()];
        resources.extend(views.iter().map(wgpu::BindingResource::TextureView));
        let view_layout = Some(&stage.world.view_layout);
        let mirror_layout = Some(&stage.gbuffer.mirror_layout);
        let pixels = module(gpu, "cubemap_trace/mirror_pixels", &[])?;
        let listing = |entry| {
            let layouts = [view_layout, mirror_layout, Some(&write_layout)];
            compute(gpu, &pixels, entry, &layouts)
        };
        let mut features = march::features(options);
        let ballot = options.agree == Agreement::Ballot;
        let agreement = match gpu.info().subgroups.filter(|_| ballot) {
            Some([least, most]) => {
                features.push("ballot");
                format!(
                    "the lanes of a ray agree by ballots of subgroups of {least} to {most} lanes"
                )
            }
            None => {
                let none = if ballot {
                    ": the adapter has no subgroups"
                } else {
                    ""
                };
                format!("the lanes of a ray agree in workgroup memory{none}")
            }
        };
        let lanes = module(gpu, "cubemap_trace/lanes", &features)?;
        let layouts = [
            view_layout,
            mirror_layout,
            Some(&images_layout),
            Some(own_layout),
        ];
        Ok(Self {
            reset: listing("reset"),
            gather: listing("gather"),
            trace: compute(gpu, &lanes, "trace_rays", &layouts),
            write_list: group(gpu, &write_layout, &[list.as_entire_binding()]),
            images: group(gpu, &images_layout, &resources),
            list,
            agreement,
        })
    }

    /// How the lanes of a ray come to one mask, in a sentence.
    pub(crate) fn agreement(&self) -> &str {
        &self.agreement
    }

    /// Traces into the stage's reflections and into `effort`; `groups` are those of the mirrors'
    /// maps.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        variant: Variant,
        groups: &[&wgpu::BindGroup],
        effort: &wgpu::TextureView,
    ) {
        draw_reflections(frame, "clear", stage, variant, Begin::Clear, None, |_| {});
        frame.render("clear", &[effort], Begin::Clear, None, |_| {});
        let [width, height] = self.gather.groups_over(stage.world.size);
        for (own, mirror) in groups.iter().zip(&stage.gbuffer.mirror_groups) {
            frame.compute("list", |pass| {
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &self.write_list, &[]);
                pass.set_pipeline(&self.reset);
                pass.dispatch_workgroups(1, 1, 1);
                pass.set_pipeline(&self.gather);
                pass.dispatch_workgroups(width, height, 1);
            });
            frame.compute("trace", |pass| {
                pass.set_pipeline(&self.trace);
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &self.images, &[]);
                pass.set_bind_group(3, *own, &[]);
                pass.dispatch_workgroups_indirect(&self.list, 0);
            });
        }
    }
}

//! The triangles in the order of their clusters, their boxes and those of the clusters, where they are
//! in this frame (`beams/refit.wesl`).

use super::clusters::{self, CLUSTER, clusters, without_coincident};
use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, dispatch_size, group, layout, module,
    storage_bytes, target, uniform, view,
};
use crate::stage::Stage;

/// Clusters in a row of texels. Twin of `ROW` in `beams/triangles.wesl`.
const ROW: u32 = 64;

/// Texels of a triangle, and of a box.
const CORNERS: u32 = 3;
const BOX: u32 = 2;

/// Triangles and boxes, and the pass that puts them where they are.
pub(super) struct Geometry {
    /// Triangles, those that lie on another one of their object left out.
    pub(super) triangles: u32,
    pub(super) corners: wgpu::Texture,
    pub(super) boxes: wgpu::Texture,
    pub(super) cluster_boxes: wgpu::Texture,
    /// Where triangles of several objects coincide: they may do so no more once these move.
    coinciding: Option<Vec<clusters::Slot>>,
    slots: wgpu::Buffer,
    place: Kernel,
    placed: wgpu::BindGroup,
    bound: Kernel,
    bounded: wgpu::BindGroup,
}

impl Geometry {
    /// # Errors
    /// More triangles than the device's textures hold.
    pub(super) fn new(gpu: &Gpu, stage: &Stage) -> Result<Self, ReflectError> {
        let all = clusters(&stage.world.scene);
        let seen = without_coincident(&stage.world.scene, &all);
        let triangles = all.len() as u32;
        let rows = triangles.div_ceil(CLUSTER as u32 * ROW).max(1);
        let corners = [CORNERS * CLUSTER as u32 * ROW, rows];
        let corners = target(gpu, "triangles", corners, FLOAT4);
        let boxes = [BOX * CLUSTER as u32 * ROW, rows];
        let boxes = target(gpu, "boxes of triangles", boxes, FLOAT4);
        let cluster_boxes = target(gpu, "boxes of clusters", [BOX * ROW, rows], FLOAT4);
        let slots = storage_bytes(gpu, bytemuck::cast_slice(seen.as_ref().unwrap_or(&all)));
        gpu.check()?;
        let count = uniform(gpu, &triangles);
        let module = module(gpu, "beams/refit", &[])?;
        let place_slots = [
            Slot::Read,
            Slot::Read,
            Slot::Uniform,
            Slot::Image,
            Slot::Image,
        ];
        let place_layout = layout(gpu, "triangles placed", &place_slots);
        let bound_slots = [Slot::Texture, Slot::Uniform, Slot::Image];
        let bound_layout = layout(gpu, "clusters bounded", &bound_slots);
        let placed = group(
            gpu,
            &place_layout,
            &[
                stage.world.positions.as_entire_binding(),
                slots.as_entire_binding(),
                count.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&corners)),
                wgpu::BindingResource::TextureView(&view(&boxes)),
            ],
        );
        let bounded = group(
            gpu,
            &bound_layout,
            &[
                wgpu::BindingResource::TextureView(&view(&boxes)),
                count.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&cluster_boxes)),
            ],
        );
        Ok(Self {
            triangles,
            corners,
            boxes,
            cluster_boxes,
            coinciding: seen.map(|_| all),
            slots,
            place: compute(gpu, &module, "triangles", &[Some(&place_layout)]),
            placed,
            bound: compute(gpu, &module, "clusters", &[None, Some(&bound_layout)]),
            bounded,
        })
    }

    /// Takes over which triangles coincide now, of those that did once.
    pub(super) fn update(&self, gpu: &Gpu, stage: &Stage) {
        if let Some(all) = &self.coinciding {
            let seen = without_coincident(&stage.world.scene, all);
            let slots = bytemuck::cast_slice(seen.as_ref().unwrap_or(all));
            gpu.queue.write_buffer(&self.slots, 0, slots);
        }
    }

    /// How many clusters there are.
    pub(super) fn clusters(&self) -> u32 {
        self.triangles.div_ceil(CLUSTER as u32)
    }

    /// Records the pass `refit`.
    pub(super) fn record(&self, frame: &mut Recorder<'_>) {
        frame.compute("refit", |pass| {
            pass.set_pipeline(&self.place);
            pass.set_bind_group(0, &self.placed, &[]);
            let [x, y] = dispatch_size(self.place.groups(self.triangles));
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.bound);
            pass.set_bind_group(1, &self.bounded, &[]);
            let [x, y] = dispatch_size(self.bound.groups(self.clusters()));
            pass.dispatch_workgroups(x, y, 1);
        });
    }
}

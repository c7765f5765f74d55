//! The triangles in the order of their clusters, their boxes and those of the clusters, where they are
//! in this frame (`beams/refit.wesl`).

use encase::ShaderType;

use super::clusters::{CLUSTER, clusters};
use super::mirrors::Mirrors;
use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, dispatch_size, group, layout, module,
    storage_bytes, target, uniform, view,
};
use crate::image_order::coincident::{self, without_coincident};
use crate::stage::Stage;

/// Clusters in a row of texels. Twin of `ROW` in `beams/triangles.wesl`.
const ROW: u32 = 64;

/// Texels of a triangle, and of a box.
const CORNERS: u32 = 3;
const BOX: u32 = 2;

/// Twin of `Placing` in `beams/refit.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Placing {
    pub count: u32,
    pub mirror_triangles: u32,
    pub stride: u32,
    pub first: u32,
}

/// Where vertices lie in a buffer: numbers from one to the next, and before the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strided {
    pub(super) stride: u32,
    pub(super) first: u32,
}

/// Triangles and boxes, and the pass that puts them where they are.
pub(super) struct Geometry {
    /// Triangles, those that lie on another one of their object left out.
    pub(super) triangles: u32,
    /// Those of mirrors among them.
    pub(super) mirror_triangles: u32,
    pub(super) corners: wgpu::Texture,
    pub(super) boxes: wgpu::Texture,
    pub(super) cluster_boxes: wgpu::Texture,
    /// Where triangles of several objects coincide: they may do so no more once these move.
    coinciding: Option<Vec<coincident::Slot>>,
    slots: wgpu::Buffer,
    place: Kernel,
    placed: wgpu::BindGroup,
    bound: Kernel,
    bounded: wgpu::BindGroup,
}

impl Geometry {
    /// All objects' triangles, and those of the mirrors that rays meet as triangles.
    ///
    /// # Errors
    /// More triangles than the device's textures hold.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &Stage,
        mirrors: Option<&Mirrors>,
    ) -> Result<Self, ReflectError> {
        let of_mirrors = mirrors.map_or(&[][..], |mirrors| &mirrors.triangles);
        let all = clusters(&stage.world.scene, of_mirrors);
        let seen = without_coincident(&stage.world.scene, &all, of_mirrors.len() as u32);
        let slots = seen.as_ref().unwrap_or(&all);
        let mirrors = mirrors.map(|mirrors| (&mirrors.corners, of_mirrors.len() as u32));
        let geometry = Self::of_slots(gpu, slots, &stage.world.positions, None, mirrors)?;
        Ok(Self {
            coinciding: seen.map(|_| all),
            ..geometry
        })
    }

    /// Triangles in the order of their clusters, by a buffer of positions: `vec4f` each, or as `strided`
    /// says. `mirrors`: the corners of so many triangles that come before those of the objects.
    ///
    /// # Errors
    /// More triangles than the device's textures hold.
    pub(super) fn of_slots(
        gpu: &Gpu,
        slots: &[coincident::Slot],
        positions: &wgpu::Buffer,
        strided: Option<Strided>,
        mirrors: Option<(&wgpu::Buffer, u32)>,
    ) -> Result<Self, ReflectError> {
        let triangles = slots.len() as u32;
        let mirror_triangles = mirrors.map_or(0, |(_, count)| count);
        let rows = triangles.div_ceil(CLUSTER as u32 * ROW).max(1);
        let corners = [CORNERS * CLUSTER as u32 * ROW, rows];
        let corners = target(gpu, "triangles", corners, FLOAT4);
        let boxes = [BOX * CLUSTER as u32 * ROW, rows];
        let boxes = target(gpu, "boxes of triangles", boxes, FLOAT4);
        let cluster_boxes = target(gpu, "boxes of clusters", [BOX * ROW, rows], FLOAT4);
        let slots = storage_bytes(gpu, bytemuck::cast_slice(slots));
        gpu.check()?;
        let placing = uniform(
            gpu,
            &Placing {
                count: triangles,
                mirror_triangles,
                stride: strided.map_or(0, |strided| strided.stride),
                first: strided.map_or(0, |strided| strided.first),
            },
        );
        let features = [
            strided.map(|_| "strided"),
            (mirror_triangles > 0).then_some("mirrors"),
        ];
        let features: Vec<_> = features.into_iter().flatten().collect();
        let module = module(gpu, "beams/refit", &features)?;
        let place_slots = [
            Slot::Read,
            Slot::Read,
            Slot::Uniform,
            Slot::Image,
            Slot::Image,
            Slot::Read,
        ];
        let nothing = storage_bytes(gpu, &[]);
        let mirror_corners = mirrors.map_or(&nothing, |(corners, _)| corners);
        let place_layout = layout(gpu, "triangles placed", &place_slots);
        let bound_slots = [Slot::Texture, Slot::Uniform, Slot::Image];
        let bound_layout = layout(gpu, "clusters bounded", &bound_slots);
        let placed = group(
            gpu,
            &place_layout,
            &[
                positions.as_entire_binding(),
                slots.as_entire_binding(),
                placing.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&corners)),
                wgpu::BindingResource::TextureView(&view(&boxes)),
                mirror_corners.as_entire_binding(),
            ],
        );
        let bounded = group(
            gpu,
            &bound_layout,
            &[
                wgpu::BindingResource::TextureView(&view(&boxes)),
                placing.as_entire_binding(),
                wgpu::BindingResource::TextureView(&view(&cluster_boxes)),
            ],
        );
        Ok(Self {
            triangles,
            mirror_triangles,
            corners,
            boxes,
            cluster_boxes,
            coinciding: None,
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
            let seen = without_coincident(&stage.world.scene, all, self.mirror_triangles);
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

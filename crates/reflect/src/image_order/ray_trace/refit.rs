//! A hierarchy whose boxes are fitted anew in every frame, on the GPU, around where the triangles are: its
//! topology stays that of the scene it was built for (`ray_trace/refit.wesl`).
//!
//! That is what an engine does for what moves: it is cheap, and as good as a new hierarchy while neighbours
//! stay neighbours. Boxes of triangles that move apart grow, and rays visit more of them.

use encase::ShaderType;

use catoptric_scene::Scene;
use glam::Vec3;

use super::wide::{Folded, GROWTH};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, dispatch_size, group, layout, module, set_uniform,
    storage_bytes, storage_zeros, uniform,
};
use crate::image_order::coincident::{self, without_coincident};
use crate::stage::Stage;

/// Twin of `Level` in `ray_trace/refit.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Level {
    first: u32,
    count: u32,
    growth: f32,
}

/// Bytes of a node's bounds, and of a triangle.
const BOUNDS: u64 = 32;
const TRIANGLE: u64 = 48;

/// A level of the hierarchy.
struct Fitted {
    first: u32,
    count: u32,
    settings: wgpu::Buffer,
    group: wgpu::BindGroup,
}

/// The hierarchy, and the pass that fits it.
pub(super) struct Refitted {
    pub(super) nodes: wgpu::Buffer,
    pub(super) triangles: wgpu::Buffer,
    count: u32,
    /// In the hierarchy's order: where triangles of several objects coincide, all but the first are
    /// points; in the order in which it was built.
    all: Vec<coincident::Slot>,
    slots: wgpu::Buffer,
    place: Kernel,
    fit: Kernel,
    group: wgpu::BindGroup,
    /// The deepest first.
    levels: Vec<Fitted>,
}

impl Refitted {
    /// Builds the hierarchy of all objects' triangles, those of one object that coincide once.
    ///
    /// # Errors
    /// Shaders that do not link: a bug. What the device cannot hold it notes itself.
    pub(super) fn new(gpu: &Gpu, stage: &Stage) -> Result<Self, ReflectError> {
        let scene = &stage.world.scene;
        let slots = coincident::slots(scene, 0);
        let positions = coincident::positions(scene);
        let corners = slots
            .iter()
            .map(|[a, b, c, _]| [a, b, c].map(|vertex| positions[*vertex as usize]));
        let folded = Folded::new(&corners.collect::<Vec<_>>());
        let all: Vec<_> = (folded.order.iter())
            .map(|place| slots[*place as usize])
            .collect();
        let seen = without_coincident(scene, &all, 0);
        let count = all.len() as u32;
        let levels = folded.levels();
        let order: Vec<u32> = levels.iter().rev().flatten().copied().collect();

        use Slot::{Read, Uniform, Write};
        let own_layout = layout(gpu, "refit", &[Read, Read, Write, Write, Write, Read]);
        let level_layout = layout(gpu, "level", &[Uniform]);
        let nodes = storage_bytes(gpu, bytemuck::cast_slice(&folded.nodes));
        let triangles = storage_zeros(gpu, TRIANGLE * u64::from(count.max(1)));
        let slots = storage_bytes(gpu, bytemuck::cast_slice(seen.as_ref().unwrap_or(&all)));
        let bounds = storage_zeros(gpu, BOUNDS * order.len() as u64);
        let order = storage_bytes(gpu, bytemuck::cast_slice(&order));
        gpu.check()?;
        let buffers = [
            &stage.world.positions,
            &slots,
            &triangles,
            &nodes,
            &bounds,
            &order,
        ];
        let module = module(gpu, "ray_trace/refit", &[])?;
        let layouts = [Some(&own_layout), Some(&level_layout)];
        let mut first = 0;
        let fitted = levels.iter().rev().map(|level| {
            let values = Level {
                first,
                count: level.len() as u32,
                growth: growth(scene),
            };
            first += values.count;
            let settings = uniform(gpu, &values);
            Fitted {
                first: values.first,
                count: values.count,
                group: group(gpu, &level_layout, &[settings.as_entire_binding()]),
                settings,
            }
        });
        Ok(Self {
            levels: fitted.collect(),
            group: group(
                gpu,
                &own_layout,
                &buffers.map(wgpu::Buffer::as_entire_binding),
            ),
            place: compute(gpu, &module, "place", &layouts[..1]),
            fit: compute(gpu, &module, "fit", &layouts),
            nodes,
            triangles,
            count,
            all,
            slots,
        })
    }

    /// Takes over which triangles coincide now, and how large the scene is.
    pub(super) fn update(&self, gpu: &Gpu, scene: &Scene) {
        let seen = without_coincident(scene, &self.all, 0);
        let slots = bytemuck::cast_slice(seen.as_ref().unwrap_or(&self.all));
        if !slots.is_empty() {
            gpu.queue.write_buffer(&self.slots, 0, slots);
        }
        let growth = growth(scene);
        for level in &self.levels {
            let (first, count) = (level.first, level.count);
            let values = Level {
                first,
                count,
                growth,
            };
            set_uniform(gpu, &level.settings, &values);
        }
    }

    /// Records the pass `refit`.
    pub(super) fn record(&self, frame: &mut Recorder<'_>) {
        if self.count == 0 {
            return;
        }
        frame.compute("refit", |pass| {
            pass.set_bind_group(0, &self.group, &[]);
            pass.set_pipeline(&self.place);
            let [x, y] = dispatch_size(self.place.groups(self.count));
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.fit);
            for level in &self.levels {
                pass.set_bind_group(1, &level.group, &[]);
                let [x, y] = dispatch_size(self.fit.groups(level.count));
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}

/// By how much boxes grow, world units.
fn growth(scene: &Scene) -> f32 {
    let nothing = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let [low, high] = (coincident::positions(scene).into_iter())
        .fold(nothing, |[low, high], position| {
            [low.min(position), high.max(position)]
        });
    let diagonal = (high - low).length();
    (GROWTH * if diagonal.is_finite() { diagonal } else { 0.0 }).max(f32::MIN_POSITIVE)
}

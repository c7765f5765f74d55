//! Buffers of the tessellation loop; each holds what one chunk needs.

use encase::ShaderSize;

use super::plan::Plan;
use super::records::{Level, Piece, Totals};
use crate::gpu::{Gpu, Kernel, storage_bytes, storage_zeros};

/// Distance between the [`Level`] records, bytes: where every device lets a binding begin.
pub(super) const LEVEL_STRIDE: u64 = 256;
/// Where `draw` lies in a [`Level`], bytes.
pub(super) const DRAW: u64 = 16;

/// What the kernels read and write.
pub(super) struct Buffers {
    /// Triangles being worked on: levels take turns.
    pub working: [wgpu::Buffer; 2],
    /// Finished triangles; those of the last level go there at once.
    pub finished: wgpu::Buffer,
    /// A [`Level`] a level, [`LEVEL_STRIDE`] apart.
    pub levels: wgpu::Buffer,
    /// A [`Totals`].
    pub totals: wgpu::Buffer,
    /// Of each triangle worked on: its place among its workgroup's.
    pub ranks: wgpu::Buffer,
    /// Of each workgroup: how many it finishes and splits, then those before it.
    pub sums: wgpu::Buffer,
    /// World-space positions of the new points.
    pub positions: wgpu::Buffer,
    /// Which new points are to be searched.
    pub range: wgpu::Buffer,
    /// How many workgroups search them.
    pub dispatch: wgpu::Buffer,
    /// Steps, evaluations and node tests of all new points, 64 bits each.
    pub effort_sums: wgpu::Buffer,
    splits: bool,
}

impl Buffers {
    /// `level`: how often a triangle may be split; `classify`: the kernel that leaves a sum a workgroup.
    pub(super) fn new(gpu: &Gpu, level: u32, plan: Plan, classify: &Kernel) -> Self {
        let last = level.saturating_sub(1);
        let worked_on = if level == 0 { 0 } else { plan.at(last) };
        let before = plan.at(last.saturating_sub(1));
        let working = if level.is_multiple_of(2) {
            [before, worked_on]
        } else {
            [worked_on, before]
        };
        Self {
            working: working.map(|count| records::<Piece>(gpu, count)),
            finished: records::<Piece>(gpu, plan.at(level)),
            levels: storage_zeros(gpu, LEVEL_STRIDE * u64::from(level + 1)),
            totals: storage_zeros(gpu, Totals::SHADER_SIZE.get()),
            ranks: records::<u32>(gpu, worked_on),
            sums: records::<u32>(gpu, classify.groups(worked_on)),
            positions: storage_zeros(gpu, u64::from(plan.points()) * 16),
            range: storage_bytes(gpu, &[0; 16]),
            dispatch: storage_zeros(gpu, 12),
            effort_sums: storage_zeros(gpu, 24),
            splits: level > 0,
        }
    }

    /// The triangles that a level works on; nothing is worked on where nothing may be split.
    pub(super) fn worked_on(&self, level: u32) -> &wgpu::Buffer {
        match self.splits {
            true => &self.working[level as usize % 2],
            false => &self.finished,
        }
    }

    /// The [`Level`] of a level.
    pub(super) fn level(&self, index: u32) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.levels,
            offset: LEVEL_STRIDE * u64::from(index),
            size: Some(Level::SHADER_SIZE),
        })
    }
}

fn records<T: ShaderSize>(gpu: &Gpu, count: u32) -> wgpu::Buffer {
    storage_zeros(gpu, u64::from(count) * T::SHADER_SIZE.get())
}

//! The passes that settle, in a frame, which cells serve and which points are searched:
//! `grid/settle.wesl`.

use encase::{ShaderSize, ShaderType};
use glam::UVec3;

use super::forest::Forest;
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, dispatch_size, group, layout, module, storage,
    storage_zeros, uniform,
};
use crate::refine::Context;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::{Dispatch, Efforts, Points, read};
use crate::stage::variant::Variant;

/// Twin of `Level` in `grid/settle.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Level {
    first: u32,
    count: u32,
    vertices: u32,
    error: f32,
}

/// Twin of `Tally` in `grid/settle.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Tally {
    groups: UVec3,
    closed: u32,
    listed: u32,
}

/// Kernels and what they read of the cells, for all mirrors.
pub(super) struct Settling {
    begin: Kernel,
    ask: Kernel,
    close: Kernel,
    settle: Kernel,
    layout: wgpu::BindGroupLayout,
    order: wgpu::Buffer,
    /// A [`Level`] each, with its number of cells.
    levels: Vec<(wgpu::Buffer, u32)>,
    cells: u32,
    records: u32,
    points: u32,
}

/// What a sheet's frame has settled.
pub(super) struct Settled {
    /// What became of each cell.
    pub states: wgpu::Buffer,
    /// Records that were searched, each once.
    list: wgpu::Buffer,
    tally: wgpu::Buffer,
    /// One a level.
    groups: Vec<wgpu::BindGroup>,
}

impl Settling {
    /// `error`: largest miss of a centre's image, in pixels.
    pub(super) fn new(
        context: &Context<'_>,
        forest: &Forest,
        error: f32,
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let (read, write) = (Slot::Read, Slot::Write);
        let slots = [
            Slot::Uniform,
            read,
            read,
            read,
            write,
            write,
            write,
            write,
            write,
        ];
        let layout = layout(gpu, "grid/settle", &slots);
        let features = context.continued.then_some("continued");
        let module = module(gpu, "grid/settle", features.as_slice())?;
        let layouts = [Some(&stage.world.view_layout), Some(&layout)];
        let kernel = |entry| compute(gpu, &module, entry, &layouts);
        let levels = forest.levels.iter().map(|cells| {
            let level = Level {
                first: cells.start,
                count: cells.end - cells.start,
                vertices: forest.vertices.len() as u32,
                error,
            };
            (uniform(gpu, &level), level.count)
        });
        Ok(Self {
            begin: kernel("begin"),
            ask: kernel("ask"),
            close: kernel("close"),
            settle: kernel("settle"),
            order: storage(gpu, &forest.order),
            levels: levels.collect(),
            cells: forest.cells.len() as u32,
            records: forest.records(),
            points: forest.points.len() as u32,
            layout,
        })
    }

    /// A sheet's batch of all records, and what settles which of them are searched. `cells`: of [`super::forest::Cell`].
    pub(super) fn on_sheet(
        &self,
        gpu: &Gpu,
        points_layout: &wgpu::BindGroupLayout,
        positions: &wgpu::Buffer,
        cells: &wgpu::Buffer,
    ) -> (Points, Settled) {
        let words = |count: u32| storage_zeros(gpu, 4 * u64::from(count));
        let (states, asked) = (words(self.cells), words(self.points));
        let list = words(self.records);
        let tally = storage_zeros(gpu, Tally::SHADER_SIZE.get());
        let dispatch = Dispatch::Indirect(tally.clone(), 0);
        let (layout, records) = (points_layout, self.records);
        let points = Points::listed(gpu, layout, positions, records, &list, dispatch);
        let groups = self.levels.iter().map(|(level, _)| {
            let buffers = [
                level,
                cells,
                &self.order,
                &points.found,
                &states,
                &asked,
                &tally,
                &list,
                &points.range,
            ];
            let resources = buffers.map(wgpu::Buffer::as_entire_binding);
            group(gpu, &self.layout, &resources)
        });
        let settled = Settled {
            groups: groups.collect(),
            states,
            list,
            tally,
        };
        (points, settled)
    }

    /// Records searches on one sheet until all cells are settled.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        (sheet, points, settled): (Sheet, &Points, &Settled),
        variant: Variant,
    ) {
        let view = &stage.world.view_group;
        for (index, ((_, count), own)) in self.levels.iter().zip(&settled.groups).enumerate() {
            frame.compute("refine", |pass| {
                pass.set_bind_group(0, view, &[]);
                pass.set_bind_group(1, own, &[]);
                if index == 0 {
                    run(pass, &self.begin, self.cells.max(self.points));
                }
                run(pass, &self.ask, *count);
                run(pass, &self.close, 1);
            });
            search.record_search(frame, stage, sheet, points, variant);
            if index + 1 < self.levels.len() {
                frame.compute("refine", |pass| {
                    pass.set_bind_group(0, view, &[]);
                    pass.set_bind_group(1, own, &[]);
                    run(pass, &self.settle, *count);
                });
            }
        }
    }
}

/// Dispatches one thread for each of `count`.
fn run(pass: &mut wgpu::ComputePass<'_>, kernel: &Kernel, count: u32) {
    let [x, y] = dispatch_size(kernel.groups(count));
    pass.set_pipeline(kernel);
    pass.dispatch_workgroups(x, y, 1);
}

impl Settled {
    /// Records that the last frame searched.
    pub(super) fn searched(&self, gpu: &Gpu) -> Vec<u32> {
        let tally: Vec<Tally> = read(gpu, &self.tally, 1);
        read(gpu, &self.list, tally[0].closed)
    }

    /// What these searches took.
    pub(super) fn efforts(&self, gpu: &Gpu, points: &Points, records: u32) -> Efforts {
        let efforts = points.read_efforts(gpu, records);
        let mut total = Efforts::default();
        for record in self.searched(gpu) {
            total.add(efforts[record as usize].into());
        }
        total
    }
}

#[cfg(test)]
mod tests {
    use super::super::forest::Cell;
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn records_lie_as_the_shaders_read_them() {
        assert_layout!(
            Cell {
                offset,
                parent,
                scale,
                center,
                corners,
                first,
                count,
                leaf
            },
            "grid/settle",
            &[],
            "Cell"
        );
        assert_layout!(
            Level {
                first,
                count,
                vertices,
                error
            },
            "grid/settle",
            &[],
            "Level"
        );
        assert_layout!(
            Tally {
                groups,
                closed,
                listed
            },
            "grid/settle",
            &[],
            "Tally"
        );
    }
}

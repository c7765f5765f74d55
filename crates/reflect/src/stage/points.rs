//! A batch of points for a search to find reflections of, and the answers.

use catoptric_frame::{VertexResult, VertexState, Work};
use encase::internal::CreateFrom;
use encase::{ShaderSize, ShaderType, StorageBuffer};
use glam::{Vec2, Vec3};

use crate::gpu::{
    Gpu, Kernel, Slot, dispatch_size, group, layout, set_storage, storage_bytes, storage_zeros,
};

/// Twin of `Range` in `shared/points.wesl`: which points of a batch are searched.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Range {
    pub first: u32,
    pub count: u32,
    pub warm: u32,
    /// 1: `first` and `count` are entries of a list of points, not points.
    pub listed: u32,
}

/// Twin of `Effort` in `shared/points.wesl`: what the search of one point took.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Effort {
    pub steps: u32,
    pub evaluations: u32,
    pub node_tests: u32,
    pub flags: u32,
}

impl Effort {
    /// `flags`: the hierarchy left a gap here.
    pub const MET_HOLE: u32 = 1;
    /// `flags`: the enlargement repair was used.
    pub const ENLARGED: u32 = 2;
    /// `flags`: the search failed and its answer is a stand-in.
    pub const STAND_IN: u32 = 4;
}

/// Twin of `Found` in `shared/points.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Found {
    pub position: Vec3,
    pub state: u32,
    pub at: Vec2,
    pub distance: f32,
    pub image: Vec3,
}

impl Found {
    /// `state`: the point has this reflection point.
    pub const FOUND: u32 = 0;
    /// `state`: behind the mirror's tangent plane at the point found.
    pub const HIDDEN: u32 = 1;
    /// `state`: the search has no answer.
    pub const FAILED: u32 = 2;
    /// `state`: reflected beyond the rim of an open mirror.
    pub const UNREFLECTED: u32 = 3;
}

/// How many workgroups a search of a batch takes.
#[derive(Clone, Debug)]
pub(crate) enum Dispatch {
    /// As many as so many points take, one thread each.
    Direct(u32),
    /// Written by an earlier pass: three `u32` at this offset.
    Indirect(wgpu::Buffer, u64),
}

/// Group 2 of every search: `points`, `found`, `range`, `efforts`, `list`. One record a point.
pub(crate) struct Points {
    /// [`Found`] records.
    pub found: wgpu::Buffer,
    /// One [`Range`]: which points are searched.
    pub range: wgpu::Buffer,
    /// [`Effort`] records, written when work is counted.
    pub efforts: wgpu::Buffer,
    /// For `range`.
    pub dispatch: Dispatch,
    pub group: wgpu::BindGroup,
}

/// The layout of [`Points::group`].
pub(crate) fn points_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let slots = [Slot::Read, Slot::Write, Slot::Read, Slot::Write, Slot::Read];
    layout(gpu, "points", &slots)
}

impl Points {
    /// A batch that searches all of `count` positions.
    pub(crate) fn new(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        positions: &wgpu::Buffer,
        count: u32,
    ) -> Self {
        let range = storage_bytes(gpu, &[0; 16]);
        let all = Range {
            first: 0,
            count,
            warm: 0,
            listed: 0,
        };
        set_storage(gpu, &range, &all);
        let dispatch = Dispatch::Direct(count);
        Self::with_range(gpu, layout, positions, count, range, dispatch)
    }

    /// A batch of `count` positions, of which those in a list are searched that `range` says: what writes
    /// the list, the range and the dispatch runs before. What was never searched for counts as not found.
    pub(crate) fn listed(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        positions: &wgpu::Buffer,
        count: u32,
        list: &wgpu::Buffer,
        dispatch: Dispatch,
    ) -> Self {
        let range = storage_bytes(gpu, &[0; 16]);
        let listed = Range {
            first: 0,
            count: 0,
            warm: 0,
            listed: 1,
        };
        set_storage(gpu, &range, &listed);
        let made = Self::with_list(gpu, layout, positions, count, range, dispatch, list);
        let nowhere = Found {
            position: Vec3::ZERO,
            state: Found::FAILED,
            at: Vec2::ZERO,
            distance: 0.0,
            image: Vec3::ZERO,
        };
        if count > 0 {
            set_storage(gpu, &made.found, &vec![nowhere; count as usize]);
        }
        made
    }

    /// A batch of at most `capacity` positions, of which `range` says which are searched.
    pub(crate) fn with_range(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        positions: &wgpu::Buffer,
        capacity: u32,
        range: wgpu::Buffer,
        dispatch: Dispatch,
    ) -> Self {
        let list = storage_zeros(gpu, 4);
        Self::with_list(gpu, layout, positions, capacity, range, dispatch, &list)
    }

    fn with_list(
        gpu: &Gpu,
        layout: &wgpu::BindGroupLayout,
        positions: &wgpu::Buffer,
        capacity: u32,
        range: wgpu::Buffer,
        dispatch: Dispatch,
        list: &wgpu::Buffer,
    ) -> Self {
        let records =
            |size: std::num::NonZeroU64| storage_zeros(gpu, u64::from(capacity) * size.get());
        let found = records(Found::SHADER_SIZE);
        let efforts = records(Effort::SHADER_SIZE);
        let resources = [positions, &found, &range, &efforts, list];
        let resources = resources.map(wgpu::Buffer::as_entire_binding);
        Self {
            group: group(gpu, layout, &resources),
            found,
            range,
            efforts,
            dispatch,
        }
    }

    /// Tells the search whether `found` holds the previous frame's answers, and that all of `count`
    /// points are searched.
    pub(crate) fn set_warm(&self, gpu: &Gpu, count: u32, warm: bool) {
        let range = Range {
            first: 0,
            count,
            warm: u32::from(warm),
            listed: 0,
        };
        set_storage(gpu, &self.range, &range);
    }

    /// Tells the search of a list whether `found` holds the previous frame's answers.
    pub(crate) fn set_list_warm(&self, gpu: &Gpu, warm: bool) {
        let range = Range {
            first: 0,
            count: 0,
            warm: u32::from(warm),
            listed: 1,
        };
        set_storage(gpu, &self.range, &range);
    }

    /// Dispatches one thread of `kernel` for each point of the range.
    pub(crate) fn run(&self, pass: &mut wgpu::ComputePass<'_>, kernel: &Kernel) {
        match &self.dispatch {
            Dispatch::Direct(count) => {
                let [x, y] = dispatch_size(kernel.groups(*count));
                pass.dispatch_workgroups(x, y, 1);
            }
            Dispatch::Indirect(buffer, offset) => {
                pass.dispatch_workgroups_indirect(buffer, *offset);
            }
        }
    }
}

/// Totals of what searches took.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Efforts {
    /// Points searched for.
    pub searched: u64,
    pub steps: u64,
    pub evaluations: u64,
    pub node_tests: u64,
}

impl From<Effort> for Efforts {
    fn from(effort: Effort) -> Self {
        Self {
            searched: 1,
            steps: effort.steps.into(),
            evaluations: effort.evaluations.into(),
            node_tests: effort.node_tests.into(),
        }
    }
}

impl Efforts {
    pub(crate) fn add(&mut self, other: Self) {
        self.searched += other.searched;
        self.steps += other.steps;
        self.evaluations += other.evaluations;
        self.node_tests += other.node_tests;
    }

    /// Means per point searched for; node tests only where the search goes through a hierarchy, known to
    /// or seen by its tests.
    pub(crate) fn mean(&self, hierarchy: bool) -> Work {
        let mean = |total: u64| (self.searched > 0).then(|| total as f64 / self.searched as f64);
        Work {
            steps: mean(self.steps),
            evaluations: mean(self.evaluations),
            node_tests: mean(self.node_tests).filter(|mean| hierarchy || *mean > 0.0),
            ..Work::default()
        }
    }
}

impl Points {
    /// The first `count` answers on the CPU.
    pub(crate) fn read_found(&self, gpu: &Gpu, count: u32) -> Vec<Found> {
        read(gpu, &self.found, count)
    }

    /// What the first `count` searches took.
    pub(crate) fn read_efforts(&self, gpu: &Gpu, count: u32) -> Vec<Effort> {
        read(gpu, &self.efforts, count)
    }

    /// Sums of [`Points::read_efforts`].
    pub(crate) fn total(&self, gpu: &Gpu, count: u32) -> Efforts {
        let mut total = Efforts::default();
        for effort in self.read_efforts(gpu, count) {
            total.add(effort.into());
        }
        total
    }

    /// Answers and efforts as results: one for each of `places` (object id, vertex), which are the
    /// first points of the batch. `has_holes`: the search reports holes and enlargements.
    pub(crate) fn results(
        &self,
        gpu: &Gpu,
        mirror: u32,
        places: &[(u32, u32)],
        has_holes: bool,
    ) -> Vec<VertexResult> {
        let count = places.len() as u32;
        let answers = self.read_found(gpu, count).into_iter();
        let answers = answers.zip(self.read_efforts(gpu, count));
        let flag = |effort: &Effort, flag: u32| has_holes.then_some(effort.flags & flag != 0);
        places
            .iter()
            .zip(answers)
            .map(|(&(object, vertex), (found, effort))| VertexResult {
                object,
                vertex,
                mirror,
                state: match found.state {
                    Found::FOUND => VertexState::Found,
                    Found::HIDDEN => VertexState::Hidden,
                    Found::FAILED => VertexState::Failed,
                    Found::UNREFLECTED => VertexState::Unreflected,
                    state => unreachable!("no search writes the state {state}"),
                },
                at: found.at,
                steps: effort.steps,
                evaluations: effort.evaluations,
                node_tests: effort.node_tests,
                hole: flag(&effort, Effort::MET_HOLE),
                enlarged: flag(&effort, Effort::ENLARGED),
                stand_in: effort.flags & Effort::STAND_IN != 0,
            })
            .collect()
    }
}

/// The first `count` records of a buffer.
pub(crate) fn read<T: ShaderType + ShaderSize + CreateFrom>(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    count: u32,
) -> Vec<T> {
    let size = <T as ShaderSize>::SHADER_SIZE.get() * u64::from(count);
    if size == 0 {
        return Vec::new();
    }
    let bytes = gpu.read_buffer_part(buffer, size);
    StorageBuffer::new(bytes)
        .create()
        .expect("the buffer holds whole records")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn records_lie_as_the_shaders_read_them() {
        assert_layout!(
            Range {
                first,
                count,
                warm,
                listed
            },
            "linear",
            &[],
            "Range"
        );
        assert_layout!(
            Found {
                position,
                state,
                at,
                distance,
                image
            },
            "linear",
            &[],
            "Found"
        );
        assert_layout!(
            Effort {
                steps,
                evaluations,
                node_tests,
                flags
            },
            "linear",
            &["count"],
            "Effort"
        );
    }
}

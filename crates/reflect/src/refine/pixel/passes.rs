//! The levels recorded: `pixel/kernels.wesl`.

use encase::{ShaderSize, StorageBuffer};
use glam::{Vec3, Vec4};

use super::kernels::Kernels;
use super::records::{Asked, Edge, GROUP, Level, Room, Settings, Totals, Working};
use super::topology::Topology;
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, dispatch_size, group, storage, storage_bytes, storage_zeros,
    uniform,
};
use crate::refine::Context;
use crate::refine::scene_vertices::SceneVertices;
use crate::refine::split::{Counts, clear, sums};
use crate::refine::tessellation::Piece;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::{Dispatch, Found, Points, read};
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;

/// Distance between the [`Level`] records, bytes: where every device lets a binding begin.
const LEVEL_STRIDE: u64 = 256;
/// Where `edge_groups` and `draw` lie in a [`Level`], bytes.
const EDGE_GROUPS: u64 = 16;
const DRAW: u64 = 32;

/// A corner of a drawn triangle, on the CPU.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub position: Vec3,
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "tests compare drawn edges by it")
    )]
    pub found: Found,
}

/// The loop, ready for one scene.
pub(super) struct Passes {
    parts: Parts,
    sized: Sized,
}

/// What does not depend on how much is drawn.
struct Parts {
    asked: Asked,
    kernels: Kernels,
    raster: Raster,
    points_layout: wgpu::BindGroupLayout,
    scene_positions: wgpu::Buffer,
    scene_edges: wgpu::Buffer,
    sources: wgpu::Buffer,
    totals: wgpu::Buffer,
    effort_sums: wgpu::Buffer,
    /// Largest deviation in pixels, as drawing reads it.
    deviation: wgpu::Buffer,
}

/// Buffers with room for so many records, and what binds them.
struct Sized {
    room: Room,
    settings: Settings,
    positions: wgpu::Buffer,
    finished: wgpu::Buffer,
    levels: wgpu::Buffer,
    points: Points,
    /// Group 2 of most kernels.
    geometry: wgpu::BindGroup,
    /// Group 3 of `adopt`, one a sheet.
    adopt: Vec<wgpu::BindGroup>,
    begin: wgpu::BindGroup,
    /// Group 3 of `count`, `scan` and `write_edges` at the scene's own edges.
    first: [wgpu::BindGroup; 3],
    /// Group 3 of `judge`, `count`, `scan`, `write_edges` and `write_triangles`, one a level.
    steps: Vec<[wgpu::BindGroup; 5]>,
    tally: wgpu::BindGroup,
    drawn: wgpu::BindGroup,
}

fn whole<'a>(buffers: &[&'a wgpu::Buffer]) -> Vec<wgpu::BindingResource<'a>> {
    let binding = |buffer: &&'a wgpu::Buffer| buffer.as_entire_binding();
    buffers.iter().map(binding).collect()
}

fn records<T: ShaderSize>(gpu: &Gpu, count: u32) -> wgpu::Buffer {
    storage_zeros(gpu, u64::from(count) * T::SHADER_SIZE.get())
}

/// A [`Level`] of a buffer of them.
fn level(levels: &wgpu::Buffer, index: u32) -> wgpu::BindingResource<'_> {
    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
        buffer: levels,
        offset: LEVEL_STRIDE * u64::from(index),
        size: Some(Level::SHADER_SIZE),
    })
}

impl Parts {
    fn sized(
        &self,
        gpu: &Gpu,
        topology: &Topology,
        room: Room,
        scene_vertices: &SceneVertices,
    ) -> Sized {
        let settings = Settings {
            error: self.asked.error,
            level: self.asked.level,
            vertices: topology.vertices,
            edges: topology.edges.len() as u32,
            triangles: topology.triangles.len() as u32,
            most_points: room.points,
            most_edges: room.edges,
            most_working: room.working,
            most_finished: room.finished,
            most_items: room.items,
        };
        let own = uniform(gpu, &settings);
        let own = || own.as_entire_binding();
        let positions = storage_zeros(gpu, 16 * u64::from(room.points));
        let range = storage_bytes(gpu, &[0; 16]);
        let dispatch = storage_zeros(gpu, 12);
        let indirect = Dispatch::Indirect(dispatch.clone(), 0);
        let layout = &self.points_layout;
        let points = Points::with_range(gpu, layout, &positions, room.points, range, indirect);
        let edges = records::<Edge>(gpu, room.edges);
        let finished = records::<Piece>(gpu, room.finished);
        let working = [(); 2].map(|()| records::<Working>(gpu, room.working));
        let sums = u64::from(room.items) + 2 * u64::from(room.items.div_ceil(GROUP) + 1);
        let sums = storage_zeros(gpu, 8 * sums);
        // The scene's edges, the levels, and what the last level leaves.
        let levels = storage_zeros(gpu, LEVEL_STRIDE * u64::from(self.asked.level + 3));
        let kernels = &self.kernels;
        let adopt = scene_vertices.batches.iter().map(|batch| {
            let scene = [&self.scene_positions, &batch.found];
            let scene = whole(&scene);
            kernels.adopt.group(gpu, &[&[own()], &scene[..]].concat())
        });
        let at = |index: u32| level(&levels, index);
        let scanned = |index: u32| {
            let all = [
                own(),
                sums.as_entire_binding(),
                at(index),
                at(index + 1),
                points.range.as_entire_binding(),
                dispatch.as_entire_binding(),
                self.totals.as_entire_binding(),
            ];
            kernels.scan.group(gpu, &all)
        };
        let counted = |index: u32, working: &wgpu::Buffer| {
            let buffers = whole(&[working, &sums, &self.totals]);
            let all = [&[own(), at(index)], &buffers[..]].concat();
            kernels.count.group(gpu, &all)
        };
        let written = |index: u32| {
            let unread = working[0].as_entire_binding();
            let all = [own(), at(index), unread, sums.as_entire_binding()];
            kernels.write_edges.group(gpu, &all)
        };
        let steps = (0..=self.asked.level).map(|index| {
            let from = match index {
                0 => &self.sources,
                _ => &working[index as usize % 2],
            };
            let to = &working[(index as usize + 1) % 2];
            let place = index + 1;
            let judge = [own(), at(place)];
            let triangles = whole(&[from, &sums, to, &finished]);
            let triangles = [&[own(), at(place)], &triangles[..]].concat();
            [
                kernels.judge.group(gpu, &judge),
                counted(place, from),
                scanned(place),
                written(place),
                kernels.write_triangles.group(gpu, &triangles),
            ]
        });
        let steps = steps.collect();
        let begin = [own(), self.scene_edges.as_entire_binding(), at(0)];
        let mut drawn = whole(&[&points.found, &finished, &positions, &points.found]);
        drawn.push(self.deviation.as_entire_binding());
        let tallied = [&points.efforts, &points.range, &self.effort_sums];
        Sized {
            room,
            settings,
            geometry: group(
                gpu,
                &kernels.geometry,
                &whole(&[&positions, &points.found, &edges]),
            ),
            adopt: adopt.collect(),
            begin: kernels.begin.group(gpu, &begin),
            first: [counted(0, &working[0]), scanned(0), written(0)],
            steps,
            tally: kernels.tally.group(gpu, &whole(&tallied)),
            drawn: group(gpu, &self.raster.own_layout, &drawn),
            positions,
            finished,
            levels,
            points,
        }
    }
}

impl Passes {
    pub(super) fn new(
        context: &Context<'_>,
        asked: Asked,
        topology: &Topology,
        room: Room,
        scene_vertices: &SceneVertices,
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let read = Slot::Read;
        let slots = [read, read, read, read, Slot::Uniform];
        let features = ["split", "bounded"];
        let parts = Parts {
            asked,
            kernels: Kernels::new(context)?,
            raster: Raster::new(
                gpu,
                context.drawn,
                stage,
                "stage/virtual",
                &features,
                &slots,
            )?,
            points_layout: context.points_layout.clone(),
            scene_positions: stage.world.positions.clone(),
            scene_edges: storage(gpu, &topology.edges),
            sources: storage(gpu, &topology.triangles),
            totals: records::<Totals>(gpu, 1),
            effort_sums: storage_zeros(gpu, 24),
            deviation: uniform(gpu, &asked.error),
        };
        let sized = parts.sized(gpu, topology, room, scene_vertices);
        gpu.check()?;
        Ok(Self { parts, sized })
    }

    pub(super) fn room(&self) -> Room {
        self.sized.room
    }

    /// Makes room for more.
    ///
    /// # Errors
    /// What the device cannot hold.
    pub(super) fn resize(
        &mut self,
        gpu: &Gpu,
        topology: &Topology,
        room: Room,
        scene_vertices: &SceneVertices,
    ) -> Result<(), ReflectError> {
        self.sized = self.parts.sized(gpu, topology, room, scene_vertices);
        Ok(gpu.check()?)
    }

    pub(super) fn begin_frame(&self, gpu: &Gpu) {
        clear(gpu, [&self.parts.totals, &self.parts.effort_sums]);
    }

    /// What was counted in the last frame.
    pub(super) fn counts(&self, gpu: &Gpu) -> Counts {
        let totals = self.totals(gpu);
        Counts {
            by_level: totals.by_level,
            points: totals.points,
            unfinished: totals.unfinished,
            efforts: sums(gpu, &self.parts.effort_sums),
        }
    }

    /// The [`Totals`] of the last frame.
    fn totals(&self, gpu: &Gpu) -> Totals {
        let size = Totals::SHADER_SIZE.get();
        let bytes = gpu.read_buffer_part(&self.parts.totals, size);
        let totals = StorageBuffer::new(bytes).create();
        totals.expect("the buffer holds the totals")
    }

    /// How much room the last frame wanted, as far as it got.
    pub(super) fn wanted(&self, gpu: &Gpu) -> Room {
        let totals = self.totals(gpu);
        Room {
            points: totals.wanted_points,
            edges: totals.wanted_edges,
            working: totals.wanted_working,
            finished: totals.wanted_finished,
            items: 0,
        }
    }

    /// Records the loop on one sheet, whose vertices were searched before.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    ) {
        let (kernels, sized) = (&self.parts.kernels, &self.sized);
        let settings = &sized.settings;
        let counts = variant == Variant::AllLayers;
        let bind = |pass: &mut wgpu::ComputePass<'_>| {
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[sheet.mirror], &[]);
            pass.set_bind_group(2, &sized.geometry, &[]);
        };
        let over = |pass: &mut wgpu::ComputePass<'_>, kernel: &Kernel, count: u32| {
            let [x, y] = dispatch_size(kernel.groups(count));
            pass.set_pipeline(kernel);
            pass.dispatch_workgroups(x, y, 1);
        };
        frame.compute("refine", |pass| {
            bind(pass);
            pass.set_bind_group(3, &sized.adopt[sheet.index], &[]);
            over(pass, &kernels.adopt.kernel, settings.vertices.max(1));
            pass.set_bind_group(3, &sized.begin, &[]);
            over(pass, &kernels.begin.kernel, settings.edges.max(1));
            let [count, scan, write] = &sized.first;
            pass.set_bind_group(3, count, &[]);
            over(pass, &kernels.first_count.kernel, settings.edges.max(1));
            pass.set_bind_group(3, scan, &[]);
            over(pass, &kernels.first_scan.kernel, 1);
            pass.set_bind_group(3, write, &[]);
            over(pass, &kernels.first_write.kernel, settings.edges.max(1));
        });
        self.record_search(frame, stage, search, sheet, variant);
        for (index, [judge, count, scan, edges, triangles]) in (1..).zip(&sized.steps) {
            let groups = LEVEL_STRIDE * index;
            let indirect = |pass: &mut wgpu::ComputePass<'_>, kernel: &Kernel, offset| {
                pass.set_pipeline(kernel);
                pass.dispatch_workgroups_indirect(&sized.levels, groups + offset);
            };
            frame.compute("refine", |pass| {
                bind(pass);
                pass.set_bind_group(3, judge, &[]);
                indirect(pass, &kernels.judge.kernel, EDGE_GROUPS);
                pass.set_bind_group(3, count, &[]);
                let counting = match counts {
                    true => &kernels.telling_count,
                    false => &kernels.count,
                };
                indirect(pass, &counting.kernel, 0);
                pass.set_bind_group(3, scan, &[]);
                over(pass, &kernels.scan.kernel, 1);
                pass.set_bind_group(3, edges, &[]);
                indirect(pass, &kernels.write_edges.kernel, EDGE_GROUPS);
                pass.set_bind_group(3, triangles, &[]);
                indirect(pass, &kernels.write_triangles.kernel, 0);
            });
            if index as usize != sized.steps.len() {
                self.record_search(frame, stage, search, sheet, variant);
            }
        }
    }

    /// Records the search of the points that were made last.
    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    ) {
        let points = &self.sized.points;
        search.record_search(frame, stage, sheet, points, variant);
        if variant == Variant::AllLayers {
            let tally = &self.parts.kernels.tally.kernel;
            frame.compute("count", |pass| {
                pass.set_bind_group(3, &self.sized.tally, &[]);
                pass.set_pipeline(tally);
                points.run(pass, tally);
            });
        }
    }

    /// Where the last [`Level`] lies.
    fn end(&self) -> u64 {
        LEVEL_STRIDE * u64::from(self.parts.asked.level + 2)
    }

    /// Records the drawing of what the loop made last.
    pub(super) fn draw(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        variant: Variant,
    ) {
        let (mirror, drawn) = (sheet.mirror, &self.sized.drawn);
        (self.parts.raster).record(frame, stage, mirror, drawn, variant, |pass| {
            pass.draw_indirect(&self.sized.levels, self.end() + DRAW);
        });
    }

    /// The drawn triangles of a sheet in the last frame with their corners, made again: the buffers only
    /// ever hold one sheet's.
    pub(super) fn drawn(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
    ) -> Vec<(Piece, [Corner; 3])> {
        let totals = gpu.read_buffer(&self.parts.totals);
        gpu.run(|frame| {
            stage.record_maps(frame, sheet.mirror);
            search.record_build(frame, stage, sheet.mirror);
            self.record(frame, stage, search, sheet, Variant::Color);
        });
        gpu.queue.write_buffer(&self.parts.totals, 0, &totals);
        let end = self.end();
        let bytes = gpu.read_buffer_part(&self.sized.levels, end + Level::SHADER_SIZE.get());
        let last = StorageBuffer::new(&bytes[end as usize..]).create();
        let last: Level = last.expect("a whole record");
        let positions: Vec<Vec4> = read(gpu, &self.sized.positions, last.points);
        let found = self.sized.points.read_found(gpu, last.points);
        let pieces: Vec<Piece> = read(gpu, &self.sized.finished, last.finished);
        let corner = |point: u32| {
            let place = (point & !Piece::NEW) as usize;
            Corner {
                position: positions[place].truncate(),
                found: found[place],
            }
        };
        let pieces = pieces.into_iter().map(|piece| Piece {
            level: piece.level & Piece::LEVEL,
            ..piece
        });
        let drawn = pieces.map(|piece| (piece, piece.points.to_array().map(corner)));
        drawn.collect()
    }
}

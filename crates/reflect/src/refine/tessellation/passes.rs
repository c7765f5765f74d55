//! Buffers and kernels of the tessellation loop: `tessellation.wesl`, `tally.wesl`.

use encase::{ShaderSize, StorageBuffer};
use glam::{Vec3, Vec4};

use super::plan::Plan;
use super::{Chunk, Level, Rule, Settings, Totals};
use crate::ReflectError;
use crate::data::{Found, Piece};
use crate::gpu::Gpu;
use crate::points::{Dispatch, Points, read};
use crate::raster::Raster;
use crate::recorder::Recorder;
use crate::refine::Context;
use crate::refine::originals::Originals;
use crate::resources::{
    Slot, compute, dispatch_size, group, layout, module, storage_bytes, storage_zeros, uniform,
};
use crate::search::Search;
use crate::stage::Stage;
use crate::technique::Variant;

/// Threads of a workgroup of the kernels, one a triangle.
const GROUP: u32 = 256;
/// Distance between the [`Level`] records, bytes: where every device lets a binding begin.
const LEVEL_STRIDE: u64 = 256;
/// Where `draw` lies in a [`Level`], bytes.
const DRAW: u64 = 16;

/// The loop, ready for one scene.
pub(super) struct Passes {
    level: u32,
    judges: bool,
    /// A [`Totals`].
    pub totals: wgpu::Buffer,
    levels: wgpu::Buffer,
    finished: wgpu::Buffer,
    positions: wgpu::Buffer,
    effort_sums: wgpu::Buffer,
    /// The new points of a chunk.
    points: Points,
    begin: wgpu::ComputePipeline,
    classify: wgpu::ComputePipeline,
    scan: wgpu::ComputePipeline,
    split: wgpu::ComputePipeline,
    split_last: wgpu::ComputePipeline,
    judge: wgpu::ComputePipeline,
    tally: wgpu::ComputePipeline,
    raster: Raster,
    /// One a chunk: workgroups and group 3 of `begin`.
    chunks: Vec<(u32, wgpu::BindGroup)>,
    /// Group 2 of `classify` and `judge`, one a mirror.
    answers: Vec<wgpu::BindGroup>,
    /// Group 2 of `split`.
    vertices: wgpu::BindGroup,
    /// Group 3 of `classify`, `scan` and `split`, one a level that is split.
    steps: Vec<[wgpu::BindGroup; 3]>,
    judged: wgpu::BindGroup,
    tallied: wgpu::BindGroup,
    /// Group 3 of the raster pass, one a mirror.
    drawn: Vec<wgpu::BindGroup>,
}

/// What one chunk's loop left behind.
pub(super) struct Made {
    pub pieces: Vec<Piece>,
    /// World-space positions of the new points.
    pub points: Vec<Vec3>,
    pub found: Vec<Found>,
}

fn whole<'a>(buffers: &[&'a wgpu::Buffer]) -> Vec<wgpu::BindingResource<'a>> {
    let binding = |buffer: &&'a wgpu::Buffer| buffer.as_entire_binding();
    buffers.iter().map(binding).collect()
}

fn records<T: ShaderSize>(gpu: &Gpu, count: u32) -> wgpu::Buffer {
    storage_zeros(gpu, u64::from(count) * T::SHADER_SIZE.get())
}

impl Passes {
    pub(super) fn new(
        context: &Context<'_>,
        rule: Rule,
        plan: Plan,
        originals: &Originals,
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let world = &stage.world;
        let settings = Settings {
            threshold: rule.threshold.unwrap_or(0.0),
            level: rule.level,
        };
        let settings = uniform(gpu, &settings);
        // The last level's triangles go to `finished` at once; levels take turns on two buffers.
        let splitting = rule.level.saturating_sub(1);
        let worked_on = if rule.level == 0 {
            0
        } else {
            plan.at(splitting)
        };
        let before = plan.at(splitting.saturating_sub(1));
        let working = if rule.level.is_multiple_of(2) {
            [before, worked_on]
        } else {
            [worked_on, before]
        };
        let working = working.map(|count| records::<Piece>(gpu, count));
        let finished = records::<Piece>(gpu, plan.at(rule.level));
        let levels = storage_zeros(gpu, LEVEL_STRIDE * u64::from(rule.level + 1));
        let totals = storage_zeros(gpu, Totals::SHADER_SIZE.get());
        let ranks = records::<u32>(gpu, worked_on);
        let sums = records::<u32>(gpu, worked_on.div_ceil(GROUP));
        let positions = storage_zeros(gpu, u64::from(plan.points()) * 16);
        let range = storage_bytes(gpu, &[0; 16]);
        let dispatch = storage_zeros(gpu, 12);
        let points = Points::with_range(
            gpu,
            context.points_layout,
            &positions,
            plan.points(),
            range.clone(),
            Dispatch::Indirect(dispatch.clone(), 0),
        );
        let effort_sums = storage_zeros(gpu, 24);

        let level = |index: u32| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &levels,
                offset: LEVEL_STRIDE * u64::from(index),
                size: Some(Level::SHADER_SIZE),
            })
        };
        use Slot::{Read, Uniform, Write};
        let begin_layout = layout(gpu, "begin", &[Uniform, Write, Write, Uniform, Write]);
        let answers_layout = layout(gpu, "answers", &[Read; 4]);
        let classify_layout = layout(gpu, "classify", &[Uniform, Read, Read, Write, Write]);
        let scan_slots = [Uniform, Write, Write, Write, Write, Write, Write];
        let scan_layout = layout(gpu, "scan", &scan_slots);
        let vertices_layout = layout(gpu, "vertices", &[Read, Write]);
        let split_layout = layout(gpu, "split", &[Read, Write, Write, Read, Read, Read]);
        let judge_layout = layout(gpu, "judge", &[Uniform, Read, Read, Write]);
        let tally_layout = layout(gpu, "tally", &[Read, Read, Write]);

        let first = if rule.level == 0 {
            &finished
        } else {
            &working[0]
        };
        let chunks = plan.chunks().map(|[first_triangle, count]| {
            let chunk = Chunk {
                first: first_triangle,
                count,
            };
            let chunk = uniform(gpu, &chunk);
            let resources = [
                chunk.as_entire_binding(),
                first.as_entire_binding(),
                level(0),
                settings.as_entire_binding(),
                totals.as_entire_binding(),
            ];
            let groups = count.div_ceil(GROUP);
            (groups, group(gpu, &begin_layout, &resources))
        });
        let answers = originals.batches.iter().map(|batch| {
            let buffers = [&world.positions, &batch.found, &positions, &points.found];
            group(gpu, &answers_layout, &whole(&buffers))
        });
        let steps = (0..rule.level).map(|index| {
            let this = &working[index as usize % 2];
            let next = &working[(index as usize + 1) % 2];
            let classify = [
                settings.as_entire_binding(),
                this.as_entire_binding(),
                level(index),
                ranks.as_entire_binding(),
                sums.as_entire_binding(),
            ];
            let scan = [
                settings.as_entire_binding(),
                sums.as_entire_binding(),
                level(index),
                level(index + 1),
                range.as_entire_binding(),
                dispatch.as_entire_binding(),
                totals.as_entire_binding(),
            ];
            let split = [
                this.as_entire_binding(),
                next.as_entire_binding(),
                finished.as_entire_binding(),
                level(index),
                ranks.as_entire_binding(),
                sums.as_entire_binding(),
            ];
            [
                group(gpu, &classify_layout, &classify),
                group(gpu, &scan_layout, &scan),
                group(gpu, &split_layout, &split),
            ]
        });
        let judged = [
            settings.as_entire_binding(),
            finished.as_entire_binding(),
            level(rule.level),
            totals.as_entire_binding(),
        ];
        let raster = Raster::new(
            gpu,
            context.search_options,
            stage,
            "virtual",
            &["split"],
            &[Read; 4],
        )?;
        let drawn = originals.batches.iter().map(|batch| {
            let buffers = [&batch.found, &finished, &positions, &points.found];
            group(gpu, &raster.own_layout, &whole(&buffers))
        });

        let program = |features: &[&str]| module(gpu, "tessellation", features);
        let view = Some(&world.view_layout);
        let mirror = Some(&stage.gbuffer.mirror_layout);
        let surface = Some(&world.surface_layout);
        let (plain, last) = (program(&[])?, program(&["last"])?);
        let judging = if rule.threshold.is_none() {
            &program(&["full"])?
        } else {
            &plain
        };
        let answered = |entry, own| {
            let layouts = [view, mirror, Some(&answers_layout), Some(own)];
            compute(gpu, judging, entry, &layouts)
        };
        let splitter = |module| {
            let layouts = [None, None, Some(&vertices_layout), Some(&split_layout)];
            compute(gpu, module, "split", &layouts)
        };
        let tally_layouts = [None, None, None, Some(&tally_layout)];
        Ok(Self {
            level: rule.level,
            judges: rule.threshold.is_some(),
            begin: compute(
                gpu,
                &plain,
                "begin",
                &[None, None, surface, Some(&begin_layout)],
            ),
            classify: answered("classify", &classify_layout),
            scan: compute(gpu, &plain, "scan", &[None, None, None, Some(&scan_layout)]),
            split: splitter(&plain),
            split_last: splitter(&last),
            judge: answered("judge", &judge_layout),
            tally: compute(gpu, &module(gpu, "tally", &[])?, "tally", &tally_layouts),
            chunks: chunks.collect(),
            answers: answers.collect(),
            vertices: group(
                gpu,
                &vertices_layout,
                &whole(&[&world.positions, &positions]),
            ),
            steps: steps.collect(),
            judged: group(gpu, &judge_layout, &judged),
            tallied: group(
                gpu,
                &tally_layout,
                &whole(&[&points.efforts, &range, &effort_sums]),
            ),
            drawn: drawn.collect(),
            raster,
            totals,
            levels,
            finished,
            positions,
            effort_sums,
            points,
        })
    }

    pub(super) fn begin_frame(&self, gpu: &Gpu) {
        for buffer in [&self.totals, &self.effort_sums] {
            let zeros = vec![0; buffer.size() as usize];
            gpu.queue.write_buffer(buffer, 0, &zeros);
        }
    }

    /// Records the loop over one chunk on one mirror.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        [mirror, chunk]: [usize; 2],
        variant: Variant,
    ) {
        let counts = variant == Variant::AllLayers;
        frame.compute("refine", |pass| {
            let (groups, own) = &self.chunks[chunk];
            let [x, y] = dispatch_size(*groups);
            pass.set_pipeline(&self.begin);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, own, &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        for (level, [classify, scan, split]) in (0..).zip(&self.steps) {
            let groups = LEVEL_STRIDE * u64::from(level);
            frame.compute("refine", |pass| {
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, &stage.gbuffer.mirror_groups[mirror], &[]);
                pass.set_bind_group(2, &self.answers[mirror], &[]);
                pass.set_bind_group(3, classify, &[]);
                pass.set_pipeline(&self.classify);
                pass.dispatch_workgroups_indirect(&self.levels, groups);
                pass.set_bind_group(3, scan, &[]);
                pass.set_pipeline(&self.scan);
                pass.dispatch_workgroups(1, 1, 1);
                pass.set_bind_group(2, &self.vertices, &[]);
                pass.set_bind_group(3, split, &[]);
                pass.set_pipeline(if level + 1 == self.level {
                    &self.split_last
                } else {
                    &self.split
                });
                pass.dispatch_workgroups_indirect(&self.levels, groups);
            });
            search.record_search(frame, stage, mirror, &self.points, variant);
            if counts {
                frame.compute("count", |pass| {
                    pass.set_bind_group(3, &self.tallied, &[]);
                    pass.set_pipeline(&self.tally);
                    self.points.run(pass);
                });
            }
        }
        if counts && self.judges {
            frame.compute("count", |pass| {
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, &stage.gbuffer.mirror_groups[mirror], &[]);
                pass.set_bind_group(2, &self.answers[mirror], &[]);
                pass.set_bind_group(3, &self.judged, &[]);
                pass.set_pipeline(&self.judge);
                let groups = LEVEL_STRIDE * u64::from(self.level);
                pass.dispatch_workgroups_indirect(&self.levels, groups);
            });
        }
    }

    /// Records the drawing of what the loop made last.
    pub(super) fn draw(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        variant: Variant,
    ) {
        let arguments = LEVEL_STRIDE * u64::from(self.level) + DRAW;
        self.raster
            .record(frame, stage, mirror, &self.drawn[mirror], variant, |pass| {
                pass.draw_indirect(&self.levels, arguments);
            });
    }

    /// Steps, evaluations and node tests of all new points of the last frame.
    pub(super) fn effort_sums(&self, gpu: &Gpu) -> [u64; 3] {
        let bytes = gpu.read_buffer_part(&self.effort_sums, 24);
        let word = |index: usize| -> u64 { bytemuck::pod_read_unaligned(&bytes[index * 8..][..8]) };
        [word(0), word(1), word(2)]
    }

    /// What the loop made last.
    pub(super) fn read(&self, gpu: &Gpu, level: u32) -> Made {
        let end = LEVEL_STRIDE * u64::from(level);
        let levels = gpu.read_buffer_part(&self.levels, end + Level::SHADER_SIZE.get());
        let last: Level = StorageBuffer::new(&levels[end as usize..])
            .create()
            .expect("a whole record");
        let positions: Vec<Vec4> = read(gpu, &self.positions, last.points);
        Made {
            pieces: read(gpu, &self.finished, last.finished + last.count),
            points: positions.into_iter().map(Vec4::truncate).collect(),
            found: self.points.read_found(gpu, last.points),
        }
    }
}

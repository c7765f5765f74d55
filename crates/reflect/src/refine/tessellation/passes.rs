//! The tessellation loop recorded: `tessellation/kernels.wesl`, `tessellation/tally.wesl`.

use encase::{ShaderSize, StorageBuffer};
use glam::{Vec3, Vec4};

use super::buffers::{Buffers, DRAW, LEVEL_STRIDE};
use super::kernels::Kernels;
use super::plan::Plan;
use super::records::{Chunk, Level, Piece, Settings, Totals};
use super::rule::Rule;
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, dispatch_size, group, uniform};
use crate::refine::Context;
use crate::refine::scene_vertices::SceneVertices;
use crate::refine::split::{Counts, clear, sums};
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::{Dispatch, Found, Points, read};
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;

/// The loop, ready for one scene.
pub(super) struct Passes {
    level: u32,
    judges: bool,
    kernels: Kernels,
    buffers: Buffers,
    /// The new points of a chunk.
    points: Points,
    raster: Raster,
    /// One a chunk: workgroups and group 3 of `begin`.
    chunks: Vec<(u32, wgpu::BindGroup)>,
    /// Group 2 of `classify` and `judge`, one a sheet.
    answers: Vec<wgpu::BindGroup>,
    /// Group 2 of `split`.
    vertices: wgpu::BindGroup,
    /// Group 3 of `classify`, `scan` and `split`, one a level that is split.
    steps: Vec<[wgpu::BindGroup; 3]>,
    judged: wgpu::BindGroup,
    tallied: wgpu::BindGroup,
    /// Group 3 of the raster pass, one a sheet.
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

impl Passes {
    pub(super) fn new(
        context: &Context<'_>,
        rule: Rule,
        plan: Plan,
        scene_vertices: &SceneVertices,
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let world = &stage.world;
        let settings = Settings {
            threshold: rule.threshold.unwrap_or(0.0),
            level: rule.level,
        };
        let settings = uniform(gpu, &settings);
        let kernels = Kernels::new(context, rule)?;
        let buffers = Buffers::new(gpu, rule.level, plan, &kernels.classify.kernel);
        let points = Points::with_range(
            gpu,
            context.points_layout,
            &buffers.positions,
            plan.points(),
            buffers.range.clone(),
            Dispatch::Indirect(buffers.dispatch.clone(), 0),
        );
        let chunks = plan.chunks().map(|[first, count]| {
            let chunk = uniform(gpu, &Chunk { first, count });
            let resources = [
                chunk.as_entire_binding(),
                buffers.worked_on(0).as_entire_binding(),
                buffers.level(0),
                settings.as_entire_binding(),
                buffers.totals.as_entire_binding(),
            ];
            let groups = kernels.begin.kernel.groups(count);
            (groups, kernels.begin.group(gpu, &resources))
        });
        let answers = scene_vertices.batches.iter().map(|batch| {
            let found = [&batch.found, &buffers.positions, &points.found];
            let all = [&[&world.positions], &found[..]].concat();
            group(gpu, &kernels.answers_layout, &whole(&all))
        });
        let steps = (0..rule.level).map(|index| {
            let classify = [
                settings.as_entire_binding(),
                buffers.worked_on(index).as_entire_binding(),
                buffers.level(index),
                buffers.ranks.as_entire_binding(),
                buffers.sums.as_entire_binding(),
            ];
            let scan = [
                settings.as_entire_binding(),
                buffers.sums.as_entire_binding(),
                buffers.level(index),
                buffers.level(index + 1),
                buffers.range.as_entire_binding(),
                buffers.dispatch.as_entire_binding(),
                buffers.totals.as_entire_binding(),
            ];
            let split = [
                buffers.worked_on(index).as_entire_binding(),
                buffers.working[(index as usize + 1) % 2].as_entire_binding(),
                buffers.finished.as_entire_binding(),
                buffers.level(index),
                buffers.ranks.as_entire_binding(),
                buffers.sums.as_entire_binding(),
            ];
            [
                kernels.classify.group(gpu, &classify),
                kernels.scan.group(gpu, &scan),
                kernels.split.group(gpu, &split),
            ]
        });
        let judged = [
            settings.as_entire_binding(),
            buffers.finished.as_entire_binding(),
            buffers.level(rule.level),
            buffers.totals.as_entire_binding(),
        ];
        let tallied = [&points.efforts, &buffers.range, &buffers.effort_sums];
        let raster = Raster::new(
            gpu,
            context.drawn,
            stage,
            "stage/virtual",
            &["split"],
            &[Slot::Read; 4],
        )?;
        let drawn = scene_vertices.batches.iter().map(|batch| {
            let all = [
                &batch.found,
                &buffers.finished,
                &buffers.positions,
                &points.found,
            ];
            group(gpu, &raster.own_layout, &whole(&all))
        });
        let vertices = whole(&[&world.positions, &buffers.positions]);
        Ok(Self {
            level: rule.level,
            judges: rule.threshold.is_some(),
            chunks: chunks.collect(),
            answers: answers.collect(),
            vertices: group(gpu, &kernels.vertices_layout, &vertices),
            steps: steps.collect(),
            judged: kernels.judge.group(gpu, &judged),
            tallied: kernels.tally.group(gpu, &whole(&tallied)),
            drawn: drawn.collect(),
            raster,
            kernels,
            buffers,
            points,
        })
    }

    /// Whether it looks up the mirror's normals.
    pub(super) fn judges(&self) -> bool {
        self.judges
    }

    pub(super) fn begin_frame(&self, gpu: &Gpu) {
        clear(gpu, [&self.buffers.totals, &self.buffers.effort_sums]);
    }

    /// What the [`Totals`] are kept in.
    pub(super) fn totals_buffer(&self) -> &wgpu::Buffer {
        &self.buffers.totals
    }

    /// What was counted in the last frame.
    pub(super) fn counts(&self, gpu: &Gpu) -> Counts {
        let size = Totals::SHADER_SIZE.get();
        let bytes = gpu.read_buffer_part(&self.buffers.totals, size);
        let totals = StorageBuffer::new(bytes).create();
        let totals: Totals = totals.expect("the buffer holds the totals");
        Counts {
            by_level: totals.by_level,
            points: totals.points,
            unfinished: totals.unfinished,
            efforts: sums(gpu, &self.buffers.effort_sums),
        }
    }

    /// Records the loop over one chunk on one sheet.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        (sheet, chunk): (Sheet, usize),
        variant: Variant,
    ) {
        let counts = variant == Variant::AllLayers;
        frame.compute("refine", |pass| {
            let (groups, own) = &self.chunks[chunk];
            let [x, y] = dispatch_size(*groups);
            pass.set_pipeline(&self.kernels.begin.kernel);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, own, &[]);
            pass.dispatch_workgroups(x, y, 1);
        });
        for (level, [classify, scan, split]) in (0..).zip(&self.steps) {
            let groups = LEVEL_STRIDE * u64::from(level);
            frame.compute("refine", |pass| {
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, &stage.maps().mirror_groups[sheet.mirror], &[]);
                pass.set_bind_group(2, &self.answers[sheet.index], &[]);
                pass.set_bind_group(3, classify, &[]);
                pass.set_pipeline(&self.kernels.classify.kernel);
                pass.dispatch_workgroups_indirect(&self.buffers.levels, groups);
                pass.set_bind_group(3, scan, &[]);
                pass.set_pipeline(&self.kernels.scan.kernel);
                pass.dispatch_workgroups(1, 1, 1);
                pass.set_bind_group(2, &self.vertices, &[]);
                pass.set_bind_group(3, split, &[]);
                pass.set_pipeline(if level + 1 == self.level {
                    &self.kernels.split_last
                } else {
                    &self.kernels.split.kernel
                });
                pass.dispatch_workgroups_indirect(&self.buffers.levels, groups);
            });
            search.record_search(frame, stage, sheet, &self.points, variant);
            if counts {
                frame.compute("count", |pass| {
                    pass.set_bind_group(3, &self.tallied, &[]);
                    pass.set_pipeline(&self.kernels.tally.kernel);
                    self.points.run(pass, &self.kernels.tally.kernel);
                });
            }
        }
        if counts && self.judges {
            frame.compute("count", |pass| {
                pass.set_bind_group(0, &stage.world.view_group, &[]);
                pass.set_bind_group(1, &stage.maps().mirror_groups[sheet.mirror], &[]);
                pass.set_bind_group(2, &self.answers[sheet.index], &[]);
                pass.set_bind_group(3, &self.judged, &[]);
                pass.set_pipeline(&self.kernels.judge.kernel);
                let groups = LEVEL_STRIDE * u64::from(self.level);
                pass.dispatch_workgroups_indirect(&self.buffers.levels, groups);
            });
        }
    }

    /// Records the drawing of what the loop made last.
    pub(super) fn draw(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        variant: Variant,
    ) {
        let arguments = LEVEL_STRIDE * u64::from(self.level) + DRAW;
        self.raster.record(
            frame,
            stage,
            sheet.mirror,
            &self.drawn[sheet.index],
            variant,
            |pass| {
                pass.draw_indirect(&self.buffers.levels, arguments);
            },
        );
    }

    /// What the loop made last.
    pub(super) fn read(&self, gpu: &Gpu, level: u32) -> Made {
        let end = LEVEL_STRIDE * u64::from(level);
        let levels = gpu.read_buffer_part(&self.buffers.levels, end + Level::SHADER_SIZE.get());
        let last: Level = StorageBuffer::new(&levels[end as usize..])
            .create()
            .expect("a whole record");
        let positions: Vec<Vec4> = read(gpu, &self.buffers.positions, last.points);
        Made {
            pieces: read(gpu, &self.buffers.finished, last.finished + last.count),
            points: positions.into_iter().map(Vec4::truncate).collect(),
            found: self.points.read_found(gpu, last.points),
        }
    }
}

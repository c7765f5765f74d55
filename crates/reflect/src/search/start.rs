//! Searches on the image that start at one texel for all vertices: the mirror's texel nearest to the
//! projection of its centre, or of its bounding box, found by the pass `start` (`start.wesl`).

use catoptric_scene::{Mirror, View};
use glam::{DVec2, Vec2};

use super::{Context, Pipelines, Search};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform, storage_bytes,
    uniform,
};
use crate::options::words;
use crate::stage::Stage;
use crate::stage::gbuffer::{GBuffer, MirrorsAlone};
use crate::stage::points::Points;
use crate::stage::variant::Variant;

words! {
    /// Where a search starts.
    pub(crate) enum Start {
        /// The mirror's projected centre.
        Center = "center",
        /// Its projected bounding box's.
        Bounds = "bounds",
        /// The vertex's answer in the previous frame, where there is one; else the centre.
        Previous = "previous",
    }
}

/// A search by a shader that reads the start texel as its group 3.
pub(super) struct FromStart {
    starts: Starts,
    pipelines: Pipelines,
}

impl FromStart {
    /// Of a program with an entry point `search`.
    pub(super) fn new(
        context: &Context<'_>,
        start: Start,
        program: &str,
        features: &[&str],
    ) -> Result<Self, ReflectError> {
        let starts = Starts::new(context, start)?;
        Ok(Self {
            pipelines: Pipelines::new(context, program, features, &starts.layout)?,
            starts,
        })
    }
}

impl Search for FromStart {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        self.starts.update(gpu, stage);
    }

    fn begin_frame(&mut self, gpu: &Gpu) {
        self.starts.begin_frame(gpu);
    }

    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        self.starts.record(frame, stage);
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.starts.groups[mirror];
        let on = &self.starts.gbuffer(stage).mirror_groups[mirror];
        (self.pipelines).record(frame, (stage, on), points, own, variant);
    }
}

/// The start texels of all mirrors, found anew in each frame.
struct Starts {
    /// Of a search's group 3: the start texel.
    layout: wgpu::BindGroupLayout,
    /// One a mirror.
    groups: Vec<wgpu::BindGroup>,
    from_bounds: bool,
    /// What is searched where vertices are continued; else the stage's G-buffer.
    alone: Option<MirrorsAlone>,
    nearest: Kernel,
    choose: Kernel,
    mirrors: Vec<StartTexel>,
}

struct StartTexel {
    /// Wanted image coordinates.
    wanted: wgpu::Buffer,
    /// Texel index, then the square of its distance from the wanted one.
    texel: wgpu::Buffer,
    find: wgpu::BindGroup,
}

impl Starts {
    fn new(context: &Context<'_>, start: Start) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let from_bounds = start == Start::Bounds;
        let alone = (context.extends).then(|| MirrorsAlone::new(gpu, &stage.world));
        let find = layout(gpu, "start found", &[Slot::Uniform, Slot::Write]);
        let read = layout(gpu, "start", &[Slot::Read]);
        let module = module(gpu, "start", &[])?;
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&find),
        ];
        let mirrors = (0..stage.world.mirrors.len()).map(|index| {
            let wanted = uniform(gpu, &start_point(stage, index, from_bounds));
            let texel = storage_bytes(gpu, &[0xff; 8]);
            let resources = [wanted.as_entire_binding(), texel.as_entire_binding()];
            StartTexel {
                find: group(gpu, &find, &resources),
                wanted,
                texel,
            }
        });
        let mirrors: Vec<StartTexel> = mirrors.collect();
        let texels = mirrors.iter().map(|start| start.texel.as_entire_binding());
        Ok(Self {
            groups: texels.map(|texel| group(gpu, &read, &[texel])).collect(),
            layout: read,
            from_bounds,
            alone: alone.transpose()?,
            nearest: compute(gpu, &module, "nearest", &layouts),
            choose: compute(gpu, &module, "choose", &layouts),
            mirrors,
        })
    }

    /// Takes over where the mirrors are now.
    fn update(&self, gpu: &Gpu, stage: &Stage) {
        for (index, start) in self.mirrors.iter().enumerate() {
            let wanted = start_point(stage, index, self.from_bounds);
            set_uniform(gpu, &start.wanted, &wanted);
        }
    }

    /// Forgets the last frame's texels.
    fn begin_frame(&self, gpu: &Gpu) {
        for start in &self.mirrors {
            gpu.queue.write_buffer(&start.texel, 0, &[0xff; 8]);
        }
    }

    /// What the search reads.
    fn gbuffer<'s>(&'s self, stage: &'s Stage) -> &'s GBuffer {
        let alone = self.alone.as_ref();
        alone.map_or(&stage.gbuffer, |alone| &alone.gbuffer)
    }

    /// Records the pass `start`, and what it reads where that is not the stage's.
    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        if let Some(alone) = &self.alone {
            alone.record(frame, &stage.world);
        }
        let mirrors = &self.gbuffer(stage).mirror_groups;
        frame.compute("start", |pass| {
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            for (start, mirror) in self.mirrors.iter().zip(mirrors) {
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &start.find, &[]);
                for kernel in [&self.nearest, &self.choose] {
                    let [width, height] = kernel.groups_over(stage.world.size);
                    pass.set_pipeline(kernel);
                    pass.dispatch_workgroups(width, height, 1);
                }
            }
        });
    }
}

/// Where a search starts, in image coordinates, before it is moved onto the mirror.
fn start_point(stage: &Stage, mirror: usize, from_bounds: bool) -> Vec2 {
    let world = &stage.world;
    let view = world.scene.camera.view(world.size);
    let mirror = &world.scene.mirrors[mirror];
    let middle = DVec2::new(f64::from(view.size[0]), f64::from(view.size[1])) / 2.0;
    let center = view.project(mirror.shape.center()).map(|(at, _)| at);
    let start = if from_bounds {
        bounds_middle(mirror, &view)
    } else {
        center.or_else(|| bounds_middle(mirror, &view))
    };
    let start = start.unwrap_or(middle);
    start.clamp(DVec2::ZERO, middle * 2.0 - 1.0).as_vec2()
}

/// Middle of the box around the projection of what is in front of the eye.
fn bounds_middle(mirror: &Mirror, view: &View) -> Option<DVec2> {
    let mesh = mirror.shape.tessellate(mirror.tessellation);
    let positions = mesh.positions.iter();
    let projected = positions.filter_map(|position| Some(view.project(position.as_dvec3())?.0));
    let (low, high) = projected.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| {
        (low.min(at), high.max(at))
    });
    low.cmple(high).all().then(|| (low + high) / 2.0)
}

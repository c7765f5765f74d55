//! Linear screen-space search (Szabo 2013, Alg. 3.2 and 3.3; Szabo CESCG, Alg. 2).
//!
//! The start texel is found first (pass `start`): the projection of the mirror's centre or of its
//! bounding box, moved to the nearest pixel that shows the mirror.

use catoptric_scene::{Mirror, View};
use glam::{DVec2, Vec2};

use super::{Context, Search};
use crate::ReflectError;
use crate::gpu::Gpu;
use crate::points::Points;
use crate::recorder::Recorder;
use crate::resources::{Slot, compute, group, layout, module, set_uniform, storage_bytes, uniform};
use crate::stage::Stage;
use crate::technique::Variant;

/// Side of the start pass's workgroups, in texels.
const START_GROUP: u32 = 8;

struct Linear {
    from_bounds: bool,
    from_previous: bool,
    nearest: wgpu::ComputePipeline,
    choose: wgpu::ComputePipeline,
    search: wgpu::ComputePipeline,
    counting: wgpu::ComputePipeline,
    mirrors: Vec<Start>,
}

/// Where the walks on one mirror begin.
struct Start {
    /// Wanted image coordinates.
    wanted: wgpu::Buffer,
    /// Texel index, then the square of its distance from the wanted one.
    texel: wgpu::Buffer,
    find: wgpu::BindGroup,
    read: wgpu::BindGroup,
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    let Context {
        gpu,
        options,
        stage,
        points_layout,
        account,
    } = context;
    let mut features = Vec::new();
    if options.is("residual", "cross") {
        features.push("cross");
    }
    if options.is("neighbours", "8") {
        features.push("eight");
    }
    if options.is("hidden", "extend") {
        features.push("extend");
    }
    let view = Some(&stage.world.view_layout);
    let mirror = Some(&stage.gbuffer.mirror_layout);
    let find = layout(gpu, "start found", &[Slot::Uniform, Slot::Write]);
    let read = layout(gpu, "start", &[Slot::Read]);
    let seek = module(gpu, "start", &[])?;
    let walk = |features: &[&str]| -> Result<_, ReflectError> {
        let module = module(gpu, "linear", features)?;
        let layouts = [view, mirror, Some(points_layout), Some(&read)];
        Ok(compute(gpu, &module, "search", &layouts))
    };
    let search = walk(&features)?;
    features.push(account.feature());
    let from_bounds = options.is("start", "bounds");
    let mirrors = (0..stage.world.mirrors.len()).map(|index| {
        let wanted = uniform(gpu, &start_point(stage, index, from_bounds));
        let texel = storage_bytes(gpu, &[0xff; 8]);
        Start {
            find: group(
                gpu,
                &find,
                &[wanted.as_entire_binding(), texel.as_entire_binding()],
            ),
            read: group(gpu, &read, &[texel.as_entire_binding()]),
            wanted,
            texel,
        }
    });
    Ok(Box::new(Linear {
        from_bounds,
        from_previous: options.is("start", "previous"),
        nearest: compute(gpu, &seek, "nearest", &[view, mirror, Some(&find)]),
        choose: compute(gpu, &seek, "choose", &[view, mirror, Some(&find)]),
        search,
        counting: walk(&features)?,
        mirrors: mirrors.collect(),
    }))
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

impl Search for Linear {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        for (index, start) in self.mirrors.iter().enumerate() {
            let wanted = start_point(stage, index, self.from_bounds);
            set_uniform(gpu, &start.wanted, &wanted);
        }
    }

    fn begin_frame(&mut self, gpu: &Gpu) {
        for start in &self.mirrors {
            gpu.queue.write_buffer(&start.texel, 0, &[0xff; 8]);
        }
    }

    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        let [width, height] = stage.world.size.map(|side| side.div_ceil(START_GROUP));
        frame.compute("start", |pass| {
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            for (start, mirror) in self.mirrors.iter().zip(&stage.gbuffer.mirror_groups) {
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &start.find, &[]);
                for pipeline in [&self.nearest, &self.choose] {
                    pass.set_pipeline(pipeline);
                    pass.dispatch_workgroups(width, height, 1);
                }
            }
        });
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        frame.compute("search", |pass| {
            pass.set_pipeline(match variant {
                Variant::AllLayers => &self.counting,
                Variant::Color => &self.search,
            });
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &points.group, &[]);
            pass.set_bind_group(3, &self.mirrors[mirror].read, &[]);
            points.run(pass);
        });
    }

    fn uses_previous(&self) -> bool {
        self.from_previous
    }
}

#[cfg(test)]
mod tests {
    use crate::spec::parse;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn a_still_camera_needs_one_step_from_the_second_frame_on() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        for technique in [
            "linear(start=previous)",
            "linear(start=previous,neighbours=8)",
        ] {
            let spec = parse(technique).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
            let [first, second, third] = [(); 3].map(|()| prepared.render().expect("renders"));
            assert!(
                first.work.steps > Some(5.0),
                "{technique}: {:?}",
                first.work
            );
            for later in [second, third] {
                assert_eq!(later.work.steps, Some(1.0), "{technique}");
                assert!(
                    later.work.evaluations <= Some(9.0),
                    "{technique}: {:?}",
                    later.work
                );
                let places = |output: &crate::Output| {
                    let vertices = output.vertices.iter().flatten();
                    vertices
                        .map(|vertex| (vertex.at, vertex.state))
                        .collect::<Vec<_>>()
                };
                assert_eq!(places(&later), places(&first), "{technique}");
            }
        }
    }

    #[test]
    fn a_slow_camera_needs_few_steps() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        let spec = parse("linear(start=previous)").expect("a technique");
        let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
        let first = prepared
            .render()
            .expect("renders")
            .work
            .steps
            .expect("a search that steps");
        for frame in 1..4 {
            prepared
                .update(&scene.at(frame))
                .expect("the same scene, moved");
            let steps = prepared
                .render()
                .expect("renders")
                .work
                .steps
                .expect("a search that steps");
            assert!(
                (1.0..0.1 * first).contains(&steps),
                "frame {frame}: {steps} of {first}"
            );
        }
    }
}

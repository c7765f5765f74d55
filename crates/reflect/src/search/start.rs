//! Searches in the image that start at one texel for all vertices: the projection of the mirror's
//! centre or of its bounding box's centre; the pass `start` (`start.wesl`). The pass tests that one
//! texel, as `MirrorCenter` of Szabo 2013, Alg. 3.2, does, and scans the image for the nearest one
//! only if that texel does not show the mirror.

use catoptric_scene::{Mirror, View};
use glam::{DVec2, Vec2};

use super::{Context, Pipelines, Search, Sheet};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, set_uniform, storage_zeros,
    uniform,
};
use crate::options::words;
use crate::stage::Stage;
use crate::stage::points::Points;
use crate::stage::variant::Variant;

words! {
    /// Where a search starts.
    pub(crate) enum Start {
        /// The mirror's projected middle.
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

    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        self.starts.record(frame, stage, mirror);
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.starts.groups[sheet.mirror];
        (self.pipelines).record(frame, (stage, sheet.mirror), points, own, variant);
    }
}

/// The start texels of all mirrors, found anew in each frame.
struct Starts {
    /// Of a search's group 3: the start texel.
    layout: wgpu::BindGroupLayout,
    /// One a mirror.
    groups: Vec<wgpu::BindGroup>,
    from_bounds: bool,
    look: Kernel,
    nearest: Kernel,
    choose: Kernel,
    mirrors: Vec<StartTexel>,
}

struct StartTexel {
    /// Wanted image coordinates.
    wanted: wgpu::Buffer,
    /// Index of the texel found, then the square of its distance from the wanted one.
    texel: wgpu::Buffer,
    find: wgpu::BindGroup,
    /// Workgroups of the scan: none where the wanted texel shows the mirror.
    scan: wgpu::Buffer,
    decide: wgpu::BindGroup,
}

impl Starts {
    fn new(context: &Context<'_>, start: Start) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let from_bounds = start == Start::Bounds;
        let find = layout(gpu, "start found", &[Slot::Uniform, Slot::Write]);
        let decide = layout(gpu, "start scan", &[Slot::Write]);
        let read = layout(gpu, "start", &[Slot::Read]);
        let module = module(gpu, "start", &[])?;
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&find),
            Some(&decide),
        ];
        let [scanning, deciding] = [&layouts[..3], &layouts[..]];
        let mirrors = (0..stage.world.mirrors.len()).map(|index| {
            let wanted = uniform(gpu, &start_point(stage, index, from_bounds));
            let texel = storage_zeros(gpu, 8);
            let scan = storage_zeros(gpu, 12);
            let resources = [wanted.as_entire_binding(), texel.as_entire_binding()];
            StartTexel {
                find: group(gpu, &find, &resources),
                decide: group(gpu, &decide, &[scan.as_entire_binding()]),
                scan,
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
            look: compute(gpu, &module, "look", deciding),
            nearest: compute(gpu, &module, "nearest", scanning),
            choose: compute(gpu, &module, "choose", scanning),
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

    /// Records the pass `start` for a mirror whose maps are the stage's.
    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        let start = &self.mirrors[mirror];
        frame.compute("start", |pass| {
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &start.find, &[]);
            pass.set_bind_group(3, &start.decide, &[]);
            pass.set_pipeline(&self.look);
            pass.dispatch_workgroups(1, 1, 1);
            for kernel in [&self.nearest, &self.choose] {
                pass.set_pipeline(kernel);
                pass.dispatch_workgroups_indirect(&start.scan, 0);
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
    let center = view.project(mirror.shape.middle()).map(|(at, _)| at);
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

#[cfg(test)]
mod tests {
    use catoptric_scene::Scene;
    use glam::DVec3;

    use super::*;
    use crate::search::Instrumentation;
    use crate::stage::points::points_layout;
    use crate::testing::{gpu_or_skip, scene, stage};

    const SIZE: [u32; 2] = [160, 120];

    /// Workgroups of the scan, in x and y.
    fn scanned(gpu: &Gpu, scene: &Scene) -> [u32; 2] {
        let stage = stage(gpu, scene, SIZE);
        let context = Context {
            gpu,
            stage: &stage,
            extends: false,
            points_layout: &points_layout(gpu),
            instrumentation: Instrumentation::Efforts,
        };
        let starts = Starts::new(&context, Start::Center).expect("fits the device");
        gpu.run(|frame| {
            stage.begin(frame, Variant::AllLayers);
            starts.record(frame, &stage, 0);
        });
        let bytes = gpu.read_buffer_part(&starts.mirrors[0].scan, 8);
        [0, 4].map(|from| bytemuck::pod_read_unaligned(&bytes[from..][..4]))
    }

    #[test]
    fn the_image_is_scanned_only_where_the_middle_shows_no_mirror() {
        let Some(gpu) = gpu_or_skip() else { return };
        for name in ["sphere-square", "ellipsoid", "bowl", "prototype-bowl"] {
            assert_eq!(scanned(&gpu, &scene(name)), [0, 0], "{name}");
        }
        // Nearly along its axis, the middle of a torus shows its hole.
        let mut torus = scene("torus");
        torus.camera.target = torus.mirrors[0].shape.center();
        torus.camera.eye = torus.camera.target + 5.0 * DVec3::Z;
        assert_eq!(scanned(&gpu, &torus), [20, 15]);
    }
}

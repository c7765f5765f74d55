//! The control: the reference's reflected rays, traced on the GPU in `f32` over an obvhs
//! hierarchy. What it does not match of the reference is the harness's own noise; its time is what
//! an application would pay instead of any other technique.
//!
//! The hierarchy is obvhs's compressed wide one, uploaded as it is, with the triangles copied in
//! its order. It covers the objects, not the mirrors (truth `first-bounce`).

use std::time::Duration;

use catoptric_frame::Work;
use catoptric_scene::Scene;
use glam::Vec3;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::triangle::Triangle;

use super::ImageOrder;
use crate::ReflectError;
use crate::gpu::Gpu;
use crate::recorder::Recorder;
use crate::resources::{Slot, compute, group, layout, module, storage_bytes, storage_zeros, view};
use crate::spec::Options;
use crate::stage::Stage;
use crate::technique::Variant;

/// Side of a workgroup in pixels.
const GROUP: u32 = 8;

/// The pass `trace`, for all mirror pixels or for those that another technique leaves open.
pub(crate) struct RayTrace {
    layout: wgpu::BindGroupLayout,
    trace: wgpu::ComputePipeline,
    counting: wgpu::ComputePipeline,
    hierarchy: Hierarchy,
    /// Nodes and triangles tested, a pair of `u32` a pixel.
    counts: wgpu::Buffer,
    /// Colours of a technique before, −1 in w where it has no answer; all others are left alone.
    left_open: Option<wgpu::TextureView>,
    group: wgpu::BindGroup,
}

/// The scene's triangles as the shader reads them.
struct Hierarchy {
    nodes: wgpu::Buffer,
    /// 48 bytes each, in the hierarchy's order.
    triangles: wgpu::Buffer,
}

pub(crate) fn make(
    gpu: &Gpu,
    _options: &Options,
    stage: &Stage,
) -> Result<Box<dyn ImageOrder>, ReflectError> {
    Ok(Box::new(RayTrace::new(gpu, stage, None)?))
}

impl RayTrace {
    /// `left_open`: only where this image has −1 in w.
    pub(crate) fn new(
        gpu: &Gpu,
        stage: &Stage,
        left_open: Option<&wgpu::Texture>,
    ) -> Result<Self, ReflectError> {
        let left_open = left_open.map(view);
        let mut slots = vec![
            Slot::Read,
            Slot::Read,
            Slot::Image,
            Slot::Image,
            Slot::Write,
        ];
        let mut features = Vec::new();
        if left_open.is_some() {
            slots.push(Slot::Texture);
            features.push("fallback");
        }
        let layout = layout(gpu, "ray trace", &slots);
        let pipeline = |features: &[&str]| -> Result<_, ReflectError> {
            let layouts = [
                Some(&stage.world.view_layout),
                Some(&stage.gbuffer.mirror_layout),
                Some(&stage.world.surface_layout),
                Some(&layout),
            ];
            let module = module(gpu, "ray_trace", features)?;
            Ok(compute(gpu, &module, "reflections", &layouts))
        };
        let [width, height] = stage.world.size.map(u64::from);
        let counts = storage_zeros(gpu, width * height * 8);
        let hierarchy = Hierarchy::new(gpu, &stage.world.scene)?;
        let trace = pipeline(&features)?;
        features.push("count");
        Ok(Self {
            trace,
            counting: pipeline(&features)?,
            group: bind(gpu, &layout, &hierarchy, stage, &counts, left_open.as_ref()),
            left_open,
            layout,
            hierarchy,
            counts,
        })
    }
}

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    hierarchy: &Hierarchy,
    stage: &Stage,
    counts: &wgpu::Buffer,
    left_open: Option<&wgpu::TextureView>,
) -> wgpu::BindGroup {
    let color = view(&stage.reflections.color);
    let position = view(&stage.reflections.position);
    let mut resources = vec![
        hierarchy.nodes.as_entire_binding(),
        hierarchy.triangles.as_entire_binding(),
        wgpu::BindingResource::TextureView(&color),
        wgpu::BindingResource::TextureView(&position),
        counts.as_entire_binding(),
    ];
    resources.extend(left_open.map(wgpu::BindingResource::TextureView));
    group(gpu, layout, &resources)
}

impl Hierarchy {
    fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, ReflectError> {
        let meshes = scene.objects.iter().map(|object| &object.mesh);
        let triangles: Vec<Triangle> = meshes
            .flat_map(|mesh| {
                let corner = |vertex: u32| mesh.positions[vertex as usize].into();
                let triangles = mesh.triangles.iter();
                triangles.map(move |triangle| {
                    let [v0, v1, v2] = triangle.map(corner);
                    Triangle { v0, v1, v2 }
                })
            })
            .collect();
        if triangles.is_empty() {
            return Ok(Self {
                nodes: storage_zeros(gpu, 80),
                triangles: storage_zeros(gpu, 48),
            });
        }
        let params = BvhBuildParams::medium_build();
        let hierarchy = build_cwbvh_from_tris(&triangles, params, &mut Duration::default());
        let order = hierarchy.primitive_indices.iter();
        let ordered: Vec<[f32; 12]> = order
            .map(|&index| {
                let Triangle { v0, v1, v2 } = triangles[index as usize];
                let [a, b, c] = [v0, v1, v2].map(Vec3::from);
                let index = f32::from_bits(index);
                [a.x, a.y, a.z, index, b.x, b.y, b.z, 0.0, c.x, c.y, c.z, 0.0]
            })
            .collect();
        let nodes: &[u8] = bytemuck::cast_slice(&hierarchy.nodes);
        let ordered: &[u8] = bytemuck::cast_slice(&ordered);
        gpu.check_binding(nodes.len().max(ordered.len()) as u64)?;
        Ok(Self {
            nodes: storage_bytes(gpu, nodes),
            triangles: storage_bytes(gpu, ordered),
        })
    }
}

impl ImageOrder for RayTrace {
    /// Builds the hierarchy anew: any object may have moved.
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        self.hierarchy = Hierarchy::new(gpu, &stage.world.scene)?;
        let left_open = self.left_open.as_ref();
        self.group = bind(
            gpu,
            &self.layout,
            &self.hierarchy,
            stage,
            &self.counts,
            left_open,
        );
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        let [width, height] = stage.world.size.map(|side| side.div_ceil(GROUP));
        frame.compute("trace", |pass| {
            pass.set_pipeline(match variant {
                Variant::AllLayers => &self.counting,
                Variant::Color => &self.trace,
            });
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.gbuffer.mirror_groups[0], &[]);
            pass.set_bind_group(2, &stage.world.surface_group, &[]);
            pass.set_bind_group(3, &self.group, &[]);
            pass.dispatch_workgroups(width, height, 1);
        });
    }

    /// Nodes as `node_tests`, triangles as `evaluations`.
    fn work(&self, gpu: &Gpu, stage: &Stage) -> Work {
        let counts: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&gpu.read_buffer(&self.counts));
        let mirrors = gpu.read_texture(&stage.gbuffer.position);
        let pixels = mirrors.iter().filter(|texel| texel[3] > 0.0).count();
        let mean = |index: usize| {
            let counts = counts.iter().map(|count| f64::from(count[index]));
            counts.sum::<f64>() / pixels.max(1) as f64
        };
        Work {
            node_tests: mean(0),
            evaluations: mean(1),
            ..Work::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::parse;
    use crate::testing::{gpu_or_skip, scene};
    use crate::timing::Timer;

    /// Object ids at the mirror's pixels.
    fn ids(gpu: &Gpu, technique: &RayTrace, stage: &Stage) -> Vec<u32> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut unstamped = Timer::none();
        let mut frame = Recorder::new(&mut encoder, &mut unstamped);
        stage.begin(&mut frame, Variant::AllLayers);
        technique.record(&mut frame, stage, Variant::AllLayers);
        stage.finish(&mut frame);
        gpu.queue.submit([encoder.finish()]);
        let texels = gpu.read_texture(&stage.reflections.position);
        texels.iter().map(|texel| texel[3] as u32).collect()
    }

    #[test]
    fn the_picture_comes_from_the_triangles_in_the_hierarchy() {
        let Some(gpu) = gpu_or_skip() else { return };
        let spec = parse("ray-trace").expect("a technique");
        let scene = scene("sphere-square");
        let stage = Stage::new(&gpu, &spec.options, &scene, [96, 72]).expect("fits the device");
        let technique = RayTrace::new(&gpu, &stage, None).expect("fits the device");
        let before = ids(&gpu, &technique, &stage);
        assert!(before.contains(&1), "the square is reflected");
        assert_eq!(before, ids(&gpu, &technique, &stage));
        // The first triangle of the copy becomes a point.
        let triangles = &technique.hierarchy.triangles;
        gpu.queue.write_buffer(triangles, 0, &[0; 48]);
        let after = ids(&gpu, &technique, &stage);
        let lost = before
            .iter()
            .zip(&after)
            .filter(|(a, b)| **a == 1 && **b == 0);
        let seen = before.iter().filter(|id| **id == 1).count();
        assert!(lost.count() > seen / 5, "{seen} pixels showed the square");
    }
}

//! The mirror G-buffer: position and normal of the mirror seen at each pixel (Szabo 2013, §3.1).

use crate::ReflectError;
use crate::gpu::Gpu;
use crate::primary::Primary;
use crate::recorder::{Begin, Recorder};
use crate::resources::{FLOAT4, RasterTargets, Slot, group, layout, module, raster, target, view};
use crate::world::World;

/// The pass `gbuffer` and its targets.
pub(crate) struct GBuffer {
    /// World-space position and mirror id; all 0 where the first surface is no mirror.
    pub position: wgpu::Texture,
    /// Unit normal on the reflecting side, and the side seen (`SIDE_…` of `shared/mirror.wesl`).
    pub normal: wgpu::Texture,
    /// Group 1 of every pass that reads a mirror: `shared/mirror.wesl`.
    pub mirror_layout: wgpu::BindGroupLayout,
    /// One a mirror.
    pub mirror_groups: Vec<wgpu::BindGroup>,
    /// Group 1 while the G-buffer is drawn: the uniform alone. One a mirror.
    draw_groups: Vec<wgpu::BindGroup>,
    exact: wgpu::RenderPipeline,
    mesh: wgpu::RenderPipeline,
}

impl GBuffer {
    pub(crate) fn new(gpu: &Gpu, world: &World) -> Result<Self, ReflectError> {
        let position = target(gpu, "mirror position", world.size, FLOAT4);
        let normal = target(gpu, "mirror normal", world.size, FLOAT4);
        let (position_view, normal_view) = (view(&position), view(&normal));
        let mirror_layout = layout(
            gpu,
            "mirror",
            &[Slot::Uniform, Slot::Texture, Slot::Texture],
        );
        let mirror_groups = world.mirrors.iter().map(|mirror| {
            let resources = [
                mirror.uniform.as_entire_binding(),
                wgpu::BindingResource::TextureView(&position_view),
                wgpu::BindingResource::TextureView(&normal_view),
            ];
            group(gpu, &mirror_layout, &resources)
        });
        let draw_layout = layout(gpu, "mirror drawn", &[Slot::Uniform]);
        let draw_groups = world
            .mirrors
            .iter()
            .map(|mirror| group(gpu, &draw_layout, &[mirror.uniform.as_entire_binding()]));
        let module = module(gpu, "gbuffer", &[])?;
        let corner = wgpu::VertexBufferLayout {
            array_stride: 36,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3],
        };
        let pipeline = |entry| {
            let targets = RasterTargets {
                colors: 2,
                depth: true,
            };
            let layouts = [Some(&world.view_layout), Some(&draw_layout)];
            let buffers = [Some(corner.clone())];
            raster(gpu, &module, entry, targets, &layouts, &buffers)
        };
        Ok(Self {
            mirror_groups: mirror_groups.collect(),
            draw_groups: draw_groups.collect(),
            exact: pipeline("exact"),
            mesh: pipeline("mesh"),
            position,
            normal,
            mirror_layout,
        })
    }

    /// Draws every mirror over the depth of the objects.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, world: &World, primary: &Primary) {
        let targets = [view(&self.position), view(&self.normal)];
        let targets = [&targets[0], &targets[1]];
        let depth = Some((&primary.depth, Begin::Keep));
        frame.render("gbuffer", &targets, Begin::Clear, depth, |pass| {
            for (mirror, group) in world.mirrors.iter().zip(&self.draw_groups) {
                pass.set_pipeline(if mirror.exact {
                    &self.exact
                } else {
                    &self.mesh
                });
                pass.set_bind_group(0, &world.view_group, &[]);
                pass.set_bind_group(1, group, &[]);
                pass.set_vertex_buffer(0, mirror.vertices.slice(..));
                pass.draw(0..mirror.vertex_count, 0..1);
            }
        });
    }
}

//! The mirror G-buffer: position and normal of the mirror seen at each pixel (Szabo 2013, §3.1).

use crate::error::ReflectError;
use crate::gpu::{
    Begin, DEPTH, FLOAT4, Gpu, RasterTargets, Recorder, Slot, group, layout, module, raster,
    target, view,
};
use crate::stage::world::World;

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
        let module = module(gpu, "stage/gbuffer", &[])?;
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

    /// Draws every mirror over a depth, such as that of the objects.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        world: &World,
        depth: (&wgpu::Texture, Begin),
    ) {
        let targets = [view(&self.position), view(&self.normal)];
        let targets = [&targets[0], &targets[1]];
        frame.render("gbuffer", &targets, Begin::Clear, Some(depth), |pass| {
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

/// A G-buffer of the mirrors alone, as if no object stood before them.
///
/// A walk over the image that goes on beyond what the mirror shows must not end at the outline of
/// an object, either: the reflection point may lie on the object's other side, or behind it.
pub(crate) struct MirrorsAlone {
    pub gbuffer: GBuffer,
    depth: wgpu::Texture,
}

impl MirrorsAlone {
    pub(crate) fn new(gpu: &Gpu, world: &World) -> Result<Self, ReflectError> {
        Ok(Self {
            gbuffer: GBuffer::new(gpu, world)?,
            depth: target(gpu, "depth of the mirrors alone", world.size, DEPTH),
        })
    }

    /// Draws every mirror.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, world: &World) {
        (self.gbuffer).record(frame, world, (&self.depth, Begin::Clear));
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use crate::testing::{gpu_or_skip, scene};

    const SIZE: [u32; 2] = [200, 150];

    /// 99th percentile of the angle between the directions reflected by the shader's hit and by
    /// the exact one: what single precision costs, far below the width of a pixel.
    const ANGLE_P99_DEG: f64 = 0.01;

    /// Share of pixels that may be seen as mirror by one and not by the other: rays that graze it.
    const GRAZING: f64 = 0.002;

    #[test]
    fn exact_hits_are_those_of_the_surface() {
        let Some(gpu) = gpu_or_skip() else { return };
        for name in ["ellipsoid", "bowl", "torus", "saddle"] {
            let scene = scene(name);
            let spec = crate::parse("linear").expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, SIZE).expect("fits");
            let primary = prepared
                .render()
                .expect("a frame")
                .frame
                .primary
                .expect("layers");
            let (view, shape) = (scene.camera.view(SIZE), &scene.mirrors[0].shape);
            let (mut angles, mut unlike) = (Vec::new(), 0);
            for (index, id) in primary.id.pixels().iter().enumerate() {
                let (x, y) = (index as u32 % SIZE[0], index as u32 / SIZE[0]);
                let dir = view.ray(DVec2::new(f64::from(x), f64::from(y)) + 0.5);
                let hit = shape.intersect(view.eye, dir, 0.0);
                if *id != scene.mirror_id(0) {
                    // An object may hide it; the background does not.
                    unlike += u32::from(*id == 0 && hit.is_some());
                    continue;
                }
                let Some(hit) = hit else {
                    unlike += 1;
                    continue;
                };
                let reflected = |normal: DVec3| dir - 2.0 * dir.dot(normal) * normal;
                let drawn = primary.normal.at(x, y).as_dvec3().normalize();
                let angle = reflected(hit.normal).angle_between(reflected(drawn));
                angles.push(angle.to_degrees());
            }
            angles.sort_by(f64::total_cmp);
            let p99 = angles[angles.len() * 99 / 100];
            println!(
                "{name}: {} pixels, p99 {p99:e}°, {unlike} unlike",
                angles.len()
            );
            assert!(angles.len() > 2000, "{name}: {} pixels", angles.len());
            assert!(p99 < ANGLE_P99_DEG, "{name}: {p99}°");
            let share = f64::from(unlike) / angles.len() as f64;
            assert!(share <= GRAZING, "{name}: {unlike} pixels unlike");
        }
    }
}

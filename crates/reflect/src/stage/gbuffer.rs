//! The mirror G-buffer: position and normal of the mirror seen at each pixel (Szabo 2013, §3.1).

use std::ops::Range;

use crate::error::ReflectError;
use crate::gpu::{
    Begin, FLOAT4, Gpu, RasterEntries, Recorder, Slot, group, layout, module, raster_to, target,
    view,
};
use crate::stage::world::{MirrorPipelines, World};

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
    pipelines: MirrorPipelines,
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
        let entries = [
            "vertex",
            "exact",
            "triangle_vertex",
            "exact_triangle",
            "mesh",
        ];
        let pipelines = MirrorPipelines::new(entries, |[vertex, fragment], buffers| {
            let entries = RasterEntries {
                module: &module,
                vertex,
                fragment,
            };
            let layouts = [
                Some(&world.view_layout),
                Some(&draw_layout),
                None,
                Some(&world.corners_layout),
            ];
            raster_to(gpu, entries, &[FLOAT4; 2], true, &layouts, buffers)
        });
        Ok(Self {
            mirror_groups: mirror_groups.collect(),
            draw_groups: draw_groups.collect(),
            pipelines,
            position,
            normal,
            mirror_layout,
        })
    }

    /// Records a pass that draws some mirrors (indices) over a depth, such as that of the objects.
    pub(crate) fn record(
        &self,
        frame: &mut Recorder<'_>,
        pass: &str,
        world: &World,
        mirrors: Range<usize>,
        depth: (&wgpu::Texture, Begin),
    ) {
        let targets = [view(&self.position), view(&self.normal)];
        let targets = [&targets[0], &targets[1]];
        frame.render(pass, &targets, Begin::Clear, Some(depth), |pass| {
            let drawn = world.mirrors[mirrors.clone()].iter();
            for (mirror, group) in drawn.zip(&self.draw_groups[mirrors]) {
                pass.set_bind_group(0, &world.view_group, &[]);
                pass.set_bind_group(1, group, &[]);
                self.pipelines.draw(pass, mirror);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Mesh, Shape};
    use glam::{DVec2, DVec3, Vec3};

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

    /// Distance between the shader's hit and the exact one, as a share of the distance to the eye, and
    /// between the normals, both times the cosine of incidence: a triangle seen from the side turns a
    /// rounding step of its plane into as much more along the ray. Some ten steps of single precision;
    /// the smooth mesh, whose normals turn by one over its radius, is four radii away.
    const POSITION: f64 = 1e-6;
    const NORMAL: f64 = 4e-6;

    /// The nearest triangle that a ray meets, not at its edge: position, interpolated normal, cosine of
    /// incidence.
    fn exact(mesh: &Mesh, eye: DVec3, dir: DVec3) -> Option<(DVec3, DVec3, f64)> {
        const EDGE: f64 = 1e-3;
        let hits = mesh.triangles.iter().zip(&mesh.normals);
        let hits = hits.filter_map(|(triangle, normals)| {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize].as_dvec3() - eye);
            let across = (b - a).cross(c - a);
            let t = a.dot(across) / dir.dot(across);
            let weights = [b.cross(c), c.cross(a), a.cross(b)].map(|n| dir.dot(n));
            let sum: f64 = weights.iter().sum();
            let [u, v, w] = weights.map(|weight| weight / sum);
            let [na, nb, nc] = normals.map(Vec3::as_dvec3);
            let normal = (u * na + v * nb + w * nc).normalize();
            let cosine = dir.dot(across.normalize()).abs();
            let least = u.min(v).min(w);
            (t > 0.0 && least > -EDGE).then_some((t, least, (normal, cosine)))
        });
        let (t, least, (normal, cosine)) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (least > EDGE).then_some((eye + t * dir, normal, cosine))
    }

    #[test]
    fn a_mesh_is_met_exactly_whatever_the_rasterizer_makes_of_it() {
        let Some(gpu) = gpu_or_skip() else { return };
        let faceted = scene("faceted");
        let mut smooth = scene("sphere-square");
        let mesh = smooth.mirrors[0].shape.tessellate(40);
        smooth.mirrors[0].shape = Shape::Mesh(mesh);
        for (name, scene) in [("faceted", faceted), ("smooth", smooth)] {
            let view = scene.camera.view(SIZE);
            let mesh = scene.mirrors[0].shape.as_mesh().expect("a mesh");
            let (position, normal) = {
                let spec = crate::parse("linear").expect("a technique");
                let mut prepared = crate::prepare(&gpu, &spec, &scene, SIZE).expect("fits");
                let frame = prepared.render().expect("a frame").frame;
                let primary = frame.primary.expect("layers");
                let (mut count, mut position, mut normal) = (0, 0.0_f64, 0.0_f64);
                for (index, id) in primary.id.pixels().iter().enumerate() {
                    let (x, y) = (index as u32 % SIZE[0], index as u32 / SIZE[0]);
                    let dir = view.ray(DVec2::new(f64::from(x), f64::from(y)) + 0.5);
                    if *id != scene.mirror_id(0) {
                        continue;
                    }
                    let Some((hit, upright, cosine)) = exact(mesh, view.eye, dir) else {
                        continue;
                    };
                    count += 1;
                    let drawn = primary.position.at(x, y).as_dvec3();
                    let off = drawn.distance(hit) / hit.distance(view.eye);
                    position = position.max(off * cosine);
                    let off = primary.normal.at(x, y).as_dvec3().distance(upright);
                    normal = normal.max(off * cosine);
                }
                println!("{name}: {count} pixels, {position:e}, {normal:e}");
                assert!(count > 1000, "{name}: {count} pixels");
                (position, normal)
            };
            assert!(
                position < POSITION && normal < NORMAL,
                "{name}: {position:e}, {normal:e}"
            );
        }
    }
}

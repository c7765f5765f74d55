//! The mirrors as second and later rays meet them: shapes that are known exactly are intersected one by
//! one, all others are triangles that are sent down the hierarchy with those of the objects.

use crate::gpu::{Gpu, storage, storage_bytes};
use crate::stage::Stage;
use crate::stage::mirror::MirrorUniform;
use crate::stage::world::PointsFrom;
use catoptric_scene::Scene;
use glam::{DVec3, Vec3};

/// Of a triangle: its corners, counter-clockwise seen from the front, the first with the mirror's id as
/// w; then their shading normals.
type Corners = [[f32; 4]; 6];

/// All mirrors of a scene on the GPU.
pub(super) struct Mirrors {
    /// By mirror: where its points come from.
    points: Vec<PointsFrom>,
    /// [`MirrorUniform`]s, as `beams/bounce.wesl` reads them; never empty.
    pub(super) exact: wgpu::Buffer,
    pub(super) exact_count: u32,
    /// Of the other mirrors' triangles.
    pub(super) corners: wgpu::Buffer,
    /// The same here, where the positions are at first.
    pub(super) triangles: Vec<[Vec3; 3]>,
}

impl Mirrors {
    /// Takes a scene's mirrors as they are.
    pub(super) fn new(gpu: &Gpu, stage: &Stage) -> Self {
        let points: Vec<_> = stage
            .world
            .mirrors
            .iter()
            .map(|mirror| mirror.points)
            .collect();
        let exact = exact(&stage.world.scene, &points);
        let corners = corners(&stage.world.scene, &points);
        let position = |corner: &[f32; 4]| Vec3::new(corner[0], corner[1], corner[2]);
        let positions = |corners: &Corners| [0, 1, 2].map(|corner| position(&corners[corner]));
        Self {
            exact_count: points.iter().filter(|from| is_exact(**from)).count() as u32,
            exact: storage(gpu, &exact),
            corners: storage_bytes(gpu, bytemuck::cast_slice(&corners)),
            triangles: corners.iter().map(positions).collect(),
            points,
        }
    }

    /// Takes over where they are now.
    pub(super) fn update(&self, gpu: &Gpu, scene: &Scene) {
        crate::gpu::set_storage(gpu, &self.exact, &exact(scene, &self.points));
        let corners = corners(scene, &self.points);
        if !corners.is_empty() {
            let corners = bytemuck::cast_slice(&corners);
            gpu.queue.write_buffer(&self.corners, 0, corners);
        }
    }
}

fn is_exact(points: PointsFrom) -> bool {
    points == PointsFrom::Surface
}

/// Those that are met exactly; one that stands for none where there are none, as no list may be empty.
fn exact(scene: &Scene, points: &[PointsFrom]) -> Vec<MirrorUniform> {
    let mirrors = scene.mirrors.iter().zip(points).enumerate();
    let exact = mirrors.filter(|(_, (_, points))| is_exact(**points));
    let uniform = |index: usize| {
        let shape = &*scene.mirrors[index].shape;
        MirrorUniform::new(shape, scene.mirror_id(index), DVec3::ZERO)
    };
    let exact: Vec<_> = exact.map(|(index, _)| uniform(index)).collect();
    match exact.is_empty() {
        true => vec![uniform(0)],
        false => exact,
    }
}

/// The triangles of those that are met by their triangles.
fn corners(scene: &Scene, points: &[PointsFrom]) -> Vec<Corners> {
    let mut all = Vec::new();
    for (index, (mirror, points)) in scene.mirrors.iter().zip(points).enumerate() {
        if is_exact(*points) {
            continue;
        }
        let id = scene.mirror_id(index) as f32;
        let mesh = mirror.shape.tessellate(mirror.tessellation);
        for (triangle, normals) in mesh.triangles.iter().zip(&mesh.normals) {
            let [a, mut b, mut c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
            let [normal_a, mut normal_b, mut normal_c] = *normals;
            if (b - a).cross(c - a).dot(normals.iter().sum()) < 0.0 {
                (b, c) = (c, b);
                (normal_b, normal_c) = (normal_c, normal_b);
            }
            all.push([
                a.extend(id).to_array(),
                b.extend(1.0).to_array(),
                c.extend(1.0).to_array(),
                normal_a.extend(0.0).to_array(),
                normal_b.extend(0.0).to_array(),
                normal_c.extend(0.0).to_array(),
            ]);
        }
    }
    all
}

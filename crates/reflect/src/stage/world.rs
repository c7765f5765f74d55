//! A scene on the GPU: the eye, the objects' surfaces and the mirrors, as every pass reads them.

use catoptric_frame::Name;
use catoptric_scene::{Mesh, Mirror, Scene};
use glam::Vec3;

use crate::error::ReflectError;
use crate::gpu::{Gpu, Slot, buffer, group, layout, set_uniform, storage, storage_bytes, uniform};
use crate::stage::geometry::{Geometry, positions};
use crate::stage::mirror::MirrorUniform;
use crate::stage::options::Under;
use crate::stage::view::ViewUniform;

/// A scene on the GPU, for one image size.
pub(crate) struct World {
    /// Width and height of the image in pixels.
    pub size: [u32; 2],
    /// The scene as it stands now.
    pub scene: Scene,
    /// Group 0 of every pass: `shared/view.wesl`.
    pub view_layout: wgpu::BindGroupLayout,
    pub view_group: wgpu::BindGroup,
    view: wgpu::Buffer,
    under: Under,
    /// Group 2 of passes that draw objects: `shared/surface.wesl`.
    pub surface_layout: wgpu::BindGroupLayout,
    pub surface_group: wgpu::BindGroup,
    /// World-space positions of all objects' vertices, one after the other, w = 1.
    pub positions: wgpu::Buffer,
    /// Three times the number of triangles of all objects.
    pub corners: u32,
    pub mirrors: Vec<MirrorOnGpu>,
    /// Group 3 of passes that draw mirrors: `mirror_corners` of `shared/mirror_mesh.wesl`.
    pub corners_layout: wgpu::BindGroupLayout,
}

/// A mirror on the GPU.
pub(crate) struct MirrorOnGpu {
    pub id: u32,
    pub points: PointsFrom,
    /// A [`MirrorUniform`].
    pub uniform: wgpu::Buffer,
    /// Position, shading normal and face normal of each corner of the drawn triangles.
    vertices: wgpu::Buffer,
    vertex_count: u32,
    /// For [`World::corners_layout`].
    corners_group: wgpu::BindGroup,
}

/// Where the points of a mirror that are seen come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PointsFrom {
    /// Each eye ray is intersected with the surface itself; triangles only cover it.
    Surface,
    /// Each eye ray is intersected with the triangle that covers its pixel.
    Triangle,
    /// The rasterizer interpolates them between a triangle's corners.
    Rasterizer,
}

impl PointsFrom {
    fn of(mirror: &Mirror, exact: bool) -> Self {
        match (exact, mirror.shape.is_analytic()) {
            (true, true) => Self::Surface,
            (true, false) => Self::Triangle,
            (false, _) => Self::Rasterizer,
        }
    }
}

/// The pipelines that draw mirrors, by where their points come from.
pub(crate) struct MirrorPipelines {
    pub surface: wgpu::RenderPipeline,
    pub triangle: wgpu::RenderPipeline,
    pub rasterizer: wgpu::RenderPipeline,
}

impl MirrorPipelines {
    /// Made by a function from entry points of a vertex and a fragment shader, and what of vertices
    /// the first reads from a buffer.
    pub(crate) fn new(
        [vertex, surface, triangle_vertex, triangle, rasterizer]: [&'static str; 5],
        make: impl Fn(
            [&'static str; 2],
            &[Option<wgpu::VertexBufferLayout<'_>>],
        ) -> wgpu::RenderPipeline,
    ) -> Self {
        let corner = wgpu::VertexBufferLayout {
            array_stride: 36,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3],
        };
        let corners = [Some(corner)];
        Self {
            surface: make([vertex, surface], &corners),
            triangle: make([triangle_vertex, triangle], &[]),
            rasterizer: make([vertex, rasterizer], &corners),
        }
    }

    /// Draws a mirror; groups 0 and 1 are bound by the caller.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, mirror: &MirrorOnGpu) {
        pass.set_pipeline(match mirror.points {
            PointsFrom::Surface => &self.surface,
            PointsFrom::Triangle => &self.triangle,
            PointsFrom::Rasterizer => &self.rasterizer,
        });
        pass.set_bind_group(3, &mirror.corners_group, &[]);
        if mirror.points != PointsFrom::Triangle {
            pass.set_vertex_buffer(0, mirror.vertices.slice(..));
        }
        pass.draw(0..mirror.vertex_count, 0..1);
    }
}

impl World {
    /// Puts a scene on the GPU. `exact`: mirrors are intersected by each eye ray.
    pub(crate) fn new(
        gpu: &Gpu,
        scene: &Scene,
        size: [u32; 2],
        exact: bool,
        under: Under,
    ) -> Result<Self, ReflectError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        if size[0].max(size[1]) > limit || size[0].min(size[1]) == 0 {
            return Err(ReflectError::Size { size, limit });
        }
        let geometry = Geometry::new(scene);
        let view_layout = layout(gpu, "view", &[Slot::Uniform]);
        let view = uniform(gpu, &ViewUniform::new(scene, size, under));
        let surface_layout = layout(gpu, "surface", &[Slot::Read; 4]);
        let positions = storage_bytes(gpu, bytemuck::cast_slice(&geometry.positions));
        let surface_group = group(
            gpu,
            &surface_layout,
            &[
                positions.as_entire_binding(),
                storage(gpu, &geometry.corners).as_entire_binding(),
                storage(gpu, &geometry.materials).as_entire_binding(),
                storage_bytes(gpu, bytemuck::cast_slice(&geometry.texels)).as_entire_binding(),
            ],
        );
        let eye = scene.camera.view(size).eye;
        let corners_layout = layout(gpu, "mirror corners", &[Slot::Read]);
        let unread = storage_bytes(gpu, &[]);
        let mirrors = scene
            .mirrors
            .iter()
            .enumerate()
            .map(|(index, mirror)| {
                let points = PointsFrom::of(mirror, exact);
                let corners = mirror_corners(mirror, points);
                let id = scene.mirror_id(index);
                let usage = wgpu::BufferUsages::COPY_DST
                    | match points {
                        PointsFrom::Triangle => wgpu::BufferUsages::STORAGE,
                        _ => wgpu::BufferUsages::VERTEX,
                    };
                let vertices = buffer(gpu, "mirror", bytemuck::cast_slice(&corners), usage);
                let read = match points {
                    PointsFrom::Triangle => &vertices,
                    _ => &unread,
                };
                MirrorOnGpu {
                    id,
                    points,
                    uniform: uniform(gpu, &MirrorUniform::new(&*mirror.shape, id, eye)),
                    vertex_count: corners.len() as u32,
                    corners_group: group(gpu, &corners_layout, &[read.as_entire_binding()]),
                    vertices,
                }
            })
            .collect();
        gpu.check()?;
        Ok(Self {
            size,
            scene: scene.clone(),
            view_group: group(gpu, &view_layout, &[view.as_entire_binding()]),
            view_layout,
            view,
            under,
            surface_layout,
            surface_group,
            positions,
            corners: geometry.corners.len() as u32,
            mirrors,
            corners_layout,
        })
    }

    /// Takes over what moved: eye, vertex positions, mirrors.
    ///
    /// # Errors
    /// A scene with other numbers of vertices, corners or mirrors.
    pub(crate) fn update(&mut self, gpu: &Gpu, scene: &Scene) -> Result<(), ReflectError> {
        let counts = |scene: &Scene| {
            let mirrors = scene.mirrors.iter().map(|mirror| mirror.tessellation);
            let mirrors: Vec<_> = mirrors.collect();
            (scene.vertex_count(), scene.triangle_count(), mirrors)
        };
        if counts(scene) != counts(&self.scene) {
            return Err(ReflectError::OtherScene);
        }
        set_uniform(
            gpu,
            &self.view,
            &ViewUniform::new(scene, self.size, self.under),
        );
        let positions = positions(scene);
        gpu.queue
            .write_buffer(&self.positions, 0, bytemuck::cast_slice(&positions));
        let eye = scene.camera.view(self.size).eye;
        for (on_gpu, mirror) in self.mirrors.iter().zip(&scene.mirrors) {
            let data = MirrorUniform::new(&*mirror.shape, on_gpu.id, eye);
            set_uniform(gpu, &on_gpu.uniform, &data);
            let corners = mirror_corners(mirror, on_gpu.points);
            gpu.queue
                .write_buffer(&on_gpu.vertices, 0, bytemuck::cast_slice(&corners));
        }
        self.scene = scene.clone();
        Ok(())
    }

    /// Number of unique vertices of all objects.
    pub(crate) fn vertices(&self) -> u32 {
        self.scene.vertex_count() as u32
    }

    /// `(object id, vertex)` of each position, in order.
    pub(crate) fn places(&self) -> impl Iterator<Item = (u32, u32)> {
        let objects = self.scene.objects.iter().zip(1_u32..);
        objects.flat_map(|(object, id)| {
            (0..object.mesh.positions.len() as u32).map(move |vertex| (id, vertex))
        })
    }

    /// Names of all ids.
    pub(crate) fn names(&self) -> Vec<Name> {
        let ids = self.scene.ids().into_iter();
        ids.map(|(id, name, mirror)| Name { id, name, mirror })
            .collect()
    }
}

/// Position, shading normal and face normal of each corner of the triangles a mirror is drawn
/// from: slightly outside the surface where each pixel intersects the surface itself.
fn mirror_corners(mirror: &Mirror, points: PointsFrom) -> Vec<[Vec3; 3]> {
    let mesh = match points {
        PointsFrom::Surface => mirror.shape.cover(mirror.tessellation),
        _ => mirror.shape.tessellate(mirror.tessellation),
    };
    corners(&mesh)
}

fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    let mut corners = Vec::with_capacity(mesh.triangles.len() * 3);
    for (triangle, normals) in mesh.triangles.iter().zip(&mesh.normals) {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let face = (b - a).cross(c - a).normalize_or_zero();
        let face = if face.dot(normals[0] + normals[1] + normals[2]) < 0.0 {
            -face
        } else {
            face
        };
        corners.extend(
            [a, b, c]
                .into_iter()
                .zip(*normals)
                .map(|(position, normal)| [position, normal, face]),
        );
    }
    corners
}

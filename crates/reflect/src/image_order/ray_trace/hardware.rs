//! The driver's own acceleration structure, for ray queries in hardware: all objects' triangles in
//! one geometry, so that a triangle's index is the one in `shared/surface.wesl`.

use catoptric_scene::Scene;

use crate::gpu::{Gpu, Recorder, buffer};

/// Bytes from one vertex to the next.
const STRIDE: u64 = 12;

/// Vertices and triangles, and what the driver makes of them.
pub(super) struct Hardware {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    size: wgpu::BlasTriangleGeometrySizeDescriptor,
    blas: wgpu::Blas,
    pub(super) tlas: wgpu::Tlas,
}

impl Hardware {
    /// Takes the triangles of all objects; [`Hardware::build`] makes them traceable.
    pub(super) fn new(gpu: &Gpu, scene: &Scene) -> Self {
        let mut positions: Vec<[f32; 3]> = Vec::new();
        let mut indices: Vec<u32> = Vec::new();
        for object in &scene.objects {
            let first = positions.len() as u32;
            positions.extend(
                object
                    .mesh
                    .positions
                    .iter()
                    .map(|position| position.to_array()),
            );
            let triangles = object.mesh.triangles.as_flattened();
            indices.extend(triangles.iter().map(|vertex| first + vertex));
        }
        if indices.is_empty() {
            // A structure needs a triangle; no ray meets a point.
            positions = vec![[0.0; 3]];
            indices = vec![0; 3];
        }
        let traced = |contents: &[u8]| {
            buffer(
                gpu,
                "traced triangles",
                contents,
                wgpu::BufferUsages::BLAS_INPUT,
            )
        };
        let size = wgpu::BlasTriangleGeometrySizeDescriptor {
            vertex_format: wgpu::VertexFormat::Float32x3,
            vertex_count: positions.len() as u32,
            index_format: Some(wgpu::IndexFormat::Uint32),
            index_count: Some(indices.len() as u32),
            flags: wgpu::AccelerationStructureGeometryFlags::OPAQUE,
        };
        let flags = wgpu::AccelerationStructureFlags::PREFER_FAST_TRACE;
        let update_mode = wgpu::AccelerationStructureUpdateMode::Build;
        let blas = gpu.device.create_blas(
            &wgpu::CreateBlasDescriptor {
                label: Some("objects"),
                flags,
                update_mode,
            },
            wgpu::BlasGeometrySizeDescriptors::Triangles {
                descriptors: vec![size.clone()],
            },
        );
        let mut tlas = gpu.device.create_tlas(&wgpu::CreateTlasDescriptor {
            label: Some("scene"),
            max_instances: 1,
            flags,
            update_mode,
        });
        let identity = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        tlas[0] = Some(wgpu::TlasInstance::new(&blas, identity, 0, 0xff));
        Self {
            vertices: traced(bytemuck::cast_slice(&positions)),
            indices: traced(bytemuck::cast_slice(&indices)),
            size,
            blas,
            tlas,
        }
    }

    /// Records the build, on the GPU.
    pub(super) fn build(&self, frame: &mut Recorder<'_>) {
        let geometry = wgpu::BlasTriangleGeometry {
            size: &self.size,
            vertex_buffer: &self.vertices,
            first_vertex: 0,
            vertex_stride: STRIDE,
            index_buffer: Some(&self.indices),
            first_index: Some(0),
            transform_buffer: None,
            transform_buffer_offset: None,
        };
        let entry = wgpu::BlasBuildEntry {
            blas: &self.blas,
            geometry: wgpu::BlasGeometries::TriangleGeometries(vec![geometry]),
        };
        frame.build_acceleration_structures(&entry, &self.tlas);
    }
}

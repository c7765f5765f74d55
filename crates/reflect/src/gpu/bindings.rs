//! Bind groups: numbered lists of buffers and textures, as a shader's `@group(…)` reads them.

use super::device::Gpu;
use super::textures::FLOAT4;

/// What a binding of a group is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Slot {
    /// Uniform buffer.
    Uniform,
    /// Read-only storage buffer.
    Read,
    /// Storage buffer that shaders write; compute stage only.
    Write,
    /// Texture of unfilterable floats, read by `textureLoad`.
    Texture,
    /// Array of such textures.
    Textures,
    /// A [`FLOAT4`] image that shaders write; compute stage only.
    Image,
    /// Image of four `u32` that shaders write; compute stage only.
    Numbers,
    /// Acceleration structure for ray queries.
    Structure,
    /// Layers of two floats that shaders write; compute stage only.
    WriteArray,
}

/// A bind group layout with bindings 0, 1, … as listed; all stages see them, except that only
/// compute shaders see what they may write.
pub(crate) fn layout(gpu: &Gpu, label: &str, slots: &[Slot]) -> wgpu::BindGroupLayout {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = |view_dimension| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension,
        multisampled: false,
    };
    let entries: Vec<_> = (0..)
        .zip(slots)
        .map(|(binding, slot)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: match slot {
                Slot::Write | Slot::Image | Slot::Numbers | Slot::WriteArray | Slot::Structure => {
                    wgpu::ShaderStages::COMPUTE
                }
                _ => wgpu::ShaderStages::all(),
            },
            ty: match slot {
                Slot::Uniform => buffer(wgpu::BufferBindingType::Uniform),
                Slot::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
                Slot::Write => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
                Slot::Texture => texture(wgpu::TextureViewDimension::D2),
                Slot::Textures => texture(wgpu::TextureViewDimension::D2Array),
                Slot::Image => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: FLOAT4,
                    view_dimension: wgpu::TextureViewDimension::D2,
                },
                Slot::Numbers => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: wgpu::TextureFormat::Rgba32Uint,
                    view_dimension: wgpu::TextureViewDimension::D2,
                },
                Slot::Structure => wgpu::BindingType::AccelerationStructure {
                    vertex_return: false,
                },
                Slot::WriteArray => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: wgpu::TextureFormat::Rg32Float,
                    view_dimension: wgpu::TextureViewDimension::D2Array,
                },
            },
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        })
}

/// A bind group with bindings 0, 1, … as listed.
pub(crate) fn group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry {
            binding,
            resource: resource.clone(),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}

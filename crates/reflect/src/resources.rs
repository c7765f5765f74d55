//! Buffers, textures, bind groups and pipelines, in the few forms that the passes use.

use encase::{ShaderSize, ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use wgpu::util::DeviceExt;

use crate::ReflectError;
use crate::gpu::Gpu;
use crate::shaders;

/// Format of every colour target: linear, exact, and readable without conversion.
pub(crate) const FLOAT4: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// Format of every depth target; depth is reversed, 0 is infinitely far.
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Most workgroups in one dimension on every adapter.
const MAX_GROUPS: u32 = 65535;

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
                Slot::Write | Slot::Image | Slot::WriteArray | Slot::Structure => {
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

/// A uniform buffer that holds `value`.
pub(crate) fn uniform<T: ShaderType + WriteInto>(gpu: &Gpu, value: &T) -> wgpu::Buffer {
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: &uniform_bytes(value),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        })
}

/// Overwrites a buffer made by [`uniform`].
pub(crate) fn set_uniform<T: ShaderType + WriteInto>(gpu: &Gpu, buffer: &wgpu::Buffer, value: &T) {
    gpu.queue.write_buffer(buffer, 0, &uniform_bytes(value));
}

fn uniform_bytes<T: ShaderType + WriteInto>(value: &T) -> Vec<u8> {
    let mut bytes = UniformBuffer::new(Vec::new());
    bytes.write(value).expect("writing to memory");
    bytes.into_inner()
}

/// A storage buffer that holds `values`; never empty, as no binding may be.
pub(crate) fn storage<T: ShaderType + ShaderSize + WriteInto>(
    gpu: &Gpu,
    values: &Vec<T>,
) -> wgpu::Buffer {
    let mut bytes = StorageBuffer::new(Vec::new());
    if !values.is_empty() {
        bytes.write(values).expect("writing to memory");
    }
    storage_bytes(gpu, bytes.as_ref())
}

/// Overwrites the beginning of a storage buffer.
pub(crate) fn set_storage<T: ShaderType + WriteInto>(gpu: &Gpu, buffer: &wgpu::Buffer, value: &T) {
    let mut bytes = StorageBuffer::new(Vec::new());
    bytes.write(value).expect("writing to memory");
    gpu.queue.write_buffer(buffer, 0, bytes.as_ref());
}

/// A storage buffer that holds `bytes`; never empty, as no binding may be.
pub(crate) fn storage_bytes(gpu: &Gpu, bytes: &[u8]) -> wgpu::Buffer {
    const EMPTY: [u8; 64] = [0; 64];
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: if bytes.is_empty() { &EMPTY } else { bytes },
            usage: STORAGE,
        })
}

/// A storage buffer of `bytes` zeros, at least 64.
pub(crate) fn storage_zeros(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: bytes.max(64),
        usage: STORAGE,
        mapped_at_creation: false,
    })
}

const STORAGE: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE
    .union(wgpu::BufferUsages::COPY_DST)
    .union(wgpu::BufferUsages::COPY_SRC)
    .union(wgpu::BufferUsages::INDIRECT);

/// An image to render to and, unless it is a depth image, to read and to write from shaders.
pub(crate) fn target(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    let extra = if format == DEPTH {
        wgpu::TextureUsages::empty()
    } else {
        wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::STORAGE_BINDING
    };
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | extra,
        view_formats: &[],
    })
}

/// A square [`FLOAT4`] image with all its levels, written by compute shaders; `side` is a power of
/// two.
pub(crate) fn pyramid(gpu: &Gpu, label: &str, side: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: 1,
        },
        mip_level_count: side.ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FLOAT4,
        usage: wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// One level of a texture.
pub(crate) fn level_view(texture: &wgpu::Texture, level: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        base_mip_level: level,
        mip_level_count: Some(1),
        ..Default::default()
    })
}

/// Square layers `[side, layers]` to read by `textureLoad`, and for whatever `usage` says.
pub(crate) fn texture_array(
    gpu: &Gpu,
    label: &str,
    [side, layers]: [u32; 2],
    levels: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: side,
            height: side,
            depth_or_array_layers: layers,
        },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// The whole of a texture.
pub(crate) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Links and compiles a program of `shaders/` with the given features on.
pub(crate) fn module(
    gpu: &Gpu,
    program: &str,
    features: &[&str],
) -> Result<wgpu::ShaderModule, ReflectError> {
    let text = shaders::link(program, features).map_err(ReflectError::Shader)?;
    Ok(gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        }))
}

fn pipeline_layout(gpu: &Gpu, layouts: &[Option<&wgpu::BindGroupLayout>]) -> wgpu::PipelineLayout {
    gpu.device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: layouts,
            immediate_size: 0,
        })
}

/// A compute pipeline; `layouts` are those of groups 0, 1, …, `None` for a group not used.
pub(crate) fn compute(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    entry: &str,
    layouts: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::ComputePipeline {
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&pipeline_layout(gpu, layouts)),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
}

/// What a raster pipeline draws to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RasterTargets {
    /// Number of [`FLOAT4`] colour targets.
    pub colors: usize,
    /// Depth test (greater wins) and write.
    pub depth: bool,
}

/// A raster pipeline of triangle lists, drawn from both sides, with the vertex entry `vertex`.
pub(crate) fn raster(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    fragment: &str,
    targets: RasterTargets,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> wgpu::RenderPipeline {
    let entries = RasterEntries {
        module,
        vertex: "vertex",
        fragment,
    };
    let formats = vec![FLOAT4; targets.colors];
    raster_to(gpu, entries, &formats, targets.depth, layouts, buffers)
}

/// The two ends of a raster pipeline.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RasterEntries<'a> {
    pub module: &'a wgpu::ShaderModule,
    pub vertex: &'a str,
    pub fragment: &'a str,
}

/// A raster pipeline to colour targets of any formats; `depth` as in [`RasterTargets`].
pub(crate) fn raster_to(
    gpu: &Gpu,
    RasterEntries {
        module,
        vertex,
        fragment,
    }: RasterEntries<'_>,
    formats: &[wgpu::TextureFormat],
    depth: bool,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> wgpu::RenderPipeline {
    let color = |format: &wgpu::TextureFormat| {
        Some(wgpu::ColorTargetState {
            format: *format,
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
        })
    };
    let colors: Vec<_> = formats.iter().map(color).collect();
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&pipeline_layout(gpu, layouts)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: depth.then(|| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &colors,
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Workgroups in x and y that give at least `count` groups; a shader finds its group's index as
/// `x + y · num_workgroups.x`.
pub(crate) fn dispatch_size(count: u32) -> [u32; 2] {
    [count.min(MAX_GROUPS), count.div_ceil(MAX_GROUPS)]
}

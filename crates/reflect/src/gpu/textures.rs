//! Textures and views, in the few forms that the passes use.

use super::device::Gpu;

/// Format of every colour target: linear, exact, and readable without conversion.
pub(crate) const FLOAT4: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// Format of every depth target; depth is reversed, 0 is infinitely far.
pub(crate) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A texture that the device can hold, or else one of a single texel.
fn texture(gpu: &Gpu, descriptor: &wgpu::TextureDescriptor<'_>) -> wgpu::Texture {
    if gpu.allows_texture(descriptor) {
        return gpu.device.create_texture(descriptor);
    }
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        size: wgpu::Extent3d::default(),
        mip_level_count: 1,
        ..descriptor.clone()
    })
}

/// Square [`FLOAT4`] layers `[side, layers]` that hold `texels`, layer by layer, to read by
/// `textureLoad`.
pub(crate) fn texture_with(
    gpu: &Gpu,
    label: &str,
    [side, layers]: [u32; 2],
    texels: &[[f32; 4]],
) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::COPY_SRC;
    let texture = texture_array(gpu, label, [side, layers], 1, FLOAT4, usage);
    if texture.width() == side && texture.depth_or_array_layers() == layers {
        gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(16 * side),
                rows_per_image: Some(side),
            },
            texture.size(),
        );
    }
    texture
}

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
    texture(
        gpu,
        &wgpu::TextureDescriptor {
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
        },
    )
}

/// An image of four `u32` that compute shaders write and others read.
pub(crate) fn texture_of_numbers(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
) -> wgpu::Texture {
    texture(
        gpu,
        &wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Uint,
            usage: wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        },
    )
}

/// A square [`FLOAT4`] image with all its levels, written by compute shaders; `side` is a power of
/// two.
pub(crate) fn pyramid(gpu: &Gpu, label: &str, side: u32) -> wgpu::Texture {
    image_with_levels(gpu, label, [side; 2], side.ilog2() + 1)
}

/// A [`FLOAT4`] image with so many levels, written by compute shaders.
pub(crate) fn image_with_levels(
    gpu: &Gpu,
    label: &str,
    [width, height]: [u32; 2],
    levels: u32,
) -> wgpu::Texture {
    texture(
        gpu,
        &wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FLOAT4,
            usage: wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        },
    )
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
    texture(
        gpu,
        &wgpu::TextureDescriptor {
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
        },
    )
}

/// The whole of a texture.
pub(crate) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

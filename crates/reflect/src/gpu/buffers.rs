//! Uniform and storage buffers, laid out by encase as the shaders read them.

use encase::{ShaderSize, ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use wgpu::util::DeviceExt;

use super::device::Gpu;

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

//! Uniform and storage buffers, laid out by encase as the shaders read them.

use encase::{ShaderSize, ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use wgpu::util::DeviceExt;

use super::device::Gpu;

/// A uniform buffer that holds `value`.
pub(crate) fn uniform<T: ShaderType + WriteInto>(gpu: &Gpu, value: &T) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    buffer(gpu, "uniform", &uniform_bytes(value), usage)
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
    buffer(gpu, "storage", bytes, STORAGE)
}

/// A storage buffer of `bytes` zeros, at least 64.
pub(crate) fn storage_zeros(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    empty(gpu, "zeros", bytes, STORAGE)
}

/// A buffer that holds `bytes`, or 64 zeros where there are none.
pub(crate) fn buffer(
    gpu: &Gpu,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> wgpu::Buffer {
    let size = bytes.len() as u64;
    if bytes.is_empty() || !gpu.allows_buffer(size, usage) {
        return stand_in(gpu, label, usage);
    }
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents: bytes,
            usage,
        })
}

/// A buffer of `bytes` zeros, at least 64.
pub(super) fn empty(gpu: &Gpu, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    if bytes <= STAND_IN || !gpu.allows_buffer(bytes, usage) {
        return stand_in(gpu, label, usage);
    }
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes,
        usage,
        mapped_at_creation: false,
    })
}

/// A small buffer of zeros.
fn stand_in(gpu: &Gpu, label: &str, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: STAND_IN,
        usage,
        mapped_at_creation: false,
    })
}

/// Bytes of the smallest buffer.
const STAND_IN: u64 = 64;

const STORAGE: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE
    .union(wgpu::BufferUsages::COPY_DST)
    .union(wgpu::BufferUsages::COPY_SRC)
    .union(wgpu::BufferUsages::INDIRECT);

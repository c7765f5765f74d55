//! Reading results back: buffers and textures created with `COPY_SRC`, part by part, so that what is
//! read may be larger than any buffer.
//!
//! Where the device fails, zeros are read, and [`Gpu::check`] tells.

use super::buffers::empty;
use super::device::Gpu;
use super::error::BuildError;

/// Most bytes that are read at a time, unless a single row of texels has more.
const PART: u64 = 64 << 20;

impl Gpu {
    /// Bytes of a buffer that was created with `COPY_SRC`.
    pub(crate) fn read_buffer(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        self.read_buffer_part(buffer, buffer.size())
    }

    /// The first `size` bytes (a multiple of 4) of a buffer that was created with `COPY_SRC`.
    pub(crate) fn read_buffer_part(&self, buffer: &wgpu::Buffer, size: u64) -> Vec<u8> {
        let mut bytes = Vec::new();
        while (bytes.len() as u64) < size {
            let first = bytes.len() as u64;
            let part = self.read_by(PART.min(size - first), |encoder, staging| {
                encoder.copy_buffer_to_buffer(buffer, first, staging, 0, PART.min(size - first));
            });
            bytes.extend(part);
        }
        bytes
    }

    /// Texels of an `Rgba32Float` texture created with `COPY_SRC`, rows from the top.
    pub(crate) fn read_texture(&self, texture: &wgpu::Texture) -> Vec<[f32; 4]> {
        self.read_level(texture, 0)
    }

    /// [`Gpu::read_texture`] of one mip level.
    pub(crate) fn read_level(&self, texture: &wgpu::Texture, level: u32) -> Vec<[f32; 4]> {
        let floats = self.read_layers(texture, level);
        floats.as_chunks().0.to_vec()
    }

    /// One mip level of all layers of a texture of floats created with `COPY_SRC`: by layer, row from
    /// the top, column, channel.
    pub(crate) fn read_layers(&self, texture: &wgpu::Texture, level: u32) -> Vec<f32> {
        let size = [texture.width(), texture.height()].map(|side| (side >> level).max(1));
        let mut floats = Vec::new();
        for layer in 0..texture.depth_or_array_layers() {
            self.read_layer(texture, [level, layer], size, PART, &mut floats);
        }
        floats
    }

    /// Adds one mip level of one layer, in parts of at most `most` bytes or a row.
    fn read_layer(
        &self,
        texture: &wgpu::Texture,
        [level, layer]: [u32; 2],
        [width, height]: [u32; 2],
        most: u64,
        floats: &mut Vec<f32>,
    ) {
        let bytes = 4 * width * u32::from(texture.format().components());
        let row = bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let rows = ((most / u64::from(row)) as u32).clamp(1, height);
        for first in (0..height).step_by(rows as usize) {
            let rows = rows.min(height - first);
            let part = self.read_by(u64::from(row) * u64::from(rows), |encoder, staging| {
                encoder.copy_texture_to_buffer(
                    wgpu::TexelCopyTextureInfo {
                        mip_level: level,
                        origin: wgpu::Origin3d {
                            x: 0,
                            y: first,
                            z: layer,
                        },
                        ..texture.as_image_copy()
                    },
                    wgpu::TexelCopyBufferInfo {
                        buffer: staging,
                        layout: wgpu::TexelCopyBufferLayout {
                            offset: 0,
                            bytes_per_row: Some(row),
                            rows_per_image: Some(rows),
                        },
                    },
                    wgpu::Extent3d {
                        width,
                        height: rows,
                        depth_or_array_layers: 1,
                    },
                );
            });
            for line in part.chunks_exact(row as usize) {
                let values = line[..bytes as usize].chunks_exact(4);
                floats.extend(values.map(bytemuck::pod_read_unaligned::<f32>));
            }
        }
    }

    /// Bytes of a buffer that `copy` fills.
    fn read_by(
        &self,
        bytes: u64,
        copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    ) -> Vec<u8> {
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let staging = empty(self, "readback", bytes, usage);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        copy(&mut encoder, &staging);
        self.queue.submit([encoder.finish()]);
        let budget = self.budget.clone();
        staging.map_async(wgpu::MapMode::Read, .., move |result| {
            if let Err(error) = result {
                budget.note(BuildError::Device(format!("nothing is read: {error}")));
            }
        });
        self.wait();
        let mut read = match staging.get_mapped_range(..) {
            Ok(range) => range.to_vec(),
            Err(error) => {
                self.budget.note(BuildError::Device(error.to_string()));
                Vec::new()
            }
        };
        // A stand-in is larger or smaller.
        read.resize(bytes as usize, 0);
        self.budget.forget(bytes);
        read
    }
}

#[cfg(test)]
mod tests {
    use crate::gpu::{FLOAT4, texture_with};
    use crate::testing::gpu_or_skip;

    #[test]
    fn parts_make_the_whole() {
        let Some(gpu) = gpu_or_skip() else { return };
        let texels: Vec<[f32; 4]> = (0..2 * 37 * 37)
            .map(|index| [0.0, 0.25, 0.5, 0.75].map(|more| index as f32 + more))
            .collect();
        let texture = texture_with(&gpu, "numbers", [37, 2], &texels);
        assert_eq!(texture.format(), FLOAT4);
        for most in [1, 2000, 5000, 1 << 20] {
            let mut floats = Vec::new();
            for layer in 0..2 {
                gpu.read_layer(&texture, [0, layer], [37; 2], most, &mut floats);
            }
            assert!(floats == texels.as_flattened(), "{most} bytes at a time");
        }
    }
}

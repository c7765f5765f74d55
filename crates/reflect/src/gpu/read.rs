//! Reading results back: buffers and textures created with `COPY_SRC`.

use super::device::Gpu;

impl Gpu {
    /// Bytes of a buffer that was created with `COPY_SRC`.
    pub(crate) fn read_buffer(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        self.read_buffer_part(buffer, buffer.size())
    }

    /// The first `size` bytes (a multiple of 4) of a buffer that was created with `COPY_SRC`.
    pub(crate) fn read_buffer_part(&self, buffer: &wgpu::Buffer, size: u64) -> Vec<u8> {
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
        self.queue.submit([encoder.finish()]);
        self.mapped(&staging)
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
        let [width, height] =
            [texture.width(), texture.height()].map(|side| (side >> level).max(1));
        let layers = texture.depth_or_array_layers();
        let texels = width as usize * texture.format().components() as usize;
        let row = (4 * texels as u32).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(row) * u64::from(height * layers),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                mip_level: level,
                ..texture.as_image_copy()
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row),
                    rows_per_image: Some(height),
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: layers,
            },
        );
        self.queue.submit([encoder.finish()]);
        let bytes = self.mapped(&staging);
        bytes
            .chunks_exact(row as usize)
            .flat_map(|line| line[..4 * texels].chunks_exact(4))
            .map(bytemuck::pod_read_unaligned)
            .collect()
    }

    fn mapped(&self, staging: &wgpu::Buffer) -> Vec<u8> {
        staging.map_async(wgpu::MapMode::Read, .., |result| {
            result.expect("a staging buffer can be mapped");
        });
        self.wait();
        staging
            .get_mapped_range(..)
            .expect("the buffer was just mapped")
            .to_vec()
    }
}

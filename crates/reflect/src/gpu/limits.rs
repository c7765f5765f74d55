//! The limits of a device, checked before anything is made on it, and the faults that happen all the
//! same.
//!
//! Code that makes a buffer or a texture need not check anything: what is beyond a limit is noted
//! and a small stand-in is made, as wgpu itself goes on with invalid resources. [`Gpu::check`]
//! reports the fault, before anything is read from them.

use super::device::Gpu;
use super::error::BuildError;

/// Most bytes of buffers and textures that one technique makes, on any device: the largest picture
/// takes less. More would fail on most devices, and on a software device could bring down the
/// machine.
const MOST_BYTES: u64 = 8 << 30;

impl Gpu {
    /// Begins to count and to look for faults.
    pub(crate) fn begin(&self) {
        self.budget.begin();
    }

    /// What went wrong since the last [`Gpu::begin`].
    ///
    /// # Errors
    /// The first thing.
    pub(crate) fn check(&self) -> Result<(), BuildError> {
        self.budget.take_fault().map_or(Ok(()), Err)
    }

    /// Bytes of buffers and textures made since the last [`Gpu::begin`], and kept.
    #[cfg(test)]
    pub(crate) fn made(&self) -> u64 {
        self.budget.bytes()
    }

    /// Refuses what takes more memory than there may be.
    ///
    /// # Errors
    /// [`BuildError::Memory`].
    pub(crate) fn check_memory(&self, more: u64) -> Result<(), BuildError> {
        let bytes = self.budget.bytes().saturating_add(more);
        if bytes > MOST_BYTES {
            let limit = MOST_BYTES;
            return Err(BuildError::Memory { bytes, limit });
        }
        Ok(())
    }

    /// Whether a buffer can be made; counts it if so, and else notes why not.
    pub(super) fn allows_buffer(&self, bytes: u64, usage: wgpu::BufferUsages) -> bool {
        let limits = self.device.limits();
        let seen = [
            (
                wgpu::BufferUsages::STORAGE,
                limits.max_storage_buffer_binding_size,
            ),
            (
                wgpu::BufferUsages::UNIFORM,
                limits.max_uniform_buffer_binding_size,
            ),
        ];
        let seen = seen.into_iter().filter(|(kind, _)| usage.contains(*kind));
        let limit = seen.fold(limits.max_buffer_size, |least, (_, limit)| least.min(limit));
        self.count(
            bytes,
            (bytes > limit).then_some(BuildError::Buffer { bytes, limit }),
        )
    }

    /// Whether a texture can be made; counts it if so, and else notes why not.
    pub(super) fn allows_texture(&self, descriptor: &wgpu::TextureDescriptor<'_>) -> bool {
        let limits = self.device.limits();
        let limit = [
            limits.max_texture_dimension_2d,
            limits.max_texture_array_layers,
        ];
        let wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        } = descriptor.size;
        let beyond = width.max(height) > limit[0] || layers > limit[1];
        let needed = [width, height, layers];
        let levels = 0..descriptor.mip_level_count;
        let texels = levels.map(|level| {
            let [width, height] = [width, height].map(|side| u64::from(side >> level).max(1));
            width * height
        });
        let texel = descriptor.format.block_copy_size(None).unwrap_or(4);
        let bytes = texels.sum::<u64>() * u64::from(layers) * u64::from(texel);
        self.count(
            bytes,
            beyond.then_some(BuildError::Texture { needed, limit }),
        )
    }

    fn count(&self, bytes: u64, beyond: Option<BuildError>) -> bool {
        let fault = beyond.or_else(|| self.check_memory(bytes).err());
        let allowed = fault.is_none();
        match fault {
            Some(fault) => self.budget.note(fault),
            None => self.budget.add(bytes),
        }
        allowed
    }
}

#[cfg(test)]
mod tests {
    use crate::gpu::{BuildError, DEPTH, FLOAT4, storage_zeros, target, texture_array};
    use crate::testing::gpu_or_skip;

    #[test]
    fn what_is_beyond_the_device_is_told_with_its_limit() {
        let Some(gpu) = gpu_or_skip() else { return };
        let limits = gpu.device.limits();
        gpu.begin();
        let bytes = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size)
            + 4;
        storage_zeros(&gpu, bytes);
        // Only the first is told.
        target(&gpu, "wide", [u32::MAX, 1], DEPTH);
        let error = gpu.check().unwrap_err();
        assert!(
            matches!(error, BuildError::Buffer { bytes: b, .. } if b == bytes),
            "{error}"
        );
        assert!(gpu.check().is_ok(), "told once");

        gpu.begin();
        let usage = wgpu::TextureUsages::COPY_SRC;
        let layers = limits.max_texture_array_layers + 1;
        texture_array(&gpu, "many", [4, layers], 1, FLOAT4, usage);
        let error = gpu.check().unwrap_err();
        assert!(matches!(error, BuildError::Texture { .. }), "{error}");

        gpu.begin();
        for _ in 0..2 {
            texture_array(&gpu, "much", [8192, 4], 1, FLOAT4, usage);
            if let Err(error) = gpu.check() {
                assert!(
                    matches!(error, BuildError::Memory { .. } | BuildError::OutOfMemory),
                    "{error}"
                );
                return;
            }
        }
        panic!("8 GiB and more were made");
    }

    #[test]
    fn errors_of_the_device_are_no_panics() {
        let Some(gpu) = gpu_or_skip() else { return };
        gpu.begin();
        let buffer = storage_zeros(&gpu, 64);
        // Copies beyond the buffer's end.
        assert_eq!(gpu.read_buffer_part(&buffer, 128), vec![0; 128]);
        let error = gpu.check().unwrap_err();
        assert!(matches!(error, BuildError::Device(_)), "{error}");
        gpu.begin();
        assert_eq!(gpu.read_buffer(&buffer), vec![0; 64]);
        assert!(gpu.check().is_ok());
    }
}

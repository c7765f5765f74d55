//! The device: choosing an adapter on purpose, and reading results back.

use thiserror::Error;

const RAY_QUERY: wgpu::Features = wgpu::Features::EXPERIMENTAL_RAY_QUERY;

/// A wgpu device and what is known about its adapter.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: AdapterInfo,
}

/// What an adapter is called and can do.
#[derive(Clone, Debug, PartialEq)]
pub struct AdapterInfo {
    /// As the driver names it.
    pub name: String,
    /// Driver and version.
    pub driver: String,
    /// Graphics API.
    pub backend: String,
    /// True for renderers that run on the CPU.
    pub software: bool,
    /// GPU time of passes can be measured.
    pub timestamps: bool,
    /// Rays can be traced by the hardware.
    pub ray_queries: bool,
    /// Widest or highest image.
    pub max_image: u32,
    /// Largest buffer a shader can see, in bytes.
    pub max_storage_binding: u64,
    /// Least and greatest number of lanes of a subgroup; `None` where shaders know no subgroups.
    pub subgroups: Option<[u32; 2]>,
}

/// Which kind of adapter to take where no name is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Prefer {
    /// The fastest: measuring.
    Hardware,
    /// The most reproducible: tests.
    Software,
}

/// Why there is no device.
#[derive(Debug, Error)]
pub enum GpuError {
    /// No adapter, or none of the name asked for.
    #[error("no usable graphics adapter{wanted}; {found}")]
    NoAdapter {
        /// ` named "…"`, or empty.
        wanted: String,
        /// What there is instead, or how to get one.
        found: String,
    },
    /// The adapter refuses a device.
    #[error("the adapter {adapter} gives no device: {source}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// Its reason.
        source: wgpu::RequestDeviceError,
    },
}

/// Features that are used where the adapter has them.
const WANTED: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::SUBGROUP);

fn describe(adapter: &wgpu::Adapter) -> AdapterInfo {
    let info = adapter.get_info();
    let limits = adapter.limits();
    let subgroups = adapter.features().contains(wgpu::Features::SUBGROUP);
    AdapterInfo {
        name: info.name,
        driver: format!("{} {}", info.driver, info.driver_info)
            .trim()
            .to_owned(),
        backend: info.backend.to_string(),
        software: info.device_type == wgpu::DeviceType::Cpu,
        timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        ray_queries: adapter.features().contains(RAY_QUERY),
        max_image: limits.max_texture_dimension_2d,
        // Devices are opened with the default limits.
        max_storage_binding: (limits.max_storage_buffer_binding_size)
            .min(wgpu::Limits::default().max_storage_buffer_binding_size),
        subgroups: subgroups.then_some([info.subgroup_min_size, info.subgroup_max_size]),
    }
}

/// Vulkan, Metal and DirectX 12; OpenGL lacks what the passes need.
fn enumerate() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

impl GpuError {
    /// That there is no adapter at all, and what brings one.
    pub fn no_adapter() -> Self {
        Self::NoAdapter {
            wanted: String::new(),
            found: NONE.to_owned(),
        }
    }
}

/// What is said where there is no adapter.
const NONE: &str = "there is none. On Debian and Ubuntu the packages mesa-vulkan-drivers and \
                    libvulkan1 bring a software Vulkan driver";

/// All adapters of this machine, in the order the drivers give them.
pub fn adapters() -> Vec<AdapterInfo> {
    enumerate().iter().map(describe).collect()
}

/// Asks for a device with the default limits, with what it has of [`WANTED`], and with ray queries if
/// asked for.
fn request(
    adapter: &wgpu::Adapter,
    ray_queries: bool,
) -> Result<(wgpu::Device, wgpu::Queue), wgpu::RequestDeviceError> {
    let mut descriptor = wgpu::DeviceDescriptor {
        label: Some("catoptric"),
        required_features: adapter.features() & WANTED,
        required_limits: wgpu::Limits::default().using_resolution(adapter.limits()),
        ..Default::default()
    };
    if ray_queries {
        let limits = descriptor.required_limits;
        descriptor.required_limits = limits.using_acceleration_structure_values(adapter.limits());
        descriptor.required_features |= RAY_QUERY;
        #[expect(
            unsafe_code,
            reason = "wgpu marks what may still change in it, ray queries too"
        )]
        // SAFETY: the token only says that bugs of wgpu's ray queries are known to be possible.
        let experimental = unsafe { wgpu::ExperimentalFeatures::enabled() };
        descriptor.experimental_features = experimental;
    }
    pollster::block_on(adapter.request_device(&descriptor))
}

impl Gpu {
    /// Opens the adapter whose name contains `name` (any case), else the preferred kind.
    pub fn new(name: Option<&str>, prefer: Prefer) -> Result<Self, GpuError> {
        let mut candidates: Vec<_> = enumerate()
            .into_iter()
            .map(|adapter| (describe(&adapter), adapter))
            .collect();
        let names: Vec<_> = candidates
            .iter()
            .map(|(info, _)| format!("\"{}\"", info.name))
            .collect();
        if let Some(name) = name {
            let wanted = name.to_lowercase();
            candidates.retain(|(info, _)| info.name.to_lowercase().contains(&wanted));
        }
        let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        candidates.sort_by_key(|(info, adapter)| {
            let other = info.software == (prefer == Prefer::Hardware);
            (other, rank(adapter))
        });
        let Some((mut info, adapter)) = candidates.into_iter().next() else {
            return Err(GpuError::NoAdapter {
                wanted: name
                    .map(|name| format!(" named \"{name}\""))
                    .unwrap_or_default(),
                found: if names.is_empty() {
                    NONE.to_owned()
                } else {
                    format!("there are {}", names.join(", "))
                },
            });
        };
        if info.ray_queries
            && let Ok((device, queue)) = request(&adapter, true)
        {
            return Ok(Self {
                device,
                queue,
                info,
            });
        }
        info.ray_queries = false;
        let (device, queue) = request(&adapter, false).map_err(|source| GpuError::NoDevice {
            adapter: info.name.clone(),
            source,
        })?;
        Ok(Self {
            device,
            queue,
            info,
        })
    }

    /// What was opened.
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// Puts a known compute load after a render pass and checks that its time is seen where it ran.
    pub fn timestamp_self_test(&self) -> crate::timing::SelfTest {
        crate::timing::self_test(self)
    }

    /// Refuses a buffer that no shader could see as a whole.
    pub(crate) fn check_binding(&self, bytes: u64) -> Result<(), crate::ReflectError> {
        let limit = self.device.limits().max_storage_buffer_binding_size;
        if bytes > limit {
            return Err(crate::ReflectError::TooLarge { bytes, limit });
        }
        Ok(())
    }

    /// Waits until everything submitted has run.
    pub(crate) fn wait(&self) {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device is not lost");
    }

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
            result.expect("a staging buffer can be mapped")
        });
        self.wait();
        staging
            .get_mapped_range(..)
            .expect("the buffer was just mapped")
            .to_vec()
    }
}

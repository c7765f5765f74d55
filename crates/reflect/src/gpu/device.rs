//! The device, opened on an adapter that was chosen on purpose.

use super::adapters::{AdapterInfo, Prefer, RAY_QUERY, describe, enumerate};
use super::error::{BuildError, GpuError};

/// A wgpu device and what is known about its adapter.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    info: AdapterInfo,
}

/// Features that are used where the adapter has them.
const WANTED: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::SUBGROUP);

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
            return Err(GpuError::not_found(name, &names));
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

    /// Refuses a buffer that no shader could see as a whole.
    pub(crate) fn check_binding(&self, bytes: u64) -> Result<(), BuildError> {
        let limit = self.device.limits().max_storage_buffer_binding_size;
        if bytes > limit {
            return Err(BuildError::TooLarge { bytes, limit });
        }
        Ok(())
    }

    /// Waits until everything submitted has run.
    pub(crate) fn wait(&self) {
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device is not lost");
    }
}

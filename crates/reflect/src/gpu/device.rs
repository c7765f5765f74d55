//! The device, opened on an adapter that was chosen on purpose.

use std::sync::Arc;

use super::adapters::{AdapterInfo, Prefer, RAY_QUERY, describe, enumerate};
use super::budget::Budget;
use super::error::{BuildError, GpuError};

/// A wgpu device and what is known about its adapter.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(super) budget: Budget,
    info: AdapterInfo,
}

/// Features that are used where the adapter has them.
const WANTED: wgpu::Features = wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::SUBGROUP);

/// What is asked for: the default limits, but as large buffers, images and arrays as the adapter has.
fn limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    let most = adapter.limits();
    wgpu::Limits {
        max_buffer_size: most.max_buffer_size,
        max_storage_buffer_binding_size: most.max_storage_buffer_binding_size,
        max_texture_array_layers: most.max_texture_array_layers,
        ..wgpu::Limits::default().using_resolution(most)
    }
}

/// Asks for a device with what it has of [`WANTED`], and with ray queries if asked for.
fn request(
    adapter: &wgpu::Adapter,
    ray_queries: bool,
) -> Result<(wgpu::Device, wgpu::Queue), wgpu::RequestDeviceError> {
    let mut descriptor = wgpu::DeviceDescriptor {
        label: Some("catoptric"),
        required_features: adapter.features() & WANTED,
        required_limits: limits(adapter),
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
            && let Ok(opened) = request(&adapter, true)
        {
            return Ok(Self::with(opened, info));
        }
        info.ray_queries = false;
        let opened = request(&adapter, false).map_err(|source| GpuError::NoDevice {
            adapter: info.name.clone(),
            source,
        })?;
        Ok(Self::with(opened, info))
    }

    /// A device whose errors are noted: none is a panic.
    fn with((device, queue): (wgpu::Device, wgpu::Queue), info: AdapterInfo) -> Self {
        let budget = Budget::default();
        let of_errors = budget.clone();
        device.on_uncaptured_error(Arc::new(move |error| of_errors.note_error(&error)));
        let of_loss = budget.clone();
        device.set_device_lost_callback(move |reason, message| {
            // A device that is dropped at the end is lost, too.
            if reason != wgpu::DeviceLostReason::Destroyed {
                of_loss.note(BuildError::Device(format!("it is lost: {message}")));
            }
        });
        Self {
            device,
            queue,
            budget,
            info,
        }
    }

    /// A device that somebody else has opened, whose errors and loss go where they went before.
    pub(crate) fn given(device: &wgpu::Device, queue: &wgpu::Queue) -> Self {
        let limits = device.limits();
        Self {
            device: device.clone(),
            queue: queue.clone(),
            budget: Budget::default(),
            info: AdapterInfo {
                name: "given".to_owned(),
                driver: String::new(),
                backend: String::new(),
                software: false,
                timestamps: false,
                ray_queries: false,
                max_image: limits.max_texture_dimension_2d,
                max_storage_binding: limits.max_storage_buffer_binding_size,
                subgroups: None,
            },
        }
    }

    /// What was opened.
    pub fn info(&self) -> &AdapterInfo {
        &self.info
    }

    /// Waits until everything submitted has run.
    pub(crate) fn wait(&self) {
        if let Err(error) = self.device.poll(wgpu::PollType::wait_indefinitely()) {
            self.budget.note(BuildError::Device(error.to_string()));
        }
    }
}

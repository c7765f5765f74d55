//! The adapters of this machine and what they can do.

/// The feature that ray queries in hardware need.
pub(super) const RAY_QUERY: wgpu::Features = wgpu::Features::EXPERIMENTAL_RAY_QUERY;

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
    /// Widest or highest image, pixels.
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

pub(super) fn describe(adapter: &wgpu::Adapter) -> AdapterInfo {
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
        max_storage_binding: (limits.max_storage_buffer_binding_size).min(limits.max_buffer_size),
        subgroups: subgroups.then_some([info.subgroup_min_size, info.subgroup_max_size]),
    }
}

/// Vulkan, Metal and DirectX 12; OpenGL lacks what the passes need.
pub(super) fn enumerate() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

/// All adapters of this machine, in the order the drivers give them.
pub fn adapters() -> Vec<AdapterInfo> {
    enumerate().iter().map(describe).collect()
}

//! What can be wrong with a device.

use thiserror::Error;

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

impl GpuError {
    /// That there is no adapter at all, and what brings one.
    pub fn no_adapter() -> Self {
        Self::NoAdapter {
            wanted: String::new(),
            found: NONE.to_owned(),
        }
    }

    /// That none of `names` (quoted) is asked for by `name`.
    pub(super) fn not_found(name: Option<&str>, names: &[String]) -> Self {
        Self::NoAdapter {
            wanted: name
                .map(|name| format!(" named \"{name}\""))
                .unwrap_or_default(),
            found: if names.is_empty() {
                NONE.to_owned()
            } else {
                format!("there are {}", names.join(", "))
            },
        }
    }
}

/// What is said where there is no adapter.
const NONE: &str = "there is none. On Debian and Ubuntu the packages mesa-vulkan-drivers and \
                    libvulkan1 bring a software Vulkan driver";

/// Why something cannot be made on a device.
#[derive(Debug, Error)]
pub enum BuildError {
    /// A shader does not link: a bug.
    #[error("shader: {0}")]
    Shader(String),
    /// More geometry or texels than one buffer holds.
    #[error("needs a buffer of {bytes} bytes, the device takes {limit}")]
    Buffer {
        /// Needed.
        bytes: u64,
        /// Possible.
        limit: u64,
    },
    /// A larger image, or more layers of it, than one texture holds.
    #[error(
        "needs a texture of {}x{} texels in {} layers, the device takes {}x{} in {}",
        needed[0], needed[1], needed[2], limit[0], limit[0], limit[1]
    )]
    Texture {
        /// Width, height, layers.
        needed: [u32; 3],
        /// Longest side, most layers.
        limit: [u32; 2],
    },
    /// More memory than a technique may have.
    #[error("needs {bytes} bytes of the device's memory at least, the most is {limit}")]
    Memory {
        /// Needed so far.
        bytes: u64,
        /// Possible.
        limit: u64,
    },
    /// The device has no memory left.
    #[error("the device has no memory left for it")]
    OutOfMemory,
    /// The device is gone, or refuses what it is asked for.
    #[error("the device failed: {0}")]
    Device(String),
}

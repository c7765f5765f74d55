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
    #[error("the scene needs a buffer of {bytes} bytes, the device takes {limit}")]
    TooLarge {
        /// Needed.
        bytes: u64,
        /// Possible.
        limit: u64,
    },
}

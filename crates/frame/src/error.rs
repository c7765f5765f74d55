//! What can go wrong between a frame and a file.

use std::path::PathBuf;

use thiserror::Error;

/// Why a picture could not be read or written. Every variant names the file.
#[derive(Debug, Error)]
pub enum FrameError {
    /// The file could not be opened or read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// The file could not be created, written or put in its place.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// Not an OpenEXR file, a damaged one, or one with a feature that is not supported.
    #[error("{}: not a readable OpenEXR file", path.display())]
    Exr {
        /// The file.
        path: PathBuf,
        /// What the decoder or encoder says.
        source: exr::error::Error,
    },
    /// The PNG encoder refused.
    #[error("{}: PNG encoding failed", path.display())]
    Png {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        source: ::png::EncodingError,
    },
    /// A channel that is needed is not there.
    #[error("{}: channel `{channel}` is missing; the file has {present}", path.display())]
    MissingChannel {
        /// The file.
        path: PathBuf,
        /// The channel's full name.
        channel: String,
        /// The channels that are there.
        present: String,
    },
    /// A channel holds something that it must not, or is stored in a way that is not supported.
    #[error("{}: channel `{channel}`: {reason}", path.display())]
    RefusedChannel {
        /// The file.
        path: PathBuf,
        /// The channel's full name.
        channel: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The file as a whole is not what is expected: its kind, parts, windows, header, layer sizes.
    #[error("{}: {reason}", path.display())]
    Refused {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

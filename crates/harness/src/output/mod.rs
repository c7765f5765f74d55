//! Where results go, tried before any work is done.

mod bundle;
mod draft;

use std::path::Path;

use anyhow::anyhow;
use catoptric_frame::FrameError;

use crate::exit::bad_input;

pub use self::bundle::Bundle;
pub use self::draft::{Draft, FIGURES, PICTURES};

/// Refuses a file that could not be written, before any work is done.
pub fn check_writable(path: &Path) -> anyhow::Result<()> {
    catoptric_frame::check_writable(path).map_err(|error| match error {
        FrameError::Write { path, source } => unwritable(&path, &source),
        other => bad_input(format!("cannot write {other}")),
    })
}

/// That nothing can be written there, without the name of the file that was tried.
fn unwritable(path: &Path, error: &std::io::Error) -> anyhow::Error {
    use std::io::ErrorKind::{QuotaExceeded, StorageFull};

    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    let message = format!("cannot write {}: {reason}", path.display());
    match error.kind() {
        StorageFull | QuotaExceeded => anyhow!(message),
        _ => bad_input(message),
    }
}

//! Where results go, tried before any work is done.

use std::io::ErrorKind;
use std::path::Path;

use anyhow::{Context, anyhow};

use crate::exit::bad_input;

/// Folder of all pictures, inside a page's.
pub const PICTURES: &str = "pictures";

/// Refuses a file that could not be written, before any work is done.
pub fn check_writable(path: &Path) -> anyhow::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if path.is_dir() {
        return Err(bad_input(format!(
            "cannot write {}: it is a folder",
            path.display()
        )));
    }
    match tempfile::NamedTempFile::new_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => Err(unwritable(path, &error)),
    }
}

/// That nothing can be written there, without the name of the file that was tried.
pub fn unwritable(path: &Path, error: &std::io::Error) -> anyhow::Error {
    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    let message = format!("cannot write {}: {reason}", path.display());
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => anyhow!(message),
        _ => bad_input(message),
    }
}

/// Makes the report's folder; where an earlier report is in it, without that one's pictures.
pub fn make_folder(folder: &Path) -> anyhow::Result<()> {
    if folder.is_file() {
        let text = format!("cannot write into {}: it is a file", folder.display());
        return Err(bad_input(text));
    }
    let unwritable = |error: std::io::Error| unwritable(folder, &error);
    std::fs::create_dir_all(folder).map_err(unwritable)?;
    tempfile::NamedTempFile::new_in(folder).map_err(unwritable)?;
    let pictures = folder.join(PICTURES);
    let earlier = ["index.html", "record.json"]
        .iter()
        .all(|name| folder.join(name).is_file());
    if earlier && pictures.exists() {
        std::fs::remove_dir_all(&pictures)
            .with_context(|| format!("cannot empty {}", pictures.display()))?;
    }
    std::fs::create_dir_all(&pictures).map_err(unwritable)
}

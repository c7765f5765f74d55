//! Writing a file so that it is there whole or not at all.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::FrameError;

/// Replaces the file at `path` by these bytes: it is there whole or not at all. An error names the
/// path.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FrameError> {
    let path = path.as_ref();
    write_atomically(path, |writer| {
        writer.write_all(bytes).map_err(|source| FrameError::Write {
            path: path.into(),
            source,
        })
    })
}

/// Lets `fill` write a temporary file beside `path`, then renames it to `path`. On any error the
/// temporary file is removed and what was at `path` before is untouched.
pub(crate) fn write_atomically(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<(), FrameError>,
) -> Result<(), FrameError> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    let write_error = |source| FrameError::Write {
        path: path.into(),
        source,
    };

    let Some(name) = path.file_name() else {
        return Err(FrameError::Odd {
            path: path.into(),
            reason: "is not a file name".into(),
        });
    };
    let unique = COUNTER.fetch_add(1, Ordering::Relaxed);
    let temporary = path.with_file_name(format!(
        ".{}.{}-{unique}.tmp",
        name.to_string_lossy(),
        std::process::id()
    ));

    let file = File::create(&temporary).map_err(write_error)?;
    let mut writer = BufWriter::new(file);
    let written = fill(&mut writer)
        .and_then(|()| writer.flush().map_err(write_error))
        .and_then(|()| fs::rename(&temporary, path).map_err(write_error));
    if written.is_err() {
        // The first error is the one worth reporting; a left-over temporary file is not.
        let _ = fs::remove_file(&temporary);
    }
    written
}

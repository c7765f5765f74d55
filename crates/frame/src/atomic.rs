//! Writing a file so that it is there whole or not at all.
//!
//! The bytes go to a temporary file in the same folder, with a random name that was not there
//! before, and from there to the disk before that file takes the place of the old one.

use std::fs::{self, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use crate::FrameError;

/// Temporary files that are being written.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Replaces the file at `path` by these bytes: it is there whole or not at all. A file that was
/// there keeps its mode; where `path` is a link, the file that it leads to is replaced.
///
/// # Errors
/// The file cannot be written, or what is there is no regular file. What was there is untouched.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FrameError> {
    let path = path.as_ref();
    Replacement::begin(path)?
        .finish(bytes)
        .map_err(|source| FrameError::Write {
            path: path.into(),
            source,
        })
}

/// Finds out whether [`write_whole`] could write here, and leaves everything as it is.
///
/// # Errors
/// As of [`write_whole`], apart from a full disk.
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), FrameError> {
    Replacement::begin(path.as_ref()).map(drop)
}

/// Removes the temporary files of all writes that are under way, and keeps further ones from
/// beginning: for a program that was told to end and does so next. May be called from a thread that
/// handles signals.
pub fn abandon_writes() {
    let unfinished = unfinished();
    for temporary in unfinished.iter() {
        // The program ends: nobody is left to act on a failure.
        let _ = fs::remove_file(temporary);
    }
    // Whoever begins a file waits for this lock until the program has ended.
    std::mem::forget(unfinished);
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file that is to take the place of another; dropped, it is removed.
struct Replacement {
    /// `None` once it has taken its place.
    temporary: Option<NamedTempFile>,
    target: PathBuf,
    /// Of the file that is there.
    existing: Option<Metadata>,
}

impl Replacement {
    fn begin(path: &Path) -> Result<Self, FrameError> {
        let write_error = |source| FrameError::Write {
            path: path.into(),
            source,
        };
        let refused = |reason: &str| FrameError::Refused {
            path: path.into(),
            reason: reason.into(),
        };
        if path.file_name().is_none() {
            return Err(refused("is not a file name"));
        }
        let is_link = fs::symlink_metadata(path).is_ok_and(|entry| entry.is_symlink());
        let existing = match fs::metadata(path) {
            Ok(existing) if existing.is_dir() => {
                return Err(refused("is a folder; a file's name is needed"));
            }
            Ok(existing) if !existing.is_file() => {
                return Err(refused("is a device or a pipe; a file's name is needed"));
            }
            Ok(existing) => Some(existing),
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(write_error(error));
            }
            Err(_) if is_link => return Err(refused("is a link to a file that is not there")),
            Err(_) => None,
        };
        let target = if is_link {
            fs::canonicalize(path).map_err(write_error)?
        } else {
            path.to_owned()
        };
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut unfinished = unfinished();
        let temporary = temporary_in(folder).map_err(|error| write_error(without_path(&error)))?;
        unfinished.push(temporary.path().to_owned());
        Ok(Self {
            temporary: Some(temporary),
            target,
            existing,
        })
    }

    fn finish(mut self, bytes: &[u8]) -> io::Result<()> {
        let Some(temporary) = &mut self.temporary else {
            return Ok(());
        };
        let file = temporary.as_file_mut();
        file.write_all(bytes)?;
        if let Some(existing) = &self.existing {
            file.set_permissions(existing.permissions())?;
        }
        file.sync_all()?;
        let path = temporary.path().to_owned();
        // Kept in place while it is renamed: it stays listed until it bears its new name.
        let renamed = self.temporary.take().map(|file| file.persist(&self.target));
        forget(&path);
        match renamed {
            Some(Err(failed)) => Err(without_path(&failed.error)),
            _ => Ok(()),
        }
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        if let Some(temporary) = self.temporary.take() {
            let path = temporary.path().to_owned();
            drop(temporary);
            forget(&path);
        }
    }
}

/// Takes a temporary file off the list of those to be removed.
fn forget(path: &Path) {
    unfinished().retain(|listed| listed != path);
}

/// The name is short, so that whatever name the file is to have, this one fits too.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catoptric-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As of any new file: less what the process masks.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// An error as the operating system says it, without the name of the temporary file.
fn without_path(error: &io::Error) -> io::Error {
    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    io::Error::new(error.kind(), reason.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        for text in ["one", "two"] {
            write_whole(&path, text.as_bytes()).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        check_writable(&path).unwrap();
        check_writable(folder.path().join("b")).unwrap();
        assert_eq!(names(folder.path()), ["a"]);
    }

    #[test]
    fn a_name_may_be_as_long_as_names_are() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("n".repeat(255));
        write_whole(&path, b"text").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"text");
        let longer = folder.path().join("n".repeat(256));
        assert!(matches!(
            check_writable(longer),
            Err(FrameError::Write { .. })
        ));
    }

    #[test]
    fn folders_and_missing_folders_are_refused_in_words() {
        let folder = tempfile::tempdir().unwrap();
        let error = check_writable(folder.path()).unwrap_err();
        assert!(error.to_string().contains("is a folder"), "{error}");
        let error = write_whole(folder.path().join("no/a"), b"").unwrap_err();
        let FrameError::Write { source, .. } = error else {
            panic!("{error}");
        };
        assert!(!source.to_string().contains(".tmp"), "{source}");
    }

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{PermissionsExt, symlink};

        use super::*;

        fn mode(path: &Path) -> u32 {
            fs::metadata(path).unwrap().permissions().mode() & 0o7777
        }

        #[test]
        fn an_old_file_keeps_its_mode_and_a_new_one_is_like_any_other() {
            let folder = tempfile::tempdir().unwrap();
            let [private, new, plain] = ["private", "new", "plain"].map(|n| folder.path().join(n));
            fs::write(&private, "old").unwrap();
            fs::set_permissions(&private, fs::Permissions::from_mode(0o600)).unwrap();
            write_whole(&private, b"new").unwrap();
            assert_eq!(mode(&private), 0o600);
            fs::set_permissions(&private, fs::Permissions::from_mode(0o666)).unwrap();
            write_whole(&private, b"new").unwrap();
            assert_eq!(mode(&private), 0o666);
            write_whole(&new, b"new").unwrap();
            fs::write(&plain, "by the standard library").unwrap();
            assert_eq!(mode(&new), mode(&plain));
        }

        #[test]
        fn a_link_is_kept_and_the_file_that_it_leads_to_is_replaced() {
            let folder = tempfile::tempdir().unwrap();
            fs::create_dir(folder.path().join("away")).unwrap();
            let target = folder.path().join("away/file");
            fs::write(&target, "old").unwrap();
            let link = folder.path().join("link");
            symlink("away/file", &link).unwrap();
            write_whole(&link, b"new").unwrap();
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
            assert_eq!(fs::read(&target).unwrap(), b"new");
            assert_eq!(names(&folder.path().join("away")), ["file"]);

            fs::remove_file(&target).unwrap();
            let error = write_whole(&link, b"new").unwrap_err().to_string();
            assert!(error.contains("not there"), "{error}");
            assert_eq!(names(&folder.path().join("away")), Vec::<String>::new());
        }

        #[test]
        fn devices_are_not_replaced() {
            let error = write_whole("/dev/null", b"text").unwrap_err().to_string();
            assert!(error.contains("device"), "{error}");
            assert!(!fs::metadata("/dev/null").unwrap().is_file());
        }

        #[test]
        fn two_temporary_files_differ_in_name_and_may_not_be_there_before() {
            let folder = tempfile::tempdir().unwrap();
            let [a, b] = [0, 1].map(|_| temporary_in(folder.path()).unwrap());
            assert_ne!(a.path(), b.path());
        }
    }
}

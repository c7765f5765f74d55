//! Writing a file so that it is there whole or not at all.
//!
//! The bytes go to a temporary file in the same folder, with a random name that was not there
//! before, and from there to the disk before that file takes the place of the old one.

use std::fs::{self, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::FrameError;
use crate::unfinished::{Provisional, list, sweep_once};

/// Replaces the file at `path` by these bytes: it is there whole or not at all. A file that was
/// there keeps its mode; where `path` is a link, the file that it leads to is replaced.
///
/// # Errors
/// The file cannot be written, or what is there is no regular file. What was there is untouched.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), FrameError> {
    write_together(&[(path.as_ref(), bytes)], &mut [])
}

/// Replaces several files that belong together, in this order, each as [`write_whole`] does, and keeps
/// what is in `shown`. All files are on the disk before the first one takes its place, and a signal that
/// ends the program finds either all of it done or none of it.
///
/// # Errors
/// As of [`write_whole`]. If one of the last steps fails, the files before it are already replaced; if
/// none is, nothing in `shown` is kept.
pub fn write_together(
    files: &[(&Path, &[u8])],
    shown: &mut [&mut Provisional],
) -> Result<(), FrameError> {
    let write_error = |path: &Path| {
        let path = path.to_owned();
        |source| FrameError::Write { path, source }
    };
    let mut replacements = Vec::new();
    for (path, bytes) in files {
        let mut replacement = Replacement::begin(path)?;
        replacement.fill(bytes).map_err(write_error(path))?;
        replacements.push(replacement);
    }
    let mut list = list();
    for ((path, _), replacement) in files.iter().zip(&mut replacements) {
        let Some(temporary) = replacement.temporary.take() else {
            continue;
        };
        let name = temporary.path().to_owned();
        let put = temporary.persist(&replacement.target);
        list.end_file(&name);
        if let Err(failed) = put {
            // Dropping the others waits for the list.
            drop(list);
            return Err(write_error(path)(without_path(&failed.error)));
        }
        for shown in &mut *shown {
            list.keep(shown);
        }
    }
    Ok(())
}

/// Finds out whether [`write_whole`] could write here, and leaves everything as it is.
///
/// # Errors
/// As of [`write_whole`], apart from a full disk.
pub fn check_writable(path: impl AsRef<Path>) -> Result<(), FrameError> {
    Replacement::begin(path.as_ref()).map(drop)
}

/// A temporary file that is to take the place of another; dropped, it is removed.
struct Replacement {
    /// `None` once it has taken its place.
    temporary: Option<NamedTempFile>,
    target: PathBuf,
    /// Metadata of the file that is replaced; `None` if there is none.
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
        sweep_once(folder);
        let temporary = list().begin_file(folder);
        let temporary = temporary.map_err(|error| write_error(without_path(&error)))?;
        Ok(Self {
            temporary: Some(temporary),
            target,
            existing,
        })
    }

    /// Writes the bytes to the disk, under the temporary name.
    fn fill(&mut self, bytes: &[u8]) -> io::Result<()> {
        let Some(temporary) = &mut self.temporary else {
            return Ok(());
        };
        let file = temporary.as_file_mut();
        file.write_all(bytes)?;
        if let Some(existing) = &self.existing {
            file.set_permissions(existing.permissions())?;
        }
        file.sync_all()
    }
}

impl Drop for Replacement {
    fn drop(&mut self) {
        if let Some(temporary) = self.temporary.take() {
            let path = temporary.path().to_owned();
            drop(temporary);
            list().end_file(&path);
        }
    }
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
    fn files_are_replaced_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b, nowhere] = ["a", "b", "no/c"].map(|name| folder.path().join(name));
        fs::write(&a, "old").unwrap();
        let mut made = Provisional::folder(&folder.path().join("made")).unwrap();
        let failed = write_together(&[(&a, b"new"), (&nowhere, b"new")], &mut [&mut made]);
        assert!(matches!(failed, Err(FrameError::Write { .. })));
        assert_eq!(fs::read(&a).unwrap(), b"old");
        drop(made);
        let mut kept = Provisional::folder(&folder.path().join("kept")).unwrap();
        write_together(&[(&a, b"new"), (&b, b"other")], &mut [&mut kept]).unwrap();
        drop(kept);
        assert_eq!(fs::read(&a).unwrap(), b"new");
        assert_eq!(fs::read(&b).unwrap(), b"other");
        assert_eq!(names(folder.path()), ["a", "b", "kept"]);
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
    }
}

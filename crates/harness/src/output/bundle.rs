//! Files that belong together, put into a folder at once.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use catoptric_frame::{create_folders, write_together};

use super::unwritable;

/// Files of a folder, all made before any of them is written, so that earlier files are kept until
/// then. The last one takes its place last.
#[derive(Debug, Default)]
pub struct Bundle {
    /// Paths inside the folder, and what they hold.
    files: Vec<(String, Vec<u8>)>,
}

/// So many files are open at once: operating systems allow a program no more than about a thousand.
const AT_ONCE: usize = 200;

impl Bundle {
    /// Adds a file by its path inside the folder.
    pub fn add(&mut self, path: impl Into<String>, bytes: Vec<u8>) {
        self.files.push((path.into(), bytes));
    }

    /// Writes all files, whole or not at all; more than some hundreds of them group by group.
    ///
    /// # Errors
    /// The folder, or a file in it, cannot be made.
    pub fn put(&self, folder: &Path) -> anyhow::Result<()> {
        let files: Vec<(PathBuf, &[u8])> = self
            .files
            .iter()
            .map(|(path, bytes)| (folder.join(path), bytes.as_slice()))
            .collect();
        let folders: BTreeSet<&Path> = files.iter().filter_map(|(path, _)| path.parent()).collect();
        for folder in folders {
            create_folders(folder).map_err(|error| unwritable(folder, &error))?;
        }
        for group in files.chunks(AT_ONCE) {
            let group: Vec<(&Path, &[u8])> = group
                .iter()
                .map(|(path, bytes)| (path.as_path(), *bytes))
                .collect();
            write_together(&group, &mut [])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_there_stands_where_one_file_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let with = |text: &str| {
            let mut bundle = Bundle::default();
            bundle.add("parts/a", text.as_bytes().to_vec());
            bundle.add("b", text.as_bytes().to_vec());
            bundle
        };
        with("old").put(folder.path()).unwrap();
        let mut bad = with("new");
        bad.add("parts", Vec::new());
        bad.put(folder.path()).unwrap_err();
        for name in ["parts/a", "b"] {
            assert_eq!(std::fs::read(folder.path().join(name)).unwrap(), b"old");
        }
    }

    #[test]
    fn there_may_be_more_files_than_can_be_open() {
        let folder = tempfile::tempdir().unwrap();
        let mut bundle = Bundle::default();
        for number in 0..2 * AT_ONCE + 1 {
            bundle.add(format!("{number}"), vec![1]);
        }
        bundle.put(folder.path()).unwrap();
        let count = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(count, 2 * AT_ONCE + 1);
    }
}

//! What is on disk and not finished: temporary files, and folders that nothing shows yet. All of it
//! is removed where the program ends before it is finished; what a killed program left, the next one
//! removes.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// How the name of a temporary file begins and ends.
const TEMPORARY: [&str; 2] = [".catoptric-", ".tmp"];

/// All of this program that is unfinished.
static UNFINISHED: Mutex<Vec<Unfinished>> = Mutex::new(Vec::new());

/// Folders that were looked through for what killed programs left.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// What is removed, and how.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Unfinished {
    File(PathBuf),
    /// With all that is in it.
    Folder(PathBuf),
    /// Unless something is in it.
    EmptyFolder(PathBuf),
}

impl Unfinished {
    fn remove(&self) -> io::Result<()> {
        match self {
            Self::File(path) => fs::remove_file(path),
            Self::Folder(path) => fs::remove_dir_all(path),
            Self::EmptyFolder(path) => fs::remove_dir(path),
        }
    }
}

/// The list, locked: nothing is begun or finished meanwhile.
pub(crate) struct List(MutexGuard<'static, Vec<Unfinished>>);

/// Waits for the list.
pub(crate) fn list() -> List {
    List(UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner))
}

impl List {
    /// Makes a temporary file in a folder and puts it on the list. Its name is short, so that
    /// whatever name the file is to have, this one fits too.
    pub(crate) fn begin_file(&mut self, folder: &Path) -> io::Result<NamedTempFile> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY[0]).suffix(TEMPORARY[1]);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As of any new file: less what the process masks.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        loop {
            let temporary = builder.tempfile_in(folder)?;
            // Where files cannot be locked, what a killed program left is not removed.
            let _ = temporary.as_file().lock();
            // Another program may have taken it for abandoned before it was locked.
            if temporary.path().exists() {
                self.0.push(Unfinished::File(temporary.path().to_owned()));
                return Ok(temporary);
            }
        }
    }

    /// Takes a temporary file off the list.
    pub(crate) fn end_file(&mut self, path: &Path) {
        self.end(&Unfinished::File(path.to_owned()));
    }

    /// From now on a file or folder stays.
    pub(crate) fn keep(&mut self, provisional: &mut Provisional) {
        if let Some(unfinished) = provisional.unfinished.take() {
            self.end(&unfinished);
        }
    }

    fn end(&mut self, entry: &Unfinished) {
        self.0.retain(|listed| listed != entry);
    }
}

/// Removes all that is unfinished, and keeps anything further from being begun: for a program that
/// was told to end and does so next. May be called from a thread that handles signals.
pub fn abandon_writes() {
    let list = list();
    for entry in list.0.iter() {
        // The program ends: nobody is left to act on a failure.
        let _ = entry.remove();
    }
    // Whoever begins or finishes something waits for this lock until the program has ended.
    std::mem::forget(list);
}

/// A file or a folder that was not there before and that nothing shows yet. Dropped, it is removed,
/// unless it is kept.
#[derive(Debug)]
pub struct Provisional {
    /// `None` once it is kept.
    unfinished: Option<Unfinished>,
    path: PathBuf,
}

impl Provisional {
    /// A file that is written next, if it is written at all.
    pub fn file(path: &Path) -> Self {
        Self::of(&mut list(), path, Unfinished::File(path.to_owned()))
    }

    /// Makes a folder that is removed with all that is in it; its parent must be there.
    ///
    /// # Errors
    /// It is there already, or cannot be made.
    pub fn folder(path: &Path) -> io::Result<Self> {
        Self::make(path, Unfinished::Folder(path.to_owned()))
    }

    /// Makes a folder that is removed unless something is in it; its parent must be there.
    ///
    /// # Errors
    /// As of [`Provisional::folder`].
    pub fn folder_for_others(path: &Path) -> io::Result<Self> {
        Self::make(path, Unfinished::EmptyFolder(path.to_owned()))
    }

    fn make(path: &Path, unfinished: Unfinished) -> io::Result<Self> {
        let mut list = list();
        fs::create_dir(path)?;
        Ok(Self::of(&mut list, path, unfinished))
    }

    fn of(list: &mut List, path: &Path, unfinished: Unfinished) -> Self {
        list.0.push(unfinished.clone());
        Self {
            unfinished: Some(unfinished),
            path: path.to_owned(),
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// From now on it stays.
    pub fn keep(&mut self) {
        list().keep(self);
    }
}

impl Drop for Provisional {
    fn drop(&mut self) {
        if let Some(unfinished) = self.unfinished.take() {
            let mut list = list();
            // Not there any more, or not empty: then it is to stay.
            let _ = unfinished.remove();
            list.end(&unfinished);
        }
    }
}

/// Makes a folder and those that it is in, unless all is being abandoned.
///
/// # Errors
/// It cannot be made.
pub fn create_folders(path: &Path) -> io::Result<()> {
    let _list = list();
    fs::create_dir_all(path)
}

/// Removes the temporary files that killed programs left in a folder; those of a running one stay.
pub fn sweep(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_temporary = name.starts_with(TEMPORARY[0]) && name.ends_with(TEMPORARY[1]);
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        if !is_temporary || !is_file {
            continue;
        }
        let Ok(file) = File::open(entry.path()) else {
            continue;
        };
        if is_abandoned(&file) {
            // It will be in the way of nobody.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether the program that wrote `file` has ended without finishing it: programs lock such a file
/// while they write. If so, the file is locked from now on, until it is closed. Where files cannot
/// be locked, none counts as abandoned.
pub fn is_abandoned(file: &File) -> bool {
    match file.try_lock() {
        Ok(()) => true,
        Err(TryLockError::WouldBlock | TryLockError::Error(_)) => false,
    }
}

/// [`sweep`], the first time that this program writes there.
pub(crate) fn sweep_once(folder: &Path) {
    let first = SWEPT
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .insert(folder.to_owned());
    if first {
        sweep(folder);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_temporary_files_differ_in_name_and_may_not_be_there_before() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = [0, 1].map(|_| list().begin_file(folder.path()).unwrap());
        assert_ne!(a.path(), b.path());
        for file in [&a, &b] {
            list().end_file(file.path());
        }
    }

    #[test]
    fn what_a_killed_program_left_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let running = list().begin_file(folder.path()).unwrap();
        for name in [
            ".catoptric-abc.tmp",
            ".catoptric-abc",
            "catoptric.tmp",
            "a.tmp",
        ] {
            fs::write(at(name), "text").unwrap();
        }
        fs::create_dir(at(".catoptric-folder.tmp")).unwrap();
        sweep(folder.path());
        assert!(!at(".catoptric-abc.tmp").exists());
        assert!(running.path().exists());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5);
        list().end_file(running.path());
    }

    #[test]
    fn a_file_stays_if_it_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [kept, dropped, never] =
            ["kept", "dropped", "never"].map(|name| folder.path().join(name));
        let [mut keep, lose, unwritten] =
            [&kept, &dropped, &never].map(|path| Provisional::file(path));
        for path in [&kept, &dropped] {
            fs::write(path, "text").unwrap();
        }
        keep.keep();
        drop((keep, lose, unwritten));
        assert!(kept.exists() && !dropped.exists() && !never.exists());
    }

    #[test]
    fn a_folder_stays_if_it_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [all, empty, kept] = ["all", "empty", "kept"].map(|name| folder.path().join(name));
        let other = Provisional::folder_for_others(&empty).unwrap();
        let whole = Provisional::folder(&all).unwrap();
        let mut keep = Provisional::folder(&kept).unwrap();
        for path in [&all, &empty, &kept] {
            fs::write(path.join("file"), "text").unwrap();
        }
        assert!(Provisional::folder(&all).is_err(), "it is there");
        keep.keep();
        drop((whole, other, keep));
        assert!(!all.exists() && empty.join("file").exists() && kept.join("file").exists());
    }
}

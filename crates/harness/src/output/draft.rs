//! A page and the files that it shows, written so that an earlier page stays whole until the new one
//! can replace it.
//!
//! The files of a run lie in folders of its own: `pictures` and `figures` or, where there are such
//! already, `pictures-2` and `figures-2`, and so on. `index.html` and `record.json` are replaced
//! together, once a run has something to show. Then the earlier run's files are removed: those in
//! the list that each folder of ours has. A run that ends keeps the files that its page shows and
//! no others. Whatever else is there stays.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use anyhow::Context;
use catoptric_frame::{Provisional, create_folders, is_abandoned, sweep, write_together};

use crate::exit::bad_input;

use super::unwritable;

/// Folder of all pictures, inside a page's.
pub const PICTURES: &str = "pictures";
/// Folder of plots and tables, inside a page's.
pub const FIGURES: &str = "figures";

/// The page.
const PAGE: &str = "index.html";
/// What it is made from.
const RECORD: &str = "record.json";
/// Text that every page of ours has, and hardly any other page.
const OURS: &str = "<title>catoptric: ";
/// In each folder of ours: the files in it that are ours, a path a line. Locked while a run writes.
const LIST: &str = ".catoptric-files";

/// The files of a run. Dropped before [`Draft::put`], it leaves nothing behind; after it, what the page
/// shows.
pub struct Draft {
    folder: PathBuf,
    /// Those that the page does not show yet, by what it calls them.
    unshown: RefCell<BTreeMap<String, Provisional>>,
    /// After the names of the folders in it: nothing, or `-2` and so on.
    suffix: String,
    parts: Vec<Part>,
    /// Made for this run; dropped after the parts, when it is empty.
    made: Option<Provisional>,
}

/// A folder of a run's files.
struct Part {
    name: &'static str,
    /// Open and locked as long as the run writes.
    list: File,
    folder: Provisional,
}

impl Draft {
    /// Begins a run's files in a folder, which is made if it is not there: its page may show files in
    /// these `parts`. Removes what runs left there that were killed.
    ///
    /// # Errors
    /// The folder cannot be made or written into, or has a page or a record that is not ours.
    pub fn begin(folder: &Path, parts: &[&'static str]) -> anyhow::Result<Self> {
        if folder.exists() && !folder.is_dir() {
            let text = format!("cannot write into {}: it is a file", folder.display());
            return Err(bad_input(text));
        }
        refuse_others_page(folder)?;
        let failed = |error: std::io::Error| unwritable(folder, &error);
        let made = match folder.exists() {
            true => None,
            false => {
                if let Some(parent) = folder.parent() {
                    create_folders(parent).map_err(failed)?;
                }
                Some(Provisional::folder_for_others(folder).map_err(failed)?)
            }
        };
        sweep(folder);
        remove_forsaken(folder);
        let (suffix, parts) = new_parts(folder, parts).map_err(failed)?;
        Ok(Self {
            folder: folder.to_owned(),
            unshown: RefCell::default(),
            suffix,
            parts,
            made,
        })
    }

    /// Where a file is to be written that pages call `pictures/…` or `figures/…`; the folders that it
    /// is in are made.
    ///
    /// # Errors
    /// They cannot be made.
    pub fn file(&self, path: &str) -> anyhow::Result<PathBuf> {
        let (part, inside) = path.split_once('/').unwrap_or(("", path));
        let part = self.parts.iter().find(|known| known.name == part);
        let part = part.with_context(|| format!("{path}: pages have no such folder"))?;
        let file = part.folder.path().join(inside);
        if file.exists() || self.unshown.borrow().contains_key(path) {
            return Ok(file);
        }
        let failed = |error: std::io::Error| unwritable(&file, &error);
        if let Some(folder) = file.parent() {
            create_folders(folder).map_err(failed)?;
        }
        (&part.list)
            .write_all(format!("{inside}\n").as_bytes())
            .map_err(failed)?;
        let provisional = Provisional::file(&file);
        self.unshown
            .borrow_mut()
            .insert(path.to_owned(), provisional);
        Ok(file)
    }

    /// Puts a page and its record in place of what was there; the answer is the page's path. The page
    /// calls its files as they were given to [`Draft::file`].
    ///
    /// # Errors
    /// They cannot be written; then the earlier page stands, with its files.
    pub fn put(&mut self, page: &str, record: &[u8]) -> anyhow::Result<PathBuf> {
        self.put_with(page, Some(record))
    }

    /// Puts a page that is not made from a record in place of what was there, as [`Draft::put`] does.
    ///
    /// # Errors
    /// As there.
    pub fn put_alone(&mut self, page: &str) -> anyhow::Result<PathBuf> {
        self.put_with(page, None)
    }

    fn put_with(&mut self, page: &str, record: Option<&[u8]>) -> anyhow::Result<PathBuf> {
        let shows = |name: &String| page.contains(&format!("=\"{name}\""));
        let unshown = self.unshown.get_mut();
        let mut shown = unshown
            .extract_if(.., |name, _| shows(name))
            .collect::<Vec<_>>();
        let page = self.with_suffix(page);
        let (path, record_path) = (self.folder.join(PAGE), self.folder.join(RECORD));
        let parts = self.parts.iter_mut().map(|part| &mut part.folder);
        let files = shown.iter_mut().map(|(_, file)| file);
        let mut kept: Vec<&mut Provisional> = parts.chain(&mut self.made).chain(files).collect();
        let page = (path.as_path(), page.as_bytes());
        let record = record.map(|record| (record_path.as_path(), record));
        let files: Vec<_> = std::iter::once(page).chain(record).collect();
        write_together(&files, &mut kept)?;
        // What the page before showed.
        remove_forsaken(&self.folder);
        Ok(path)
    }

    /// A page whose attributes name this run's folders. In an attribute's value of any other origin
    /// a quotation mark is escaped, so that none begins like this.
    fn with_suffix(&self, page: &str) -> String {
        let named = |page: String, part: &Part| {
            let name = part.name;
            page.replace(
                &format!("=\"{name}/"),
                &format!("=\"{name}{}/", self.suffix),
            )
        };
        self.parts.iter().fold(page.to_owned(), named)
    }
}

/// Refuses a folder with a page or a record that we would overwrite and did not make.
fn refuse_others_page(folder: &Path) -> anyhow::Result<()> {
    let holds = |name: &str, ours: &dyn Fn(&str) -> bool| {
        let bytes = fs::read(folder.join(name)).unwrap_or_default();
        bytes.is_empty() || ours(&String::from_utf8_lossy(&bytes))
    };
    let record = |text: &str| text.trim_start().starts_with('[') && text.contains("schema_version");
    for (name, ours) in [
        (PAGE, holds(PAGE, &|text| text.contains(OURS))),
        (
            RECORD,
            holds(RECORD, &|text| record(text) || text.trim() == "[]"),
        ),
    ] {
        if !ours {
            return Err(bad_input(format!(
                "{}: this file was not written by catoptric and would be replaced; name another folder (-o DIR)",
                folder.join(name).display()
            )));
        }
    }
    Ok(())
}

/// The first set of folders that are not there.
fn new_parts(folder: &Path, names: &[&'static str]) -> std::io::Result<(String, Vec<Part>)> {
    for number in 1.. {
        let suffix = match number {
            1 => String::new(),
            number => format!("-{number}"),
        };
        let parts = names.iter().map(|name| Part::begin(folder, name, &suffix));
        match parts.collect::<Result<Vec<_>, _>>() {
            Ok(parts) => return Ok((suffix, parts)),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
    Err(std::io::ErrorKind::AlreadyExists.into())
}

impl Part {
    fn begin(folder: &Path, name: &'static str, suffix: &str) -> std::io::Result<Self> {
        let folder = Provisional::folder(&folder.join(format!("{name}{suffix}")))?;
        let path = folder.path().join(LIST);
        let list = File::options().append(true).create_new(true).open(&path)?;
        // Where files cannot be locked, those of a killed run are not removed.
        let _ = list.lock();
        if path.exists() {
            Ok(Self { name, list, folder })
        } else {
            // Another run took it for forsaken before it was locked.
            Err(std::io::ErrorKind::AlreadyExists.into())
        }
    }
}

/// Removes the files of runs that no page shows and that no program is writing.
fn remove_forsaken(folder: &Path) {
    let page = fs::read(folder.join(PAGE)).unwrap_or_default();
    let page = String::from_utf8_lossy(&page);
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && is_part(&name) && !page.contains(&format!("=\"{name}/")) {
            remove_listed(&entry.path());
        }
    }
}

/// Whether a folder is called as ours are.
fn is_part(name: &str) -> bool {
    let suffix = [PICTURES, FIGURES]
        .iter()
        .find_map(|part| name.strip_prefix(part));
    suffix.is_some_and(|suffix| {
        let number = suffix.strip_prefix('-').map(str::parse::<u32>);
        suffix.is_empty() || matches!(number, Some(Ok(_)))
    })
}

/// Removes what a folder's list names, the list, and folders that are then empty; nothing where there
/// is no list or a program holds it.
fn remove_listed(folder: &Path) {
    let path = folder.join(LIST);
    let Ok(file) = File::open(&path) else { return };
    if !is_abandoned(&file) {
        return;
    }
    let list = fs::read_to_string(&path).unwrap_or_default();
    let mut folders = BTreeSet::from([folder.to_owned()]);
    for line in list.lines() {
        let inside = Path::new(line);
        let plain = |part: Component<'_>| matches!(part, Component::Normal(_));
        if line.is_empty() || !inside.components().all(plain) {
            continue;
        }
        // One that is not there was not written any more.
        let _ = fs::remove_file(folder.join(inside));
        let above = inside.ancestors().skip(1).map(|above| folder.join(above));
        folders.extend(above);
    }
    for inner in folders.iter().rev() {
        sweep(inner);
        if inner != folder {
            // Somebody else's file may be in it.
            let _ = fs::remove_dir(inner);
        }
    }
    let _ = fs::remove_file(&path);
    let _ = fs::remove_dir(folder);
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARTS: [&str; 1] = [PICTURES];

    fn page(path: &str) -> String {
        format!("{OURS}x</title><img src=\"{path}\">")
    }

    /// Writes a page with one picture.
    fn run(folder: &Path) {
        let mut draft = Draft::begin(folder, &PARTS).unwrap();
        fs::write(draft.file("pictures/scene/a.png").unwrap(), "a").unwrap();
        draft.put(&page("pictures/scene/a.png"), b"[]").unwrap();
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().flatten();
        let mut names: Vec<String> = entries
            .map(|entry| entry.file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    fn shown(folder: &Path) -> String {
        let page = fs::read_to_string(folder.join(PAGE)).unwrap();
        let shown = page.split('"').nth(1).unwrap();
        assert!(folder.join(shown).is_file(), "{shown}");
        shown.to_owned()
    }

    #[test]
    fn a_draft_that_is_given_up_leaves_the_old_page_as_it_was() {
        let parent = tempfile::tempdir().unwrap();
        let folder = parent.path().join("new/report");
        drop(Draft::begin(&folder, &PARTS).unwrap());
        assert!(!folder.exists());
        run(&folder);
        let before = names(&folder);
        let draft = Draft::begin(&folder, &PARTS).unwrap();
        fs::write(draft.file("pictures/scene/a.png").unwrap(), "b").unwrap();
        let shown = shown(&folder);
        assert_eq!(fs::read(folder.join(&shown)).unwrap(), b"a");
        drop(draft);
        assert_eq!(names(&folder), before);
    }

    #[test]
    fn what_the_page_does_not_show_goes_with_the_run() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().join("report");
        let mut draft = Draft::begin(&folder, &PARTS).unwrap();
        let write = |draft: &Draft, path: &str| {
            let file = draft.file(path).unwrap();
            fs::write(&file, path).unwrap();
            file
        };
        let [first, later, never] = ["first", "later", "never"].map(|name| {
            let path = format!("pictures/{name}.png");
            let file = write(&draft, &path);
            if name == "first" {
                draft.put(&page(&path), b"[]").unwrap();
            }
            file
        });
        let both = page("pictures/first.png") + "<img src=\"pictures/later.png\">";
        draft.put(&both, b"[]").unwrap();
        assert!(never.exists(), "the next page may show it");
        drop(draft);
        assert!(first.exists() && later.exists() && !never.exists());
    }

    #[test]
    fn a_new_page_takes_the_place_of_the_old_one_and_of_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        for kept in ["pictures", "pictures-2", "pictures-of-mine"] {
            fs::create_dir(folder.join(kept)).unwrap();
            fs::write(folder.join(kept).join("holiday.jpg"), kept).unwrap();
        }
        for _ in 0..4 {
            run(folder);
            let shown = shown(folder);
            let scene = folder.join(shown).parent().unwrap().to_owned();
            fs::write(scene.join("holiday.jpg"), "mine").unwrap();
        }
        let ours = |name: &String| folder.join(name).join(LIST).exists();
        assert_eq!(names(folder).iter().filter(|name| ours(name)).count(), 1);
        for kept in ["pictures", "pictures-2", "pictures-of-mine"] {
            let text = fs::read_to_string(folder.join(kept).join("holiday.jpg")).unwrap();
            assert_eq!(text, kept);
        }
        for number in 3..7 {
            let scene = folder.join(format!("pictures-{number}/scene"));
            assert!(scene.join("holiday.jpg").exists());
            assert_eq!(scene.join("a.png").exists(), number == 6);
        }
    }

    #[test]
    fn what_a_killed_run_left_is_removed_by_the_next() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        run(folder);
        let before = names(folder);
        let part = folder.join("pictures-2/scene");
        fs::create_dir_all(&part).unwrap();
        for name in ["a.png", ".catoptric-x.tmp"] {
            fs::write(part.join(name), "killed").unwrap();
        }
        fs::write(folder.join(".catoptric-y.tmp"), "killed").unwrap();
        let list = "scene/a.png\nscene/b.png\n../../index.html\n/index.html\n";
        fs::write(folder.join("pictures-2").join(LIST), list).unwrap();
        drop(Draft::begin(folder, &PARTS).unwrap());
        assert_eq!(names(folder), before);
        shown(folder);
    }

    #[test]
    fn a_page_by_somebody_else_is_refused() {
        for (name, text) in [
            (PAGE, "<title>My site</title>"),
            (RECORD, "{}"),
            (RECORD, "[1]"),
        ] {
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join(name), text).unwrap();
            let error = Draft::begin(folder.path(), &PARTS).err().expect("refused");
            assert!(error.to_string().contains(name), "{error}");
            assert_eq!(names(folder.path()), [name]);
        }
    }
}

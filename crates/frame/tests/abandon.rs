//! Ending a program in the middle of a write. The test is alone in its program: no file is begun
//! after it.

use std::path::Path;
use std::time::Duration;

use catoptric_frame::{abandon_writes, write_whole};

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name();
    entries
        .map(|entry| name(entry).into_string().unwrap())
        .collect()
}

#[test]
fn an_abandoned_write_leaves_no_temporary_file_and_none_is_begun() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: usize| {
        let path = folder.path().join(name);
        std::thread::spawn(move || write_whole(path, &vec![1; bytes]));
    };
    let large = 1 << 28;
    write("first", large);
    while names(folder.path()).is_empty() {
        std::thread::yield_now();
    }
    abandon_writes();
    write("second", 1);
    std::thread::sleep(Duration::from_millis(200));
    let left = names(folder.path());
    // The first may have been whole already.
    assert!(left.is_empty() || left == ["first"], "{left:?}");
    if left == ["first"] {
        let length = std::fs::metadata(folder.path().join("first"))
            .unwrap()
            .len();
        assert_eq!(length, large as u64);
    }
}

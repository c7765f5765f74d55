//! What OBJ and MTL files have in common: logical lines, comments, names, errors at a line.
//!
//! These files are lists of words in no stated encoding, so all of them are bytes here, and names
//! that differ in a byte are different names.

use std::borrow::Cow;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use crate::SceneError;

/// A file's text without a byte order mark. UTF-16 and other files with zero bytes are refused.
pub(crate) fn read(path: &Path, what: &str) -> Result<Vec<u8>, SceneError> {
    let error = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let mut bytes =
        std::fs::read(path).map_err(|cause| error(format!("cannot be read: {cause}")))?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(error("is UTF-16 text: save it as UTF-8".to_owned()));
    }
    if bytes.contains(&0) {
        let message = format!(
            "is binary, or UTF-16 text (it has zero bytes): {what} text in UTF-8 is expected"
        );
        return Err(error(message));
    }
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    Ok(bytes)
}

/// The logical lines, each with the number (from 1) of the line that it starts at: a backslash
/// at the end of a line joins it with the next, unless it stands in a comment.
pub(crate) fn lines(text: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut physical = (1..).zip(physical_lines(text));
    std::iter::from_fn(move || {
        let (number, first) = physical.next()?;
        let Some(start) = continued(first) else {
            return Some((number, Cow::Borrowed(first)));
        };
        let mut line = start.to_vec();
        for (_, next) in physical.by_ref() {
            line.push(b' ');
            match continued(next) {
                Some(part) => line.extend_from_slice(part),
                None => {
                    line.extend_from_slice(next);
                    break;
                }
            }
        }
        Some((number, Cow::Owned(line)))
    })
}

/// The lines as the file has them, ended by a line feed, a carriage return or both.
fn physical_lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = text;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let ends = |byte: &u8| matches!(byte, b'\n' | b'\r');
        let end = rest.iter().position(ends).unwrap_or(rest.len());
        let line = &rest[..end];
        let both = rest[end..].starts_with(b"\r\n");
        rest = rest.get(end + 1 + usize::from(both)..).unwrap_or_default();
        Some(line)
    })
}

/// The line without the backslash that joins it with the next.
fn continued(line: &[u8]) -> Option<&[u8]> {
    let joined = line.strip_suffix(b"\\")?;
    (without_comment(line).len() == line.len()).then_some(joined)
}

/// The line up to a `#` that starts a word.
pub(crate) fn without_comment(line: &[u8]) -> &[u8] {
    let starts_word = |at: usize| at == 0 || line[at - 1].is_ascii_whitespace();
    (0..line.len())
        .find(|at| line[*at] == b'#' && starts_word(*at))
        .map_or(line, |at| &line[..at])
}

/// The first word of a line, and all after it without the spaces around.
pub(crate) fn split_key(line: &[u8]) -> (&[u8], &[u8]) {
    let line = line.trim_ascii();
    let end = line.iter().position(u8::is_ascii_whitespace);
    let (key, rest) = line.split_at(end.unwrap_or(line.len()));
    (key, rest.trim_ascii_start())
}

/// All words of a line.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// A word as a number; `None` where it is none, infinite or not a number (`nan`).
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    let value: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    // What is computed from it in f64 cannot overflow, and most of it fits f32.
    (value.abs() <= f64::from(f32::MAX)).then_some(value)
}

/// The spellings of a name that may have a comment after it or a `#` in it, the longest first.
pub(crate) fn spellings(name: &[u8]) -> impl Iterator<Item = &[u8]> {
    let short = without_comment(name).trim_ascii_end();
    std::iter::once(name).chain((short != name).then_some(short))
}

/// A name for messages and for people: bytes that are no UTF-8, and control characters, escaped.
pub(crate) fn shown(name: &[u8]) -> String {
    let mut text = String::with_capacity(name.len());
    for chunk in name.utf8_chunks() {
        for character in chunk.valid().chars() {
            if character.is_control() {
                text.extend(character.escape_default());
            } else {
                text.push(character);
            }
        }
        for byte in chunk.invalid() {
            text.push_str(&format!("\\x{byte:02x}"));
        }
    }
    text
}

/// A file beside another; `None` where there is none. The name is taken as it stands, or with
/// slashes for backslashes, without quotes around it, or with its spaces escaped by backslashes;
/// one that is no UTF-8 is taken for Latin-1 where no file has just these bytes.
pub(crate) fn beside(folder: &Path, name: &[u8]) -> Option<PathBuf> {
    spellings(name)
        .flat_map(|name| {
            let bare = name
                .strip_prefix(b"\"")
                .and_then(|name| name.strip_suffix(b"\""))
                .unwrap_or(name);
            [slashes(&unescaped(bare)), slashes(bare), bare.to_vec()]
        })
        .flat_map(|name| {
            let latin1 = std::str::from_utf8(&name)
                .is_err()
                .then(|| folder.join(name.iter().copied().map(char::from).collect::<String>()));
            std::iter::once(folder.join(os_string(name))).chain(latin1)
        })
        .find(|file| file.is_file())
}

/// The words of a line of file names, of which each may have spaces escaped by backslashes.
pub(crate) fn file_words(names: &[u8]) -> Vec<Vec<u8>> {
    let mut all: Vec<Vec<u8>> = Vec::new();
    for word in words(without_comment(names)) {
        match all.last_mut().filter(|last| last.ends_with(b"\\")) {
            Some(last) => {
                last.push(b' ');
                last.extend_from_slice(word);
            }
            None => all.push(word.to_vec()),
        }
    }
    all
}

fn unescaped(name: &[u8]) -> Vec<u8> {
    let mut plain = Vec::with_capacity(name.len());
    for byte in name {
        if *byte == b' ' && plain.ends_with(b"\\") {
            plain.pop();
        }
        plain.push(*byte);
    }
    plain
}

fn slashes(name: &[u8]) -> Vec<u8> {
    let slash = |byte: &u8| if *byte == b'\\' { b'/' } else { *byte };
    name.iter().map(slash).collect()
}

#[cfg(unix)]
fn os_string(name: Vec<u8>) -> OsString {
    std::os::unix::ffi::OsStringExt::from_vec(name)
}

#[cfg(not(unix))]
fn os_string(name: Vec<u8>) -> OsString {
    String::from_utf8_lossy(&name).into_owned().into()
}

/// An error at a line of an OBJ or MTL file.
pub(crate) fn at_line(path: &Path, line: usize, message: impl Into<String>) -> SceneError {
    SceneError::AtLine {
        file: path.display().to_string(),
        line,
        message: message.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(text: &str) -> Vec<(usize, String)> {
        lines(text.as_bytes())
            .map(|(number, line)| (number, shown(&line)))
            .collect()
    }

    #[test]
    fn a_backslash_joins_lines_and_keeps_their_numbers() {
        let expected = [
            (1, "f 1  2 3".to_owned()),
            (3, "# C:\\models\\".to_owned()),
            (4, "v 0".to_owned()),
            (5, "a b c".to_owned()),
            (8, "last".to_owned()),
        ];
        let text = "f 1 \\\n2 3\n# C:\\models\\\nv 0\na\\\r\nb\\\rc\nlast\\";
        assert_eq!(joined(text), expected);
    }

    #[test]
    fn a_million_joined_lines_take_no_time() {
        let text = [b"l 1 2".as_slice(), &b" 1\\\n".repeat(1_000_000)].concat();
        let all: Vec<_> = lines(&text).collect();
        assert_eq!((all.len(), all[0].1.len()), (1, 5 + 3 * 1_000_000 - 1));
    }

    #[test]
    fn comments_start_a_word() {
        assert_eq!(without_comment(b"f 1 2 3 # a face"), b"f 1 2 3 ");
        assert_eq!(without_comment(b"# all"), b"");
        assert_eq!(without_comment(b"usemtl wood#5"), b"usemtl wood#5");
        let found: Vec<_> = spellings(b"Material #5").collect();
        assert_eq!(found, [b"Material #5".as_slice(), b"Material"]);
        assert_eq!(spellings(b"wood").collect::<Vec<_>>(), [b"wood"]);
    }

    #[test]
    fn line_ends_and_marks_of_every_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, b"\xef\xbb\xbfv 1\r\nv 2\rv 3\n").unwrap();
        let text = read(&path, "OBJ").unwrap();
        let lines: Vec<_> = physical_lines(&text).collect();
        assert_eq!(lines, [b"v 1", b"v 2", b"v 3"]);
        for (bytes, wanted) in [
            (b"\x89PNG\r\n\0\0".as_slice(), "a.obj: is binary"),
            (b"\xff\xfev\0 \x001\0", "a.obj: is UTF-16 text"),
        ] {
            std::fs::write(&path, bytes).unwrap();
            let message = read(&path, "OBJ").unwrap_err().to_string();
            assert!(message.contains(wanted), "{message}");
        }
    }

    #[test]
    fn numbers() {
        assert_eq!(number(b"-1.5e2"), Some(-150.0));
        assert_eq!(number(b"0.1"), Some(0.1));
        for word in [b"nan".as_slice(), b"inf", b"1e39", b"1,5", b"", b"\xe9"] {
            assert_eq!(number(word), None, "{}", shown(word));
        }
    }

    #[test]
    fn names_are_shown_without_harm_and_stay_distinct() {
        assert_eq!(shown("é".as_bytes()), "é");
        assert_eq!(shown(b"M\xe9"), "M\\xe9");
        assert_eq!(shown(b"M\xe8 \x1b[31m"), "M\\xe8 \\u{1b}[31m");
    }

    #[test]
    fn files_are_found_by_every_spelling_of_their_names() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("maps")).unwrap();
        for file in ["maps/old wood.png", "é.png", "a#1.png"] {
            std::fs::write(folder.path().join(file), "").unwrap();
        }
        for (name, file) in [
            (b"maps/old wood.png".as_slice(), "maps/old wood.png"),
            (b"maps\\old wood.png", "maps/old wood.png"),
            (b"maps/old\\ wood.png", "maps/old wood.png"),
            (b"maps\\old\\ wood.png", "maps/old wood.png"),
            (b"\"maps/old wood.png\" # oak", "maps/old wood.png"),
            ("é.png".as_bytes(), "é.png"),
            (b"\xe9.png", "é.png"),
            (b"a#1.png", "a#1.png"),
        ] {
            let found = beside(folder.path(), name);
            assert_eq!(found, Some(folder.path().join(file)), "{}", shown(name));
        }
        assert_eq!(beside(folder.path(), b"none.png"), None);
        assert_eq!(beside(folder.path(), b""), None);
        let words = file_words(b"a\\ b.mtl c.mtl # d.mtl");
        assert_eq!(words, [b"a\\ b.mtl".to_vec(), b"c.mtl".to_vec()]);
    }
}

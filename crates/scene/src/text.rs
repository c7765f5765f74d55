//! What OBJ and MTL files have in common: logical lines, comments, names, errors at a line.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::SceneError;

/// A file's text with its line ends made `\n` and without a byte order mark. Bytes that are no
/// UTF-8 (in comments of old files) are replaced; a file with zero bytes is refused as binary.
pub(crate) fn read(path: &Path, what: &str) -> Result<String, SceneError> {
    let error = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let bytes = std::fs::read(path).map_err(|cause| error(format!("cannot be read: {cause}")))?;
    if bytes.contains(&0) {
        let message = format!("is binary (it has zero bytes), not the text of an {what} file");
        return Err(error(message));
    }
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Ok(text.replace("\r\n", "\n").replace('\r', "\n"))
}

/// The logical lines, each with the number (from 1) of the line that it starts at: a backslash
/// at the end of a line joins it with the next, unless it stands in a comment.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut physical = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, first) = physical.next()?;
        let mut line = Cow::Borrowed(first);
        while let Some(joined) = continued(&line) {
            let (_, next) = physical.next().unwrap_or((number, ""));
            line = Cow::Owned(format!("{joined} {next}"));
        }
        Some((number, line))
    })
}

/// The line without its last backslash, where another line follows.
fn continued(line: &str) -> Option<&str> {
    without_comment(line)
        .strip_suffix('\\')
        .filter(|joined| joined.len() + 1 == line.len())
}

/// The line up to a `#` that starts a word.
pub(crate) fn without_comment(line: &str) -> &str {
    let starts_word = |at: usize| line[..at].ends_with(char::is_whitespace) || at == 0;
    line.match_indices('#')
        .find(|(at, _)| starts_word(*at))
        .map_or(line, |(at, _)| &line[..at])
}

/// The first word of a line, and all after it without the spaces around.
pub(crate) fn split_key(line: &str) -> (&str, &str) {
    let line = line.trim();
    let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    (key, rest.trim_start())
}

/// The spellings of a name that may have a comment after it or a `#` in it, the longest first.
pub(crate) fn spellings(name: &str) -> impl Iterator<Item = &str> {
    let short = without_comment(name).trim_end();
    std::iter::once(name).chain((short != name).then_some(short))
}

/// A file beside another, its name with slashes of either kind; `None` where there is none.
pub(crate) fn beside(folder: &Path, name: &str) -> Option<PathBuf> {
    spellings(name)
        .map(|name| folder.join(name.replace('\\', "/")))
        .find(|file| file.is_file())
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
        lines(text)
            .map(|(number, line)| (number, line.into_owned()))
            .collect()
    }

    #[test]
    fn a_backslash_joins_lines_and_keeps_their_numbers() {
        let expected = [
            (1, "f 1  2 3".to_owned()),
            (3, "# C:\\models\\".to_owned()),
            (4, "v 0".to_owned()),
            (5, "last ".to_owned()),
        ];
        let text = "f 1 \\\n2 3\n# C:\\models\\\nv 0\nlast\\";
        assert_eq!(joined(text), expected);
    }

    #[test]
    fn comments_start_a_word() {
        assert_eq!(without_comment("f 1 2 3 # a face"), "f 1 2 3 ");
        assert_eq!(without_comment("# all"), "");
        assert_eq!(without_comment("usemtl wood#5"), "usemtl wood#5");
        let found: Vec<_> = spellings("Material #5").collect();
        assert_eq!(found, ["Material #5", "Material"]);
        assert_eq!(spellings("wood").collect::<Vec<_>>(), ["wood"]);
    }

    #[test]
    fn line_ends_and_marks_of_every_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, b"\xef\xbb\xbfv 1\r\nv 2\rv 3\n").unwrap();
        assert_eq!(read(&path, "OBJ").unwrap(), "v 1\nv 2\nv 3\n");
        std::fs::write(&path, b"\x89PNG\r\n\0\0").unwrap();
        let message = read(&path, "OBJ").unwrap_err().to_string();
        assert!(message.contains("a.obj: is binary"), "{message}");
    }
}

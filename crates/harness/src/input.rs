//! Text and JSON files that the user gives us, read as they come from any editor.

use std::path::Path;

use anyhow::Context;
use serde_json::Value;

use crate::exit::bad_input;

/// Reads a file of text in UTF-8, with or without a byte order mark.
///
/// # Errors
/// It cannot be read, or is no such text.
pub fn text(path: &Path) -> anyhow::Result<String> {
    let name = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("cannot read {name}"))?;
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(bad_input(format!(
            "{name}: is UTF-16 text; save it as UTF-8"
        )));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        bad_input(format!("{name}: is no UTF-8 text: see byte {at}"))
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned())
}

/// Reads a file of JSON.
///
/// # Errors
/// As of [`text`], or it is no JSON.
pub fn json(path: &Path) -> anyhow::Result<Value> {
    serde_json::from_str(&text(path)?).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let text = error.to_string();
        let reason = text.split(" at line ").next().unwrap_or_default();
        let name = path.display();
        bad_input(match line {
            0 => format!("{name}: is no JSON: {reason}"),
            _ => format!("{name}: line {line}, column {column}: is no JSON: {reason}"),
        })
    })
}

/// A value for messages: the value itself if it is short, otherwise what kind of value it is.
pub fn brief(value: &Value) -> String {
    const LONGEST: usize = 40;
    match value {
        Value::Object(_) => "an object".to_owned(),
        Value::Array(_) => "an array".to_owned(),
        Value::String(text) if text.chars().count() > LONGEST => "a long text".to_owned(),
        value => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_comes_from_any_editor_and_other_bytes_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        let read = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            json(&path)
        };
        assert_eq!(read(b"\xef\xbb\xbf[1]\r\n").unwrap()[0], 1);
        for (bytes, reason) in [
            (&b"\xff\xfe[\0]\0"[..], "UTF-16"),
            (b"[\"\xff\"]", "byte 2"),
            (b"[1,\n x]", "line 2, column 2: is no JSON"),
            (b"", "is no JSON"),
        ] {
            let error = read(bytes).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
            assert!(error.contains("a.json"), "{error}");
        }
    }
}

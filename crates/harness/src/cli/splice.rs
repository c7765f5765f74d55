//! Puts generated text into a hand-written one, such as the README, between two comments.

use std::path::Path;

use catoptric_frame::write_whole;

use crate::exit::bad_input;
use crate::input;
use crate::output::check_writable;

/// Replaces what stands in a file between the lines `<!-- NAME: begin -->` and `<!-- NAME: end -->`.
///
/// # Errors
/// The file cannot be read or written, or lacks the lines.
pub fn into_file(file: &Path, name: &str, made: &str) -> anyhow::Result<()> {
    check_writable(file)?;
    let text = input::text(file)?;
    let spliced = spliced(&text, name, made).ok_or_else(|| {
        let [begin, end] = markers(name);
        bad_input(format!(
            "{}: no line `{begin}` with a line `{end}` after it",
            file.display()
        ))
    })?;
    Ok(write_whole(file, spliced.as_bytes())?)
}

fn markers(name: &str) -> [String; 2] {
    ["begin", "end"].map(|which| format!("<!-- {name}: {which} -->"))
}

fn spliced(text: &str, name: &str, made: &str) -> Option<String> {
    let [begin, end] = markers(name);
    let (before, rest) = text.split_once(&begin)?;
    let (_, after) = rest.split_once(&end)?;
    Some(format!("{before}{begin}\n{made}{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_spliced_twice_is_spliced_once() {
        let [begin, end] = markers("summary");
        let text = format!("# A\n{begin}\nold\n{end}\nB\n");
        let once = spliced(&text, "summary", "new\n").unwrap();
        assert_eq!(once, format!("# A\n{begin}\nnew\n{end}\nB\n"));
        assert_eq!(spliced(&once, "summary", "new\n").unwrap(), once);
        assert_eq!(spliced(&text, "claims", "new\n"), None);
        assert_eq!(spliced(&format!("{end}{begin}"), "summary", "new\n"), None);
    }
}

//! What people read: lines on stderr, and text that cannot command the terminal it is shown on.

use std::borrow::Cow;
use std::io::Write;

/// Writes a line, or several, to stderr. If stderr is closed, the text is lost and the program goes
/// on.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", plain(text));
}

/// Text as it may be shown: names come from files, and a terminal obeys control characters. Line
/// breaks and tabs stay; any other is written as JSON does, `\u001b`, so that JSON stays JSON.
pub fn plain(text: &str) -> Cow<'_, str> {
    replaced(text, |c| commands(c) && c != '\n' && c != '\t')
}

/// [`plain`] text on one line.
pub fn in_a_line(text: &str) -> Cow<'_, str> {
    replaced(text, commands)
}

/// Columns of a line that people read: what the variable `COLUMNS` says, else those of the terminal
/// that stdout is, else 80.
pub fn width() -> usize {
    let said = std::env::var("COLUMNS").ok();
    let said = said.and_then(|columns| columns.trim().parse().ok());
    said.filter(|columns| *columns > 0).unwrap_or_else(|| {
        let size = console::Term::stdout().size_checked();
        size.map_or(80, |(_, columns)| usize::from(columns))
    })
}

/// Text in lines of at most `columns` characters, except for longer words.
pub fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if length(line) + 1 + length(word) <= columns => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// As much of a text as fits in so many columns, with an ellipsis where some is left out.
pub fn cut(text: &str, columns: usize) -> Cow<'_, str> {
    if length(text) <= columns {
        return Cow::Borrowed(text);
    }
    let short: String = text.chars().take(columns.saturating_sub(1)).collect();
    Cow::Owned(format!("{}…", short.trim_end()))
}

fn length(text: &str) -> usize {
    text.chars().count()
}

fn replaced(text: &str, odd: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&odd) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::new();
    for c in text.chars() {
        if odd(c) {
            shown += &format!("\\u{:04x}", u32::from(c));
        } else {
            shown.push(c);
        }
    }
    Cow::Owned(shown)
}

/// Whether a character does something other than being shown: control characters, and those that
/// turn the direction of what follows.
fn commands(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_long_as_they_may_be() {
        assert_eq!(wrapped("a bc  def", 4), ["a bc", "def"]);
        assert_eq!(wrapped("abcdef g", 4), ["abcdef", "g"]);
        assert_eq!(wrapped("", 4), Vec::<String>::new());
        assert_eq!((&*cut("größe", 5), &*cut("größer", 5)), ("größe", "größ…"));
        assert_eq!((&*cut("ab cd", 4), &*cut("ab", 1)), ("ab…", "…"));
    }

    #[test]
    fn what_a_terminal_obeys_is_written_out() {
        assert_eq!(plain("a\tb\nзеркало ½ °"), "a\tb\nзеркало ½ °");
        assert_eq!(
            plain("\u{1b}[31mred\u{7}\r"),
            "\\u001b[31mred\\u0007\\u000d"
        );
        assert_eq!(plain("\u{9b}2J\u{202e}"), "\\u009b2J\\u202e");
        assert_eq!(in_a_line("a\nb"), "a\\u000ab");
        let json = plain("\"\u{9b}\"").into_owned();
        let back: String = serde_json::from_str(&json).unwrap();
        assert_eq!(back, "\u{9b}");
    }
}

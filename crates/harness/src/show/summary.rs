//! The short table of a recorded run, for a text such as the README.

use std::path::Path;

use serde_json::Value;

use crate::options::Format;
use crate::record::path::lookup;

use super::records;
use super::table::{cell, markdown as escaped, markdown_code};

/// Columns of the table: those that fit on a page.
const COLUMNS: [&str; 7] = [
    "object_agreement",
    "coverage.missing",
    "angular_error_deg.p50",
    "vertices.offset_px.mean",
    "color.flip",
    "work.total",
    "time_ms.frame.median",
];

/// The table and where it comes from.
pub fn markdown(rows: &[Value], path: &Path) -> String {
    let first = |path: &str| {
        let found = rows.first().and_then(|row| lookup(row, path));
        cell(found)
    };
    let software = rows
        .iter()
        .any(|row| lookup(row, "adapter.software") == Some(&true.into()));
    let note = if software {
        " (a CPU playing the GPU: its times compare techniques with each other, not with a graphics card)"
    } else {
        ""
    };
    format!(
        "Recorded {} at revision {} on {}{note} by\n{}:\n\n{}",
        escaped(first("meta.date").split('T').next().unwrap_or_default()),
        escaped(&first("meta.revision")),
        escaped(&first("adapter.name")),
        markdown_code(&first("meta.command")),
        table(rows, Format::Markdown),
    ) + &format!(
        "\nEverything measured is in [record.json]({}).\n",
        link(path)
    )
}

/// A file's path as the target of a link.
fn link(path: &Path) -> String {
    let path = path.to_string_lossy();
    let plain = |c: char| !c.is_whitespace() && !c.is_control() && !"()<>\\\"".contains(c);
    let mut target = String::new();
    for c in path.chars() {
        if plain(c) {
            target.push(c);
        } else {
            let mut bytes = [0; 4];
            for byte in c.encode_utf8(&mut bytes).bytes() {
                target += &format!("%{byte:02X}");
            }
        }
    }
    target
}

/// The table alone.
pub fn table(rows: &[Value], format: Format) -> String {
    records::numbers(rows, &COLUMNS).write(format)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Record;
    use crate::record::tests::{blank, measured};

    #[test]
    fn the_summary_says_where_it_comes_from() {
        let rows = [measured("a", "linear"), blank("b", "linear")];
        let rows: Vec<Value> = rows.iter().map(Record::to_value).collect();
        let text = markdown(&rows, Path::new("results/x/record.json"));
        for part in [
            "2026-01-02",
            "0123456789ab",
            "test adapter",
            "98.10",
            "(results/x/record.json)",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert!(!text.contains("remark"), "{text}");
        assert_eq!(link(Path::new("a b(1).json")), "a%20b%281%29.json");
    }
}

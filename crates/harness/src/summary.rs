//! `catoptric summary`: the short table of a recorded run, on stdout or spliced into a text such
//! as the README.

use std::path::Path;

use anyhow::Context;
use catoptric_frame::write_whole;
use serde_json::Value;

use crate::cli::{Common, Format};
use crate::exit::{Outcome, bad_input};
use crate::gate::lookup;
use crate::print::{self, cell};
use crate::{record, setup};

/// Line before the table in a text.
const BEGIN: &str = "<!-- summary: begin -->";
/// Line after it.
const END: &str = "<!-- summary: end -->";

/// Columns of the table: those that fit on a page.
const COLUMNS: [&str; 7] = [
    "agree %",
    "missing %",
    "angle p50 °",
    "offset px",
    "FLIP",
    "evals",
    "GPU ms",
];

/// Prints the summary of a record, or splices it into a text between its markers.
pub fn run(path: &Path, into: Option<&Path>, common: &Common) -> anyhow::Result<Outcome> {
    let rows = record::read(path)?;
    let Some(into) = into else {
        let text = match common.format {
            Format::Table | Format::Markdown => markdown(&rows, path),
            Format::Csv => table(&rows, Format::Csv),
            Format::Json => return print::json(&Value::Array(rows)).map(|()| Outcome::Done),
        };
        return print::text(&text).map(|()| Outcome::Done);
    };
    setup::check_writable(into)?;
    let text = std::fs::read_to_string(into);
    let text = text.with_context(|| format!("cannot read {}", into.display()))?;
    let spliced = splice(&text, &markdown(&rows, path)).ok_or_else(|| {
        let file = into.display();
        bad_input(format!(
            "{file}: no line `{BEGIN}` with a line `{END}` after it"
        ))
    })?;
    write_whole(into, spliced.as_bytes())?;
    Ok(Outcome::Done)
}

/// The table and where it comes from.
fn markdown(rows: &[Value], path: &Path) -> String {
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
        "Recorded {} at revision {} on {}{note} by\n`{}`:\n\n{}",
        first("meta.date").split('T').next().unwrap_or_default(),
        first("meta.revision"),
        first("adapter.name"),
        first("meta.command"),
        table(rows, Format::Markdown),
    ) + &format!(
        "\nEverything measured is in [record.json]({}).\n",
        path.display()
    )
}

fn table(rows: &[Value], format: Format) -> String {
    let mut table = print::summary(rows);
    let wanted = |heading: &String| {
        ["scene", "technique"].contains(&heading.as_str()) || COLUMNS.contains(&heading.as_str())
    };
    let keep: Vec<bool> = table.heading.iter().map(wanted).collect();
    let kept = |cells: &mut Vec<String>| {
        let mut places = keep.iter();
        cells.retain(|_| places.next() == Some(&true));
    };
    kept(&mut table.heading);
    table.rows.iter_mut().for_each(kept);
    table.write(format)
}

/// Replaces what stands between the markers.
fn splice(text: &str, summary: &str) -> Option<String> {
    let (before, rest) = text.split_once(BEGIN)?;
    let (_, after) = rest.split_once(END)?;
    Some(format!("{before}{BEGIN}\n{summary}{END}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::{blank, measured};

    #[test]
    fn what_is_spliced_twice_is_spliced_once() {
        let text = format!("# A\n{BEGIN}\nold\n{END}\nB\n");
        let once = splice(&text, "new\n").unwrap();
        assert_eq!(once, format!("# A\n{BEGIN}\nnew\n{END}\nB\n"));
        assert_eq!(splice(&once, "new\n").unwrap(), once);
        assert_eq!(splice("no markers", "new\n"), None);
        assert_eq!(splice(&format!("{END}{BEGIN}"), "new\n"), None);
    }

    #[test]
    fn the_summary_says_where_it_comes_from() {
        let rows = [measured("a", "linear"), blank("b", "linear")];
        let rows: Vec<Value> = rows.iter().map(record::Record::to_value).collect();
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
    }
}

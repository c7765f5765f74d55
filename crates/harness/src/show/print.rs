//! Results on stdout or in the file asked for.

use std::io::Write;
use std::path::Path;

use anyhow::Context;
use serde_json::Value;

use crate::options::{Common, Format};
use crate::output::check_writable;
use crate::record::path::leaves;
use crate::terminal::plain;

use super::table::{Table, cell};

/// Writes text to stdout, where it cannot command a terminal; a reader that has gone away is no error.
pub fn text(text: &str) -> anyhow::Result<()> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(plain(text).as_bytes());
    match written.and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        result => result.context("cannot write to stdout"),
    }
}

/// Writes a value as indented JSON.
pub fn json(value: &Value) -> anyhow::Result<()> {
    text(&format!("{value:#}\n"))
}

/// How a file of this name is written, as its ending says; `None` for other endings.
pub fn format_of(path: &Path) -> Option<Format> {
    match path.extension()?.to_str()? {
        "json" => Some(Format::Json),
        "csv" => Some(Format::Csv),
        "md" => Some(Format::Markdown),
        _ => None,
    }
}

/// How a result is written that goes to the file asked for, else to stdout.
pub fn format(common: &Common) -> Format {
    let of_file = common.output.as_deref().and_then(format_of);
    of_file.unwrap_or(common.format)
}

/// Writes a result to the file asked for, else to stdout.
pub fn result(result: &str, common: &Common) -> anyhow::Result<()> {
    match &common.output {
        Some(path) => {
            check_writable(path)?;
            Ok(catoptric_frame::write_whole(path, result.as_bytes())?)
        }
        None => text(result),
    }
}

/// Writes a listing, to the file asked for or to stdout: JSON as it is, else a table of the named
/// members.
pub fn listing(rows: &[Value], columns: &[&str], common: &Common) -> anyhow::Result<()> {
    let format = format(common);
    if format == Format::Json {
        return result(&format!("{:#}\n", Value::Array(rows.to_vec())), common);
    }
    let mut table = Table::new(columns.iter().copied());
    for row in rows {
        table.row(columns.iter().map(|column| cell(row.get(*column))));
    }
    result(&table.write(format), common)
}

/// Names and values, one a line.
pub fn facts(value: &Value, format: Format) -> String {
    if format == Format::Json {
        return format!("{value:#}\n");
    }
    let mut table = Table::new(["name", "value"]);
    for (path, value) in leaves(value) {
        table.row([path, cell(Some(&value))]);
    }
    table.write(format)
}

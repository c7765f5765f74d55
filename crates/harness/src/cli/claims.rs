//! `catoptric claims`: what became of the papers' claims, by recorded runs of the suites.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, Format};
use crate::record;
use crate::record::path::lookup;
use crate::show::print;
use crate::suites::ledger::{self, Entry};
use crate::suites::{self, Row};

use super::splice;

/// What `claims` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// `record.json` of runs of `bench`; where several have a measurement, the first one's counts
    #[arg(required = true)]
    pub records: Vec<PathBuf>,
    /// Text with the lines `<!-- claims: begin -->` and `<!-- claims: end -->`
    #[arg(long, value_name = "FILE")]
    pub into: Option<PathBuf>,
}

/// Prints the table of all claims, or splices it into a text.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    if args.into.is_some() && (common.output.is_some() || common.format != Format::Table) {
        return Err(bad_input(
            "--into splices Markdown into a text: it goes without -o and --format",
        ));
    }
    let mut rows = Vec::new();
    for path in &args.records {
        rows.extend(record::read(path)?);
    }
    let from = source(&rows, &args.records);
    let rows: Vec<Row> = rows.into_iter().filter_map(Row::read).collect();
    let entries = ledger::published(suites::claims_by(&rows));
    if let Some(into) = &args.into {
        splice::into_file(into, "claims", &markdown(&entries, &from))?;
        return Ok(Outcome::Done);
    }
    let text = match print::format(common) {
        Format::Json => format!("{:#}\n", ledger::value(&entries)),
        Format::Markdown => markdown(&entries, &from),
        format @ (Format::Table | Format::Csv) => ledger::table(&entries).write(format),
    };
    print::result(&text, common).map(|()| Outcome::Done)
}

/// Where the numbers come from, in a sentence.
fn source(rows: &[Value], records: &[PathBuf]) -> String {
    let known = |path: &str| rows.iter().find_map(|row| lookup(row, path)?.as_str());
    let date = known("meta.date").and_then(|date| date.split('T').next());
    let names = records.iter().map(|path: &PathBuf| link(path));
    format!(
        "Measured {} on {}: {}.",
        date.unwrap_or("at an unknown date"),
        known("adapter.name").unwrap_or("an unknown adapter"),
        names.collect::<Vec<_>>().join(", ")
    )
}

fn link(path: &Path) -> String {
    let name = path
        .parent()
        .and_then(Path::file_name)
        .unwrap_or(path.as_os_str());
    format!("`{}`", name.to_string_lossy())
}

/// The tally, the table and the claims that are not judged, folded.
fn markdown(entries: &[Entry], from: &str) -> String {
    format!(
        "{} {from}\n\n<details><summary>All of them</summary>\n\n{}\n</details>\n\n\
         <details><summary>Claims that are not judged, and why</summary>\n\n{}\n</details>\n",
        ledger::tally(entries),
        ledger::table(entries).write(Format::Markdown),
        ledger::open().write(Format::Markdown)
    )
}

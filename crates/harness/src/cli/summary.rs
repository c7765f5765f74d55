//! `catoptric summary`: the short table of a recorded run, on stdout or spliced into a text such
//! as the README.

use std::path::PathBuf;

use serde_json::Value;

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, Format};
use crate::record;
use crate::show::print;
use crate::show::summary::{markdown, table};

use super::splice;

/// What `summary` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// A run's record.json
    pub record: PathBuf,
    /// Text with the lines `<!-- summary: begin -->` and `<!-- summary: end -->`
    #[arg(long, value_name = "FILE")]
    pub into: Option<PathBuf>,
}

/// Prints the summary of a record, or splices it into a text between its markers.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let path = &args.record;
    if args.into.is_some() && (common.output.is_some() || common.format != Format::Table) {
        return Err(bad_input(
            "--into splices Markdown into a text: it goes without -o and --format",
        ));
    }
    let rows = record::read(path)?;
    let Some(into) = &args.into else {
        let text = match print::format(common) {
            Format::Table | Format::Markdown => markdown(&rows, path),
            Format::Csv => table(&rows, Format::Csv),
            Format::Json => format!("{:#}\n", Value::Array(rows)),
        };
        return print::result(&text, common).map(|()| Outcome::Done);
    };
    splice::into_file(into, "summary", &markdown(&rows, path))?;
    Ok(Outcome::Done)
}

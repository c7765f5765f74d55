//! `catoptric summary`: the short table of a recorded run, on stdout or spliced into a text such
//! as the README.

use std::path::PathBuf;

use catoptric_frame::write_whole;
use serde_json::Value;

use crate::exit::{Outcome, bad_input};
use crate::input;
use crate::options::{Common, Format};
use crate::output::check_writable;
use crate::record;
use crate::show::print;
use crate::show::summary::{markdown, table};

/// What `summary` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// A run's record.json
    pub record: PathBuf,
    /// Text with the lines `<!-- summary: begin -->` and `<!-- summary: end -->`
    #[arg(long, value_name = "FILE")]
    pub into: Option<PathBuf>,
}

/// Line before the table in a text.
const BEGIN: &str = "<!-- summary: begin -->";
/// Line after it.
const END: &str = "<!-- summary: end -->";

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
    check_writable(into)?;
    let text = input::text(into)?;
    let spliced = splice(&text, &markdown(&rows, path)).ok_or_else(|| {
        let file = into.display();
        bad_input(format!(
            "{file}: no line `{BEGIN}` with a line `{END}` after it"
        ))
    })?;
    write_whole(into, spliced.as_bytes())?;
    Ok(Outcome::Done)
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

    #[test]
    fn what_is_spliced_twice_is_spliced_once() {
        let text = format!("# A\n{BEGIN}\nold\n{END}\nB\n");
        let once = splice(&text, "new\n").unwrap();
        assert_eq!(once, format!("# A\n{BEGIN}\nnew\n{END}\nB\n"));
        assert_eq!(splice(&once, "new\n").unwrap(), once);
        assert_eq!(splice("no markers", "new\n"), None);
        assert_eq!(splice(&format!("{END}{BEGIN}"), "new\n"), None);
    }
}

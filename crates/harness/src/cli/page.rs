//! `catoptric page`: recorded runs on one page, and what changed since an earlier one.

use std::path::{Path, PathBuf};

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, Format};
use crate::output::{Draft, PICTURES, check_writable};
use crate::record::delta::delta;
use crate::record::joined::{self, Joined};
use crate::show::runs::{self, Content};
use crate::show::{junit, print};
use crate::suites::runner::refuse_file_name;

/// What `page` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Records (JSON): one run, its parts, or runs of several adapters
    #[arg(required = true, value_name = "RECORD")]
    pub records: Vec<PathBuf>,
    /// The record of an earlier run (several times: its parts)
    #[arg(long, value_name = "RECORD")]
    pub against: Vec<PathBuf>,
    /// Write what got worse or vanished as JUnit's XML
    #[arg(long, value_name = "FILE", requires = "against")]
    pub junit: Option<PathBuf>,
}

/// Where the page goes if nothing else is said.
const FOLDER: &str = "page";

/// Writes a page into a folder, or a comment into a Markdown file.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let to = common
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(FOLDER));
    let is_text = print::format_of(&to) == Some(Format::Markdown) && !to.is_dir();
    match is_text {
        true => check_writable(&to)?,
        false => refuse_file_name(&to)?,
    }
    refuse_overwriting(args, &to)?;
    if let Some(path) = &args.junit {
        check_writable(path)?;
    }
    let now = joined::read(&args.records)?;
    let before = match args.against.is_empty() {
        true => None,
        false => {
            let before = named_as_now(joined::read(&args.against)?);
            let delta = delta(&before.rows, &now.rows);
            Some((before, delta))
        }
    };
    let content = Content {
        now: &now,
        before: before.as_ref().map(|(before, delta)| (before, delta)),
    };
    if let (Some(path), Some((before, delta))) = (&args.junit, &before) {
        junit::write("page", &junit::of_delta(&now, before, delta), path)?;
    }
    let written = match is_text {
        true => {
            catoptric_frame::write_whole(&to, runs::comment(&content).as_bytes())?;
            to
        }
        false => {
            let mut draft = Draft::begin(&to, &[PICTURES])?;
            let page = runs::page(&content, &draft)?;
            let mut record = serde_json::to_vec_pretty(&now.rows)?;
            record.push(b'\n');
            draft.put(&page, &record)?
        }
    };
    print::text(&format!("{}\n", written.display()))?;
    Ok(Outcome::Done)
}

/// Techniques by the names that they have now, whatever their options' order.
fn named_as_now(mut joined: Joined) -> Joined {
    for row in &mut joined.rows {
        let spec = row["technique"].as_str().map(catoptric_reflect::parse);
        if let Some(Ok(spec)) = spec {
            row["technique"] = spec.to_string().into();
        }
    }
    joined
}

/// Refuses a page whose record would replace one that is read.
fn refuse_overwriting(args: &Args, to: &Path) -> anyhow::Result<()> {
    let file = |path: &Path| std::fs::canonicalize(path).ok();
    let targets = [
        Some(to.join("record.json")),
        Some(to.to_owned()),
        args.junit.clone(),
    ];
    for target in targets.iter().flatten().filter_map(|path| file(path)) {
        let read = args.records.iter().chain(&args.against);
        if let Some(record) = read
            .into_iter()
            .find(|path| file(path).as_ref() == Some(&target))
        {
            return Err(bad_input(format!(
                "{} is read, and would be overwritten: name another folder (-o DIR)",
                record.display()
            )));
        }
    }
    Ok(())
}

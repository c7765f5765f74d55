//! `catoptric compare`: measure techniques on scenes and print the records.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::time::Duration;

use catoptric_reflect::Spec;
use serde_json::Value;

use crate::exit::{Outcome, bad_input};
use crate::input::brief;
use crate::options::{Common, Format, seconds};
use crate::output::check_writable;
use crate::record::gate::Gate;
use crate::record::path::lookup;
use crate::record::{self, Record, Status, against, metrics};
use crate::run::interrupt::interrupted;
use crate::run::load::parse;
use crate::run::{Setup, measure, product};
use crate::show::table::cell;
use crate::show::{changes, junit, print, records};
use crate::terminal::say;

/// What `compare` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in names or scene files
    #[arg(required = true)]
    pub scenes: Vec<String>,
    /// Such as `linear(residual=cross)`; several are allowed (`list techniques`)
    #[arg(short, long = "technique", value_name = "TECHNIQUE", required = true, num_args = 1..)]
    pub techniques: Vec<String>,
    /// Earlier results (JSON): say what got better or worse (with --format json on stderr, with csv
    /// instead of the records)
    #[arg(long, value_name = "RECORD")]
    pub against: Option<PathBuf>,
    /// Gate such as `angular_error_deg.p99<=0.05`: exit code 1 where a row breaks it
    #[arg(long, value_name = "METRIC<=X")]
    pub require: Vec<String>,
    /// Write what --require and --against found as JUnit's XML
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Seconds of timing for each scene, shared by the techniques
    #[arg(long, value_name = "SECONDS", default_value_t = 6.0, value_parser = seconds)]
    pub time_budget: f64,
    /// Follow so many frames of the scene's motion: jitter and jumps of the reflection points, and
    /// the cost of a moving frame
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub frames: Option<u32>,
}

/// Measures, prints, then checks gates and says what changed.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let gates = args
        .require
        .iter()
        .map(|text| Gate::parse(text))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let baseline = args.against.as_deref().map(read_baseline).transpose()?;
    let file = common.output.as_deref().map(to_file).transpose()?;
    if let Some(path) = &args.junit {
        check_writable(path)?;
    }
    each_pair_once(&args.scenes, &args.techniques)?;
    let timing = Duration::from_secs_f64(args.time_budget);
    let wanted = product(&args.scenes, &args.techniques, timing, args.frames);
    let setup = Setup::new(&wanted, common)?;

    let rows = measure(&setup, |_, rows| match file {
        Some((path, Format::Json)) => record::write(rows, path),
        Some((path, format)) => {
            let values: Vec<Value> = rows.iter().map(Record::to_value).collect();
            let text = records::text(&values, format);
            Ok(catoptric_frame::write_whole(path, text.as_bytes())?)
        }
        None => Ok(()),
    })?;

    let values: Vec<Value> = rows.iter().map(Record::to_value).collect();
    for (row, value) in rows.iter().zip(&values) {
        for note in row.reason.iter().chain(&row.meta.notes) {
            setup.progress.remark(&format!(
                "{}, {}: {note}",
                value["scene"].as_str().unwrap_or(""),
                row.technique
            ));
        }
    }
    if let (Some(baseline), Format::Csv) = (&baseline, common.format) {
        print::text(&changes::table(&against::changes(baseline, &values)).write(Format::Csv))?;
    } else {
        records::print(&values, common.format)?;
    }
    match (&baseline, common.format) {
        (Some(baseline), Format::Table | Format::Markdown) => {
            print::text(&format!(
                "\n{}",
                changes::table(&against::changes(baseline, &values)).write(common.format)
            ))?;
        }
        (Some(baseline), Format::Json) => {
            let changes = changes::table(&against::changes(baseline, &values)).write(Format::Table);
            setup.progress.remark(changes.trim_end());
        }
        (Some(_), Format::Csv) | (None, _) => {}
    }
    if let Some(path) = &args.junit {
        let mut cases = junit::of_rows(&rows, &values, &gates);
        if let Some(baseline) = &baseline {
            cases.extend(junit::of_changes(&against::changes(baseline, &values)));
        }
        junit::write("compare", &cases, path)?;
    }
    Ok(outcome(&rows, &values, &gates, setup.rows()))
}

/// Where the records go and how: as JSON unless the name ends otherwise.
fn to_file(path: &Path) -> anyhow::Result<(&Path, Format)> {
    check_writable(path)?;
    match (print::format_of(path), path.extension()) {
        (Some(format), _) => Ok((path, format)),
        (None, None) => Ok((path, Format::Json)),
        (None, Some(_)) => Err(bad_input(format!(
            "-o {}: records are written to .json, .csv or .md",
            path.display()
        ))),
    }
}

/// Refuses what would give two rows of one scene and technique.
fn each_pair_once(scenes: &[String], techniques: &[String]) -> anyhow::Result<()> {
    let mut specs: Vec<(&str, Spec)> = Vec::new();
    for text in techniques {
        let spec = parse(text)?;
        if let Some((other, _)) = specs.iter().find(|(_, known)| *known == spec) {
            return Err(bad_input(if *other == text.as_str() {
                format!("technique `{text}` is given twice")
            } else {
                format!("`{other}` and `{text}` are one technique, `{spec}`")
            }));
        }
        specs.push((text, spec));
    }
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for scene in scenes {
        let name = recorded(scene);
        let Some((other, _)) = seen.iter().find(|(_, known)| *known == name) else {
            seen.push((scene, name));
            continue;
        };
        let file = |scene: &str| std::fs::canonicalize(scene).ok();
        let same =
            *other == scene.as_str() || file(other).is_some_and(|path| file(scene) == Some(path));
        return Err(bad_input(if same {
            format!("scene `{scene}` is given twice")
        } else {
            format!(
                "`{other}` and `{scene}` would both be recorded as scene `{name}`: rename one or \
                 compare them one by one"
            )
        }));
    }
    Ok(())
}

/// What a scene is called in records: a built-in name, or the stem of a file.
fn recorded(scene: &str) -> &str {
    let stem = || Path::new(scene).file_stem().and_then(OsStr::to_str);
    match catoptric_scene::builtin::text(scene) {
        Some(_) => scene,
        None => stem().unwrap_or(scene),
    }
}

/// Earlier rows. Their techniques get the names they have now, whatever their options' order.
fn read_baseline(path: &Path) -> anyhow::Result<Vec<Value>> {
    let mut rows = record::read(path)?;
    for row in &mut rows {
        let odd = metrics::all().iter().find_map(|metric| {
            let value = lookup(row, &metric.path)?;
            (!value.is_null() && !value.is_number()).then_some((&metric.path, value))
        });
        if let Some((metric, value)) = odd {
            return Err(bad_input(format!(
                "{}: {}, {}: `{metric}` is {}, not a number",
                path.display(),
                cell(row.get("scene")),
                cell(row.get("technique")),
                brief(value)
            )));
        }
        let spec = row["technique"].as_str().map(catoptric_reflect::parse);
        if let Some(Ok(spec)) = spec {
            row["technique"] = spec.to_string().into();
        }
    }
    Ok(rows)
}

/// Whether every row came out, within its gates.
fn outcome(rows: &[Record], values: &[Value], gates: &[Gate], wanted: usize) -> Outcome {
    let mut outcome = Outcome::Done;
    if interrupted() && rows.len() < wanted {
        say(&format!(
            "catoptric: interrupted after {} of {wanted} rows",
            rows.len()
        ));
        outcome = Outcome::FellShort;
    }
    for (row, value) in rows.iter().zip(values) {
        if row.status == Status::Failed {
            let reason = row.reason.as_deref().unwrap_or_default();
            say(&format!(
                "catoptric: {}, {}: failed: {reason}",
                row.scene, row.technique
            ));
            outcome = Outcome::FellShort;
        }
        if row.status != Status::Ok {
            continue;
        }
        for trip in gates.iter().filter_map(|gate| gate.trips(value)) {
            say(&format!(
                "catoptric: {}, {}: gate {trip}",
                row.scene, row.technique
            ));
            outcome = Outcome::FellShort;
        }
    }
    // A gate that no row could break shows nothing.
    if !gates.is_empty() && rows.iter().all(|row| row.status != Status::Ok) {
        say("catoptric: gates were given, and no row has a measurement");
        outcome = Outcome::FellShort;
    }
    outcome
}

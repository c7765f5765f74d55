//! `catoptric compare`: measure techniques on scenes and print the records.

use std::time::Duration;

use serde_json::Value;

use crate::cli::{Common, CompareArgs, Format};
use crate::exit::Outcome;
use crate::gate::Gate;
use crate::record::{self, Record, Status};
use crate::setup::{self, Setup};
use crate::{against, pipeline, print};

/// Measures, prints, then checks gates and says what changed.
pub fn run(args: &CompareArgs, common: &Common) -> anyhow::Result<Outcome> {
    let gates = args
        .require
        .iter()
        .map(|text| Gate::parse(text))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let baseline = args.against.as_deref().map(record::read).transpose()?;
    if let Some(path) = &common.output {
        setup::check_writable(path)?;
    }
    let timing = Duration::from_secs_f64(args.time_budget);
    let wanted = setup::product(&args.scenes, &args.techniques, timing, args.frames);
    let setup = Setup::new(&wanted, common)?;

    let rows = crate::measure(&setup, |_, rows| match &common.output {
        Some(path) => record::write(rows, path),
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
        print::text(&against::changes(baseline, &values).write(Format::Csv))?;
    } else {
        print::records(&values, common.format)?;
    }
    match (&baseline, common.format) {
        (Some(baseline), Format::Table | Format::Markdown) => {
            print::text(&format!(
                "\n{}",
                against::changes(baseline, &values).write(common.format)
            ))?;
        }
        (Some(baseline), Format::Json) => {
            let changes = against::changes(baseline, &values).write(Format::Table);
            setup.progress.remark(changes.trim_end());
        }
        (Some(_), Format::Csv) | (None, _) => {}
    }
    Ok(outcome(&rows, &values, &gates, setup.rows()))
}

/// Whether every row came out, within its gates.
fn outcome(rows: &[Record], values: &[Value], gates: &[Gate], wanted: usize) -> Outcome {
    let mut outcome = Outcome::Done;
    if pipeline::interrupted() && rows.len() < wanted {
        eprintln!(
            "catoptric: interrupted after {} of {wanted} rows",
            rows.len()
        );
        outcome = Outcome::FellShort;
    }
    for (row, value) in rows.iter().zip(values) {
        if row.status == Status::Failed {
            let reason = row.reason.as_deref().unwrap_or_default();
            eprintln!(
                "catoptric: {}, {}: failed: {reason}",
                row.scene, row.technique
            );
            outcome = Outcome::FellShort;
        }
        if row.status != Status::Ok {
            continue;
        }
        for trip in gates.iter().filter_map(|gate| gate.trips(value)) {
            eprintln!("catoptric: {}, {}: gate {trip}", row.scene, row.technique);
            outcome = Outcome::FellShort;
        }
    }
    // A gate that no row could break shows nothing.
    if !gates.is_empty() && rows.iter().all(|row| row.status != Status::Ok) {
        eprintln!("catoptric: gates were given, and no row has a measurement");
        outcome = Outcome::FellShort;
    }
    outcome
}

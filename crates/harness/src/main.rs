//! `catoptric`: how exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The program reads as one sentence, [`measure()`]: load a scene, trace its reference, render it by
//! every technique, compare, time, record. `compare` prints the records, `report` makes a page of
//! them, the other commands are single words of the sentence.

mod against;
mod cli;
mod compare;
mod diff;
mod doctor;
mod exit;
mod gate;
mod list;
mod measure;
mod pictures;
mod pipeline;
mod print;
mod progress;
mod provenance;
mod record;
mod report;
mod schema;
mod setup;
mod table;

use std::process::ExitCode;

use clap::Parser;

use crate::cli::{Cli, Command};
use crate::exit::Outcome;
use crate::pipeline::{Rendered, Truth};
use crate::record::Record;
use crate::setup::Setup;

fn main() -> ExitCode {
    match run(Cli::parse()) {
        Ok(outcome) => outcome.into(),
        Err(error) => {
            eprintln!("catoptric: {error:#}");
            ExitCode::from(exit::code(&error))
        }
    }
}

fn run(Cli { command, common }: Cli) -> anyhow::Result<Outcome> {
    match command {
        Command::List { what } => list::run(what, &common),
        Command::Reference {
            scene,
            truth,
            samples,
        } => pictures::reference(&scene, truth, samples, &common),
        Command::Render { scene, technique } => pictures::render(&scene, &technique, &common),
        Command::Compare(args) => compare::run(&args, &common),
        Command::Bench { suite } => Err(exit::bad_input(format!(
            "no suite `{suite}`: this version has no bench suites yet; `cargo bench -p catoptric` runs the \
             criterion benchmarks, `catoptric report --suite quick|full` measures scenes"
        ))),
        Command::Report { suite, time_budget } => report::run(suite, time_budget, &common),
        Command::Diff { reference, test } => diff::run(&reference, &test, &common),
        Command::Doctor => doctor::run(&common),
    }
}

/// What one scene gave: its rows in the order of the techniques, and what they were made from.
struct Measured<'a, 'g> {
    scene: &'a catoptric_scene::Scene,
    truth: &'a Truth,
    rendered: &'a [Result<Rendered<'g>, pipeline::Blank>],
    rows: &'a [Record],
}

/// Load → trace the reference → render → compare → time → record, for every scene and technique.
/// `finished` is called after each scene with its pictures (`None` where it is not available) and
/// with all rows so far.
fn measure(
    setup: &Setup,
    mut finished: impl FnMut(Option<Measured<'_, '_>>, &[Record]) -> anyhow::Result<()>,
) -> anyhow::Result<Vec<Record>> {
    let mut rows: Vec<Record> = Vec::new();
    for loaded in &setup.scenes {
        if pipeline::interrupted() {
            break;
        }
        let scene = match loaded {
            (_, Ok(scene)) => scene,
            (name, Err(reason)) => {
                rows.extend(setup.unavailable(name, reason));
                finished(None, &rows)?;
                continue;
            }
        };
        let doing = |what: &str| setup.progress.doing(format!("{}: {what}", scene.name));

        doing("tracing the reference");
        let truth = pipeline::trace_reference(scene, setup.bounces)?;

        let mut rendered = Vec::new();
        for spec in &setup.techniques {
            doing(&format!("rendering {spec}"));
            rendered.push(pipeline::render(&setup.gpu, spec, scene));
            setup.progress.step();
        }

        let mut compared = Vec::new();
        for (spec, row) in setup.techniques.iter().zip(&rendered) {
            doing(&format!("comparing {spec}"));
            let output = row.as_ref().map(|row| &row.output).map_err(Clone::clone);
            compared.push(output.and_then(|output| pipeline::compare(scene, &truth, output)));
        }

        doing("timing");
        let timed = pipeline::time(&mut rendered, setup.time_budget);

        let first = rows.len();
        for (((spec, rendered), compared), samples) in setup
            .techniques
            .iter()
            .zip(&rendered)
            .zip(compared)
            .zip(timed)
        {
            rows.push(setup.record(scene, spec, rendered, compared, samples));
            setup.progress.step();
        }
        let (truth, rendered) = (&truth, rendered.as_slice());
        finished(
            Some(Measured {
                scene,
                truth,
                rendered,
                rows: &rows[first..],
            }),
            &rows,
        )?;
    }
    setup.progress.finish();
    Ok(rows)
}

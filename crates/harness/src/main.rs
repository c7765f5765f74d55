//! `catoptric`: how exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The program reads as one sentence, [`measure()`]: load a scene, trace its reference, render it by
//! every technique, compare, time, record. `compare` prints the records, `report` makes a page of
//! them, the other commands are single words of the sentence.

mod against;
mod check;
mod cli;
mod compare;
mod diff;
mod doctor;
mod exit;
mod export;
mod gate;
mod list;
mod measure;
mod motion;
mod pictures;
mod pipeline;
mod plot;
mod print;
mod progress;
mod provenance;
mod record;
mod report;
mod schema;
mod setup;
mod suggest;
mod suites;
mod summary;
mod table;

use std::process::ExitCode;

use catoptric_reflect::Gpu;
use catoptric_scene::Scene;
use clap::Parser;

use crate::cli::{Cli, Command};
use crate::exit::Outcome;
use crate::pipeline::{Blank, Rendered, Truth};
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
    let common = setup::settled(common)?;
    match command {
        Command::List { what } => list::run(what, &common),
        Command::Reference {
            scene,
            truth,
            samples,
        } => pictures::reference(&scene, truth, samples, &common),
        Command::Render { scene, technique } => pictures::render(&scene, &technique, &common),
        Command::Compare(args) => compare::run(&args, &common),
        Command::Bench(args) => suites::run(&args, &common),
        Command::Report { suite, time_budget } => report::run(suite, time_budget, &common),
        Command::Diff { reference, test } => diff::run(&reference, &test, &common),
        Command::Summary { record, into } => summary::run(&record, into.as_deref(), &common),
        Command::Export { scene, mitsuba } => export::run(&scene, &mitsuba, &common),
        Command::Check(args) => check::run(&args, &common),
        Command::Doctor => doctor::run(&common),
    }
}

/// What one scene gave: its rows in the order of the techniques, and what they were made from.
struct Measured<'a, 'g> {
    gpu: &'g Gpu,
    scene: &'a Scene,
    truth: &'a Truth,
    rendered: &'a [Result<Rendered<'g>, Blank>],
    rows: &'a [Record],
}

/// So many techniques at most stand ready at once and are timed in turn: all of them would need
/// the memory of all.
const IN_TURN: usize = 8;

/// Why a row has no `temporal` though frames were asked for.
const STILL: &str = "the scene has no [motion]: there are no frames to follow";

/// Load → trace the reference → render → compare → time → record, for every scene and technique.
/// `finished` is called after each scene, or each [`IN_TURN`] techniques of it, with the pictures
/// (`None` where the scene is not available) and with all rows so far.
fn measure(
    setup: &Setup,
    mut finished: impl FnMut(Option<Measured<'_, '_>>, &[Record]) -> anyhow::Result<()>,
) -> anyhow::Result<Vec<Record>> {
    setup.begin();
    let mut rows: Vec<Record> = Vec::new();
    for job in &setup.jobs {
        if pipeline::interrupted() {
            break;
        }
        let scene = match &job.scene {
            Ok(scene) => scene,
            Err(reason) => {
                rows.extend(setup.unavailable(job, reason));
                finished(None, &rows)?;
                continue;
            }
        };
        let doing = |what: &str| setup.progress.doing(format!("{}: {what}", scene.name));
        doing("tracing the reference");
        let truth = pipeline::trace_reference(scene, setup.bounces)?;

        for techniques in job.techniques.chunks(IN_TURN) {
            if pipeline::interrupted() && !rows.is_empty() {
                break;
            }
            let mut rendered = Vec::new();
            for spec in techniques {
                doing(&format!("rendering {spec}"));
                rendered.push(pipeline::render(&setup.gpu, spec, scene));
                setup.progress.step();
            }

            let mut compared = Vec::new();
            for (spec, row) in techniques.iter().zip(&rendered) {
                doing(&format!("comparing {spec}"));
                let output = row.as_ref().map(|row| &row.output).map_err(Clone::clone);
                compared.push(output.and_then(|output| pipeline::compare(scene, &truth, output)));
            }

            doing("timing");
            let share = techniques.len() as f64 / job.techniques.len() as f64;
            let timed = pipeline::time(&mut rendered, job.timing.mul_f64(share));

            let moving = scene.motion.is_some();
            if let Some(frames) = job.frames.filter(|_| moving) {
                for (spec, row) in techniques.iter().zip(&mut rendered) {
                    doing(&format!("following {spec} over {frames} frames"));
                    if let Err(blank) = pipeline::follow(row, scene, frames) {
                        *row = Err(blank);
                    }
                }
            }

            let first = rows.len();
            let parts = techniques.iter().zip(&rendered).zip(compared).zip(timed);
            for (((spec, rendered), compared), samples) in parts {
                let mut row = setup.record(job, scene, spec, rendered, compared, samples);
                if job.frames.is_some() && !moving {
                    row.meta.notes.push(STILL.to_owned());
                }
                rows.push(row);
                setup.progress.step();
            }
            let measured = Measured {
                gpu: &setup.gpu,
                scene,
                truth: &truth,
                rendered: &rendered,
                rows: &rows[first..],
            };
            finished(Some(measured), &rows)?;
        }
    }
    setup.progress.finish();
    Ok(rows)
}

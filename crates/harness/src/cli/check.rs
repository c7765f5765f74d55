//! `catoptric check`: our tracer against pictures that another renderer made of the same scenes.

use std::path::{Path, PathBuf};

use anyhow::Context;
use catoptric_metrics::Colormap;
use catoptric_reference::{RayStart, Truth};
use serde_json::{Value, json};

use crate::check::case::{self, Request};
use crate::check::layer::Layer;
use crate::check::verdict::{Verdict, verdict};
use crate::exit::Outcome;
use crate::options::{Common, Format};
use crate::output::check_writable;
use crate::run::progress::Progress;
use crate::show::table::Table;
use crate::show::{junit, print};
use crate::terminal::say;

/// Where error maps go if nothing else is said.
const MAPS: &str = "check-errors";

/// Checks one picture or all stored ones; error maps are written of what falls short.
pub fn run(args: &Request, common: &Common) -> anyhow::Result<Outcome> {
    if let Some(path) = &args.junit {
        check_writable(path)?;
    }
    let cases = case::cases(args, common)?;
    let progress = Progress::new(cases.len(), common.quiet);
    let mut verdicts = Vec::new();
    for case in &cases {
        progress.doing(format!("{}: tracing", case.name));
        for start in &case.starts {
            verdicts.push(verdict(case, *start)?);
        }
        progress.step();
    }
    progress.finish();
    let folder = common.output.clone().unwrap_or_else(|| PathBuf::from(MAPS));
    let maps = write_maps(&verdicts, &folder)?;
    if let Some(path) = &args.junit {
        junit::write("check", &junit_cases(&verdicts), path)?;
    }
    show(&verdicts, common.format)?;
    if !common.quiet {
        remark(&verdicts);
        if maps > 0 {
            say(&format!("{maps} error maps in {}", folder.display()));
        }
    }
    Ok(if verdicts.iter().all(Verdict::passed) {
        Outcome::Done
    } else {
        Outcome::FellShort
    })
}

/// A case for each layer of each comparison.
fn junit_cases(verdicts: &[Verdict<'_>]) -> Vec<junit::Case> {
    let rows = verdicts.iter().flat_map(|verdict| {
        let layers = verdict.measured.layers.iter();
        layers.map(move |layer| (verdict, layer))
    });
    let case = |(verdict, layer): (&Verdict<'_>, &Layer)| junit::Case {
        class: verdict.case.name.clone(),
        name: format!("{}, rays start: {}", layer.layer, start_name(verdict.start)),
        outcome: match verdict.of(layer) {
            "ok" => junit::Outcome::Passed,
            said @ "nothing to compare" => junit::Outcome::Skipped(said.to_owned()),
            said => junit::Outcome::Failed(format!("{said}: the limit is {}", layer.limit)),
        },
    };
    rows.map(case).collect()
}

fn truth_name(truth: Truth) -> String {
    match truth {
        Truth::FirstBounce => "first-bounce".to_owned(),
        Truth::Full { bounces } => format!("full, {bounces}"),
    }
}

fn start_name(start: RayStart) -> &'static str {
    match start {
        RayStart::Exact => "surface",
        RayStart::Mitsuba => "Mitsuba's",
    }
}

fn show(verdicts: &[Verdict<'_>], format: Format) -> anyhow::Result<()> {
    let rows = || {
        verdicts.iter().flat_map(|verdict| {
            verdict
                .measured
                .layers
                .iter()
                .map(move |layer| (verdict, layer))
        })
    };
    if format == Format::Json {
        let row = |(verdict, layer): (&Verdict<'_>, &Layer)| -> anyhow::Result<Value> {
            let mut row = json!({
                "picture": verdict.case.name,
                "scene": verdict.case.scene.name,
                "truth": truth_name(verdict.truth),
                "start": start_name(verdict.start),
                "verdict": verdict.of(layer),
                "mirror_pixels": verdict.measured.mirror_pixels,
                "apart": verdict.measured.apart,
            });
            if let (Value::Object(row), Value::Object(layer)) =
                (&mut row, serde_json::to_value(layer)?)
            {
                row.extend(layer);
            }
            Ok(row)
        };
        return print::json(&rows().map(row).collect::<anyhow::Result<Value>>()?);
    }
    let mut table = Table::new([
        "picture",
        "truth",
        "rays start",
        "layer",
        "pixels",
        "agree %",
        "p50",
        "p99.9",
        "max",
        "limit",
        "verdict",
    ]);
    for (verdict, layer) in rows() {
        let number =
            |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.1e}"));
        table.row([
            verdict.case.name.clone(),
            truth_name(verdict.truth),
            start_name(verdict.start).to_owned(),
            layer.layer.to_owned(),
            layer.pixels.to_string(),
            layer
                .agree
                .map_or("–".to_owned(), |agree| format!("{:.3}", 100.0 * agree)),
            number(layer.p50),
            number(layer.p999),
            number(layer.max),
            layer.limit.clone(),
            verdict.of(layer).to_owned(),
        ]);
    }
    print::text(&table.write(format))
}

/// What the table has no column for.
fn remark(verdicts: &[Verdict<'_>]) {
    for Verdict { case, measured, .. } in verdicts.iter().filter(|v| v.start == v.case.starts[0]) {
        if let Some(hash) = &case.stale {
            say(&format!(
                "{}: stale: the scene has changed since the picture was made ({:.12} was, {:.12} is); \
                 render it again",
                case.name, hash, case.scene.hash
            ));
        }
        for layer in measured.layers.iter().filter(|layer| layer.not_numbers > 0) {
            say(&format!(
                "{}: {}: {} of {} pixels are NaN or infinite, or too far off for a 32-bit float",
                case.name, layer.layer, layer.not_numbers, layer.pixels
            ));
        }
        if measured.apart > 0 {
            say(&format!(
                "{}: {} of {} mirror pixels reflect below the mesh's surface: counted apart",
                case.name, measured.apart, measured.mirror_pixels
            ));
        }
    }
    let fell = verdicts.iter().filter(|verdict| !verdict.passed()).count();
    say(&format!(
        "{} of {} comparisons hold",
        verdicts.len() - fell,
        verdicts.len()
    ));
}

/// Writes a map of each layer that falls short; how many.
fn write_maps(verdicts: &[Verdict<'_>], folder: &Path) -> anyhow::Result<usize> {
    let mut count = 0;
    for verdict in verdicts {
        for layer in verdict.measured.layers.iter().filter(|layer| !layer.passed) {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("cannot make the folder {}", folder.display()))?;
            let start = match verdict.start {
                RayStart::Exact => "surface",
                RayStart::Mitsuba => "mitsuba",
            };
            let name = layer.layer.replace(' ', "");
            let path = folder.join(format!("{}-{start}-{name}.png", verdict.case.name));
            let (map, brightest) = &layer.map;
            let painted = catoptric_metrics::colorize(map, [0.0, *brightest], Colormap::Magma);
            catoptric_frame::write_png_rgb8(&painted, path)?;
            count += 1;
        }
    }
    Ok(count)
}

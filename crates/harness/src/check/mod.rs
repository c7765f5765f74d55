//! `catoptric check`: our tracer against pictures that another renderer made of the same scenes.

mod case;
mod color;
mod layer;
mod limits;
mod masks;
mod measure;

use std::path::{Path, PathBuf};

use anyhow::Context;
use catoptric_metrics::Colormap;
use catoptric_reference::{RayStart, Truth};
use serde_json::{Value, json};

use crate::cli::{CheckArgs, Common, Format};
use crate::exit::{Outcome, bad_input};
use crate::print;
use crate::progress::Progress;
use crate::table::Table;

use self::case::Case;
use self::layer::Layer;
use self::measure::{Measured, Ours};

/// Where error maps go if nothing else is said.
const MAPS: &str = "check-errors";

/// Checks one picture or all stored ones; error maps are written of what falls short.
pub fn run(args: &CheckArgs, common: &Common) -> anyhow::Result<Outcome> {
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
    show(&verdicts, common.format)?;
    if !common.quiet {
        say(&verdicts);
        if maps > 0 {
            eprintln!("{maps} error maps in {}", folder.display());
        }
    }
    Ok(if verdicts.iter().all(Verdict::passed) {
        Outcome::Done
    } else {
        Outcome::FellShort
    })
}

/// What became of a picture, with our rays starting in one way.
struct Verdict<'c> {
    case: &'c Case,
    start: RayStart,
    truth: Truth,
    measured: Measured,
}

impl Verdict<'_> {
    fn passed(&self) -> bool {
        self.case.stale.is_none() && self.measured.passed()
    }

    fn of(&self, layer: &Layer) -> &'static str {
        match (&self.case.stale, layer.passed) {
            (Some(_), _) => "stale",
            (None, true) if layer.pixels == 0 => "nothing to compare",
            (None, true) => "ok",
            (None, false) => "falls short",
        }
    }
}

/// Of the truths that a picture may show, the first that fits, else the one it is nearest to.
fn verdict(case: &Case, start: RayStart) -> anyhow::Result<Verdict<'_>> {
    let mut best: Option<Verdict<'_>> = None;
    for truth in &case.truths {
        let ours = Ours::trace(&case.scene, case.channels.size(), *truth, start, case.side)?;
        let measured = measure::measure(&case.channels, &ours)?;
        if measured.layers.is_empty() {
            return Err(bad_input(format!(
                "{}: no layer that could be compared; it has {}",
                case.name,
                case.channels.channel_names().collect::<Vec<_>>().join(", ")
            )));
        }
        let passed = measured.passed();
        let nearer = best
            .as_ref()
            .is_none_or(|best| measured.disagreement() < best.measured.disagreement());
        if passed || nearer {
            best = Some(Verdict {
                case,
                start,
                truth: *truth,
                measured,
            });
        }
        if passed {
            break;
        }
    }
    best.context("no truth to compare with")
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
fn say(verdicts: &[Verdict<'_>]) {
    for Verdict { case, measured, .. } in verdicts.iter().filter(|v| v.start == v.case.starts[0]) {
        if let Some(hash) = &case.stale {
            eprintln!(
                "{}: stale: the scene has changed since the picture was made ({:.12} was, {:.12} is); \
                 render it again",
                case.name, hash, case.scene.hash
            );
        }
        if measured.apart > 0 {
            eprintln!(
                "{}: {} of {} mirror pixels reflect below the mesh's surface: counted apart",
                case.name, measured.apart, measured.mirror_pixels
            );
        }
    }
    let fell = verdicts.iter().filter(|verdict| !verdict.passed()).count();
    eprintln!(
        "{} of {} comparisons hold",
        verdicts.len() - fell,
        verdicts.len()
    );
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

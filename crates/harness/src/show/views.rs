//! The record as the page's template wants it: text that is ready to be shown.

use serde_json::Value;

use crate::record::metric::Unit;
use crate::record::path::lookup;
use crate::record::{Record, Status, metrics};

use super::facts::Fact;
use super::number::{count, or_dash, percent, share, significant};
use super::pictures::{self, Names};
use super::plot::SERIES;
use super::{diagrams, html, words};

/// A line of the summary.
pub struct SummaryRow {
    /// The scene.
    pub scene: String,
    /// The scene's section.
    pub anchor: String,
    /// True at a scene's first technique.
    pub first: bool,
    /// The technique; HTML.
    pub technique: String,
    /// The technique's colour.
    pub color: &'static str,
    /// As many as there are [`headings`]; none for a row without numbers.
    pub cells: Vec<String>,
    /// Why there are no numbers.
    pub reason: String,
}

/// The numbers of the summary.
const SUMMARY: [&str; 9] = [
    "object_agreement",
    "coverage.missing",
    "coverage.extra",
    "angular_error_deg.p50",
    "angular_error_deg.p99",
    "vertices.offset_px.mean",
    "color.flip",
    "work.total",
    "time_ms.frame.median",
];

/// Headings of the summary's numbers, and what they mean.
pub fn headings() -> Vec<(String, &'static str)> {
    let metrics = SUMMARY.iter().map(|path| metrics::known(path));
    metrics
        .map(|metric| (metric.column(), metric.what.as_str()))
        .collect()
}

/// A scene's section.
pub struct Scene {
    /// Name.
    pub name: String,
    /// Place on the page.
    pub anchor: String,
    /// What the scene is for.
    pub why: String,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Techniques with pictures.
    pub techniques: Vec<Technique>,
    /// Techniques without, and why.
    pub blanks: Vec<Fact>,
    /// Every timing sample, as a plot.
    pub samples: Option<String>,
    /// Whether the techniques' times differ.
    pub differences: Vec<String>,
    /// The truth `full`, where it differs.
    pub full: Option<String>,
}

/// A technique on a scene.
pub struct Technique {
    /// Name.
    pub name: String,
    /// Colour in the diagrams.
    pub color: &'static str,
    /// Pictures.
    pub names: Names,
    /// What the numbers mean; HTML.
    pub sentences: Vec<String>,
    /// Counted work, which is the same on every adapter.
    pub work: Vec<Fact>,
    /// The numbers.
    pub facts: Vec<Fact>,
    /// Time by pass.
    pub passes: Vec<Pass>,
    /// Why there is none.
    pub passes_reason: String,
}

/// A pass in a technique's bar of time.
pub struct Pass {
    /// Name.
    pub name: String,
    /// Median time in milliseconds.
    pub time: String,
    /// Share of the frame.
    pub share: String,
    /// Where it begins, per cent of the bar.
    pub x: f64,
    /// How long it is, per cent of the bar.
    pub width: f64,
    /// Colour.
    pub color: &'static str,
}

/// Techniques in order of appearance.
pub fn techniques(rows: &[Record]) -> Vec<String> {
    distinct(rows.iter().map(|row| row.technique.as_str()))
}

fn distinct<'r>(names: impl Iterator<Item = &'r str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        if !found.iter().any(|other| other == name) {
            found.push(name.to_owned());
        }
    }
    found
}

/// The colour of a technique.
pub fn color(technique: &str, techniques: &[String]) -> &'static str {
    let place = techniques
        .iter()
        .position(|other| other == technique)
        .unwrap_or(0);
    SERIES[place % SERIES.len()]
}

/// Lines of the summary.
pub fn summary(rows: &[Record], techniques: &[String]) -> Vec<SummaryRow> {
    let mut last = "";
    rows.iter()
        .map(|row| {
            let first = row.scene != last;
            last = &row.scene;
            let status = match row.status {
                Status::Ok => String::new(),
                Status::NotApplicable => "not applicable: ".to_owned(),
                Status::Failed => "failed: ".to_owned(),
            };
            SummaryRow {
                scene: row.scene.clone(),
                anchor: pictures::slug(&row.scene),
                first,
                technique: html::breakable(&row.technique),
                color: color(&row.technique, techniques),
                cells: if row.status == Status::Ok {
                    cells(row)
                } else {
                    Vec::new()
                },
                reason: status + row.reason.as_deref().unwrap_or_default(),
            }
        })
        .collect()
}

fn cells(row: &Record) -> Vec<String> {
    let value = row.to_value();
    let cell = |path: &&str| {
        let number = lookup(&value, path).and_then(Value::as_f64);
        match (*path, metrics::known(path).unit) {
            ("time_ms.frame.median", _) => time(row),
            // What a technique without vertices looks at is another thing.
            ("work.total", _) if row.vertices.is_none() => or_dash(None),
            (_, Unit::Share) => share(number),
            _ => or_dash(number),
        }
    };
    SUMMARY.iter().map(cell).collect()
}

/// Median and scatter of a frame's time.
fn time(row: &Record) -> String {
    let Some(times) = &row.time_ms else {
        return or_dash(None);
    };
    match times.frame {
        Some(frame) => format!("{} ± {}", significant(frame.median), significant(frame.mad)),
        None => format!("{} (wall)", significant(times.wall.median)),
    }
}

/// Sections of the page, by scene.
pub fn scenes(rows: &[Record], techniques: &[String]) -> anyhow::Result<Vec<Scene>> {
    distinct(rows.iter().map(|row| row.scene.as_str()))
        .iter()
        .map(|name| {
            scene(
                name,
                &rows
                    .iter()
                    .filter(|row| row.scene == *name)
                    .collect::<Vec<_>>(),
                techniques,
            )
        })
        .collect()
}

fn scene(name: &str, rows: &[&Record], techniques: &[String]) -> anyhow::Result<Scene> {
    let measured: Vec<&Record> = rows
        .iter()
        .copied()
        .filter(|row| row.status == Status::Ok)
        .collect();
    let blanks = rows
        .iter()
        .filter(|row| row.status != Status::Ok)
        .map(|row| Fact {
            name: row.technique.clone(),
            value: row.reason.clone().unwrap_or_default(),
        });
    let differences = measured.split_first().map(|(first, others)| {
        others
            .iter()
            .filter_map(|other| words::time_difference(first, other))
            .collect()
    });
    let differs = measured.iter().any(|row| {
        let full = row
            .against_full
            .as_ref()
            .and_then(|full| full.object_agreement);
        full.zip(row.object_agreement)
            .is_some_and(|(full, first)| (full - first).abs() > 1e-4)
    });
    let [width, height] = rows.first().map_or([0, 0], |row| row.resolution);
    let samples = match measured.as_slice() {
        [] => None,
        measured => diagrams::distribution(measured, techniques).inline(),
    };
    Ok(Scene {
        samples,
        name: name.to_owned(),
        anchor: pictures::slug(name),
        why: rows
            .iter()
            .find_map(|row| row.meta.scene_why.clone())
            .unwrap_or_default(),
        width,
        height,
        techniques: measured
            .iter()
            .map(|row| technique(row, techniques))
            .collect(),
        blanks: blanks.collect(),
        differences: differences.unwrap_or_default(),
        full: rows
            .first()
            .filter(|_| differs)
            .map(|row| pictures::names(row).full),
    })
}

fn technique(row: &Record, techniques: &[String]) -> Technique {
    let times = row.time_ms.as_ref();
    Technique {
        name: row.technique.clone(),
        color: color(&row.technique, techniques),
        names: pictures::names(row),
        sentences: words::sentences(row),
        work: work(row),
        facts: facts(row),
        passes: times
            .and_then(|times| times.passes.as_deref())
            .map(passes)
            .unwrap_or_default(),
        passes_reason: times
            .and_then(|times| times.passes_reason.clone())
            .unwrap_or_default(),
    }
}

fn passes(passes: &[(String, f64)]) -> Vec<Pass> {
    let total: f64 = passes.iter().map(|(_, time)| time).sum();
    let mut x = 0.0;
    passes
        .iter()
        .zip(SERIES.iter().cycle())
        .map(|((name, time), color)| {
            let share = if total > 0.0 { time / total } else { 0.0 };
            let pass = Pass {
                name: name.clone(),
                time: significant(*time),
                share: percent(share),
                x: 100.0 * x,
                width: 100.0 * share,
                color,
            };
            x += share;
            pass
        })
        .collect()
}

/// Counted work, which is the same on every adapter.
const WORK: [&str; 11] = [
    "vertices.searched",
    "vertices.reflected",
    "vertices.failed",
    "work.total",
    "work.evaluations",
    "work.steps",
    "work.node_tests",
    "work.samples",
    "work.skips",
    "triangles.in",
    "triangles.drawn",
];

fn work(row: &Record) -> Vec<Fact> {
    let value = row.to_value();
    let per = match row.vertices {
        Some(_) => "vertex",
        None => "mirror pixel",
    };
    let fact = |path: &&str| {
        let number = lookup(&value, path).filter(|number| number.is_number())?;
        let name = &metrics::known(path).name;
        let each = [
            "work.total",
            "work.evaluations",
            "work.steps",
            "work.node_tests",
        ]
        .contains(path);
        Some(Fact {
            name: match each {
                true => format!("{name} a {per}"),
                false => name.clone(),
            },
            value: text(number),
        })
    };
    WORK.iter().filter_map(fact).collect()
}

/// A number in a list of facts: whole ones with thin spaces.
fn text(number: &Value) -> String {
    match number.as_u64() {
        Some(whole) => count(whole),
        None => or_dash(number.as_f64()),
    }
}

/// Numbers that stand in one line of a technique's facts.
const FACTS: [&[&str]; 13] = [
    &["motion.error_px"],
    &["motion.pixels", "motion.missing", "motion.true_px.p50"],
    &["motion.picture.flip", "motion.picture.flip_true"],
    &["color.mae", "color.rmse", "color.psnr"],
    &["color.ssim", "color.flip"],
    &["angular_error_deg"],
    &[
        "vertices.searched",
        "vertices.reflected",
        "vertices.hidden",
        "vertices.failed",
    ],
    &["vertices.offset_px"],
    &["vertices.recall"],
    &["vertices.discard.false_keep", "vertices.discard.false_drop"],
    &["triangles.in", "triangles.drawn"],
    &["time_ms.frame"],
    &["time_ms.wall.median", "time_ms.prepare"],
];

fn facts(row: &Record) -> Vec<Fact> {
    let value = row.to_value();
    FACTS
        .iter()
        .filter_map(|paths| fact(&value, paths))
        .collect()
}

/// The numbers of a line; `None` where what they belong to is not there.
fn fact(row: &Value, paths: &[&str]) -> Option<Fact> {
    match paths {
        ["time_ms.frame"] => spread(row, "time_ms.frame", "median", &["p5", "median", "p95"]),
        [family] if metrics::at(family).is_none() => {
            spread(row, family, "mean", &["mean", "p50", "p95", "p99", "max"])
        }
        _ => {
            let (parent, _) = paths.first()?.rsplit_once('.')?;
            lookup(row, parent).filter(|parent| parent.is_object())?;
            let columns: Vec<String> = (paths.iter())
                .map(|path| metrics::known(path).column())
                .collect();
            let shown: Vec<String> = paths.iter().map(|path| alone(row, path)).collect();
            Some(Fact {
                name: columns.join(", "),
                value: shown.join(", "),
            })
        }
    }
}

/// A number where it stands alone. There is no noise to compare a signal with where pictures are
/// equal.
fn alone(row: &Value, path: &str) -> String {
    let value = lookup(row, path).filter(|value| value.is_number());
    let metric = metrics::known(path);
    match (value, metric.unit) {
        (None, Unit::Decibels) => "equal".to_owned(),
        (None, _) => or_dash(None),
        (Some(value), Unit::Decibels) => format!("{:.1}", value.as_f64().unwrap_or(f64::NAN)),
        (Some(value), Unit::Share) => percent(value.as_f64().unwrap_or(f64::NAN)),
        (Some(value), _) => text(value),
    }
}

/// Some members of a family, under the heading of the one that stands for it.
fn spread(row: &Value, family: &str, first: &str, members: &[&str]) -> Option<Fact> {
    let values = lookup(row, family).filter(|values| values.is_object())?;
    let numbers = members.iter().map(|member| values[*member].as_f64());
    let numbers: Vec<String> = numbers.map(or_dash).collect();
    let heading = metrics::known(&format!("{family}.{first}")).column();
    let samples = values.get("samples").and_then(Value::as_u64);
    let samples = samples.map_or_else(String::new, |samples| format!(" ({samples} samples)"));
    Some(Fact {
        name: format!("{heading}: {}", members.join(", ")),
        value: numbers.join(", ") + &samples,
    })
}

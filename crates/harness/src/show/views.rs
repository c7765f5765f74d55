//! The record as the page's template wants it: text that is ready to be shown.

use crate::record::{Record, Status};

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
    /// As many as [`SUMMARY`] says; none for a row without numbers.
    pub cells: Vec<String>,
    /// Why there are no numbers.
    pub reason: String,
}

/// Headings of the summary's numbers, and what they mean.
pub const SUMMARY: [(&str, &str); 9] = [
    (
        "agreement",
        "share of mirror pixels that show the right object",
    ),
    (
        "missing",
        "share of mirror pixels without the reflection that is there",
    ),
    (
        "extra",
        "share of mirror pixels with a reflection that is not there",
    ),
    (
        "angle p50",
        "median angular error in degrees, where the object is right",
    ),
    (
        "angle p99",
        "99th percentile of the angular error in degrees",
    ),
    (
        "offset",
        "mean distance in pixels from found to true reflection point",
    ),
    ("FLIP", "perceived difference, 0 to 1, on the mirrors"),
    (
        "evaluations",
        "mean uses of the error function for each searched vertex",
    ),
    (
        "frame ms",
        "median time of a frame, ± median absolute deviation",
    ),
];

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
    let coverage = row.coverage.as_ref();
    let time = row.time_ms.as_ref().map(|times| match times.frame {
        Some(frame) => format!("{} ± {}", significant(frame.median), significant(frame.mad)),
        None => format!("{} (wall)", significant(times.wall.median)),
    });
    vec![
        share(row.object_agreement),
        share(coverage.and_then(|coverage| coverage.missing)),
        share(coverage.and_then(|coverage| coverage.extra)),
        or_dash(row.angular_error_deg.map(|angle| angle.p50)),
        or_dash(row.angular_error_deg.map(|angle| angle.p99)),
        or_dash(
            row.vertices
                .as_ref()
                .and_then(|vertices| vertices.offset_px)
                .map(|offset| offset.mean),
        ),
        or_dash(row.color.map(|color| color.flip)),
        or_dash(
            row.work
                .filter(|_| row.vertices.is_some())
                .and_then(|work| work.evaluations),
        ),
        time.unwrap_or_else(|| "–".to_owned()),
    ]
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
        measured => diagrams::distribution(measured, techniques).inline()?,
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

fn work(row: &Record) -> Vec<Fact> {
    let work = row.work.unwrap_or_default();
    let (vertices, triangles) = (row.vertices.as_ref(), row.triangles.as_ref());
    let per = if vertices.is_some() {
        "vertex"
    } else {
        "mirror pixel"
    };
    let whole = |value: Option<u64>| value.map(count);
    let mean = |value: Option<f64>| value.map(significant);
    let named = [
        ("vertices searched", whole(vertices.map(|v| v.searched))),
        ("truly reflected", whole(vertices.and_then(|v| v.reflected))),
        ("search failed", whole(vertices.and_then(|v| v.failed))),
        ("evaluations", mean(work.evaluations)),
        ("steps", mean(work.steps)),
        ("node tests", mean(work.node_tests)),
        ("samples", mean(work.samples)),
        ("skips", mean(work.skips)),
        ("triangles in", whole(triangles.map(|t| t.input))),
        ("triangles drawn", whole(triangles.map(|t| t.drawn))),
    ];
    let per_one = ["evaluations", "steps", "node tests", "samples", "skips"];
    let fact = |(name, value): (&str, Option<String>)| {
        let name = match per_one.contains(&name) {
            true => format!("{name} a {per}"),
            false => name.to_owned(),
        };
        value.map(|value| Fact { name, value })
    };
    named.into_iter().filter_map(fact).collect()
}

fn facts(row: &Record) -> Vec<Fact> {
    let mut facts = Vec::new();
    let mut fact = |name: &str, value: String| {
        facts.push(Fact {
            name: name.to_owned(),
            value,
        })
    };
    if let Some(color) = row.color {
        let psnr = color
            .psnr
            .map_or_else(|| "equal".to_owned(), |psnr| format!("{psnr:.1} dB"));
        fact(
            "colour: MAE, RMSE, PSNR",
            format!(
                "{}, {}, {psnr}",
                significant(color.mae),
                significant(color.rmse)
            ),
        );
        fact(
            "colour: SSIM, FLIP",
            format!("{}, {}", significant(color.ssim), significant(color.flip)),
        );
    }
    if let Some(angle) = row.angular_error_deg {
        let parts = [angle.mean, angle.p50, angle.p95, angle.p99, angle.max].map(significant);
        fact("angle °: mean, p50, p95, p99, max", parts.join(", "));
    }
    if let Some(vertices) = &row.vertices {
        let known = |value: Option<u64>| value.map_or_else(|| "–".to_owned(), count);
        let parts = [
            Some(vertices.searched),
            vertices.reflected,
            vertices.hidden,
            vertices.failed,
        ]
        .map(known);
        fact(
            "vertices: searched, in view, hidden, failed",
            parts.join(", "),
        );
        if let Some(offset) = vertices.offset_px {
            let parts =
                [offset.mean, offset.p50, offset.p95, offset.p99, offset.max].map(significant);
            fact("offset px: mean, p50, p95, p99, max", parts.join(", "));
        }
        fact(
            "recall",
            vertices.recall.map_or_else(|| "–".to_owned(), percent),
        );
        if let Some(discard) = vertices.discard {
            let parts = [discard.false_keep, discard.false_drop].map(count);
            fact("drop rule: wrongly kept, wrongly dropped", parts.join(", "));
        }
    }
    if let Some(triangles) = &row.triangles {
        fact(
            "triangles: in, drawn",
            format!("{}, {}", count(triangles.input), count(triangles.drawn)),
        );
    }
    if let Some(times) = &row.time_ms {
        if let Some(frame) = times.frame {
            let parts = [frame.p5, frame.median, frame.p95].map(significant);
            fact(
                "frame ms: p5, median, p95",
                format!("{} ({} samples)", parts.join(", "), frame.samples),
            );
        }
        fact(
            "wall, prepare ms",
            format!(
                "{}, {}",
                significant(times.wall.median),
                significant(times.prepare)
            ),
        );
    }
    facts
}

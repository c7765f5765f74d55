//! The page and the comment about recorded runs: their rows under the adapters that made them, and what
//! became of each since an earlier run.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Context;
use askama::Template;
use serde_json::Value;

use crate::options::Format;
use crate::output::{Draft, PICTURES};
use crate::record::against::{Verdict, What};
use crate::record::delta::{Delta, RowDelta, TimeDelta};
use crate::record::joined::{Joined, adapter};
use crate::record::metrics;
use crate::record::path::lookup;

use super::facts::{self, Fact};
use super::look;
use super::number::significant;
use super::pictures::{self, Names, slug};
use super::table::{Table, cell, markdown, markdown_code};
use super::{changes, records};

/// What the page and the comment are about.
pub struct Content<'r> {
    /// The rows now.
    pub now: &'r Joined,
    /// The earlier rows, and what they differ in.
    pub before: Option<(&'r Joined, &'r Delta)>,
}

/// How many rows there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// With a metric that is better, and none that is worse.
    pub better: usize,
    /// With a metric that is worse.
    pub worse: usize,
    /// Changed in another way.
    pub changed: usize,
    /// Without an earlier row.
    pub appeared: usize,
    /// Without a row now.
    pub vanished: usize,
    /// As they were.
    pub same: usize,
}

/// What became of a row, in a word.
pub fn verdict(row: &RowDelta) -> &'static str {
    let has = |wanted: Verdict| {
        row.moved
            .iter()
            .any(|what| matches!(what, What::Moved { verdict, .. } if *verdict == wanted))
    };
    match (row.before, row.now) {
        (None, _) => "appeared",
        (_, None) => "vanished",
        _ if has(Verdict::Worse) => "worse",
        _ if has(Verdict::Better) => "better",
        _ if row.is_news() => "changed",
        _ => "unchanged",
    }
}

impl Tally {
    /// Of all rows.
    pub fn of(delta: &Delta) -> Self {
        let mut tally = Self::default();
        for row in &delta.rows {
            *match verdict(row) {
                "better" => &mut tally.better,
                "worse" => &mut tally.worse,
                "appeared" => &mut tally.appeared,
                "vanished" => &mut tally.vanished,
                "changed" => &mut tally.changed,
                _ => &mut tally.same,
            } += 1;
        }
        tally
    }

    /// In a sentence.
    pub fn sentence(&self) -> String {
        let mut parts = Vec::new();
        for (count, what) in [
            (self.worse, "worse"),
            (self.better, "better"),
            (self.changed, "changed otherwise"),
            (self.appeared, "appeared"),
            (self.vanished, "vanished"),
            (self.same, "unchanged"),
        ] {
            if count > 0 {
                parts.push(format!("{count} {what}"));
            }
        }
        match parts.is_empty() {
            true => "no rows".to_owned(),
            false => format!("rows: {}", parts.join(", ")),
        }
    }
}

/// The page's template.
#[derive(Template)]
#[template(path = "runs.html")]
struct Page<'r> {
    against: Option<Against>,
    missing: &'r [String],
    groups: Vec<Group>,
    headings: Vec<Fact>,
    scale: &'static str,
    angle_labels: &'static [&'static str],
    coverage: Vec<Fact>,
    sources: Vec<Fact>,
    pictured: bool,
    look: String,
}

/// What the runs differ in.
struct Against {
    tally: String,
    rows: Vec<Changed>,
    times: Vec<Timed>,
    other_adapter: bool,
}

/// A row that is not what it was.
struct Changed {
    scene: String,
    technique: String,
    adapter: String,
    verdict: &'static str,
    remark: String,
    /// Metric, before, now, change, verdict.
    moved: Vec<[String; 5]>,
    before: Option<Pictures>,
    now: Option<Pictures>,
}

/// A row's time that is not what it was.
struct Timed {
    scene: String,
    technique: String,
    before: String,
    now: String,
    interval: String,
    slower: bool,
}

/// An adapter's rows.
struct Group {
    adapter: String,
    table: Table,
    rows: Vec<PictureRow>,
}

/// A row that has pictures.
struct PictureRow {
    scene: String,
    technique: String,
    pictures: Pictures,
}

/// Pictures that are there, and their size.
#[derive(Clone)]
struct Pictures {
    names: Names,
    wide: u64,
    high: u64,
}

/// The numbers of the tables.
const COLUMNS: [&str; 8] = [
    "object_agreement",
    "coverage.missing",
    "angular_error_deg.p50",
    "angular_error_deg.p99",
    "vertices.offset_px.mean",
    "color.flip",
    "work.total",
    "time_ms.frame.median",
];

fn text(row: &Value, path: &str) -> String {
    cell(lookup(row, path))
}

/// The page as text; pictures of its rows are copied into the draft.
pub fn page(content: &Content<'_>, draft: &Draft) -> anyhow::Result<String> {
    let now = content.now;
    let mut adapters: Vec<String> = Vec::new();
    for row in &now.rows {
        let name = adapter(row);
        if !adapters.contains(&name) {
            adapters.push(name);
        }
    }
    let mut of_rows: Vec<Option<Pictures>> = Vec::new();
    for (row, from) in now.rows.iter().zip(&now.from) {
        let place = adapters.iter().position(|name| *name == adapter(row));
        let folder = match place.unwrap_or_default() {
            // As the run itself has them, so that this page can be compared with in its turn.
            0 => String::new(),
            other => format!("adapter-{}/", other + 1),
        };
        of_rows.push(copy(row, from, &folder, draft)?);
    }
    let against = match content.before {
        None => None,
        Some((before, delta)) => Some(against(now, before, delta, &of_rows, draft)?),
    };
    let groups = adapters.iter().map(|name| {
        let of_adapter = || {
            let rows = now.rows.iter().zip(&of_rows);
            rows.filter(|(row, _)| adapter(row) == *name)
        };
        let rows: Vec<Value> = of_adapter().map(|(row, _)| row.clone()).collect();
        Group {
            adapter: name.clone(),
            table: records::with_remarks(&rows, &COLUMNS),
            rows: of_adapter()
                .filter_map(|(row, pictures)| {
                    Some(PictureRow {
                        scene: text(row, "scene"),
                        technique: text(row, "technique"),
                        pictures: pictures.clone()?,
                    })
                })
                .collect(),
        }
    });
    let groups: Vec<Group> = groups.collect();
    let pictured = of_rows.iter().any(Option::is_some);
    if pictured {
        let scale = draft.file(pictures::SCALE)?;
        catoptric_frame::write_png_rgb8(&pictures::angle_scale(), scale)?;
    }
    let page = Page {
        against,
        missing: &now.missing,
        groups,
        headings: headings(),
        scale: pictures::SCALE,
        angle_labels: &pictures::ANGLE_LABELS,
        coverage: facts::coverage_legend(),
        sources: sources(content),
        pictured,
        look: look::json(),
    };
    page.render().context("filling the template of runs")
}

/// What the columns mean.
fn headings() -> Vec<Fact> {
    let known = COLUMNS.map(metrics::known);
    let fact = |metric: &crate::record::metric::Metric| Fact {
        name: metric.column(),
        value: metric.what.clone(),
    };
    known.into_iter().map(fact).collect()
}

fn against(
    now: &Joined,
    before: &Joined,
    delta: &Delta,
    of_rows: &[Option<Pictures>],
    draft: &Draft,
) -> anyhow::Result<Against> {
    let mut rows = Vec::new();
    for row in delta.rows.iter().filter(|row| row.is_news()) {
        let value = shown(row, now, before);
        let earlier = match row.before {
            None => None,
            Some(at) => copy(&before.rows[at], &before.from[at], "before/", draft)?,
        };
        rows.push(Changed {
            scene: text(value, "scene"),
            technique: text(value, "technique"),
            adapter: adapter(value),
            verdict: verdict(row),
            remark: row.remark.clone().unwrap_or_default(),
            moved: row.moved.iter().map(changes::cells).collect(),
            before: earlier,
            now: row.now.and_then(|at| of_rows[at].clone()),
        });
    }
    Ok(Against {
        tally: Tally::of(delta).sentence(),
        rows,
        times: delta.times.iter().map(|time| timed(time, now)).collect(),
        other_adapter: delta.other_adapter,
    })
}

/// The row that a difference is about: as it is, or as it was.
fn shown<'r>(row: &RowDelta, now: &'r Joined, before: &'r Joined) -> &'r Value {
    match (row.now, row.before) {
        (Some(at), _) => &now.rows[at],
        (None, Some(at)) => &before.rows[at],
        (None, None) => &Value::Null,
    }
}

fn timed(time: &TimeDelta, now: &Joined) -> Timed {
    let row = &now.rows[time.now];
    let [low, high] = time.interval_ms;
    let clock = if time.wall { " (wall clock)" } else { "" };
    let share = 100.0 * (time.now_ms / time.before_ms - 1.0);
    Timed {
        scene: text(row, "scene"),
        technique: text(row, "technique"),
        before: significant(time.before_ms),
        now: significant(time.now_ms),
        interval: format!(
            "{share:+.1} %, between {} and {} ms{clock}",
            signed(low),
            signed(high)
        ),
        slower: time.now_ms > time.before_ms,
    }
}

fn signed(value: f64) -> String {
    let sign = if value < 0.0 { "−" } else { "+" };
    format!("{sign}{}", significant(value.abs()))
}

/// Copies a row's pictures into the draft, if there are any beside its record.
fn copy(row: &Value, from: &Path, into: &str, draft: &Draft) -> anyhow::Result<Option<Pictures>> {
    let side = |place: usize| row["resolution"].get(place)?.as_u64();
    let (Some(wide), Some(high)) = (side(0), side(1)) else {
        return Ok(None);
    };
    let size = [wide, high].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let (scene, technique) = (text(row, "scene"), text(row, "technique"));
    let names = pictures::names_of(&scene, &technique, size);
    let Some(folder) = pictures_beside(from, &names.technique) else {
        return Ok(None);
    };
    let one = |name: &str| -> anyhow::Result<Option<String>> {
        let inside = name.split_once('/').map_or(name, |(_, inside)| inside);
        let source = folder.join(inside);
        if !source.is_file() {
            return Ok(None);
        }
        let name = format!("{PICTURES}/{into}{inside}");
        let target = draft.file(&name)?;
        fs::copy(&source, &target).with_context(|| format!("cannot copy {}", source.display()))?;
        Ok(Some(name))
    };
    let (Some(reference), Some(technique), Some(angle), Some(coverage)) = (
        one(&names.reference)?,
        one(&names.technique)?,
        one(&names.angle)?,
        one(&names.coverage)?,
    ) else {
        return Ok(None);
    };
    let levels = match &names.levels {
        Some(levels) => one(levels)?,
        None => None,
    };
    let motion = match &names.motion {
        Some([fetched, error]) => one(fetched)?.zip(one(error)?).map(<[String; 2]>::from),
        None => None,
    };
    // A page whose values are gone says so.
    let [truth_layers, layers] = [&names.truth_layers, &names.layers]
        .map(|name| one(name).map(|copied| copied.unwrap_or_else(|| name.clone())));
    Ok(Some(Pictures {
        names: Names {
            full: reference.clone(),
            reference,
            technique,
            angle,
            coverage,
            levels,
            motion,
            truth_layers: truth_layers?,
            layers: layers?,
        },
        wide,
        high,
    }))
}

/// The folder beside a record that holds this picture: `pictures`, or `pictures-2` and so on.
fn pictures_beside(record: &Path, name: &str) -> Option<PathBuf> {
    let inside = name.split_once('/').map_or(name, |(_, inside)| inside);
    let parent = record
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let beside = fs::read_dir(parent.unwrap_or(Path::new("."))).ok()?;
    let mut folders: Vec<PathBuf> = beside
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            let name = path.file_name().and_then(|name| name.to_str());
            name.is_some_and(|name| name == PICTURES || name.starts_with(&format!("{PICTURES}-")))
        })
        .collect();
    folders.sort();
    folders
        .into_iter()
        .find(|folder| folder.join(inside).is_file())
}

/// Which records were read, of which revision, when, by which command.
fn sources(content: &Content<'_>) -> Vec<Fact> {
    let mut facts: Vec<Fact> = Vec::new();
    let before = content.before.iter().map(|(before, _)| ("before", *before));
    for (when, joined) in std::iter::once(("now", content.now)).chain(before) {
        let mut known: Vec<&PathBuf> = Vec::new();
        for (row, path) in joined.rows.iter().zip(&joined.from) {
            if known.contains(&path) {
                continue;
            }
            known.push(path);
            facts.push(Fact {
                name: format!("{when}: {}", path.display()),
                value: format!(
                    "{}, revision {}, {}: {}",
                    adapter(row),
                    text(row, "meta.revision"),
                    text(row, "meta.date"),
                    text(row, "meta.command")
                ),
            });
        }
    }
    facts
}

/// So many rows of a table in a comment: it is to be read at a glance.
const MOST_IN_COMMENT: usize = 60;

/// A short text in Markdown, for a comment on a change.
pub fn comment(content: &Content<'_>) -> String {
    let now = content.now;
    let mut said = String::new();
    let Some((before, delta)) = content.before else {
        said += "**catoptric**\n";
        let mut names: Vec<String> = now.rows.iter().map(adapter).collect();
        names.dedup();
        for name in names {
            let rows = now.rows.iter().filter(|row| adapter(row) == name);
            let rows: Vec<Value> = rows.cloned().collect();
            let table = records::with_remarks(&rows, &COLUMNS);
            said += &format!("\n{}\n\n{}", markdown(&name), table.write(Format::Markdown));
        }
        return said + &missing(now);
    };
    said += &format!("**catoptric**, {}\n", Tally::of(delta).sentence());
    let mut table = Table::new([
        "scene",
        "technique",
        "verdict",
        "metric",
        "before",
        "now",
        "change",
    ]);
    for row in delta.rows.iter().filter(|row| row.is_news()) {
        let value = shown(row, now, before);
        let first = [text(value, "scene"), text(value, "technique")];
        let line = |verdict: &str, cells: [String; 4]| {
            let verdict = [verdict.to_owned()];
            first
                .iter()
                .cloned()
                .chain(verdict)
                .chain(cells)
                .collect::<Vec<String>>()
        };
        if row.moved.is_empty() {
            let remark = row.remark.clone().unwrap_or_default();
            table.row(line(
                verdict(row),
                [remark, String::new(), String::new(), String::new()],
            ));
        }
        for what in &row.moved {
            let [metric, then, value, share, verdict] = changes::cells(what);
            table.row(line(&verdict, [metric, then, value, share]));
        }
    }
    said += &limited(table);
    let mut table = Table::new(["scene", "technique", "before ms", "now ms", "difference"]);
    for time in &delta.times {
        let Timed {
            scene,
            technique,
            before,
            now,
            interval,
            ..
        } = timed(time, now);
        table.row([scene, technique, before, now, interval]);
    }
    if !table.rows.is_empty() {
        said += "\nTimes whose difference has an interval that excludes zero:\n";
        said += &limited(table);
    }
    if delta.other_adapter {
        said += "\nTimes of different adapters are not compared.\n";
    }
    said += &missing(now);
    let revision = |joined: &Joined| {
        let row = joined.rows.first();
        markdown_code(&row.map_or_else(|| "–".to_owned(), |row| text(row, "meta.revision")))
    };
    said += &format!(
        "\nRevision {} before, {} now",
        revision(before),
        revision(now)
    );
    let software = |row: &Value| lookup(row, "adapter.software") == Some(&Value::Bool(true));
    if now.rows.iter().any(software) {
        said += "; times are of a software driver";
    }
    said + ".\n"
}

/// A table, if it has rows, of which no more are shown than one reads.
fn limited(mut table: Table) -> String {
    let left_out = table.rows.len().saturating_sub(MOST_IN_COMMENT);
    table.rows.truncate(MOST_IN_COMMENT);
    if table.rows.is_empty() {
        return String::new();
    }
    let more = match left_out {
        0 => String::new(),
        count => format!("\n{count} more lines are on the page.\n"),
    };
    format!("\n{}{more}", table.write(Format::Markdown))
}

fn missing(joined: &Joined) -> String {
    let said = joined.missing.iter();
    said.map(|what| format!("\nMissing: {}.\n", markdown(what)))
        .collect()
}

impl Changed {
    /// Where the page's list leads to.
    fn anchor(&self) -> String {
        slug(&format!(
            "{} {} {}",
            self.scene, self.technique, self.adapter
        ))
    }
}

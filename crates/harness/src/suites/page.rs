//! A suite's page: figures, records and the names of pictures in; the page, a plot and a table a
//! figure out.

use crate::options::Format;
use crate::output::{Draft, FIGURES};
use crate::record::{Record, Status};
use crate::show::number::{or_dash, short, significant};
use crate::show::plot::{Axis, Curve, Mark, Plot, Scale, TALL};
use crate::show::table::Table;
use crate::show::{facts, look, pictures, words};
use anyhow::Context;
use askama::Template;
use catoptric_frame::write_whole;

use super::cells::{Grid, grids};
use super::figure::{Figure, Quantity, Quote};
use super::ledger::{self, Entry};
use super::results::{Results, Row, place_name};
use super::suite::{Picture, Suite};

#[derive(Template)]
#[template(path = "bench.html")]
struct Page<'p> {
    suite: &'p Suite,
    /// How many measurements of how many, where something is missing.
    unfinished: Option<String>,
    figures: Vec<Shown<'p>>,
    blanks: Vec<String>,
    angle_labels: &'static [&'static str],
    scale: &'static str,
    coverage: Vec<facts::Fact>,
    noise_floor: Option<String>,
    software: Option<String>,
    environment: Vec<facts::Fact>,
    command: String,
    measured: usize,
    ledger: Option<Ledger>,
    look: String,
}

/// The table of all claims.
struct Ledger {
    tally: String,
    entries: Vec<Entry>,
    open: Table,
    /// As JSON and Markdown; empty on a page without files.
    files: Vec<(&'static str, String)>,
}

/// A figure as the template wants it.
struct Shown<'p> {
    figure: &'p Figure,
    /// The size of the measured pictures, where all have one that is not their scene's.
    measured_at: Option<String>,
    /// How many points of how many, where some are not measured: then nothing is concluded.
    open: Option<String>,
    claims: Vec<Entry>,
    grids: Vec<Grid>,
    plots: Vec<Diagram>,
    quotes: Vec<Quotation<'p>>,
    table: Table,
    /// Its file; `None` on a page without files.
    csv: Option<String>,
    rows: Vec<PictureRow<'p>>,
    own: Vec<&'p Picture>,
}

/// A plot, and the file it is in; `None` on a page without files.
struct Diagram {
    title: String,
    svg: String,
    path: Option<String>,
}

/// What a page is about.
pub struct Content<'p> {
    /// Title and question.
    pub suite: &'p Suite,
    /// In the order of the page.
    pub figures: &'p [Figure],
    /// Figures of all suites whose claims are judged in a table at the end, each with its suite's name.
    pub judged: &'p [(&'static str, Figure)],
    /// What is measured so far.
    pub rows: &'p [Record],
    /// How many rows were asked for.
    pub wanted: usize,
    /// Pictures of the suite's own kind; `None` as long as they are not made.
    pub own: Option<&'p [Picture]>,
}

/// A paper's number beside ours.
struct Quotation<'p> {
    quote: &'p Quote,
    ours: String,
}

/// Pictures of a measured point.
struct PictureRow<'p> {
    row: &'p Record,
    names: pictures::Names,
}

/// The page as text. With `files`, plots and tables are written there too, and the page leads to them.
/// Where rows or pictures are missing, the page says so, and draws no conclusion from the others.
pub fn render(content: &Content<'_>, files: Option<&Draft>) -> anyhow::Result<String> {
    let rows = content.rows;
    let values: Vec<Row> = rows.iter().map(Row::of).collect();
    let shown = content
        .figures
        .iter()
        .map(|figure| show(content, figure, &values, files))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let finished = content.finished();
    let blanks = rows.iter().filter(|row| row.status != Status::Ok);
    let page = Page {
        suite: content.suite,
        unfinished: (!finished).then(|| format!("{} of {}", rows.len(), content.wanted)),
        figures: shown,
        blanks: blanks
            .map(|row| {
                let reason = row.reason.as_deref().unwrap_or_default();
                format!("{}, {}: {reason}", row.scene, row.technique)
            })
            .collect(),
        angle_labels: &pictures::ANGLE_LABELS,
        scale: pictures::SCALE,
        coverage: facts::coverage_legend(),
        noise_floor: words::noise_floor(rows).filter(|_| finished),
        software: facts::software(rows),
        environment: facts::environment(rows),
        command: facts::command(rows),
        measured: rows.len(),
        ledger: ledger(content, &values, files)?,
        look: look::json(),
    };
    page.render().context("filling the page's template")
}

impl Content<'_> {
    fn finished(&self) -> bool {
        self.rows.len() >= self.wanted && self.own.is_some()
    }
}

fn show<'p>(
    content: &'p Content<'_>,
    figure: &'p Figure,
    values: &'p [Row],
    files: Option<&Draft>,
) -> anyhow::Result<Shown<'p>> {
    let results = Results::new(figure, values);
    let grids = grids(figure, &results);
    let mut diagrams = Vec::new();
    let plotted = match grids {
        Some(_) => &[][..],
        None => &figure.quantities,
    };
    for quantity in plotted {
        let plot = plot(figure, quantity, &results);
        let Some(svg) = plot.inline() else { continue };
        let path = format!(
            "{FIGURES}/{}.{}.svg",
            figure.anchor,
            pictures::slug(quantity.path)
        );
        if let (Some(draft), Some(file)) = (files, plot.file()) {
            write_whole(draft.file(&path)?, file.as_bytes())?;
        }
        diagrams.push(Diagram {
            title: plot.title,
            svg,
            path: files.map(|_| path),
        });
    }
    let table = table(figure, &results);
    let csv = format!("{FIGURES}/{}.csv", figure.anchor);
    if let Some(draft) = files {
        let text = table.write(Format::Csv);
        write_whole(draft.file(&csv)?, text.as_bytes())?;
    }
    let quotes = figure.quotes.iter().map(|quote| Quotation {
        quote,
        ours: quote.ours.map_or_else(String::new, |ask| {
            let answer = results.answer(&ask);
            answer.map_or_else(
                || "not measured".to_owned(),
                |value| format!("{} {}", short(value), ask.unit),
            )
        }),
    });
    let points = || figure.series.iter().flat_map(|series| &series.points);
    let measured = points().filter(|point| results.index(point).is_some());
    let (measured, all) = (measured.count(), points().count());
    let open = measured < all && content.rows.len() < content.wanted;
    let pictured = points().filter(|point| point.picture);
    let rows = pictured.filter_map(|point| content.rows.get(results.index(point)?));
    let rows = rows.filter(|row| row.status == Status::Ok);
    let own = content.own.unwrap_or_default().iter();
    let size = figure.resolution();
    Ok(Shown {
        figure,
        measured_at: size.map(|[width, height]| format!("{width} × {height}")),
        open: open.then(|| format!("{measured} of {all}")),
        claims: match open {
            true => Vec::new(),
            false => ledger::of_figure(content.suite.name, figure, values),
        },
        grids: grids.unwrap_or_default(),
        plots: diagrams,
        quotes: quotes.collect(),
        table,
        csv: files.map(|_| csv),
        rows: rows
            .map(|row| PictureRow {
                row,
                names: pictures::names(row),
            })
            .collect(),
        own: own
            .filter(|picture| picture.figure == figure.anchor)
            .collect(),
    })
}

/// The table of all claims, where the suite has one; written as files too.
fn ledger(
    content: &Content<'_>,
    rows: &[Row],
    files: Option<&Draft>,
) -> anyhow::Result<Option<Ledger>> {
    if content.judged.is_empty() {
        return Ok(None);
    }
    let judged = content.judged.iter();
    let entries = judged.flat_map(|(suite, figure)| ledger::of_figure(suite, figure, rows));
    let entries = ledger::published(entries.collect());
    let mut written = Vec::new();
    if let Some(draft) = files {
        let json = format!("{:#}\n", ledger::value(&entries));
        let table = ledger::table(&entries);
        for (name, text) in [("json", json), ("md", table.write(Format::Markdown))] {
            let path = format!("{FIGURES}/claims.{name}");
            write_whole(draft.file(&path)?, text.as_bytes())?;
            written.push((if name == "md" { "Markdown" } else { "JSON" }, path));
        }
    }
    Ok(Some(Ledger {
        tally: ledger::tally(&entries),
        entries,
        open: ledger::open(),
        files: written,
    }))
}

/// A quantity of a figure against its axis.
fn plot(figure: &Figure, quantity: &Quantity, results: &Results<'_>) -> Plot {
    let series = figure.series.iter().map(|series| {
        let marks = series.points.iter().filter_map(|point| {
            let y = results.value(point, quantity.path)?;
            Some(Mark {
                x: results.place(point)?,
                y,
                name: String::new(),
                label: format!("{}, {}: {}", series.label, point.scene, significant(y)),
            })
        });
        Curve {
            label: series.label.clone(),
            points: marks.collect(),
        }
    });
    Plot {
        title: format!("{} against {}", quantity.label(), figure.axis.label),
        x: figure.axis.clone(),
        y: Axis {
            label: quantity.label(),
            scale: quantity.scale.clone(),
        },
        series: series.chain(guide(figure, quantity, results)).collect(),
        height: TALL,
        joined: !matches!(figure.axis.scale, Scale::Names(_)),
    }
}

/// The guide of a quantity at every place where a point has it.
fn guide(figure: &Figure, quantity: &Quantity, results: &Results<'_>) -> Option<Curve> {
    let guide = quantity.guide?;
    let mut points: Vec<Mark> = Vec::new();
    for point in figure.series.iter().flat_map(|series| &series.points) {
        let Some(y) = results.value(point, guide.path) else {
            continue;
        };
        if points.iter().all(|mark| mark.x != point.x) {
            points.push(Mark {
                x: point.x,
                y,
                name: String::new(),
                label: format!("{}, {}: {}", guide.label, point.scene, significant(y)),
            });
        }
    }
    points.sort_by(|a, b| a.x.total_cmp(&b.x));
    Some(Curve {
        label: guide.label.to_owned(),
        points,
    })
}

/// Every point with all the figure's quantities.
fn table(figure: &Figure, results: &Results<'_>) -> Table {
    let quantities = figure.quantities.iter().map(Quantity::label);
    let heading = ["series", figure.axis.label.as_str(), "scene", "technique"].map(str::to_owned);
    let mut table = Table::new(heading.into_iter().chain(quantities));
    for series in &figure.series {
        for point in &series.points {
            let x = match point.along {
                None => place_name(&figure.axis, point.x),
                Some(_) => or_dash(results.place(point)),
            };
            let values = figure
                .quantities
                .iter()
                .map(|quantity| or_dash(results.value(point, quantity.path)));
            let first = [
                series.label.clone(),
                x,
                point.scene.clone(),
                point.technique.clone(),
            ];
            table.row(first.into_iter().chain(values));
        }
    }
    table
}

//! A suite's page: figures, records and the names of pictures in; `index.html`, a plot and a
//! table a figure out.

use std::path::{Path, PathBuf};

use anyhow::Context;
use askama::Template;
use catoptric_frame::write_whole;
use serde_json::Value;

use crate::options::Format;
use crate::record::{Record, Status};
use crate::show::number::{or_dash, short, significant};
use crate::show::plot::{Axis, Curve, Mark, Plot, Scale, TALL};
use crate::show::table::Table;
use crate::show::{facts, pictures, words};
use crate::suites::results::Results;

use super::figure::{Figure, Quantity, Quote};
use super::suite::{Picture, Suite};

/// Folder of the plots and tables, inside the page's.
const FOLDER: &str = "figures";

#[derive(Template)]
#[template(path = "bench.html")]
struct Page<'p> {
    suite: &'p Suite,
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
}

/// A figure as the template wants it.
struct Shown<'p> {
    figure: &'p Figure,
    /// The size of the measured pictures, where all have one that is not their scene's.
    measured_at: Option<String>,
    analysis: Vec<String>,
    plots: Vec<Diagram>,
    quotes: Vec<Quotation<'p>>,
    table: Table,
    csv: String,
    rows: Vec<PictureRow<'p>>,
    own: Vec<&'p Picture>,
}

/// A plot, and the file it is in.
struct Diagram {
    title: String,
    svg: String,
    path: String,
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

/// Writes `index.html` and the folder of plots and tables.
pub fn write(
    suite: &Suite,
    figures: &[Figure],
    rows: &[Record],
    own: &[Picture],
    folder: &Path,
) -> anyhow::Result<PathBuf> {
    let values: Vec<(Record, Value)> = rows
        .iter()
        .map(|row| (row.clone(), row.to_value()))
        .collect();
    let files = folder.join(FOLDER);
    std::fs::create_dir_all(&files).with_context(|| format!("cannot make {}", files.display()))?;
    let shown = figures
        .iter()
        .map(|figure| show(figure, &values, own))
        .collect::<anyhow::Result<Vec<_>>>()?;
    for figure in &shown {
        let table = figure.table.write(Format::Csv);
        write_whole(folder.join(&figure.csv), table.as_bytes())?;
    }
    for (figure, shown) in figures.iter().zip(&shown) {
        let plots = plots(figure, &Results::new(&figure.series, &values));
        for (plot, diagram) in plots.iter().zip(&shown.plots) {
            let file = plot.file().unwrap_or_default();
            write_whole(folder.join(&diagram.path), file.as_bytes())?;
        }
    }
    let blanks = rows.iter().filter(|row| row.status != Status::Ok);
    let page = Page {
        suite,
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
        noise_floor: words::noise_floor(rows),
        software: facts::software(rows),
        environment: facts::environment(rows),
        command: facts::command(rows),
        measured: rows.len(),
    };
    let path = folder.join("index.html");
    let html = page.render().context("filling the page's template")?;
    write_whole(&path, html.as_bytes())?;
    Ok(path)
}

fn show<'p>(
    figure: &'p Figure,
    values: &'p [(Record, Value)],
    own: &'p [Picture],
) -> anyhow::Result<Shown<'p>> {
    let results = Results::new(&figure.series, values);
    let mut diagrams = Vec::new();
    for (plot, quantity) in plots(figure, &results).iter().zip(&figure.quantities) {
        let Some(svg) = plot.inline() else { continue };
        let name = pictures::slug(quantity.path);
        diagrams.push(Diagram {
            title: plot.title.clone(),
            svg,
            path: format!("{FOLDER}/{}.{name}.svg", figure.anchor),
        });
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
    let points = figure.series.iter().flat_map(|series| &series.points);
    let pictured = points.filter(|point| point.picture);
    let rows = pictured.filter_map(|point| results.row(point));
    let rows = rows.filter(|row| row.status == Status::Ok);
    let size = figure.resolution();
    Ok(Shown {
        figure,
        measured_at: size.map(|[width, height]| format!("{width} × {height}")),
        analysis: (figure.analysis)(&results),
        plots: diagrams,
        quotes: quotes.collect(),
        table: table(figure, &results),
        csv: format!("{FOLDER}/{}.csv", figure.anchor),
        rows: rows
            .map(|row| PictureRow {
                row,
                names: pictures::names(row),
            })
            .collect(),
        own: own
            .iter()
            .filter(|picture| picture.figure == figure.anchor)
            .collect(),
    })
}

/// The figure's plots that have something to show.
fn plots(figure: &Figure, results: &Results<'_>) -> Vec<Plot> {
    let plot = |quantity: &Quantity| {
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
    };
    figure.quantities.iter().map(plot).collect()
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
            let x = match &figure.axis.scale {
                Scale::Names(names) => names.get(point.x as usize).cloned().unwrap_or_default(),
                Scale::Linear | Scale::Close | Scale::Log if point.along.is_none() => {
                    format!("{}", point.x)
                }
                Scale::Linear | Scale::Close | Scale::Log => or_dash(results.place(point)),
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

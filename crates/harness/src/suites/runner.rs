//! Runs a suite: measures what its figures name, and writes the page.
//!
//! Measuring writes `record.json` and the pictures into the folder after every scene; the page is
//! made from these alone, so that the same record gives the same bytes.

use std::path::{Path, PathBuf};

use crate::exit::Outcome;
use crate::options::{Common, Format};
use crate::output::make_folder;
use crate::record::{self, Record, Status};
use crate::run::interrupt::interrupted;
use crate::run::load::load_options;
use crate::run::{Setup, measure};
use crate::show::{self, print, records};

use super::figure::Figure;
use super::suite::{Asked, Layout, Studio, Suite};
use super::{page, pictures, plan};

/// Measures a suite and writes its page. `seconds` of timing go before the suite's own.
pub fn run(
    suite: &Suite,
    scene: Option<&str>,
    seconds: Option<f64>,
    common: &Common,
) -> anyhow::Result<Outcome> {
    let common = &Common {
        resolution: common.resolution.or(suite.resolution),
        ..common.clone()
    };
    let load = load_options(common);
    let mut figures = (suite.figures)(&Asked { scene, load });
    if let Some(size) = common.resolution {
        // All is measured in the size asked for, so that is where a figure finds its points.
        let series = figures.iter_mut().flat_map(|figure| &mut figure.series);
        for point in series.flat_map(|series| &mut series.points) {
            point.resolution = Some(size);
        }
    }
    let setup = Setup::new(&plan::wanted(&figures, suite.timing.or(seconds)), common)?;
    let folder = common.output.clone().unwrap_or_else(|| folder(suite));
    make_folder(&folder)?;

    let rows = measure(&setup, |measured, rows| {
        if let Some(measured) = measured {
            pictures::write(&measured, &folder, |row| plan::shown(&figures, row))?;
        }
        record::write(rows, &folder.join("record.json"))?;
        match suite.layout {
            Layout::Scenes => show::page::write(rows, setup.rows(), &folder).map(drop),
            Layout::Figures => Ok(()),
        }
    })?;
    let index = match suite.layout {
        Layout::Scenes => show::page::write(&rows, setup.rows(), &folder)?,
        Layout::Figures => by_figures(suite, &figures, &rows, scene, &setup, common, &folder)?,
    };
    print(suite, &rows, &index, common)?;
    Ok(outcome(suite, &rows, setup.rows()))
}

/// Where the page goes if nothing else is said.
fn folder(suite: &Suite) -> PathBuf {
    match suite.layout {
        Layout::Scenes => PathBuf::from("report"),
        Layout::Figures => PathBuf::from(format!("bench-{}", suite.name)),
    }
}

fn by_figures(
    suite: &Suite,
    figures: &[Figure],
    rows: &[Record],
    scene: Option<&str>,
    setup: &Setup,
    common: &Common,
    folder: &Path,
) -> anyhow::Result<PathBuf> {
    let own = match suite.pictures {
        Some(make) if !interrupted() => make(&Studio {
            setup,
            scene,
            common,
            folder,
        })?,
        _ => Vec::new(),
    };
    page::write(suite, figures, rows, &own, folder)
}

/// Where the page is; of a suite of figures the records, if another format than the table is asked
/// for.
fn print(suite: &Suite, rows: &[Record], index: &Path, common: &Common) -> anyhow::Result<()> {
    if common.format == Format::Table || suite.layout == Layout::Scenes {
        return print::text(&format!("{}\n", index.display()));
    }
    let values: Vec<_> = rows.iter().map(Record::to_value).collect();
    records::print(&values, common.format)
}

fn outcome(suite: &Suite, rows: &[Record], wanted: usize) -> Outcome {
    let (page, said) = match suite.layout {
        Layout::Scenes => ("report", "; the report says so"),
        Layout::Figures => ("page", ""),
    };
    let failed = rows.iter().filter(|row| row.status == Status::Failed);
    let failed = failed.count();
    if failed > 0 {
        eprintln!(
            "catoptric: {failed} of {} rows failed; the {page} says why",
            rows.len()
        );
    }
    if rows.len() < wanted {
        eprintln!(
            "catoptric: interrupted after {} of {wanted} rows{said}",
            rows.len()
        );
    }
    match failed == 0 && rows.len() == wanted {
        true => Outcome::Done,
        false => Outcome::FellShort,
    }
}

//! Runs a suite: measures what its figures name, and writes the page.
//!
//! After every scene the page and `record.json` are made anew, together, so that whenever the program
//! ends there is a page that says how far it is. The page is made from the record and the pictures
//! alone: the same record gives the same bytes. Until the first scene is finished, the page that was
//! there before stands.

use std::path::{Path, PathBuf};

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, Format};
use crate::output::{Draft, FIGURES, PICTURES};
use crate::record::{self, Record, Status};
use crate::run::interrupt::interrupted;
use crate::run::load::load_options;
use crate::run::{Setup, measure};
use crate::show::layers::Extent;
use crate::show::{self, print, records};
use crate::terminal::say;

use super::figure::Figure;
use super::page::Content;
use super::part::Part;
use super::suite::{Asked, Layout, Picture, Studio, Suite};
use super::{page, pictures, plan};

/// What the user says of a run.
#[derive(Clone, Copy, Debug)]
pub struct Choice<'c> {
    /// A scene in place of the suite's own.
    pub scene: Option<&'c str>,
    /// Seconds of timing; they go before the suite's own.
    pub seconds: Option<f64>,
    /// Which values are written beside the pictures.
    pub extent: Extent,
    /// Measures that part alone.
    pub part: Option<Part>,
}

/// Measures a suite, or a part of it, and writes its page.
pub fn run(suite: &Suite, choice: Choice<'_>, common: &Common) -> anyhow::Result<Outcome> {
    let Choice {
        scene,
        seconds,
        extent,
        part,
    } = choice;
    let common = &Common {
        resolution: common.resolution.or(suite.resolution),
        ..common.clone()
    };
    let load = load_options(common);
    let mut figures = (suite.figures)(&Asked { scene, load });
    let mut judged = suite.judged.map_or_else(Vec::new, |judged| judged(scene));
    if let Some(size) = common.resolution {
        // All is measured in the size asked for, so that is where a figure finds its points.
        let all = figures
            .iter_mut()
            .chain(judged.iter_mut().map(|(_, figure)| figure));
        for point in all
            .flat_map(|figure| &mut figure.series)
            .flat_map(|series| &mut series.points)
        {
            point.resolution = Some(size);
        }
    }
    let all: Vec<Figure> = figures
        .iter()
        .chain(judged.iter().map(|(_, figure)| figure))
        .cloned()
        .collect();
    let mut wanted = plan::wanted(&all, suite.timing.or(seconds));
    if let Some(part) = part {
        wanted = part.of(wanted);
    }
    let setup = Setup::new(&wanted, common)?.of_part(part.map(|part| part.to_string()));
    let folder = common.output.clone().unwrap_or_else(|| folder(suite));
    refuse_file_name(&folder)?;
    let parts = match suite.layout {
        Layout::Scenes => &[PICTURES][..],
        Layout::Figures => &[PICTURES, FIGURES],
    };
    let mut draft = Draft::begin(&folder, parts)?;
    let wanted = setup.rows();
    let figures = &figures[..];

    let rows = measure(&setup, |measured, rows| {
        if let Some(measured) = measured {
            pictures::write(&measured, &draft, extent, |row| plan::shown(figures, row))?;
        }
        let page = match suite.layout {
            Layout::Scenes => show::page::render(rows, wanted)?,
            Layout::Figures => {
                let content = Content {
                    suite,
                    figures,
                    judged: &judged,
                    rows,
                    wanted,
                    own: None,
                };
                page::render(&content, None)?
            }
        };
        draft.put(&page, &record::text(rows)?).map(drop)
    })?;
    if !rows.is_empty() || wanted == 0 {
        let page = match suite.layout {
            Layout::Scenes => show::page::render(&rows, wanted)?,
            Layout::Figures => {
                // They are not of single rows: of several parts the first has them.
                let own = match part.is_none_or(Part::is_first) {
                    true => own_pictures(suite, scene, &setup, common, &draft)?,
                    false => Some(Vec::new()),
                };
                let content = Content {
                    suite,
                    figures,
                    judged: &judged,
                    rows: &rows,
                    wanted,
                    own: own.as_deref(),
                };
                page::render(&content, Some(&draft))?
            }
        };
        let index = draft.put(&page, &record::text(&rows)?)?;
        print(suite, &rows, &index, common)?;
    }
    Ok(outcome(&rows, wanted))
}

/// Refuses a folder that is called as a file is: it was hardly meant.
pub fn refuse_file_name(folder: &Path) -> anyhow::Result<()> {
    let ending = folder.extension().and_then(|ending| ending.to_str());
    let of_a_file = ["json", "csv", "md", "html", "png", "exr", "svg"];
    if !folder.is_dir() && ending.is_some_and(|ending| of_a_file.contains(&ending)) {
        return Err(bad_input(format!(
            "-o {}: a folder is written here, with `index.html` and `record.json` in it: name one without \
             the ending of a file",
            folder.display()
        )));
    }
    Ok(())
}

/// Where the page goes if nothing else is said.
fn folder(suite: &Suite) -> PathBuf {
    match suite.layout {
        Layout::Scenes => PathBuf::from("report"),
        Layout::Figures => PathBuf::from(format!("bench-{}", suite.name)),
    }
}

/// The suite's own pictures; `None` where there was no time for them.
fn own_pictures(
    suite: &Suite,
    scene: Option<&str>,
    setup: &Setup,
    common: &Common,
    draft: &Draft,
) -> anyhow::Result<Option<Vec<Picture>>> {
    match suite.pictures {
        None => Ok(Some(Vec::new())),
        Some(_) if interrupted() => Ok(None),
        Some(make) => make(&Studio {
            setup,
            scene,
            common,
            draft,
        })
        .map(Some),
    }
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

fn outcome(rows: &[Record], wanted: usize) -> Outcome {
    let failed = rows.iter().filter(|row| row.status == Status::Failed);
    let failed = failed.count();
    if failed > 0 {
        say(&format!(
            "catoptric: {failed} of {} rows failed; the page says why",
            rows.len()
        ));
    }
    if rows.len() < wanted {
        let page = match rows.is_empty() {
            true => "; no page was written",
            false => "; the page says so",
        };
        say(&format!(
            "catoptric: interrupted after {} of {wanted} rows{page}",
            rows.len()
        ));
    }
    match failed == 0 && rows.len() == wanted {
        true => Outcome::Done,
        false => Outcome::FellShort,
    }
}

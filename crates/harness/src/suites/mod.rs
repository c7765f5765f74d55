//! `catoptric bench SUITE`: the sweeps behind the papers' figures, as data, plots and pictures.
//!
//! A suite is data. It lists [`Figure`]s; a figure lists [`Series`], and each [`Point`] of a series
//! names a scene and a technique and says where on the figure's axis the pair stands. From all
//! figures together the program makes one plan without doubles, measures it with the same sentence
//! as `compare` (so a point is a full record: accuracy, work, triangles, times), and draws every
//! [`Quantity`] of a figure, any number in a record, against its axis. Nothing is measured by a
//! suite itself.
//!
//! # Adding a suite
//!
//! 1. A file `suites/NAME.rs` with a `pub const SUITE: Suite`, and a line in [`SUITES`].
//! 2. Its `figures` function builds the figures, in the order of the page. It is given the user's
//!    `--scene`, if any: put it in place of your scenes where the figure's axis is not the scene,
//!    and leave out figures that make no sense then.
//! 3. A figure has an `analysis` function that reads [`Results`] and says, in sentences, what came
//!    out and whether the paper's claim holds here: written for any outcome, never for the one
//!    that is hoped for. Numbers of the paper stand in `quotes`, with ours beside them.
//! 4. Mark a few points with [`Point::shown`]: their pictures, reference and error map come on the
//!    page. Pictures of another kind (a search path, a wireframe, a heat map) are made by
//!    the suite's `pictures` function.
//!
//! The tests below check every suite: scenes and techniques exist, quantities are numbers of the
//! record's schema, anchors are unique. Time: the whole suite shares `timing_s`; measuring apart
//! from timing (reference, layers, comparison) comes on top and grows with the number of scenes.

mod control;
mod cubemap;
mod estalella;
mod figure;
mod page;
mod papers;
mod plan;
mod results;
mod search;
mod tessellation;

use std::path::{Path, PathBuf};

use crate::cli::{BenchArgs, Common, Format};
use crate::exit::{Outcome, bad_input};
use crate::record::{self, Record, Status};
use crate::report::pictures;
use crate::setup::Setup;
use crate::suggest::suggest;

pub use figure::{Ask, Figure, Guide, Point, Quantity, Quote, Series};
pub use results::Results;

/// A named set of figures.
pub struct Suite {
    /// As on the command line.
    pub name: &'static str,
    /// Heading of the page.
    pub title: &'static str,
    /// What is asked, in a sentence or two.
    pub why: &'static str,
    /// The figures, given the user's scene.
    pub figures: fn(Option<&str>) -> Vec<Figure>,
    /// Pictures other than those of points; `None` where there are none.
    pub pictures: Option<MakePictures>,
    /// Seconds of timing in all, where the user does not say.
    pub timing_s: f64,
}

/// Makes pictures of a suite's own kind.
pub type MakePictures = fn(&Studio<'_>) -> anyhow::Result<Vec<Picture>>;

/// Every suite, by name.
pub const SUITES: [&Suite; 7] = [
    &search::SUITE,
    &tessellation::SUITE,
    &estalella::SUITE,
    &cubemap::SUITE,
    &cubemap::FULL,
    &control::SUITE,
    &papers::SUITE,
];

/// What a suite's own pictures are made with.
pub struct Studio<'s> {
    /// Adapter and scenes.
    pub setup: &'s Setup,
    /// The user's scene.
    pub scene: Option<&'s str>,
    /// How scenes are to be loaded.
    pub common: &'s Common,
    /// The folder of the page; pictures go into [`pictures::FOLDER`] inside it.
    pub folder: &'s Path,
}

/// A picture of a suite's own kind, written already.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The figure under which it stands.
    pub figure: &'static str,
    /// Path, relative to the page.
    pub path: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What it shows, for everyone.
    pub caption: String,
    /// What is to be seen, for those who cannot.
    pub alt: String,
}

/// The suites for `bench --help`: one a line, with its heading.
pub fn help() -> String {
    let width = SUITES.iter().map(|suite| suite.name.len()).max();
    let line = |suite: &&Suite| {
        let width = width.unwrap_or(0);
        format!("\n  {:width$}  {}", suite.name, suite.title)
    };
    let lines: String = SUITES.iter().map(line).collect();
    format!("Suites:{lines}")
}

/// Runs a suite and writes its page.
pub fn run(args: &BenchArgs, common: &Common) -> anyhow::Result<Outcome> {
    let suite = match args.full {
        false => find(&args.suite)?,
        true => whole(find(&args.suite)?)?,
    };
    let mut figures = (suite.figures)(args.scene.as_deref());
    if let Some(size) = common.resolution {
        // All is measured in the size asked for, so that is where a figure finds its points.
        let series = figures.iter_mut().flat_map(|figure| &mut figure.series);
        for point in series.flat_map(|series| &mut series.points) {
            point.resolution = Some(size);
        }
    }
    let timing = args.time_budget.unwrap_or(suite.timing_s);
    let setup = Setup::new(&plan::wanted(&figures, timing), common)?;
    let default = || PathBuf::from(format!("bench-{}", suite.name));
    let folder = common.output.clone().unwrap_or_else(default);
    crate::report::make_folder(&folder)?;

    let record_path = folder.join("record.json");
    let rows = crate::measure(&setup, |measured, rows| {
        if let Some(measured) = measured {
            let shown = |row: &Record| plan::shown(&figures, row);
            pictures::write(&measured, &folder, shown)?;
        }
        record::write(rows, &record_path)
    })?;
    let own = match suite.pictures {
        Some(make) if !crate::pipeline::interrupted() => make(&Studio {
            setup: &setup,
            scene: args.scene.as_deref(),
            common,
            folder: &folder,
        })?,
        _ => Vec::new(),
    };
    let index = page::write(suite, &figures, &rows, &own, &folder)?;
    print(&rows, &index, common)?;
    Ok(outcome(&rows, setup.rows()))
}

/// The records in the format asked for; as a table, where the page is.
fn print(rows: &[Record], index: &Path, common: &Common) -> anyhow::Result<()> {
    if common.format == Format::Table {
        return crate::print::text(&format!("{}\n", index.display()));
    }
    let values: Vec<_> = rows.iter().map(Record::to_value).collect();
    crate::print::records(&values, common.format)
}

fn outcome(rows: &[Record], wanted: usize) -> Outcome {
    let failed = rows.iter().filter(|row| row.status == Status::Failed);
    let failed = failed.count();
    if failed > 0 {
        eprintln!(
            "catoptric: {failed} of {} rows failed; the page says why",
            rows.len()
        );
    }
    if rows.len() < wanted {
        eprintln!(
            "catoptric: interrupted after {} of {wanted} rows",
            rows.len()
        );
    }
    match failed == 0 && rows.len() == wanted {
        true => Outcome::Done,
        false => Outcome::FellShort,
    }
}

/// The suite that measures every cell: its name ends in `-full`.
fn whole(suite: &Suite) -> anyhow::Result<&'static Suite> {
    let name = format!("{}-full", suite.name);
    let found = SUITES.into_iter().find(|other| other.name == name);
    found.ok_or_else(|| {
        let name = suite.name;
        bad_input(format!("`--full`: suite `{name}` has no larger grid"))
    })
}

fn find(name: &str) -> anyhow::Result<&'static Suite> {
    if let Some(suite) = SUITES.iter().find(|suite| suite.name == name) {
        return Ok(suite);
    }
    let names: Vec<&str> = SUITES.iter().map(|suite| suite.name).collect();
    let hint = suggest(name, names.iter().copied());
    let all = names.join(", ");
    Err(bad_input(format!(
        "no suite `{name}`{hint}; there are: {all}"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gate::is_metric;

    #[test]
    fn what_suites_name_exists() {
        let scenes = catoptric_scene::builtin::names();
        for suite in SUITES {
            for figure in (suite.figures)(None) {
                let what = format!("{}, {}", suite.name, figure.anchor);
                assert!(!figure.series.is_empty(), "{what}");
                for quantity in &figure.quantities {
                    let guide = quantity.guide.map(|guide| guide.path);
                    for path in [quantity.path].into_iter().chain(guide) {
                        assert!(is_metric(path), "{what}: {path}");
                    }
                }
                for ask in figure.quotes.iter().filter_map(|quote| quote.ours) {
                    assert!(is_metric(ask.path), "{what}: {}", ask.path);
                    let series = |series: &Series| series.label == ask.series;
                    assert!(figure.series.iter().any(series), "{what}: {}", ask.series);
                }
                for point in figure.series.iter().flat_map(|series| &series.points) {
                    assert!(
                        point.along.is_none_or(is_metric),
                        "{what}: {:?}",
                        point.along
                    );
                    assert!(scenes.contains(&point.scene), "{what}: {}", point.scene);
                    let technique = crate::setup::parse(&point.technique);
                    assert!(technique.is_ok(), "{what}: {technique:?}");
                }
            }
        }
    }

    #[test]
    fn names_and_anchors_are_unique() {
        let mut names: Vec<&str> = SUITES.iter().map(|suite| suite.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), SUITES.len());
        for suite in SUITES {
            let figures = (suite.figures)(None);
            let mut anchors: Vec<&str> = figures.iter().map(|figure| figure.anchor).collect();
            anchors.sort_unstable();
            anchors.dedup();
            assert_eq!(anchors.len(), figures.len(), "{}", suite.name);
        }
    }

    #[test]
    fn a_scene_of_the_users_takes_the_place_of_ours() {
        for suite in SUITES {
            for figure in (suite.figures)(Some("mine.toml")) {
                for point in figure.series.iter().flat_map(|series| &series.points) {
                    assert_eq!(
                        point.scene, "mine.toml",
                        "{}, {}",
                        suite.name, figure.anchor
                    );
                }
            }
        }
    }

    #[test]
    fn the_whole_grid_is_a_flag_away() {
        let full = |name| find(name).and_then(whole).map(|suite| suite.name);
        assert_eq!(full("cubemap").ok(), Some("cubemap-full"));
        let error = full("search").err().map(|error| error.to_string());
        assert!(error.is_some_and(|text| text.contains("no larger grid")));
    }

    #[test]
    fn an_unknown_suite_is_refused_with_the_nearest() {
        let error = find("serach").err().map(|error| error.to_string());
        assert!(error.is_some_and(|text| text.contains("did you mean `search`")));
        let error = find("foo")
            .err()
            .map_or_else(String::new, |error| error.to_string());
        assert!(
            error.contains("there are: search, ") && !error.contains("did you"),
            "{error}"
        );
    }
}

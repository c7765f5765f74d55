//! What is measured together: the sweeps behind the papers' figures (`catoptric bench SUITE`), and
//! the report.
//!
//! A suite is data. It lists [`Figure`]s; a figure lists [`Series`], and each [`Point`] of a series
//! names a scene and a technique and says where on the figure's axis the pair stands. From all figures
//! together the program makes one plan without duplicates, measures it with the same pipeline as
//! `compare` (so a point is a full record: accuracy, work, triangles, times), and draws every
//! [`Quantity`] of a figure, any number in a record, against its axis. Nothing is measured by a suite
//! itself.
//!
//! # Adding a suite
//!
//! 1. A file `suites/NAME.rs`, or a folder, with a `pub const SUITE: Suite`, and a line in [`SUITES`].
//! 2. Its `figures` function builds the figures, in the order of the page. It is given the user's
//!    `--scene`, if any: put it in place of your scenes where the figure's axis is not the scene,
//!    and leave out figures that make no sense then.
//! 3. What a figure decides are its `claims::Claim`s: who says what where, the rule that measures it,
//!    and why the rule's limit is where it is. Nothing else is concluded on a page. Most rules are one
//!    line (`claims::make`); where none fits, a `claims::Measure::Own` function makes the numbers.
//!    The tests see to it that each can come out either way. Numbers of the paper stand in `quotes`,
//!    with ours beside them.
//! 4. Mark a few points with [`Point::shown`]: their pictures, reference and error map come on the
//!    page. Pictures of another kind (a search path, a wireframe, a heat map) are made by
//!    the suite's `pictures` function.
//!
//! A figure with at most three places along its axis, or with names along it, is shown as a table whose
//! cells are coloured from best to worst, any other one as plots.
//!
//! The tests below check every suite: scenes and techniques exist, quantities have a row in the
//! table of metrics, anchors are unique. Time: the whole suite, or each of its scenes, shares its
//! [`Budget`]; measuring apart from timing (reference, layers, comparison) comes on top and grows
//! with the number of scenes.
//!
//! The report is two suites, [`report::QUICK`] and [`report::FULL`], with a page by scenes.

pub mod benched;
mod cells;
mod claims;
mod control;
mod cubemap;
mod estalella;
mod exact;
mod figure;
mod fit;
pub mod ledger;
mod motion;
mod page;
mod papers;
pub mod part;
mod paths;
mod pictures;
mod plan;
pub mod report;
mod results;
pub mod runner;
mod search;
mod series;
mod shelf;
mod suite;
mod tessellation;

use catoptric_scene::suggest;

use crate::exit::bad_input;

pub use figure::{Figure, Guide, Quantity, Quote};
pub use results::Row;
pub use series::{Ask, Point, Series};
pub use suite::{Asked, Budget, Layout, Picture, Studio, Suite};

/// Every suite, by name.
pub const SUITES: [&Suite; 9] = [
    &search::SUITE,
    &tessellation::SUITE,
    &estalella::SUITE,
    &cubemap::SUITE,
    &cubemap::FULL,
    &control::SUITE,
    &motion::SUITE,
    &exact::SUITE,
    &papers::SUITE,
];

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

/// Every suite's claims, judged by these rows.
pub fn claims_by(rows: &[Row]) -> Vec<ledger::Entry> {
    let suites = SUITES.iter().filter(|suite| whole_of(suite).is_none());
    let entries = suites.flat_map(|suite| {
        let figures = (suite.figures)(&Asked::default()).into_iter();
        figures.flat_map(|figure| ledger::of_figure(suite.name, &figure, rows))
    });
    entries.collect()
}

/// Of a suite that is another one's larger grid, the other's name.
fn whole_of(suite: &Suite) -> Option<&'static str> {
    suite.name.strip_suffix("-full")
}

/// The suite that measures every cell: its name ends in `-full`.
pub fn whole(suite: &Suite) -> anyhow::Result<&'static Suite> {
    let name = format!("{}-full", suite.name);
    let found = SUITES.into_iter().find(|other| other.name == name);
    found.ok_or_else(|| {
        let name = suite.name;
        bad_input(format!("`--full`: suite `{name}` has no larger grid"))
    })
}

/// The suite of this name.
pub fn find(name: &str) -> anyhow::Result<&'static Suite> {
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
    use crate::record::metrics;

    fn all() -> impl Iterator<Item = &'static Suite> {
        SUITES.into_iter().chain([&report::QUICK, &report::FULL])
    }

    #[test]
    fn what_suites_name_exists() {
        let scenes = catoptric_scene::builtin::names();
        for suite in all() {
            for figure in (suite.figures)(&Asked::default()) {
                let what = format!("{}, {}", suite.name, figure.anchor);
                assert!(!figure.series.is_empty(), "{what}");
                for quantity in &figure.quantities {
                    let guide = quantity.guide.map(|guide| guide.path);
                    for path in [quantity.path].into_iter().chain(guide) {
                        assert!(metrics::at(path).is_some(), "{what}: {path}");
                    }
                }
                for path in figure.claims.iter().flat_map(|claim| claim.rule.of.paths()) {
                    let known = metrics::at(path).is_some()
                        || [paths::WIDTH, paths::HEIGHT].contains(&path);
                    assert!(known, "{what}: {path}");
                }
                for ask in figure.quotes.iter().filter_map(|quote| quote.ours) {
                    assert!(metrics::at(ask.path).is_some(), "{what}: {}", ask.path);
                    let series = |series: &Series| series.label == ask.series;
                    assert!(figure.series.iter().any(series), "{what}: {}", ask.series);
                }
                for point in figure.series.iter().flat_map(|series| &series.points) {
                    assert!(
                        point.along.is_none_or(|path| metrics::at(path).is_some()),
                        "{what}: {:?}",
                        point.along
                    );
                    assert!(scenes.contains(&point.scene), "{what}: {}", point.scene);
                    let technique = crate::run::load::parse(&point.technique);
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
            let figures = (suite.figures)(&Asked::default());
            let mut anchors: Vec<&str> = figures.iter().map(|figure| figure.anchor).collect();
            anchors.sort_unstable();
            anchors.dedup();
            assert_eq!(anchors.len(), figures.len(), "{}", suite.name);
        }
    }

    #[test]
    fn each_diagram_has_a_file_of_its_own() {
        for suite in all() {
            for figure in (suite.figures)(&Asked::default()) {
                let mut paths: Vec<&str> = figure.quantities.iter().map(|one| one.path).collect();
                let all = paths.len();
                paths.sort_unstable();
                paths.dedup();
                assert_eq!(paths.len(), all, "{}, {}", suite.name, figure.anchor);
            }
        }
    }

    #[test]
    fn a_scene_of_the_users_takes_the_place_of_ours() {
        let asked = Asked {
            scene: Some("mine.toml"),
            ..Asked::default()
        };
        for suite in all() {
            for figure in (suite.figures)(&asked) {
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

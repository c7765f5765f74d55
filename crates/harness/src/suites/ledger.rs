//! The table of claims: paper, section, claim, figure, number and verdict, from the rows of any suites.

use std::cell::RefCell;

use serde_json::{Value, json};

use crate::show::number::count;
use crate::show::table::Table;

use super::claims::{Claim, Finding, Limit, Numbers, Paper, UNJUDGED};
use super::figure::Figure;
use super::results::{Results, Row};

/// A claim and what became of it.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The suite that tests it.
    pub suite: &'static str,
    /// The figure that tests it.
    pub figure: &'static str,
    /// The claim.
    pub claim: Claim,
    /// The verdict; `None` where nothing of it is measured, or not all of its figure.
    pub finding: Option<Finding>,
    /// The sizes of the pictures that were measured, in words.
    pub sizes: String,
}

/// The claims of a figure. Of one that is measured in part there are no verdicts.
pub fn of_figure(suite: &'static str, figure: &Figure, rows: &[Row]) -> Vec<Entry> {
    let results = Results::new(figure, rows);
    let points = || figure.series.iter().flat_map(|series| &series.points);
    let whole = !figure.claims.is_empty() && points().all(|point| results.index(point).is_some());
    let mut sizes: Vec<[u32; 2]> = match whole {
        true => points().filter_map(|point| results.size(point)).collect(),
        false => Vec::new(),
    };
    sizes.sort_unstable();
    sizes.dedup();
    let sizes: Vec<String> = sizes.iter().map(|[w, h]| format!("{w}×{h}")).collect();
    let entry = |claim: &Claim| Entry {
        suite,
        figure: figure.anchor,
        claim: *claim,
        finding: whole.then(|| claim.rule.judge(&results)).flatten(),
        sizes: sizes.join(", "),
    };
    figure.claims.iter().map(entry).collect()
}

/// A figure with those points alone that its published claims read.
pub fn pared(figure: &Figure) -> Figure {
    let read = Read {
        figure,
        points: RefCell::default(),
    };
    let published = figure.claims.iter();
    for claim in published.filter(|claim| claim.paper != Paper::Ours) {
        claim.rule.judge(&read);
    }
    let read = read.points.into_inner();
    let mut pared = figure.clone();
    for series in &mut pared.series {
        let is_read = |x: f64| {
            read.iter()
                .any(|(label, place)| *label == series.label && *place == x)
        };
        series.points.retain(|point| is_read(point.x));
    }
    pared.series.retain(|series| !series.points.is_empty());
    pared
}

/// Numbers that are all 1, to see which ones are read.
struct Read<'f> {
    figure: &'f Figure,
    points: RefCell<Vec<(String, f64)>>,
}

impl Numbers for Read<'_> {
    fn labels(&self) -> Vec<String> {
        let series = self.figure.series.iter();
        series.map(|series| series.label.clone()).collect()
    }

    fn places(&self, series: &str) -> Vec<f64> {
        let found = self
            .figure
            .series
            .iter()
            .find(|found| found.label == series);
        let points = found.map_or(&[][..], |series| &series.points);
        points.iter().map(|point| point.x).collect()
    }

    fn at(&self, series: &str, x: f64, _: &str) -> Option<f64> {
        let known = self.places(series).contains(&x);
        if known {
            self.points.borrow_mut().push((series.to_owned(), x));
        }
        known.then_some(1.0)
    }

    fn place_name(&self, _: f64) -> String {
        String::new()
    }
}

impl Entry {
    /// The number, or a dash.
    pub fn number(&self) -> String {
        let number = self.finding.as_ref().map(|finding| finding.number.clone());
        number.unwrap_or_else(|| "–".to_owned())
    }

    /// The verdict in words.
    pub fn verdict(&self) -> String {
        let words = self.finding.as_ref().map(|finding| finding.verdict.words());
        words.unwrap_or_else(|| "not measured".to_owned())
    }

    /// The verdict in one word, for styles and for programs.
    pub fn key(&self) -> &'static str {
        let key = self.finding.as_ref().map(|finding| finding.verdict.key());
        key.unwrap_or("not-measured")
    }

    /// The limit in words.
    pub fn limit(&self) -> String {
        self.claim.rule.is.words(self.claim.rule.shown)
    }

    /// The number of each case, where there are several.
    pub fn cases(&self) -> Vec<String> {
        let cases = self
            .finding
            .as_ref()
            .map(|finding| finding.cases.as_slice());
        let cases = cases.filter(|cases| cases.len() > 1).unwrap_or_default();
        let shown = self.claim.rule.shown;
        cases
            .iter()
            .map(|case| format!("{}: {}", case.label, shown.write(case.number.value)))
            .collect()
    }
}

/// Those that a paper makes, in the order of the papers.
pub fn published(entries: Vec<Entry>) -> Vec<Entry> {
    let mut entries: Vec<Entry> = entries
        .into_iter()
        .filter(|entry| entry.claim.paper != Paper::Ours)
        .collect();
    entries.sort_by_key(|entry| entry.claim.paper);
    entries
}

/// A row a claim.
pub fn table(entries: &[Entry]) -> Table {
    let heading = ["paper", "section", "claim", "figure", "number", "verdict"];
    let mut table = Table::new(heading);
    for entry in entries {
        table.row([
            entry.claim.paper.name().to_owned(),
            entry.claim.section.to_owned(),
            entry.claim.says.to_owned(),
            format!("{}: {}", entry.suite, entry.figure),
            entry.number(),
            entry.verdict(),
        ]);
    }
    table
}

/// What is not judged, and why not.
pub fn open() -> Table {
    let mut table = Table::new(["paper", "section", "claim", "why it is not judged"]);
    for open in UNJUDGED {
        table.row([open.paper.name(), open.section, open.says, open.reason]);
    }
    table
}

/// How many verdicts of each kind there are, in a sentence.
pub fn tally(entries: &[Entry]) -> String {
    let number = |key: &str| entries.iter().filter(|entry| entry.key() == key).count();
    let missing = match number("not-measured") {
        0 => String::new(),
        some => format!(", {} not measured", count(some as u64)),
    };
    format!(
        "Of {} claims of the four papers {} hold, {} do not, {} hold in some cases only, {} are undecided{missing}.",
        count(entries.len() as u64),
        number("holds"),
        number("does-not-hold"),
        number("only-if"),
        number("undecided")
    )
}

/// All of it for programs: an object a claim, and one for each that is not judged.
pub fn value(entries: &[Entry]) -> Value {
    let judged = entries.iter().map(|entry| {
        let limit = match entry.claim.rule.is {
            Limit::Above(limit) => json!({ "above": limit }),
            Limit::Below(limit) => json!({ "below": limit }),
            Limit::Between(from, to) => json!({ "from": from, "to": to }),
            Limit::Outside(from, to) => json!({ "below": from, "or_above": to }),
        };
        let cases = entry.finding.iter().flat_map(|finding| &finding.cases);
        let cases = cases.map(|case| {
            let number = case.number;
            json!({ "case": case.label, "number": number.value, "low": number.low, "high": number.high })
        });
        json!({
            "paper": entry.claim.paper.name(),
            "section": entry.claim.section,
            "claim": entry.claim.says,
            "suite": entry.suite,
            "figure": entry.figure,
            "sizes": entry.sizes,
            "verdict": entry.key(),
            "words": entry.verdict(),
            "number": entry.number(),
            "limit": limit,
            "why": entry.claim.why,
            "cases": cases.collect::<Vec<_>>(),
        })
    });
    let open = UNJUDGED.iter().map(|open| {
        json!({
            "paper": open.paper.name(),
            "section": open.section,
            "claim": open.says,
            "verdict": "not-judged",
            "why": open.reason,
        })
    });
    judged.chain(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::measured;
    use crate::show::plot::Axis;
    use crate::suites::claims::make::{claim, difference};
    use crate::suites::claims::{Noise, Term, at};
    use crate::suites::paths::AGREEMENT;
    use crate::suites::series::{Point, Series};

    const CLAIMS: &[Claim] = &[claim(
        Paper::Szabo2013,
        "1",
        "The one is better.",
        difference(
            at("one", 0.0),
            at("other", 0.0),
            Term::Path(AGREEMENT),
            Limit::Above(0.01),
            Noise::Plus(0.001),
        ),
        "one in a hundred.",
    )];

    fn figure() -> Figure {
        let series =
            |label, technique: &str| Series::new(label, [Point::new(0.0, "bowl", technique)]);
        Figure {
            anchor: "a",
            title: String::new(),
            after: "",
            question: String::new(),
            axis: Axis::linear("x"),
            series: vec![series("one", "linear"), series("other", "newton")],
            quantities: Vec::new(),
            quotes: &[],
            claims: CLAIMS,
        }
    }

    fn row(technique: &str, agreement: f64) -> Row {
        let mut row = measured("bowl", technique);
        row.object_agreement = Some(agreement);
        // As a file has it.
        Row::read(serde_json::to_value(row).unwrap()).unwrap()
    }

    #[test]
    fn a_figure_that_is_measured_in_part_has_no_verdict() {
        let entries = of_figure("s", &figure(), &[row("linear", 0.9)]);
        assert_eq!((entries.len(), entries[0].key()), (1, "not-measured"));
        assert!(tally(&entries).ends_with("1 not measured."));
    }

    #[test]
    fn what_no_claim_reads_is_left_out() {
        let mut figure = figure();
        figure.series[0]
            .points
            .push(Point::new(1.0, "bowl", "planar"));
        figure
            .series
            .push(Series::new("third", [Point::new(0.0, "bowl", "planar")]));
        let pared = pared(&figure);
        let left = pared
            .series
            .iter()
            .map(|series| (series.label.as_str(), series.points.len()));
        assert_eq!(left.collect::<Vec<_>>(), [("one", 1), ("other", 1)]);
    }

    #[test]
    fn a_verdict_stands_in_the_table_with_its_number() {
        let rows = [row("linear", 0.9), row("newton", 0.8)];
        let entries = published(of_figure("s", &figure(), &rows));
        assert_eq!(entries[0].sizes, "640×480");
        let cells = &table(&entries).rows[0];
        assert_eq!(
            cells[..4],
            ["Szabo 2013", "1", "The one is better.", "s: a"]
        );
        assert_eq!(cells[4..], ["10.0 % (9.8 to 10.2)", "holds"]);
        let json = value(&entries);
        assert_eq!(json[0]["verdict"], "holds");
        assert_eq!(json[0]["limit"]["above"], 0.01);
        assert_eq!(json.as_array().unwrap().len(), 1 + UNJUDGED.len());
    }
}

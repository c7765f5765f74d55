//! The table of claims: paper, section, claim, figure, number and verdict, from the rows of any suites.

use serde_json::{Value, json};

use crate::show::number::count;
use crate::show::table::Table;

use super::claims::{Claim, Finding, Limit, Paper, UNJUDGED};
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

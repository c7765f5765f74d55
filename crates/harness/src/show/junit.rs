//! Outcomes as JUnit's XML, which servers that build changes read.

use std::path::Path;

use anyhow::Context;
use askama::Template;

use crate::record::against::{Change, Verdict, What};
use crate::record::delta::Delta;
use crate::record::gate::Gate;
use crate::record::joined::{Joined, adapter};
use crate::record::{Record, Status};
use crate::terminal::in_a_line;
use serde_json::Value;

use super::changes;
use super::runs::verdict;
use super::table::cell;

/// Something that held or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// What it belongs to: a scene.
    pub class: String,
    /// What was asked.
    pub name: String,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It holds.
    Passed,
    /// It does not, and why.
    Failed(String),
    /// It could not be measured since something broke.
    Broken(String),
    /// There was nothing to measure.
    Skipped(String),
}

#[derive(Template)]
#[template(path = "junit.xml")]
struct Suites<'c> {
    suite: &'c str,
    cases: &'c [Case],
    failures: usize,
    errors: usize,
    skipped: usize,
}

/// Writes a suite of cases, whole or not at all.
pub fn write(suite: &str, cases: &[Case], path: &Path) -> anyhow::Result<()> {
    Ok(catoptric_frame::write_whole(
        path,
        text(suite, cases)?.as_bytes(),
    )?)
}

/// The cases as XML.
pub fn text(suite: &str, cases: &[Case]) -> anyhow::Result<String> {
    let plain = |text: &str| in_xml(text);
    let cases: Vec<Case> = cases
        .iter()
        .map(|case| Case {
            class: plain(&case.class),
            name: plain(&case.name),
            outcome: match &case.outcome {
                Outcome::Passed => Outcome::Passed,
                Outcome::Failed(why) => Outcome::Failed(plain(why)),
                Outcome::Broken(why) => Outcome::Broken(plain(why)),
                Outcome::Skipped(why) => Outcome::Skipped(plain(why)),
            },
        })
        .collect();
    let count = |of: fn(&Outcome) -> bool| cases.iter().filter(|case| of(&case.outcome)).count();
    let suites = Suites {
        suite: &plain(suite),
        failures: count(|outcome| matches!(outcome, Outcome::Failed(_))),
        errors: count(|outcome| matches!(outcome, Outcome::Broken(_))),
        skipped: count(|outcome| matches!(outcome, Outcome::Skipped(_))),
        cases: &cases,
    };
    let mut text = suites.render().context("filling the template of JUnit")?;
    text.push('\n');
    Ok(text)
}

/// Text without what XML cannot hold, escaped or not.
fn in_xml(text: &str) -> String {
    in_a_line(text).replace(['\u{fffe}', '\u{ffff}'], "\u{fffd}")
}

/// A case for each gate of each row, or where there are none for each row: that it was measured.
pub fn of_rows(rows: &[Record], values: &[Value], gates: &[Gate]) -> Vec<Case> {
    let mut cases = Vec::new();
    for (row, value) in rows.iter().zip(values) {
        let reason = || row.reason.clone().unwrap_or_default();
        let mut case = |name: String, outcome| {
            cases.push(Case {
                class: row.scene.clone(),
                name,
                outcome,
            });
        };
        match row.status {
            Status::Failed => case(row.technique.clone(), Outcome::Broken(reason())),
            Status::NotApplicable => case(row.technique.clone(), Outcome::Skipped(reason())),
            Status::Ok if gates.is_empty() => case(row.technique.clone(), Outcome::Passed),
            Status::Ok => {
                for gate in gates {
                    let outcome = gate.trips(value).map_or(Outcome::Passed, Outcome::Failed);
                    case(format!("{}, {gate}", row.technique), outcome);
                }
            }
        }
    }
    cases
}

/// A case for each row that was compared with an earlier one: it fails where a metric got worse or
/// vanished, and where the row has another status.
pub fn of_changes(changed: &[Change]) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for change in changed {
        let name = format!("{}, against the earlier run", change.technique);
        let found = cases
            .iter()
            .position(|case| case.class == change.scene && case.name == name);
        let at = found.unwrap_or_else(|| {
            cases.push(Case {
                class: change.scene.clone(),
                name,
                outcome: Outcome::Passed,
            });
            cases.len() - 1
        });
        let outcome = &mut cases[at].outcome;
        match &change.what {
            What::New => *outcome = Outcome::Skipped("no earlier row".to_owned()),
            What::OtherScene => *outcome = Outcome::Skipped("another scene".to_owned()),
            What::Status { before, now } => {
                fail(outcome, format!("was {before}, is {now}"));
            }
            what @ What::Moved { verdict, .. } => {
                if matches!(verdict, Verdict::Worse | Verdict::Vanished) {
                    fail(outcome, sentence(what));
                }
            }
            What::Unchanged | What::OtherAdapter => {}
        }
    }
    cases
}

/// A case for each row of two runs; times are no part of it.
pub fn of_delta(now: &Joined, before: &Joined, delta: &Delta) -> Vec<Case> {
    let case = |row: &crate::record::delta::RowDelta| {
        let value = match (row.now, row.before) {
            (Some(at), _) => &now.rows[at],
            (None, Some(at)) => &before.rows[at],
            (None, None) => &Value::Null,
        };
        let mut outcome = Outcome::Passed;
        match verdict(row) {
            "appeared" => outcome = Outcome::Skipped("no earlier row".to_owned()),
            "vanished" => fail(&mut outcome, "the row vanished".to_owned()),
            _ => {}
        }
        if let Some(remark) = &row.remark {
            fail(&mut outcome, remark.clone());
        }
        for what in &row.moved {
            let bad = matches!(
                what,
                What::Moved {
                    verdict: Verdict::Worse | Verdict::Vanished,
                    ..
                }
            );
            if bad {
                fail(&mut outcome, sentence(what));
            }
        }
        Case {
            class: cell(value.get("scene")),
            name: format!("{}, on {}", cell(value.get("technique")), adapter(value)),
            outcome,
        }
    };
    delta.rows.iter().map(case).collect()
}

/// Adds a reason to fail.
fn fail(outcome: &mut Outcome, why: String) {
    *outcome = match std::mem::replace(outcome, Outcome::Passed) {
        Outcome::Failed(known) => Outcome::Failed(format!("{known}; {why}")),
        _ => Outcome::Failed(why),
    };
}

/// `object_agreement: 0.9000 → 0.8000 (−11.1%), worse`.
fn sentence(what: &What) -> String {
    let [metric, before, now, share, verdict] = changes::cells(what);
    format!("{metric}: {before} → {now} ({share}), {verdict}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::{blank, measured};

    #[test]
    fn a_parser_of_xml_reads_it() {
        let case = |name: &str, outcome| Case {
            class: "<scene> & \"more\"".to_owned(),
            name: name.to_owned(),
            outcome,
        };
        let odd = "a\u{1b}[31m\n<b>&'\"\u{ffff}";
        let cases = [
            case("one", Outcome::Passed),
            case(odd, Outcome::Failed(odd.to_owned())),
            case("three", Outcome::Broken("lost".to_owned())),
            case("four", Outcome::Skipped("no model".to_owned())),
        ];
        let text = text("compare", &cases).unwrap();
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
        let suite = document.root_element().first_element_child().unwrap();
        let count = |name| suite.attribute(name).unwrap();
        assert_eq!(
            ["tests", "failures", "errors", "skipped"].map(count),
            ["4", "1", "1", "1"]
        );
        let of: Vec<_> = suite
            .children()
            .filter(roxmltree::Node::is_element)
            .collect();
        assert_eq!(of.len(), 4);
        assert_eq!(of[0].attribute("classname"), Some("<scene> & \"more\""));
        let failure = of[1].first_element_child().unwrap();
        assert_eq!(failure.tag_name().name(), "failure");
        assert_eq!(
            failure.attribute("message"),
            Some("a\\u001b[31m\\u000a<b>&'\"\u{fffd}")
        );
        assert_eq!(failure.text(), failure.attribute("message"));
    }

    #[test]
    fn each_gate_of_each_row_is_a_case() {
        let rows = [measured("a", "linear"), blank("b", "linear")];
        let values: Vec<Value> = rows.iter().map(Record::to_value).collect();
        let gates = ["object_agreement>=0.97", "angular_error_deg.p99<=0.01"];
        let gates = gates.map(|gate| Gate::parse(gate).unwrap());
        let cases = of_rows(&rows, &values, &gates);
        assert_eq!(cases.len(), 3);
        assert_eq!(cases[0].outcome, Outcome::Passed);
        assert_eq!(cases[0].name, "linear, object_agreement>=0.97");
        assert!(matches!(&cases[1].outcome, Outcome::Failed(why) if why.contains("it is 2")));
        assert!(matches!(&cases[2].outcome, Outcome::Skipped(_)));
    }
}

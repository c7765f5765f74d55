//! Records as tables: a short one for people, every metric for spreadsheets.

use serde_json::Value;

use crate::options::Format;
use crate::record::metric::Metric;
use crate::record::metrics;
use crate::record::path::{leaves, lookup};

use super::number::rounded;
use super::print as stdout;
use super::table::{Table, cell};

/// Writes records as a table for people, or with every metric as CSV.
pub fn print(rows: &[Value], format: Format) -> anyhow::Result<()> {
    stdout::text(&text(rows, format))
}

/// Records as text, as [`print()`] writes them.
pub fn text(rows: &[Value], format: Format) -> String {
    match format {
        Format::Json => format!("{:#}\n", Value::Array(rows.to_vec())),
        Format::Csv => every_metric(rows).write(format),
        Format::Table | Format::Markdown => summary(rows).write(format),
    }
}

/// The numbers of the short table.
const SHORT: [&str; 11] = [
    "object_agreement",
    "coverage.missing",
    "coverage.extra",
    "angular_error_deg.p50",
    "angular_error_deg.p99",
    "vertices.offset_px.mean",
    "vertices.failed",
    "color.flip",
    "work.total",
    "time_ms.frame.median",
    "time_ms.wall.median",
];

/// What stands before them where techniques say how reflections moved: the rest is about their picture, the
/// control's.
const MOTION: [&str; 5] = [
    "motion.error_px.p50",
    "motion.error_px.p95",
    "motion.missing",
    "motion.true_px.p50",
    "motion.picture.excess",
];

/// The numbers that say most, and the reasons of rows without any.
fn summary(rows: &[Value]) -> Table {
    let moves = rows.iter().any(|row| row["motion"].is_object());
    let motion = if moves { &MOTION[..] } else { &[] };
    with_remarks(rows, &[motion, &SHORT].concat())
}

/// The numbers at these paths, and the reasons of rows without any.
pub fn with_remarks(rows: &[Value], paths: &[&str]) -> Table {
    let mut table = numbers(rows, paths);
    let remarks: Vec<String> = rows.iter().map(remark).collect();
    if remarks.iter().any(|remark| !remark.is_empty()) {
        table.heading.push("remark".to_owned());
        for (row, remark) in table.rows.iter_mut().zip(remarks) {
            row.push(remark);
        }
    }
    table
}

/// Scene, technique and the numbers at these paths, a line a row.
pub fn numbers(rows: &[Value], paths: &[&str]) -> Table {
    let metrics: Vec<&Metric> = paths.iter().map(|path| metrics::known(path)).collect();
    let headings = metrics.iter().map(|metric| metric.column());
    let first = ["scene", "technique"];
    let mut table = Table::new(first.map(str::to_owned).into_iter().chain(headings));
    for row in rows {
        let numbers = metrics.iter().map(|metric| number(metric, row));
        let first = first.map(|name| cell(row.get(name)));
        table.row(first.into_iter().chain(numbers));
    }
    table
}

/// A metric of a row in its unit and digits.
fn number(metric: &Metric, row: &Value) -> String {
    let value = lookup(row, &metric.path);
    match (value, metric.unit.digits()) {
        (Some(Value::Number(number)), Some(digits)) if number.is_f64() => {
            let value = number.as_f64().unwrap_or(f64::NAN);
            rounded(value * metric.unit.factor(), digits)
        }
        _ => cell(value),
    }
}

fn remark(row: &Value) -> String {
    let notes = lookup(row, "meta.notes").and_then(Value::as_array);
    let notes = notes
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .map(str::to_owned);
    let status = row["status"].as_str().filter(|status| *status != "ok");
    let status = status.map(|status| format!("{status}: {}", row["reason"].as_str().unwrap_or("")));
    status
        .into_iter()
        .chain(notes)
        .collect::<Vec<_>>()
        .join("; ")
}

fn every_metric(rows: &[Value]) -> Table {
    let flat: Vec<Vec<(String, Value)>> = rows.iter().map(leaves).collect();
    let mut paths: Vec<String> = [
        "scene",
        "technique",
        "resolution",
        "truth",
        "status",
        "reason",
    ]
    .map(str::to_owned)
    .to_vec();
    // A row without numbers has `null` where others have an object: its path is not a column.
    let objects: Vec<String> = flat
        .iter()
        .flatten()
        .filter_map(|(path, _)| Some(path.rsplit_once('.')?.0.to_owned()))
        .collect();
    for (path, _) in flat.iter().flatten() {
        let inner = objects
            .iter()
            .any(|object| object == path || object.starts_with(&format!("{path}.")));
        if !inner && !paths.contains(path) {
            paths.push(path.clone());
        }
    }
    let mut table = Table::new(paths.iter().cloned());
    for row in flat {
        table.row(paths.iter().map(|path| {
            match row
                .iter()
                .find(|(other, _)| other == path)
                .map(|(_, value)| value)
            {
                Some(Value::Number(number)) => number.to_string(),
                value => cell(value),
            }
        }));
    }
    table
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_metric_has_a_column_and_null_objects_have_none() {
        let rows = [
            json!({ "scene": "a", "technique": "t", "color": { "mae": 0.5 }, "work": null }),
            json!({ "scene": "b", "technique": "t", "color": null, "work": null }),
        ];
        let table = every_metric(&rows);
        assert!(table.heading.contains(&"color.mae".to_owned()));
        assert!(!table.heading.contains(&"color".to_owned()));
        assert_eq!(
            table.rows[0][table
                .heading
                .iter()
                .position(|name| name == "color.mae")
                .unwrap()],
            "0.5"
        );
    }

    #[test]
    fn every_number_of_a_column_is_a_metric() {
        let row = crate::record::tests::measured("a", "linear").to_value();
        for (path, value) in leaves(&row) {
            let said = path == "schema_version" || path.starts_with("meta.");
            assert!(
                !value.is_number() || said || metrics::at(&path).is_some(),
                "{path}"
            );
        }
    }

    #[test]
    fn the_short_table_reads_well() {
        use crate::record::tests::{blank, measured};
        let mut rows = [
            measured("sphere-table", "linear"),
            blank("teapot-ball", "linear(residual=cross)"),
        ];
        rows[0].motion = None;
        let rows: Vec<Value> = rows.iter().map(crate::record::Record::to_value).collect();
        insta::assert_snapshot!(summary(&rows).write(Format::Table), @"
        scene         technique               agree %  missing %  extra %  angle p50 °  angle p99 °  offset px  failed     FLIP   work  GPU ms  wall ms  remark
        sphere-table  linear                    98.10      1.100        0       0.2500        2.000     0.5000       0  0.05000  400.5   5.000    6.000
        teapot-ball   linear(residual=cross)        –          –        –            –            –          –       –        –      –       –        –  not-applicable: no such model
        ");
    }

    #[test]
    fn the_remark_column_is_there_when_needed() {
        let fine =
            json!({ "scene": "a", "technique": "t", "status": "ok", "object_agreement": 0.981 });
        let table = summary(std::slice::from_ref(&fine));
        assert!(!table.heading.contains(&"remark".to_owned()));
        assert_eq!(table.rows[0][2], "98.10");
        let failed =
            json!({ "scene": "a", "technique": "t", "status": "failed", "reason": "lost" });
        assert_eq!(
            summary(&[fine, failed]).rows[1].last().unwrap(),
            "failed: lost"
        );
    }
}

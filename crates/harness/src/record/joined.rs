//! Records of several runs as one: of the parts of a suite, and of several adapters.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::exit::bad_input;

use super::file;
use super::path::lookup;

/// Rows of several records in the order of one run, adapter by adapter.
#[derive(Clone, Debug, Default)]
pub struct Joined {
    /// All rows, as their files have them.
    pub rows: Vec<Value>,
    /// The record that each row is from.
    pub from: Vec<PathBuf>,
    /// What is missing, a sentence each: parts of a suite that no record is of.
    pub missing: Vec<String>,
}

/// What rendered a row, in words.
pub fn adapter(row: &Value) -> String {
    let text = |key: &str| {
        let found = lookup(row, "adapter").and_then(|adapter| adapter[key].as_str());
        found.unwrap_or_default().to_owned()
    };
    match (text("name"), text("driver")) {
        (name, driver) if name.is_empty() && driver.is_empty() => "no adapter".to_owned(),
        (name, driver) if driver.is_empty() => name,
        (name, driver) => format!("{name}, {driver}"),
    }
}

/// Reads records. Those of parts are put in the order of the parts; adapters come in the order in
/// which the records are named.
///
/// # Errors
/// No record, or the same row of one adapter twice.
pub fn read(paths: &[PathBuf]) -> anyhow::Result<Joined> {
    let mut all: Vec<(usize, Part, Value, &Path)> = Vec::new();
    let mut adapters: Vec<String> = Vec::new();
    let mut empty = 0;
    for path in paths {
        let rows = file::read(path)?;
        empty += usize::from(rows.is_empty());
        for row in rows {
            let name = adapter(&row);
            let place = adapters.iter().position(|known| *known == name);
            let place = place.unwrap_or_else(|| {
                adapters.push(name);
                adapters.len() - 1
            });
            all.push((place, Part::of(&row), row, path));
        }
    }
    // Stable: within a part, and where there are none, rows stay as they were.
    all.sort_by_key(|(adapter, part, ..)| (*adapter, part.of, part.index));
    let mut joined = Joined::default();
    for (_, _, row, path) in all {
        let same = |other: &Value| {
            ["scene", "technique", "resolution", "adapter"]
                .iter()
                .all(|key| other[*key] == row[*key])
        };
        if let Some(index) = joined.rows.iter().position(same) {
            return Err(bad_input(format!(
                "{} and {}: both have a row of scene {}, technique {} on the same adapter: give one of \
                 them, or the earlier one as --against",
                joined.from[index].display(),
                path.display(),
                row["scene"],
                row["technique"]
            )));
        }
        joined.rows.push(row);
        joined.from.push(path.to_owned());
    }
    joined.missing = missing(&joined.rows, &adapters, empty);
    Ok(joined)
}

/// Which part of how many a row is of; 0 of 0 where it is of a whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Part {
    index: u64,
    of: u64,
}

impl Part {
    fn of(row: &Value) -> Self {
        let text = lookup(row, "meta.part").and_then(Value::as_str);
        let sides = text.and_then(|text| text.split_once('/'));
        let part = sides.and_then(|(index, of)| {
            Some(Self {
                index: index.parse().ok()?,
                of: of.parse().ok()?,
            })
        });
        part.unwrap_or_default()
    }
}

/// Most parts that are looked for.
const MOST_PARTS: u64 = 10_000;

/// Parts of which an adapter has no row though it has rows of other parts. If there are more parts
/// than scenes, some parts have no rows, and their records do not say which part they are: `empty`
/// such records were read.
fn missing(rows: &[Value], adapters: &[String], mut empty: usize) -> Vec<String> {
    let mut said = Vec::new();
    for name in adapters {
        let parts: Vec<Part> = rows
            .iter()
            .filter(|row| adapter(row) == *name)
            .map(Part::of)
            .collect();
        let mut sizes: Vec<u64> = parts.iter().map(|part| part.of).collect();
        sizes.sort_unstable();
        sizes.dedup();
        for of in sizes.into_iter().filter(|of| (1..=MOST_PARTS).contains(of)) {
            let absent = (1..=of).filter(|index| !parts.contains(&Part { index: *index, of }));
            let absent: Vec<String> = absent.map(|index| format!("{index}/{of}")).collect();
            let covered = empty.min(absent.len());
            empty -= covered;
            if covered < absent.len() {
                said.push(format!("no rows of part {} on {name}", absent.join(", ")));
            }
        }
    }
    said
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn record(
        folder: &Path,
        name: &str,
        adapter: &str,
        part: Option<&str>,
        rows: &[&str],
    ) -> PathBuf {
        let rows: Vec<Value> = rows
            .iter()
            .map(|technique| {
                json!({ "schema_version": 1, "scene": "s", "technique": technique, "resolution": [4, 4],
                        "status": "ok", "adapter": { "name": adapter, "driver": "d" },
                        "meta": { "part": part } })
            })
            .collect();
        let path = folder.join(name);
        std::fs::write(&path, Value::Array(rows).to_string()).unwrap();
        path
    }

    #[test]
    fn parts_are_put_in_order_and_adapters_one_after_another() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name, adapter, part, rows| record(folder.path(), name, adapter, part, rows);
        let paths = [
            write("c", "x", Some("3/3"), &["e"]),
            write("other", "y", None, &["a"]),
            write("a", "x", Some("1/3"), &["a", "b"]),
        ];
        let joined = read(&paths).unwrap();
        let names: Vec<_> = joined
            .rows
            .iter()
            .map(|row| row["technique"].as_str().unwrap())
            .collect();
        assert_eq!(names, ["a", "b", "e", "a"]);
        assert_eq!(joined.from[0], paths[2]);
        assert_eq!(joined.missing, ["no rows of part 2/3 on x, d"]);
        let with_an_empty_one = [&paths[..], &[write("b", "x", Some("2/3"), &[])]].concat();
        assert!(read(&with_an_empty_one).unwrap().missing.is_empty());
    }

    #[test]
    fn numbers_stay_as_they_were() {
        for text in ["0.9391891891891893", "0.19137303494853714"] {
            let number: Value = serde_json::from_str(text).unwrap();
            assert_eq!(number.to_string(), text);
        }
    }

    #[test]
    fn one_row_twice_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let paths = ["a", "b"].map(|name| record(folder.path(), name, "x", None, &["t"]));
        let error = read(&paths).unwrap_err().to_string();
        assert!(error.contains("--against"), "{error}");
    }
}

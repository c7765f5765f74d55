//! Rows of text as aligned columns, CSV or Markdown.

use serde_json::{Map, Value};

use crate::options::Format;

use crate::terminal::in_a_line;

use super::number::significant;

/// A heading and rows of equally many cells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Column headings.
    pub heading: Vec<String>,
    /// One a row, as long as the heading.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table with these columns.
    pub fn new(heading: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self {
            heading: heading.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    /// Appends a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The table as text; as JSON an array with an object a row, its cells by their headings.
    pub fn write(&self, format: Format) -> String {
        match format {
            Format::Table => self.aligned(),
            Format::Json => format!("{:#}\n", self.json()),
            Format::Csv => self.csv(),
            Format::Markdown => self.markdown(),
        }
    }

    fn widths(&self) -> Vec<usize> {
        let lines = || std::iter::once(&self.heading).chain(&self.rows);
        (0..self.heading.len())
            .map(|column| {
                lines()
                    .map(|line| line[column].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect()
    }

    /// Columns of numbers are aligned at the right.
    fn numeric(&self) -> Vec<bool> {
        let number =
            |cell: &str| cell == "–" || cell.trim_end_matches('%').trim().parse::<f64>().is_ok();
        (0..self.heading.len())
            .map(|column| !self.rows.is_empty() && self.rows.iter().all(|row| number(&row[column])))
            .collect()
    }

    /// The same table with other texts in its cells.
    fn with_cells(&self, change: impl Fn(&str) -> String) -> Self {
        let changed = |line: &Vec<String>| line.iter().map(|cell| change(cell)).collect();
        Self {
            heading: changed(&self.heading),
            rows: self.rows.iter().map(changed).collect(),
        }
    }

    fn aligned(&self) -> String {
        let table = self.with_cells(|cell| in_a_line(cell).into_owned());
        let (widths, numeric) = (table.widths(), table.numeric());
        let mut text = String::new();
        for line in std::iter::once(&table.heading).chain(&table.rows) {
            let cells: Vec<String> = line
                .iter()
                .enumerate()
                .map(|(column, cell)| pad(cell, widths[column], numeric[column]))
                .collect();
            text.push_str(cells.join("  ").trim_end());
            text.push('\n');
        }
        text
    }

    fn json(&self) -> Value {
        let cell = |cell: &String| match cell.as_str() {
            "–" => Value::Null,
            text => text.into(),
        };
        let row = |row: &Vec<String>| -> Value {
            let cells = row.iter().map(cell);
            let named = self.heading.iter().cloned().zip(cells);
            named.collect::<Map<_, _>>().into()
        };
        self.rows.iter().map(row).collect()
    }

    fn csv(&self) -> String {
        let mut text = String::new();
        for line in std::iter::once(&self.heading).chain(&self.rows) {
            let cells: Vec<String> = line.iter().map(|cell| csv_cell(cell)).collect();
            text.push_str(&cells.join(","));
            text.push('\n');
        }
        text
    }

    fn markdown(&self) -> String {
        let table = self.with_cells(markdown);
        let (widths, numeric) = (table.widths(), table.numeric());
        let mut text = String::new();
        let mut line = |cells: &[String]| {
            text.push_str("| ");
            text.push_str(&cells.join(" | "));
            text.push_str(" |\n");
        };
        let padded = |cells: &[String]| -> Vec<String> {
            let cells = cells.iter().enumerate();
            cells
                .map(|(column, cell)| pad(cell, widths[column], numeric[column]))
                .collect()
        };
        line(&padded(&table.heading));
        let rule = widths.iter().zip(&numeric).map(|(width, numeric)| {
            let dashes = "-".repeat(width.saturating_sub(usize::from(*numeric)).max(2));
            if *numeric {
                format!("{dashes}:")
            } else {
                dashes
            }
        });
        line(&rule.collect::<Vec<_>>());
        for row in &table.rows {
            line(&padded(row));
        }
        text
    }
}

/// Text as it may stand in Markdown, in a cell or a sentence: it shows itself and nothing else.
pub fn markdown(text: &str) -> String {
    let mut shown = String::new();
    for c in in_a_line(text).chars() {
        match c {
            '<' => shown += "&lt;",
            '&' => shown += "&amp;",
            '\\' | '|' | '`' | '*' | '[' | ']' => shown.extend(['\\', c]),
            c => shown.push(c),
        }
    }
    shown
}

/// Text as code in Markdown: between more backticks than follow each other in it.
pub fn markdown_code(text: &str) -> String {
    let text = in_a_line(text);
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    match longest {
        0 => format!("{fence}{text}{fence}"),
        _ => format!("{fence} {text} {fence}"),
    }
}

fn pad(cell: &str, width: usize, right: bool) -> String {
    if right {
        format!("{cell:>width$}")
    } else {
        format!("{cell:<width$}")
    }
}

fn csv_cell(cell: &str) -> String {
    if cell == "–" {
        String::new()
    } else if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

/// A value as a cell of a table.
pub fn cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "–".to_owned(),
        Some(Value::Bool(flag)) => if *flag { "yes" } else { "no" }.to_owned(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Array(items)) => items
            .iter()
            .map(|item| cell(Some(item)))
            .collect::<Vec<_>>()
            .join(" "),
        Some(Value::Number(number)) if number.is_f64() => {
            significant(number.as_f64().unwrap_or(f64::NAN))
        }
        Some(other) => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["name", "px"]);
        table.row(["linear(a=1,b=2)", "0.38"]);
        table.row(["x|y", "–"]);
        table
    }

    #[test]
    fn aligned() {
        let lines = [
            "name               px",
            "linear(a=1,b=2)  0.38",
            "x|y                 –",
        ];
        assert_eq!(
            table().write(Format::Table),
            lines.map(|line| line.to_owned() + "\n").concat()
        );
    }

    #[test]
    fn json_is_json() {
        let rows: Value = serde_json::from_str(&table().write(Format::Json)).unwrap();
        assert_eq!(rows[0]["name"], "linear(a=1,b=2)");
        assert_eq!(rows[0]["px"], "0.38");
        assert!(rows[1]["px"].is_null() && rows.as_array().unwrap().len() == 2);
    }

    #[test]
    fn csv_quotes_and_empties() {
        assert_eq!(
            table().write(Format::Csv),
            "name,px\n\"linear(a=1,b=2)\",0.38\nx|y,\n"
        );
    }

    #[test]
    fn names_are_shown_as_they_are_and_do_nothing() {
        let mut table = Table::new(["name", "pixels"]);
        table.row(["a\nb\u{1b}[31m,\"c\"", "1"]);
        table.row(["<img> `x` *y* [z](u)\\|", "22"]);
        let text = table.write(Format::Table);
        assert!(text.contains("a\\u000ab\\u001b[31m,\"c\" "), "{text}");
        assert_eq!(text.lines().count(), 3);
        let text = table.write(Format::Markdown);
        assert!(
            text.contains(r"| &lt;img> \`x\` \*y\* \[z\](u)\\\| |     22 |"),
            "{text}"
        );
        let lengths: Vec<usize> = text.lines().map(|line| line.chars().count()).collect();
        assert_eq!(lengths, [lengths[0]; 4], "{text}");
        let text = table.write(Format::Csv);
        assert!(text.contains("\"a\nb\u{1b}[31m,\"\"c\"\"\",1\n"), "{text}");
        assert_eq!(markdown_code("a`b"), "`` a`b ``");
        assert_eq!(markdown_code("a b"), "`a b`");
    }

    #[test]
    fn markdown_escapes_bars() {
        let text = table().write(Format::Markdown);
        assert!(text.contains("| x\\|y"), "{text}");
        assert!(
            text.lines()
                .nth(1)
                .is_some_and(|rule| rule.ends_with("---: |")),
            "{text}"
        );
    }
}

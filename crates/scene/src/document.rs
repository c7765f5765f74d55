//! TOML tables that know their lines and which keys were asked for.
//!
//! Reading a key declares it as known; [`Table::finish`] then rejects every other key of the
//! table, with the nearest known one as a suggestion.

mod message;

use std::cell::RefCell;
use std::fmt::Display;
use std::ops::RangeInclusive;

use glam::{DVec3, Vec3};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub(crate) use self::message::short;
use self::message::{found, in_a_line};
use crate::SceneError;
use crate::suggest::suggest;

/// Keys that are wrong at the root of a scene, and where each belongs and under which name.
const ELSEWHERE: [(&str, &str); 5] = [
    ("move", "[[motion.move]], below [motion]"),
    ("objects", "[[object]], once for each of them"),
    ("mirrors", "[[mirror]], once for each of them"),
    (
        "transform",
        "`transform = { … }` inside an [[object]] or a [[mirror]]",
    ),
    (
        "repeat",
        "`repeat = [{ … }]` inside an [[object]] or a [[mirror]]",
    ),
];

/// Largest magnitude of a number in a scene, far inside the range of `f32`.
const LARGEST: f64 = 1e9;
/// Smallest length that counts as positive.
pub(crate) const SMALLEST: f64 = 1e-9;

/// Name and line starts of a text file.
pub(crate) struct Source {
    file: String,
    line_starts: Vec<usize>,
}

impl Source {
    pub(crate) fn new(file: &str, text: &str) -> Self {
        let starts = text
            .bytes()
            .enumerate()
            .filter(|(_, byte)| *byte == b'\n')
            .map(|(i, _)| i + 1);
        Self {
            file: file.to_owned(),
            line_starts: std::iter::once(0).chain(starts).collect(),
        }
    }

    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    pub(crate) fn line(&self, offset: usize) -> usize {
        self.line_starts.partition_point(|start| *start <= offset)
    }

    pub(crate) fn error(&self, offset: usize, message: impl Display) -> SceneError {
        SceneError::AtLine {
            file: self.file.clone(),
            line: self.line(offset),
            message: in_a_line(&message.to_string()),
        }
    }
}

/// So many numbers, as an example in a message.
fn example(count: usize) -> String {
    let numbers = ["0.0", "1.0", "0.0", "1.0"];
    format!("[{}]", numbers[..count.min(numbers.len())].join(", "))
}

/// Parses a whole TOML text.
pub(crate) fn parse<'d>(
    source: &Source,
    text: &'d str,
) -> Result<Spanned<DeTable<'d>>, SceneError> {
    DeTable::parse(text).map_err(|error| {
        let offset = error.span().map_or(0, |span| span.start);
        source.error(offset, error.message().replace('\n', ", "))
    })
}

/// One table of a scene file.
pub(crate) struct Table<'d> {
    source: &'d Source,
    /// What the table describes, for messages: `object "floor"`; empty for the root.
    owner: String,
    /// Offset of the table itself.
    start: usize,
    values: &'d DeTable<'d>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'d> Table<'d> {
    pub(crate) fn root(source: &'d Source, document: &'d Spanned<DeTable<'d>>) -> Self {
        Self::new(source, String::new(), 0, document.get_ref())
    }

    fn new(source: &'d Source, owner: String, start: usize, values: &'d DeTable<'d>) -> Self {
        Self {
            source,
            owner,
            start,
            values,
            asked: RefCell::default(),
        }
    }

    pub(crate) fn owner(&self) -> &str {
        &self.owner
    }

    pub(crate) fn file(&self) -> &str {
        self.source.file()
    }

    /// Line of a key, or of the table where it lacks the key.
    pub(crate) fn line(&self, key: &str) -> usize {
        self.source.line(self.offset(key))
    }

    fn offset(&self, key: &str) -> usize {
        self.values
            .get_key_value(key)
            .map_or(self.start, |(key, _)| key.span().start)
    }

    fn error_at(&self, offset: usize, message: impl Display) -> SceneError {
        match self.owner.as_str() {
            "" => self.source.error(offset, message),
            owner => self
                .source
                .error(offset, format_args!("{owner}: {message}")),
        }
    }

    /// An error about a key, at its line.
    pub(crate) fn error(&self, key: &str, message: impl Display) -> SceneError {
        self.error_at(self.offset(key), format_args!("`{key}` {message}"))
    }

    /// An error about the table as a whole.
    pub(crate) fn error_here(&self, message: impl Display) -> SceneError {
        self.error_at(self.start, message)
    }

    pub(crate) fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }

    fn get(&self, key: &'static str) -> Option<&'d Spanned<DeValue<'d>>> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            asked.push(key);
        }
        self.values.get(key)
    }

    fn wrong_type(&self, key: &str, value: &DeValue<'_>, wanted: impl Display) -> SceneError {
        self.error(key, format_args!("must be {wanted}, not {}", found(value)))
    }

    /// The value of a key that must be there.
    pub(crate) fn required<T>(&self, key: &'static str, value: Option<T>) -> Result<T, SceneError> {
        value.ok_or_else(|| {
            // A misspelt key explains a missing one better than its absence does.
            let known: Vec<_> = self
                .asked
                .borrow()
                .iter()
                .copied()
                .filter(|k| !self.values.contains_key(*k))
                .collect();
            let misspelt = self
                .values
                .iter()
                .map(|(found, _)| found)
                .filter(|found| !self.asked.borrow().contains(&found.get_ref().as_ref()))
                .find(|found| {
                    suggest(found.get_ref(), known.iter().copied()).contains(&format!("`{key}`"))
                });
            match misspelt {
                Some(found) => self.unknown(found.get_ref(), found.span().start, &known),
                None => self.error_here(format_args!("key `{key}` is missing")),
            }
        })
    }

    pub(crate) fn string(&self, key: &'static str) -> Result<Option<&'d str>, SceneError> {
        match self.get(key).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::String(text)) => Ok(Some(text)),
            Some(other) => Err(self.wrong_type(key, other, "a string")),
        }
    }

    pub(crate) fn boolean(&self, key: &'static str) -> Result<Option<bool>, SceneError> {
        match self.get(key).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::Boolean(value)) => Ok(Some(*value)),
            Some(other) => Err(self.wrong_type(key, other, "true or false")),
        }
    }

    /// A finite number, integer or float.
    pub(crate) fn number(&self, key: &'static str) -> Result<Option<f64>, SceneError> {
        self.get(key)
            .map(|value| self.to_number(key, value.get_ref()))
            .transpose()
    }

    /// A length above zero.
    pub(crate) fn positive(&self, key: &'static str) -> Result<Option<f64>, SceneError> {
        match self.number(key)? {
            Some(value) if value < SMALLEST => {
                Err(self.error(key, format_args!("must be positive, not {}", short(value))))
            }
            value => Ok(value),
        }
    }

    /// A whole number within a range.
    pub(crate) fn count(
        &self,
        key: &'static str,
        range: RangeInclusive<u32>,
    ) -> Result<Option<u32>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        self.to_count(key, value.get_ref(), &range).map(Some)
    }

    fn to_count(
        &self,
        key: &str,
        value: &DeValue<'_>,
        range: &RangeInclusive<u32>,
    ) -> Result<u32, SceneError> {
        let DeValue::Integer(integer) = value else {
            return Err(self.wrong_type(key, value, "a whole number"));
        };
        u32::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .filter(|count| range.contains(count))
            .ok_or_else(|| {
                let (low, high) = (range.start(), range.end());
                let found = found(value);
                self.error(
                    key,
                    format_args!("must be from {low} to {high}, not {found}"),
                )
            })
    }

    /// Two whole numbers within a range.
    pub(crate) fn counts(
        &self,
        key: &'static str,
        range: RangeInclusive<u32>,
    ) -> Result<Option<[u32; 2]>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        match value.get_ref() {
            DeValue::Array(array) if array.len() == 2 => Ok(Some([
                self.to_count(key, array[0].get_ref(), &range)?,
                self.to_count(key, array[1].get_ref(), &range)?,
            ])),
            other => Err(self.wrong_type(key, other, "an array of 2 whole numbers")),
        }
    }

    /// An array of `N` finite numbers.
    pub(crate) fn numbers<const N: usize>(
        &self,
        key: &'static str,
    ) -> Result<Option<[f64; N]>, SceneError> {
        self.get(key)
            .map(|value| self.to_numbers(key, value.get_ref()))
            .transpose()
    }

    fn to_numbers<const N: usize>(
        &self,
        key: &str,
        value: &DeValue<'_>,
    ) -> Result<[f64; N], SceneError> {
        match value {
            DeValue::Array(array) if array.len() == N => {
                let mut numbers = [0.0; N];
                for (number, (value, place)) in numbers.iter_mut().zip(array.iter().zip(1..)) {
                    let value = value.get_ref();
                    if !matches!(value, DeValue::Integer(_) | DeValue::Float(_)) {
                        let found = found(value);
                        let message = format_args!(
                            "must be an array of {N} numbers; number {place} of them is {found}"
                        );
                        return Err(self.error(key, message));
                    }
                    *number = self.to_number(key, value)?;
                }
                Ok(numbers)
            }
            DeValue::Array(array) => Err(self.error(
                key,
                format_args!(
                    "must be an array of {N} numbers, not of {} (such as {})",
                    array.len(),
                    example(N)
                ),
            )),
            other => {
                let wanted = format_args!("an array of {N} numbers, such as {}", example(N));
                Err(self.wrong_type(key, other, wanted))
            }
        }
    }

    /// An array of arrays of `N` finite numbers.
    pub(crate) fn rows<const N: usize>(
        &self,
        key: &'static str,
    ) -> Result<Option<Vec<[f64; N]>>, SceneError> {
        match self.get(key).map(Spanned::get_ref) {
            None => Ok(None),
            Some(DeValue::Array(array)) => {
                let row = |row: &Spanned<DeValue<'_>>| match row.get_ref() {
                    row @ DeValue::Array(_) => self.to_numbers(key, row),
                    other => Err(self.wrong_rows::<N>(key, other)),
                };
                array.iter().map(row).collect::<Result<_, _>>().map(Some)
            }
            Some(other) => Err(self.wrong_rows::<N>(key, other)),
        }
    }

    fn wrong_rows<const N: usize>(&self, key: &str, value: &DeValue<'_>) -> SceneError {
        let row = example(N);
        let message = format_args!(
            "must be an array of arrays of {N} numbers each, such as [{row}]; {} is there in place of \
             an array",
            found(value)
        );
        self.error(key, message)
    }

    /// An array of arrays of `N` whole numbers within a range.
    pub(crate) fn count_rows<const N: usize>(
        &self,
        key: &'static str,
        range: RangeInclusive<u32>,
    ) -> Result<Option<Vec<[u32; N]>>, SceneError> {
        let Some(value) = self.get(key).map(Spanned::get_ref) else {
            return Ok(None);
        };
        let wanted = format!("an array of arrays of {N} whole numbers");
        let DeValue::Array(rows) = value else {
            return Err(self.wrong_type(key, value, wanted));
        };
        let mut counts = Vec::new();
        for row in rows {
            match row.get_ref() {
                DeValue::Array(row) if row.len() == N => {
                    let mut numbers = [0; N];
                    for (number, value) in numbers.iter_mut().zip(row.iter()) {
                        *number = self.to_count(key, value.get_ref(), &range)?;
                    }
                    counts.push(numbers);
                }
                _ => return Err(self.error(key, format_args!("must be {wanted}"))),
            }
        }
        Ok(Some(counts))
    }

    /// A point or direction.
    pub(crate) fn vector(&self, key: &'static str) -> Result<Option<DVec3>, SceneError> {
        Ok(self.numbers::<3>(key)?.map(DVec3::from_array))
    }

    /// A unit direction.
    pub(crate) fn direction(&self, key: &'static str) -> Result<Option<DVec3>, SceneError> {
        match self.vector(key)? {
            Some(vector) if vector.length() < SMALLEST => {
                Err(self.error(key, "must not be the zero vector"))
            }
            vector => Ok(vector.map(DVec3::normalize)),
        }
    }

    /// A number for all axes, or one for each.
    pub(crate) fn scale(&self, key: &'static str) -> Result<Option<DVec3>, SceneError> {
        match self.get(key).map(Spanned::get_ref) {
            Some(DeValue::Array(_)) => self.vector(key),
            Some(DeValue::Integer(_) | DeValue::Float(_)) => {
                Ok(self.number(key)?.map(DVec3::splat))
            }
            Some(other) => Err(self.wrong_type(key, other, "a number or an array of 3 numbers")),
            None => Ok(None),
        }
    }

    /// A linear RGB colour.
    pub(crate) fn color(&self, key: &'static str) -> Result<Option<Vec3>, SceneError> {
        match self.vector(key)? {
            Some(color) if color.min_element() < 0.0 => {
                Err(self.error(key, "must not be negative"))
            }
            color => Ok(color.map(|color| color.as_vec3())),
        }
    }

    fn to_number(&self, key: &str, value: &DeValue<'_>) -> Result<f64, SceneError> {
        let number = match value {
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .map(|i| i as f64)
                .ok(),
            DeValue::Float(float) => float.as_str().parse().ok(),
            other => return Err(self.wrong_type(key, other, "a number")),
        };
        match number {
            Some(number) if number.abs() <= LARGEST => Ok(number),
            Some(number) if number.is_finite() => {
                Err(self.error(key, format_args!("is out of range: {number:e}")))
            }
            _ => Err(self.error(key, "must be a finite number")),
        }
    }

    /// A table under a key.
    pub(crate) fn table(&self, key: &'static str) -> Result<Option<Table<'d>>, SceneError> {
        let Some(value) = self.get(key) else {
            return Ok(None);
        };
        match value.get_ref() {
            DeValue::Table(values) => {
                let owner = match self.owner.as_str() {
                    "" => key.to_owned(),
                    owner => format!("{owner}: {key}"),
                };
                let start = self.offset(key);
                Ok(Some(Table::new(self.source, owner, start, values)))
            }
            other => Err(self.wrong_type(key, other, "a table")),
        }
    }

    /// An array of tables, each called by its name or its number.
    pub(crate) fn tables(&self, key: &'static str) -> Result<Vec<Table<'d>>, SceneError> {
        let prefix = match self.owner.as_str() {
            "" => String::new(),
            owner => format!("{owner}."),
        };
        // Tables of an object or a mirror are too small for headings of their own.
        let wanted = if prefix.contains('"') {
            "an array of tables".to_owned()
        } else {
            format!("written as [[{prefix}{key}]], with two brackets and once for each of them")
        };
        let elements = match self.get(key).map(Spanned::get_ref) {
            None => return Ok(Vec::new()),
            Some(DeValue::Array(elements)) => elements,
            Some(other) => return Err(self.wrong_type(key, other, wanted)),
        };
        elements
            .iter()
            .zip(1..)
            .map(|(element, number)| match element.get_ref() {
                DeValue::Table(values) => {
                    let mut owner = match values.get("name").map(Spanned::get_ref) {
                        Some(DeValue::String(name)) => format!("{key} \"{name}\""),
                        _ => format!("{key} {number}"),
                    };
                    if !self.owner.is_empty() {
                        owner = format!("{}: {owner}", self.owner);
                    }
                    Ok(Table::new(self.source, owner, element.span().start, values))
                }
                other => Err(self.wrong_type(key, other, &wanted)),
            })
            .collect()
    }

    fn unknown(&self, key: &str, offset: usize, known: &[&'static str]) -> SceneError {
        let elsewhere = ELSEWHERE.iter().find(|(other, _)| *other == key);
        let suggestion = match elsewhere {
            Some((_, heading)) if self.owner.is_empty() => format!(": it is written as {heading}"),
            _ => suggest(key, known.iter().copied()),
        };
        self.error_at(offset, format_args!("unknown key `{key}`{suggestion}"))
    }

    /// Rejects the first key, in file order, that nobody asked for.
    pub(crate) fn finish(&self) -> Result<(), SceneError> {
        let asked = self.asked.borrow();
        self.values
            .keys()
            .filter(|key| !asked.contains(&key.get_ref().as_ref()))
            .min_by_key(|key| key.span().start)
            .map_or(Ok(()), |key| {
                Err(self.unknown(key.get_ref(), key.span().start, &asked))
            })
    }
}

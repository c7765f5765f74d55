//! What is known of a number in a record: what it is called, its unit, which way it gets better.

/// A number of the record.
#[derive(Clone, Debug, PartialEq)]
pub struct Metric {
    /// Where it stands, such as `time_ms.frame.median`; `*` stands for any name.
    pub path: String,
    /// Over a column, without its unit.
    pub heading: String,
    /// In a sentence or at an axis, without its unit.
    pub name: String,
    /// What it counts.
    pub unit: Unit,
    /// Which way it gets better.
    pub better: Better,
    /// Whether `--against` says that it got better or worse.
    pub judged: bool,
    /// A sentence.
    pub what: String,
}

/// What a number counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Whole things.
    Count,
    /// A part of a whole, 0 to 1; per cent in tables.
    Share,
    /// Degrees.
    Degrees,
    /// Pixels.
    Pixels,
    /// Milliseconds.
    Milliseconds,
    /// Decibels.
    Decibels,
    /// A number without a unit.
    Plain,
}

impl Unit {
    /// The sign behind a heading; `None` where a number speaks for itself.
    pub fn sign(self) -> Option<&'static str> {
        match self {
            Self::Count | Self::Plain => None,
            Self::Share => Some("%"),
            Self::Degrees => Some("°"),
            Self::Pixels => Some("px"),
            Self::Milliseconds => Some("ms"),
            Self::Decibels => Some("dB"),
        }
    }

    /// The factor by which its value is multiplied in a table: a share is shown in per cent.
    pub fn factor(self) -> f64 {
        match self {
            Self::Share => 100.0,
            _ => 1.0,
        }
    }

    /// Significant digits in a table; whole numbers have all of theirs.
    pub fn digits(self) -> Option<u32> {
        match self {
            Self::Count => None,
            _ => Some(4),
        }
    }
}

/// Which way a number gets better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// Downwards.
    Low,
    /// Upwards.
    High,
    /// Neither: it says what there was to do.
    Neither,
}

impl Metric {
    /// Heading and unit, for a column.
    pub fn column(&self) -> String {
        match self.unit.sign() {
            Some(sign) => format!("{} {sign}", self.heading),
            None => self.heading.clone(),
        }
    }

    /// Name and unit, for an axis. The name of a share says of what it is one.
    pub fn label(&self) -> String {
        match self.unit.sign() {
            Some(sign) if self.unit != Unit::Share => format!("{} ({sign})", self.name),
            _ => self.name.clone(),
        }
    }
}

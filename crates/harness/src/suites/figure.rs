//! What a figure of a suite is: an axis, series of points along it, and what is drawn against it.

use crate::plot::{Axis, Scale};

use super::Results;

/// A sweep, and what is shown of it.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of its files and its place on the page; unique in the suite.
    pub anchor: &'static str,
    /// Heading.
    pub title: String,
    /// Where it was published, such as `Szabo 2013, Fig. 6.1`.
    pub after: &'static str,
    /// What is asked and how the measurement answers it.
    pub question: String,
    /// What the points differ by.
    pub axis: Axis,
    /// In the order of the legend.
    pub series: Vec<Series>,
    /// What is drawn, a plot each.
    pub quantities: Vec<Quantity>,
    /// The paper's numbers.
    pub quotes: Vec<Quote>,
    /// What came out, in sentences (plain text).
    pub analysis: fn(&Results<'_>) -> Vec<String>,
}

impl Figure {
    /// The size of the pictures that are measured, where all points ask for the same one.
    pub fn resolution(&self) -> Option<[u32; 2]> {
        let mut sizes = self
            .series
            .iter()
            .flat_map(|series| series.points.iter().map(|point| point.resolution));
        let first = sizes.next()??;
        sizes.all(|size| size == Some(first)).then_some(first)
    }
}

/// Points of one kind, from left to right.
#[derive(Clone, Debug)]
pub struct Series {
    /// In the legend; unique in the figure.
    pub label: String,
    /// From left to right.
    pub points: Vec<Point>,
}

/// A scene and a technique, and where they stand on the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// On the axis.
    pub x: f64,
    /// Built-in name or scene file.
    pub scene: String,
    /// Picture size; `None` for the scene's own.
    pub resolution: Option<[u32; 2]>,
    /// Name, with options.
    pub technique: String,
    /// Frames of the scene's motion to follow (the record's `temporal`); the largest of a scene's
    /// points holds for all of them.
    pub frames: Option<u32>,
    /// Whether its pictures come on the page.
    pub picture: bool,
    /// A number of its record that says where it stands on the axis, in place of `x`: error against
    /// time, for example.
    pub along: Option<&'static str>,
}

impl Point {
    /// A point without pictures, in the scene's own size.
    pub fn new(x: f64, scene: impl Into<String>, technique: impl Into<String>) -> Self {
        Self {
            x,
            scene: scene.into(),
            resolution: None,
            technique: technique.into(),
            frames: None,
            picture: false,
            along: None,
        }
    }

    /// The same point with its pictures on the page.
    pub fn shown(self) -> Self {
        Self {
            picture: true,
            ..self
        }
    }
}

/// A number of the record, drawn against the figure's axis.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// What it is, with its unit.
    pub label: &'static str,
    /// Where it stands in the record, such as `time_ms.frame.median`.
    pub path: &'static str,
    /// How it is laid out.
    pub scale: Scale,
    /// What it is to be compared with at every place.
    pub guide: Option<Guide>,
}

/// Another number of the same rows, drawn as a series of its own.
#[derive(Clone, Copy, Debug)]
pub struct Guide {
    /// In the legend.
    pub label: &'static str,
    /// Where it stands in the record.
    pub path: &'static str,
}

impl Quantity {
    /// On a logarithmic axis.
    pub const fn log(label: &'static str, path: &'static str) -> Self {
        Self {
            label,
            path,
            scale: Scale::Log,
            guide: None,
        }
    }

    /// On an axis of equal steps.
    pub const fn linear(label: &'static str, path: &'static str) -> Self {
        Self {
            label,
            path,
            scale: Scale::Linear,
            guide: None,
        }
    }

    /// On an axis of equal steps around the values, where they differ by little.
    pub const fn close(label: &'static str, path: &'static str) -> Self {
        Self {
            label,
            path,
            scale: Scale::Close,
            guide: None,
        }
    }

    /// With a number beside it.
    pub fn beside(self, guide: Guide) -> Self {
        Self {
            guide: Some(guide),
            ..self
        }
    }
}

/// A number that the paper prints, and ours beside it.
#[derive(Clone, Copy, Debug)]
pub struct Quote {
    /// What was measured.
    pub what: &'static str,
    /// The paper's number with its unit.
    pub theirs: &'static str,
    /// On what it was measured.
    pub on: &'static str,
    /// Our number for it; `None` where we have no such thing.
    pub ours: Option<Ask>,
}

/// A number of ours: of the point of a series, which is nearest to `x`.
#[derive(Clone, Copy, Debug)]
pub struct Ask {
    /// The label of the series.
    pub series: &'static str,
    /// On the axis.
    pub x: f64,
    /// Where it stands in the record.
    pub path: &'static str,
    /// Written behind it.
    pub unit: &'static str,
}

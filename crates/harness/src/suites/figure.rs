//! What a figure of a suite is: an axis, series of points along it, what is drawn against it, and
//! what is said about it.

use super::claims::Claim;
use super::series::{Ask, Series};
use crate::record::metrics;
use crate::show::plot::{Axis, Scale};

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
    pub quotes: &'static [Quote],
    /// What the figure decides.
    pub claims: &'static [Claim],
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

/// A number of the record, drawn against the figure's axis.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// What it is here, with its unit; `None` for what it is everywhere.
    pub called: Option<&'static str>,
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
    pub const fn log(path: &'static str) -> Self {
        Self {
            called: None,
            path,
            scale: Scale::Log,
            guide: None,
        }
    }

    /// On an axis of equal steps.
    pub const fn linear(path: &'static str) -> Self {
        Self {
            called: None,
            path,
            scale: Scale::Linear,
            guide: None,
        }
    }

    /// On an axis of equal steps around the values, where they differ by little.
    pub const fn close(path: &'static str) -> Self {
        Self {
            called: None,
            path,
            scale: Scale::Close,
            guide: None,
        }
    }

    /// Under a name of the figure's own, with its unit: where a technique counts something special.
    pub fn called(self, label: &'static str) -> Self {
        Self {
            called: Some(label),
            ..self
        }
    }

    /// What it is, with its unit.
    pub fn label(&self) -> String {
        let usual = || metrics::known(self.path).label();
        self.called.map_or_else(usual, str::to_owned)
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

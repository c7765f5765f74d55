//! What a diagram shows.

use super::axis::Axis;

/// Colours of the series, told apart by the colour-blind (after Okabe and Ito), with a contrast of
/// at least 3 on light and on dark paper.
pub const SERIES: [&str; 10] = [
    "#2a86c8", "#dd6a13", "#1a9f7a", "#c86fa0", "#a98500", "#7f74d8", "#858585", "#c8504d",
    "#6b9423", "#8f6245",
];

/// Width of every plot, in its own units.
pub(super) const WIDTH: u32 = 640;
/// Usual height of a plot, without its legend.
pub const TALL: u32 = 360;

/// What a diagram shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// For those who cannot see it, and as the title of a file.
    pub title: String,
    /// To the right.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// In the order of the legend.
    pub series: Vec<Curve>,
    /// Height without the legend; the width is 640.
    pub height: u32,
    /// Whether the points of a series are joined by a line; at names they stand on stems instead.
    pub joined: bool,
}

/// Points of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// In the legend.
    pub label: String,
    /// Its points, in the order in which they are joined.
    pub points: Vec<Mark>,
}

/// A measured value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Along the x axis.
    pub x: f64,
    /// Along the y axis.
    pub y: f64,
    /// Written beside the point; may be empty.
    pub name: String,
    /// Said to people who hover over it.
    pub label: String,
}

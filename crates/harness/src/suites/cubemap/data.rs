//! What the figures share: sizes, points and quantities.

use crate::suites::figure::Quantity;
use crate::suites::paths::{AGREEMENT, ANGLE, FRAME_MS, NODE_TESTS, SAMPLES, UNRESOLVED};
use crate::suites::series::{Point, Series};

/// Picture size of everything outside the grid: steps of a thousandth of a ray are slow on a
/// software adapter.
pub const SIZE: [u32; 2] = [160, 120];

/// Where one option is looked at.
pub const SCENES: [&str; 2] = ["sphere-objects-1k", "box"];

/// Beside the samples, where a pyramid is looked at.
pub fn nodes() -> Quantity {
    Quantity::log(NODE_TESTS).called("cells of the pyramid looked at per mirror pixel")
}

/// A point in the suite's small size.
pub fn point(x: usize, scene: &str, technique: impl Into<String>) -> Point {
    Point {
        resolution: Some(SIZE),
        ..Point::new(x as f64, scene, technique)
    }
}

/// What is asked of every option: exactness, what is left open, work and time.
pub fn quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear(AGREEMENT),
        Quantity::linear(UNRESOLVED),
        Quantity::log(ANGLE),
        Quantity::linear("color.flip"),
        Quantity::log(SAMPLES),
        Quantity::log(FRAME_MS),
    ]
}

/// One series for each scene: the techniques along the axis.
pub fn by_scene(scenes: &[&str], techniques: &[String], shown: Option<&str>) -> Vec<Series> {
    let series = |scene: &&str| Series {
        label: (*scene).to_owned(),
        points: techniques
            .iter()
            .enumerate()
            .map(|(x, technique)| {
                let point = point(x, scene, technique);
                if shown == Some(scene) {
                    point.shown()
                } else {
                    point
                }
            })
            .collect(),
    };
    scenes.iter().map(series).collect()
}

//! What the figures share: sizes, and where their numbers stand in a record.

use crate::show::plot::{Axis, Scale};
use crate::suites::figure::Quantity;
use crate::suites::results::Results;
use crate::suites::series::{Point, Series};

/// Picture size of everything outside the grid: steps of a thousandth of a ray are slow on a
/// software adapter.
pub const SIZE: [u32; 2] = [160, 120];
pub const FRAME_MS: &str = "time_ms.frame.median";
pub const TRACE_MS: &str = "time_ms.passes.trace";
pub const AGREEMENT: &str = "object_agreement";

/// Against the truth with mirrors in mirrors.
pub const FULL_AGREEMENT: &str = "against_full.object_agreement";
pub const UNRESOLVED: &str = "coverage.unresolved";
pub const SAMPLES: &str = "work.samples";
pub const NODE_TESTS: &str = "work.node_tests";
pub const ANGLE: &str = "angular_error_deg.p50";
pub const PIXELS: &str = "coverage.mirror_pixels";

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

/// An axis of names.
pub fn names<'n>(label: &str, names: impl IntoIterator<Item = &'n str>) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.into_iter().map(str::to_owned).collect()),
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

/// Nanoseconds that tracing takes a mirror pixel; `None` where it is not measured.
pub fn ns_per_pixel(results: &Results<'_>, point: &Point) -> Option<f64> {
    let pixels = results
        .value(point, PIXELS)
        .filter(|pixels| *pixels > 0.0)?;
    Some(results.value(point, TRACE_MS)? * 1e6 / pixels)
}

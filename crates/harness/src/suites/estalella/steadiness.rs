//! Flicker over a camera path.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{JITTER_MEAN, JITTER_P99, JUMPS, MEAN_PX};
use crate::suites::series::{Point, Series};

use super::claims;
use super::data::{search, with_grid};

/// By the number of steps, without and with a grid.
pub fn figure() -> Figure {
    const SCENE: &str = "sphere-objects-1k";
    const FRAMES: u32 = 24;
    let techniques = [
        ("3 steps", search(3)),
        ("5 steps", search(5)),
        ("9 steps", search(9)),
        ("25 steps", search(25)),
        ("5 steps, grid", with_grid(5, 10.0)),
        ("9 steps, grid", with_grid(9, 10.0)),
        ("25 steps, grid", with_grid(25, 10.0)),
    ];
    let labels = techniques.each_ref().map(|(label, _)| *label);
    let points = |scene: &'static str, wanted: &[usize]| {
        let points = wanted.iter().map(|&x| Point {
            frames: Some(FRAMES),
            ..Point::new(x as f64, scene, &techniques[x].1)
        });
        points.collect()
    };
    Figure {
        anchor: "steadiness",
        title: "Flicker of a fixed number of steps, with and without a grid".to_owned(),
        after: "Estalella et al. 2005, section 5",
        question: format!(
            "The camera moves slowly, {FRAMES} frames of the scene's own path: around a ball among objects, and \
             through the paper's own scene, a kitchen. A vertex flickers where its \
             error changes from frame to frame; that a fixed number of steps flickers and a grid of a tenth \
             of the vertices does not is the paper's claim."
        ),
        axis: Axis::names("technique", labels),
        series: vec![
            Series {
                label: claims::PATH.to_owned(),
                points: points(SCENE, &[0, 1, 2, 3, 4, 5, 6]),
            },
            Series {
                label: "kitchen".to_owned(),
                points: points("kitchen", &[2, 5]),
            },
        ],
        quantities: vec![
            Quantity::log(JITTER_MEAN),
            Quantity::log(JITTER_P99),
            Quantity::linear(JUMPS),
            Quantity::log(MEAN_PX),
        ],
        quotes: &[],
        claims: claims::STEADINESS,
    }
}

//! Flicker over a camera path.

use crate::show::number::short;
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{JITTER_MEAN, JITTER_P99, JUMPS, MEAN_PX};
use crate::suites::results::Results;
use crate::suites::series::{Point, Series};

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
                label: "objects".to_owned(),
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
        analysis,
    }
}

fn analysis(results: &Results<'_>) -> Vec<String> {
    let sentence = |scene: &str, steps: &str, alone: f64, grid: f64| {
        let at = |x, path| results.at(scene, x, path);
        let (mean, gridded) = (at(alone, JITTER_MEAN)?, at(grid, JITTER_MEAN)?);
        let (tail, tail_gridded) = (at(alone, JITTER_P99)?, at(grid, JITTER_P99)?);
        let (jumps, jumps_gridded) = (at(alone, JUMPS)?, at(grid, JUMPS)?);
        let calmer = [gridded < mean, tail_gridded < tail, jumps_gridded < jumps];
        let verdict = match calmer {
            [true, true, true] => "holds here",
            [false, false, false] => "does not hold here",
            _ => "holds in part",
        };
        let [mean_goes, tail_goes, jumps_go] = calmer.map(|calmer| match calmer {
            true => "falls",
            false => "does not fall",
        });
        Some(format!(
            "{scene}: with {steps} steps the mean jitter {mean_goes} by the grid, from {} to {} px a frame; what one \
             change in a hundred exceeds {tail_goes}, from {} to {} px; the share above 2 px {jumps_go}, from \
             {} to {} in ten thousand: that the grid removes flicker {verdict}.",
            short(mean),
            short(gridded),
            short(tail),
            short(tail_gridded),
            short(1e4 * jumps),
            short(1e4 * jumps_gridded)
        ))
    };
    [
        ("objects", "5", 1.0, 4.0),
        ("objects", "9", 2.0, 5.0),
        ("objects", "25", 3.0, 6.0),
        ("kitchen", "9", 2.0, 5.0),
    ]
    .into_iter()
    .filter_map(|(scene, steps, alone, grid)| sentence(scene, steps, alone, grid))
    .collect()
}

//! `catoptric bench cubemap`: cubemap tracing, Číž 2017, chapter 5, and what the thesis owed: the
//! comparison with the truth for every cell of its table. `--full` measures the whole grid.

mod grid;
mod heat;
mod levels;
mod options;
mod skipped;
mod sweeps;
mod techniques;

use crate::plot::{Axis, Scale};

use super::{Figure, Picture, Point, Quantity, Results, Series, Studio, Suite};

/// The suite with a grid that fits a quarter of an hour on two cores.
pub const SUITE: Suite = Suite {
    name: "cubemap",
    title: "Cubemap tracing",
    why: "What do a few cube maps of distance give in place of a ray tracer: how exact are they by \
          criterion, sampling, acceleration, face size and number, and what do they cost? Unless a \
          figure says otherwise: pictures of 160×120, two maps of 256² placed automatically, rays of \
          twice the scene's diagonal, a thousand steps a ray.",
    figures: |scene| figures(scene, grid::DEFAULT),
    pictures: Some(pictures),
    timing_s: 90.0,
};

/// The suite with every cell of Table 5.2.
pub const FULL: Suite = Suite {
    name: "cubemap-full",
    title: "Cubemap tracing, the whole grid",
    figures: |scene| figures(scene, grid::FULL),
    timing_s: 900.0,
    ..SUITE
};

/// Picture size of everything outside the grid: steps of a thousandth of a ray are slow on a
/// software adapter.
const SIZE: [u32; 2] = [160, 120];

fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let mut pictures = heat::pictures(studio)?;
    pictures.extend(skipped::pictures(studio)?);
    pictures.extend(levels::pictures(studio)?);
    Ok(pictures)
}

const FRAME_MS: &str = "time_ms.frame.median";
const TRACE_MS: &str = "time_ms.passes.trace";
const AGREEMENT: &str = "object_agreement";
/// Against the truth with mirrors in mirrors.
const FULL_AGREEMENT: &str = "against_full.object_agreement";
const UNRESOLVED: &str = "coverage.unresolved";
const SAMPLES: &str = "work.samples";
const NODE_TESTS: &str = "work.node_tests";
const ANGLE: &str = "angular_error_deg.p50";
const PIXELS: &str = "coverage.mirror_pixels";

fn figures(scene: Option<&str>, grid: grid::Grid) -> Vec<Figure> {
    let mut figures = vec![grid.figure(scene)];
    figures.extend(options::figures(scene));
    figures.extend(techniques::figures(scene));
    figures
}

/// A point in the suite's small size.
fn point(x: usize, scene: &str, technique: impl Into<String>) -> Point {
    Point {
        resolution: Some(SIZE),
        ..Point::new(x as f64, scene, technique)
    }
}

/// An axis of names.
fn names<'n>(label: &str, names: impl IntoIterator<Item = &'n str>) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.into_iter().map(str::to_owned).collect()),
    }
}

/// Beside the samples, where a pyramid is looked at.
const NODES: Quantity = Quantity::log(
    "cells of the pyramid looked at per mirror pixel",
    NODE_TESTS,
);

/// What is asked of every option: exactness, what is left open, work and time.
fn quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear("share of pixels with the right object", AGREEMENT),
        Quantity::linear("share of pixels unresolved", UNRESOLVED),
        Quantity::log("angular error, median (°)", ANGLE),
        Quantity::linear("FLIP", "color.flip"),
        Quantity::log("samples per mirror pixel", SAMPLES),
        Quantity::log("time of a frame (ms)", FRAME_MS),
    ]
}

/// One series for each scene: the techniques along the axis.
fn by_scene(scenes: &[&str], techniques: &[String], shown: Option<&str>) -> Vec<Series> {
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
fn ns_per_pixel(results: &Results<'_>, point: &Point) -> Option<f64> {
    let pixels = results
        .value(point, PIXELS)
        .filter(|pixels| *pixels > 0.0)?;
    Some(results.value(point, TRACE_MS)? * 1e6 / pixels)
}

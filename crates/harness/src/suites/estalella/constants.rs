//! What the paper leaves open: how much interpolation costs, and the constants of the adaptive
//! step.

use crate::show::plot::Axis;
use crate::suites::claims::Claim;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{MEAN_PX, MEDIAN_PX, P95_PX};
use crate::suites::series::{Point, Series};

use super::claims;
use super::data::search;

/// A figure for the edge of a cell and one for each constant.
pub fn figures() -> [Figure; 4] {
    [
        cells(),
        constant(
            "first-step",
            "The length of the first step",
            "step",
            &[0.2, 0.35, 0.5, 0.7, 1.0],
            claims::FIRST_STEP,
        ),
        constant(
            "shrink",
            "How much a step that is too long is shortened",
            "shrink",
            &[0.3, 0.45, 0.6, 0.75, 0.9],
            claims::SHRINK,
        ),
        constant(
            "grow",
            "How much a step that is too short is lengthened",
            "grow",
            &[1.0, 1.25, 1.5, 1.75, 2.0],
            claims::GROW,
        ),
    ]
}

/// The cost of a coarser grid, alone.
fn cells() -> Figure {
    let point = |edge: f64| {
        let technique = format!("{}+grid(cell={edge})", search(60));
        Point::new(edge, "prototype-sphere", technique)
    };
    Figure {
        anchor: "cells",
        title: "What interpolation costs".to_owned(),
        after: "Estalella et al. 2005, section 5",
        question:
            "The images of vertices around a sphere, interpolated in cells of a given edge whose \
             corners are found all but exactly (60 steps). The vertices begin a twentieth of the radius \
             from the mirror, nearer than a cell is wide."
                .to_owned(),
        axis: Axis::log("edge of a cell (radii of the mirror)"),
        series: vec![Series {
            label: "grid".to_owned(),
            points: [0.1, 0.25, 0.5, 1.0].into_iter().map(point).collect(),
        }],
        quantities: vec![
            Quantity::log(MEDIAN_PX),
            Quantity::log(MEAN_PX),
            Quantity::log(P95_PX),
        ],
        quotes: &[],
        claims: claims::CELLS,
    }
}

/// A sweep of a constant of the search that the paper does not give.
fn constant(
    anchor: &'static str,
    title: &str,
    option: &str,
    values: &[f64],
    claims: &'static [Claim],
) -> Figure {
    let series = |label: &str, scene: &str| Series {
        label: label.to_owned(),
        points: values
            .iter()
            .map(|value| {
                let technique = format!("reflector-cubemap(hidden=extend,{option}={value})");
                Point::new(*value, scene, technique)
            })
            .collect(),
    };
    Figure {
        anchor,
        title: title.to_owned(),
        after: "Estalella et al. 2005, section 4.3",
        question: format!(
            "The paper adapts the length of the steps but gives no constants. By default each step starts from \
             the length that fits the distances of eye and vertex; `step` is a first length, in projected \
             bisectors, in its place. A factor of the length gets 0.6 times (`shrink`) as large where the \
             field at the beginning of a step and halfway differ by more than half (`different`) of the \
             longer, 1.25 times (`grow`) where by less than a quarter (`similar`), and always stays between \
             0.05 and 4 (`least`, `greatest`). A search starts halfway between the directions to eye and \
             vertex, and ends early where E < 1e-12. `{option}` is varied here; nine steps, maps of \
             256 × 256 texels a face."
        ),
        axis: Axis::linear(option),
        series: vec![
            series("sphere", "prototype-sphere"),
            series("ellipsoid", "prototype-ellipsoid"),
        ],
        quantities: vec![Quantity::log(MEDIAN_PX), Quantity::log(P95_PX)],
        quotes: &[],
        claims,
    }
}

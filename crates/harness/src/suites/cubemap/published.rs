//! Table 5.2 cell by cell: windows, face sizes, flags and scenes as printed, as ratios to a cell without
//! flags.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, PIXELS, SAMPLES, TRACE_MS, UNRESOLVED,
};
use crate::suites::series::{Point, Series};

use super::claims;
use super::printed::{CELLS, Cell, LARGE, OURS, SMALL};

/// The table as a figure: all of it, or the cells of the smaller window alone.
pub fn figure(windows: &[[u32; 2]]) -> Figure {
    let whole = windows.contains(&LARGE);
    let wanted = |cell: &Cell| whole || cell.window == SMALL;
    let points = CELLS.iter().enumerate().filter(|(_, cell)| wanted(cell));
    let points = points.map(|(x, cell)| Point {
        resolution: Some(cell.window),
        ..Point::new(x as f64, cell.scene(), cell.technique())
    });
    let labels: Vec<String> = CELLS.iter().map(Cell::label).collect();
    Figure {
        anchor: "cells",
        title: "The published table, cell by cell".to_owned(),
        after: "Číž 2017, Table 5.2",
        question: "Window, face size, flags, scene: as printed, with a teapot for a mirror in a small scene (S0) \
                   and in an atrium (S1), levels 1 to 7 of the pyramid, with L 1 to 5. What can be compared \
                   across hardware is a cell's time a mirror pixel over that of the cell without flags. Cells \
                   in windows above 320×240 are measured by the whole grid."
            .to_owned(),
        axis: Axis::names("cell", labels.iter().map(String::as_str)),
        series: vec![Series::new(OURS, points)],
        quantities: vec![
            Quantity::log(TRACE_MS).called("tracing pass (ms)"),
            Quantity::linear(PIXELS),
            Quantity::log(FRAME_MS),
            Quantity::log(SAMPLES),
            Quantity::linear(AGREEMENT),
            Quantity::linear(FULL_AGREEMENT),
            Quantity::linear(UNRESOLVED),
        ],
        quotes: &[],
        claims: claims::TABLE,
    }
}

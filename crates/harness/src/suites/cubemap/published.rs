//! Table 5.2 cell by cell: windows, face sizes, flags and scenes as printed, as ratios to a cell without
//! flags.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, PIXELS, SAMPLES, TRACE_MS, UNRESOLVED,
};
use crate::suites::series::{Point, Series};

use super::claims;

/// The series.
pub const OURS: &str = "ours";

/// A cell of the table, as measured on a GT 540M.
pub struct Cell {
    window: [u32; 2],
    faces: u32,
    flags: &'static str,
    scene: &'static str,
    /// Microseconds a mirror pixel.
    pub micros: f64,
    /// The place of the cell that it is held against: without flags in the same window and scene, where
    /// the table has one.
    pub base: usize,
}

const SMALL: [u32; 2] = [320, 240];
const LARGE: [u32; 2] = [640, 480];
const SMALL_BASE: usize = 0;
const LARGE_BASE: usize = 5;

/// Short for the list below.
const fn cell(
    window: [u32; 2],
    faces: u32,
    flags: &'static str,
    scene: &'static str,
    micros: f64,
    base: usize,
) -> Cell {
    Cell {
        window,
        faces,
        flags,
        scene,
        micros,
        base,
    }
}

/// Every cell whose window is one of the two usual ones, and the one of a third.
pub const CELLS: [Cell; 19] = [
    cell(SMALL, 256, "", "S0", 1.77, SMALL_BASE),
    cell(SMALL, 256, "A", "S0", 1.80, SMALL_BASE),
    cell(SMALL, 256, "A", "S1", 1.23, SMALL_BASE),
    cell(SMALL, 256, "E", "S0", 8.91, SMALL_BASE),
    cell(SMALL, 256, "A, L", "S0", 1.92, SMALL_BASE),
    cell(LARGE, 256, "", "S0", 1.19, LARGE_BASE),
    cell(LARGE, 256, "A", "S0", 1.28, LARGE_BASE),
    cell(LARGE, 256, "A", "S1", 0.91, LARGE_BASE),
    cell(LARGE, 256, "E", "S0", 6.71, LARGE_BASE),
    cell(LARGE, 128, "A", "S0", 1.77, LARGE_BASE),
    cell(LARGE, 512, "E", "S0", 1.11, LARGE_BASE),
    cell(LARGE, 128, "A, L, E", "S0", 0.81, LARGE_BASE),
    cell(LARGE, 512, "A, L", "S0", 0.89, LARGE_BASE),
    cell(LARGE, 256, "A, L, E", "S0", 0.66, LARGE_BASE),
    cell(LARGE, 256, "L", "S0", 0.41, LARGE_BASE),
    cell(LARGE, 256, "L, E", "S0", 3.69, LARGE_BASE),
    cell(LARGE, 256, "A, L, E, S", "S0", 1.61, LARGE_BASE),
    cell(LARGE, 256, "L, E, S", "S0", 5.01, LARGE_BASE),
    cell([800, 600], 256, "L", "S0", 0.38, LARGE_BASE),
];

impl Cell {
    /// As the table writes it.
    pub fn label(&self) -> String {
        let [width, height] = self.window;
        let flags = match self.flags {
            "" => String::new(),
            flags => format!("{flags}, "),
        };
        format!("{width}×{height}, {}, {flags}{}", self.faces, self.scene)
    }

    /// Levels 1 to 7 of the pyramid, with the analytical criterion 1 to 5, as in the author's program.
    fn technique(&self) -> String {
        let has = |flag: &str| self.flags.split(", ").any(|other| other == flag);
        let mut options = vec![format!("size={}", self.faces)];
        options.push(match has("L") {
            true => "criterion=analytic,accept=any".to_owned(),
            false => "criterion=distance".to_owned(),
        });
        if has("A") {
            let finest = if has("L") { 5 } else { 7 };
            options.push(format!("pyramid=published,from=1,to={finest}"));
        }
        if has("E") {
            options.push("sampling=texel-entry".to_owned());
        }
        if has("S") {
            options.push("bounces=3,bias=0.0005".to_owned());
        }
        format!("cubemap-trace({})", options.join(","))
    }

    fn scene(&self) -> &'static str {
        match self.scene {
            "S0" => "box-teapot",
            _ => "atrium-teapot",
        }
    }
}

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

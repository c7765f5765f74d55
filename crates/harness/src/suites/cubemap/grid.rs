//! Table 5.2: windows, face sizes, the flags A, E, L and S, and scenes; each cell with its error.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{FRAME_MS, FULL_AGREEMENT, TRACE_MS};
use crate::suites::series::{Ask, Point, Series};

use super::claims;
use super::data::{nodes, quantities};
use super::labels::{ACCELERATED, ANALYTIC, ANALYTIC_EFFICIENT, EFFICIENT, PLAIN, SELF_REFLECTING};

/// What is varied beside the flags.
#[derive(Clone, Copy)]
pub struct Grid {
    scenes: &'static [&'static str],
    pub windows: &'static [[u32; 2]],
    faces: &'static [u32],
}

/// The published flags and scenes in one small window, by maps of one small size.
pub const DEFAULT: Grid = Grid {
    scenes: &["box-teapot", "atrium-teapot"],
    windows: &[[160, 120]],
    faces: &[128],
};

/// The published grid.
pub const FULL: Grid = Grid {
    scenes: &["box-teapot", "room", "atrium-teapot"],
    windows: &[[320, 240], [640, 480], [800, 600]],
    faces: &[128, 256, 512],
};

/// Flags of the thesis and the options they stand for: acceleration, efficient (optimal) sampling,
/// analytical intersection, self-reflections.
const FLAGS: [(&str, &str); 9] = [
    ("none", "criterion=distance"),
    ("A", "criterion=distance,pyramid=published"),
    ("E", "criterion=distance,sampling=texel"),
    ("L", "criterion=analytic,accept=any"),
    ("A, L", "criterion=analytic,accept=any,pyramid=published"),
    ("L, E", "criterion=analytic,accept=any,sampling=texel"),
    (
        "A, L, E",
        "criterion=analytic,accept=any,pyramid=published,sampling=texel",
    ),
    (
        "L, E, S",
        "criterion=analytic,accept=any,sampling=texel,bounces=3",
    ),
    (
        "A, L, E, S",
        "criterion=analytic,accept=any,pyramid=published,sampling=texel,bounces=3",
    ),
];

/// On what the thesis measured; its first scene has 846 triangles, as our box.
const SMALL: &str = "GT 540M, 320×240, faces of 256²";
const LARGE: &str = "GT 540M, 640×480, faces of 256²";

impl Grid {
    /// The table as a figure: flags along the axis, a series for each scene, window and face size.
    pub fn figure(&self, scene: Option<&str>) -> Figure {
        let mut series = Vec::new();
        let own = scene.map(|scene| [scene]);
        let scenes = own.as_ref().map_or(self.scenes, |scene| scene.as_slice());
        for scene in scenes {
            for [width, height] in self.windows {
                for size in self.faces {
                    series.push(Series {
                        label: label(scene, [*width, *height], *size),
                        points: cells(scene, [*width, *height], *size),
                    });
                }
            }
        }
        let mut quantities = quantities();
        let full = Quantity::linear(FULL_AGREEMENT);
        quantities.insert(1, full);
        quantities.push(nodes());
        quantities.push(Quantity::log(TRACE_MS).called("tracing pass (ms)"));
        let [width, height] = self.windows[0];
        let quotes: &[Quote] = match (scene, width, height) {
            (None, 160, 120) => &QUOTES,
            _ => &[],
        };
        Figure {
            anchor: "grid",
            title: "The published table".to_owned(),
            after: "Číž 2017, Table 5.2",
            question: "Its flags, cell by cell, with the error against the truth beside the cost: A accelerated by the published pyramid, E one sample a texel, L \
                       analytical criterion, S self-reflections (three rays, no acceleration of our \
                       own). Judges are the first bounce, and for S the truth with mirrors in mirrors."
                .to_owned(),
            axis: Axis::names("flags", FLAGS.map(|(flags, _)| flags)),
            series,
            quantities,
            quotes,
            claims: claims::GRID,
        }
    }
}

fn label(scene: &str, [width, height]: [u32; 2], size: u32) -> String {
    format!("{scene}, {width}×{height}, {size}²")
}

fn cells(scene: &str, resolution: [u32; 2], size: u32) -> Vec<Point> {
    let cell = |(x, (_, options)): (usize, &(&str, &str))| Point {
        resolution: Some(resolution),
        ..Point::new(
            x as f64,
            scene,
            format!("cubemap-trace(size={size},{options})"),
        )
    };
    FLAGS.iter().enumerate().map(cell).collect()
}

/// Of the default grid.
const BOX: &str = "box-teapot, 160×120, 128²";

/// `flags` is a place in [`FLAGS`].
const fn quote(what: &'static str, theirs: &'static str, on: &'static str, flags: usize) -> Quote {
    Quote {
        what,
        theirs,
        on,
        ours: Some(Ask {
            series: BOX,
            x: flags as f64,
            path: FRAME_MS,
            unit: "ms",
        }),
    }
}

const QUOTES: [Quote; 9] = [
    quote("no flag", "21.4 frames/s, 1.77 µs a pixel", SMALL, PLAIN),
    quote("A", "18.4 frames/s, 1.80 µs a pixel", SMALL, ACCELERATED),
    quote("E", "4.2 frames/s, 8.91 µs a pixel", SMALL, EFFICIENT),
    quote("L", "21.2 frames/s, 0.41 µs a pixel", LARGE, ANALYTIC),
    quote("A, L", "31.6 frames/s, 1.92 µs a pixel", SMALL, 4),
    quote(
        "L, E",
        "2.6 frames/s, 3.69 µs a pixel",
        LARGE,
        ANALYTIC_EFFICIENT,
    ),
    quote("A, L, E", "13.2 frames/s, 0.66 µs a pixel", LARGE, 6),
    quote(
        "L, E, S",
        "2.2 frames/s, 5.01 µs a pixel",
        LARGE,
        SELF_REFLECTING,
    ),
    quote("A, L, E, S", "5.2 frames/s, 1.61 µs a pixel", LARGE, 8),
];

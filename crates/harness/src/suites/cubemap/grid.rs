//! Table 5.2: windows, face sizes, the flags A, E, L and S, and scenes; each cell with its error.

use crate::report::words::{count, percent};
use crate::suites::{Ask, Figure, Point, Quote, Results, Series};

use super::{AGREEMENT, FRAME_MS, UNRESOLVED, names, ns_per_pixel, quantities};

/// What is varied beside the flags.
#[derive(Clone, Copy)]
pub struct Grid {
    scenes: &'static [&'static str],
    windows: &'static [[u32; 2]],
    faces: &'static [u32],
}

/// A part of the published grid, the windows at half and quarter size.
pub const DEFAULT: Grid = Grid {
    scenes: &["box", "room", "atrium"],
    windows: &[[160, 120]],
    faces: &[128],
};

/// The published grid.
pub const FULL: Grid = Grid {
    scenes: &["box", "room", "atrium"],
    windows: &[[320, 240], [640, 480], [800, 600]],
    faces: &[128, 256, 512],
};

/// Flags of the thesis and the options they stand for: acceleration, efficient (optimal) sampling,
/// analytical intersection, self-reflections.
const FLAGS: [(&str, &str); 9] = [
    ("none", "criterion=distance"),
    ("A", "criterion=distance,pyramid=published"),
    ("E", "criterion=distance,sampling=texel"),
    ("L", "criterion=analytic"),
    ("A, L", "criterion=analytic,pyramid=published"),
    ("L, E", "criterion=analytic,sampling=texel"),
    (
        "A, L, E",
        "criterion=analytic,pyramid=published,sampling=texel",
    ),
    ("L, E, S", "criterion=analytic,sampling=texel,bounces=3"),
    (
        "A, L, E, S",
        "criterion=analytic,pyramid=published,sampling=texel,bounces=3",
    ),
];

/// On what the thesis measured.
const THESIS: &str = "GT 540M, 320×240, faces of 256²";

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
        let [width, height] = self.windows[0];
        let quotes = match (scene, width, height) {
            (None, 160, 120) => quotes(),
            _ => Vec::new(),
        };
        Figure {
            anchor: "grid",
            title: "Flags, windows and face sizes".to_owned(),
            after: "Číž 2017, Table 5.2",
            question: "The published table, cell by cell, with the error against the truth beside \
                       the cost: A accelerated by the published pyramid, E one sample a texel, L \
                       analytical criterion, S self-reflections (three rays, no acceleration of our \
                       own)."
                .to_owned(),
            axis: names("flags", FLAGS.map(|(flags, _)| flags)),
            series,
            quantities: quantities(),
            quotes,
            analysis,
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
const BOX: &str = "box, 160×120, 128²";

fn quotes() -> Vec<Quote> {
    let quote = |what, theirs, flags: &str| Quote {
        what,
        theirs,
        on: THESIS,
        ours: FLAGS
            .iter()
            .position(|(name, _)| *name == flags)
            .map(|x| Ask {
                series: BOX,
                x: x as f64,
                path: FRAME_MS,
                unit: "ms",
            }),
    };
    vec![
        quote("no flag", "21.4 frames/s, 1.77 µs a pixel", "none"),
        quote("A", "18.4 frames/s, 1.80 µs a pixel", "A"),
        quote("E", "4.2 frames/s, 8.91 µs a pixel", "E"),
        quote("A, L", "31.6 frames/s, 1.92 µs a pixel", "A, L"),
    ]
}

fn analysis(results: &Results<'_>) -> Vec<String> {
    let mut sentences = Vec::new();
    for series in results.series() {
        let Some(best) = best(results, series) else {
            continue;
        };
        let (_, point) = best;
        let (Some(ns), Some(agreement)) = (
            ns_per_pixel(results, point),
            results.value(point, AGREEMENT),
        ) else {
            continue;
        };
        let unresolved = results.value(point, UNRESOLVED).unwrap_or(0.0);
        sentences.push(format!(
            "{}: the fastest flags are “{}”, {} ns a mirror pixel, with the right object on {} of \
             the pixels and {} unresolved.",
            series.label,
            FLAGS[point.x as usize].0,
            count(ns as u64),
            percent(agreement),
            percent(unresolved)
        ));
        let frame = |x: usize| results.value(series.points.get(x)?, FRAME_MS);
        if let (Some(without), Some(with)) = (frame(0), frame(1)) {
            sentences.push(format!(
                "{}: acceleration takes the distance criterion from {:.1} to {:.1} ms a frame (the \
                 thesis found that it hardly saves time).",
                series.label, without, with
            ));
        }
    }
    sentences
}

/// The fastest cell of a series.
fn best<'s>(results: &Results<'_>, series: &'s Series) -> Option<(f64, &'s Point)> {
    let timed = series.points.iter();
    let timed = timed.filter_map(|point| Some((results.value(point, FRAME_MS)?, point)));
    timed.min_by(|a, b| a.0.total_cmp(&b.0))
}

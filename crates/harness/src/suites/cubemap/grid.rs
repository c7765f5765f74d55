//! Table 5.2: windows, face sizes, the flags A, E, L and S, and scenes; each cell with its error.

use crate::show::number::{count, percent, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{AGREEMENT, FRAME_MS, FULL_AGREEMENT, SAMPLES, TRACE_MS, UNRESOLVED};
use crate::suites::results::Results;
use crate::suites::series::{Ask, Point, Series};

use super::data::{nodes, ns_per_pixel, quantities};

/// What is varied beside the flags.
#[derive(Clone, Copy)]
pub struct Grid {
    scenes: &'static [&'static str],
    windows: &'static [[u32; 2]],
    faces: &'static [u32],
}

/// The published flags and scenes in one small window, by maps of one small size.
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
/// The flag that asks for mirrors in mirrors.
const SELF: &str = "S";
/// Places of flags in that list.
const PLAIN: usize = 0;
const ACCELERATED: usize = 1;
const EFFICIENT: usize = 2;
const ANALYTIC: usize = 3;
const ANALYTIC_EFFICIENT: usize = 5;
const SELF_REFLECTING: usize = 7;
/// A part of samples or time that counts as a difference.
const SAVED: f64 = 0.1;

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

fn analysis(results: &Results<'_>) -> Vec<String> {
    let series = results.series().iter();
    let mut sentences: Vec<String> = series
        .clone()
        .filter_map(|series| fastest(results, series))
        .collect();
    sentences.extend(series.clone().filter_map(|series| claims(results, series)));
    sentences.extend(series.filter_map(|series| deeper(results, series)));
    sentences.extend(flatness(results));
    sentences
}

/// What a cell is held against.
fn judge(point: &Point) -> &'static str {
    match FLAGS[point.x as usize].0.ends_with(SELF) {
        true => FULL_AGREEMENT,
        false => AGREEMENT,
    }
}

/// What following three rays brings against the truth with mirrors in mirrors.
fn deeper(results: &Results<'_>, series: &Series) -> Option<String> {
    let full = |place: usize| results.value(series.points.get(place)?, FULL_AGREEMENT);
    let (one, three) = (full(ANALYTIC_EFFICIENT)?, full(SELF_REFLECTING)?);
    let verdict = match three > one {
        true => "S helps",
        false => "S harms",
    };
    Some(format!(
        "{}: with mirrors in mirrors L, E shows the right object on {} of the pixels and L, E, S on {}: \
         {verdict}.",
        series.label,
        percent(one),
        percent(three)
    ))
}

fn fastest(results: &Results<'_>, series: &Series) -> Option<String> {
    let (_, point) = best(results, series)?;
    let ns = ns_per_pixel(results, point)?;
    let agreement = results.value(point, judge(point))?;
    let unresolved = results.value(point, UNRESOLVED).unwrap_or(0.0);
    let cells = series.points.iter().filter_map(|point| {
        let ns = count(ns_per_pixel(results, point)? as u64);
        Some(format!("{} {ns}", FLAGS[point.x as usize].0))
    });
    let cells: Vec<_> = cells.collect();
    Some(format!(
        "{}: tracing takes, in ns a mirror pixel, {}. The fastest flags are “{}” with {} ns, the right object \
         on {} of the pixels and {} unresolved.",
        series.label,
        cells.join("; "),
        FLAGS[point.x as usize].0,
        count(ns as u64),
        percent(agreement),
        percent(unresolved)
    ))
}

/// What the thesis says about its flags, against one series.
fn claims(results: &Results<'_>, series: &Series) -> Option<String> {
    let value = |place: usize, path| results.value(series.points.get(place)?, path);
    let ratio = |place, path| Some(value(place, path)? / value(PLAIN, path)?);
    let open = |place: usize| {
        let point = series.points.get(place)?;
        results.row(point)?.coverage.as_ref()?;
        Some(results.value(point, UNRESOLVED).unwrap_or(0.0))
    };
    let samples = ratio(ACCELERATED, SAMPLES)?;
    let time = ratio(ACCELERATED, TRACE_MS)?;
    let saves = if samples > 1.0 - SAVED {
        "it does not even cut samples, which the thesis says it does"
    } else if time < 1.0 - SAVED {
        "it saves time as well, which the thesis did not find"
    } else if time < 1.0 + SAVED {
        "as the thesis says, it cuts samples but hardly time"
    } else {
        "it cuts samples but takes more time"
    };
    let (by_distance, by_sign) = (open(PLAIN)?, open(ANALYTIC)?);
    let leaves = if by_sign < 0.01 {
        "almost none, as the thesis says"
    } else {
        "more than the thesis says"
    };
    Some(format!(
        "{}: with A the distance criterion takes {} of the samples and {} of the tracing pass' time, so {saves}; E \
         takes {} of that time (5 times as much in the thesis); L leaves {} unresolved in place of {}, \
         {leaves}.",
        series.label,
        percent(samples),
        percent(time),
        percent(ratio(EFFICIENT, TRACE_MS)?),
        percent(by_sign),
        percent(by_distance),
    ))
}

/// What a mirror pixel costs in the scenes of least and of most cost.
fn flatness(results: &Results<'_>) -> Option<String> {
    let costs = results.series().iter().filter_map(|series| {
        let point = series.points.get(ANALYTIC)?;
        let samples = results.value(point, SAMPLES)?;
        Some((
            series.label.as_str(),
            ns_per_pixel(results, point)?,
            samples,
        ))
    });
    let costs: Vec<_> = costs.collect();
    let most = costs.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let least = costs.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    (most.0 != least.0).then(|| {
        format!(
            "With L tracing takes {} ns a mirror pixel in {}, of {} samples, and {} ns in {}, of {} samples.",
            count(least.1 as u64),
            least.0,
            short(least.2),
            count(most.1 as u64),
            most.0,
            short(most.2)
        )
    })
}

/// The fastest cell of a series.
fn best<'s>(results: &Results<'_>, series: &'s Series) -> Option<(f64, &'s Point)> {
    let timed = series.points.iter();
    let timed = timed.filter_map(|point| Some((results.value(point, TRACE_MS)?, point)));
    timed.min_by(|a, b| a.0.total_cmp(&b.0))
}

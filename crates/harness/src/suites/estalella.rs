//! `catoptric bench estalella`: search in reflector cube maps and interpolation from a grid,
//! Estalella et al. 2005.
//!
//! Fig. 6 to 8 on a kitchen, with exact errors beside them on the mirrors whose reflection points
//! are known; the constants that the paper leaves open; hidden vertices; steadiness over a camera
//! path. Fig. 4 and 5 are pictures of what the search does.

mod pictures;

use crate::plot::{Axis, Scale};
use crate::report::words::short;

use super::{Ask, Figure, Point, Quantity, Quote, Results, Series, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "estalella",
    title: "Reflector cube maps and grid interpolation",
    why: "How exact is a search of a fixed number of steps in maps of the mirror, how many vertices \
          must be searched, and what becomes of those that the mirror hides?",
    figures,
    pictures: Some(pictures::make),
    timing_s: 90.0,
};

const KITCHEN: &str = "kitchen";

const FRAME_MS: &str = "time_ms.frame.median";
const SEARCH_MS: &str = "time_ms.passes.search";
const EVALUATIONS: &str = "work.evaluations";
const SEARCHED: &str = "vertices.searched";
const MEDIAN_PX: &str = "vertices.offset_px.p50";
const MEAN_PX: &str = "vertices.offset_px.mean";
const P95_PX: &str = "vertices.offset_px.p95";
const AGREEMENT: &str = "object_agreement";
const MISSING: &str = "coverage.missing";
const EXTRA: &str = "coverage.extra";
const FLIP: &str = "color.flip";
const JITTER: &str = "temporal.jitter_px.mean";
const JITTER_P99: &str = "temporal.jitter_px.p99";
const JUMPS: &str = "temporal.jumps";

/// On what the paper measured.
const PAPER: &str = "Xeon 3.2 GHz, GeForce 6800";

/// The search as the paper runs it: hidden vertices continued, true virtual depth.
fn search(iterations: u32) -> String {
    format!("reflector-cubemap(iterations={iterations},hidden=extend,depth=virtual)")
}

/// With so many per cent of a mesh's vertices in its grid.
fn with_grid(iterations: u32, percent: f64) -> String {
    let fraction = (percent * 10.0).round() / 1000.0;
    format!("{}+grid(fraction={fraction})", search(iterations))
}

fn figures(scene: Option<&str>) -> Vec<Figure> {
    let kitchen = scene.unwrap_or(KITCHEN);
    let mut figures = vec![methods(kitchen), density(kitchen), iterations(scene)];
    if scene.is_none() {
        figures.extend([
            cells(),
            constant(
                "first-step",
                "The length of the first step",
                "step",
                &[0.2, 0.35, 0.5, 0.7, 1.0],
            ),
            constant(
                "shrink",
                "How much a step that is too long is shortened",
                "shrink",
                &[0.3, 0.45, 0.6, 0.75, 0.9],
            ),
            constant(
                "grow",
                "How much a step that is too short is lengthened",
                "grow",
                &[1.0, 1.25, 1.5, 1.75, 2.0],
            ),
            silhouette(),
            steadiness(),
        ]);
    }
    figures
}

fn names(label: &str, names: &[&str]) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.iter().map(|name| (*name).to_owned()).collect()),
    }
}

const fn quote(what: &'static str, theirs: &'static str, series: &'static str, x: f64) -> Quote {
    Quote {
        what,
        theirs,
        on: PAPER,
        ours: Some(Ask {
            series,
            x,
            path: FRAME_MS,
            unit: "ms",
        }),
    }
}

/// How right a picture is.
fn picture_quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear("time of a frame (ms)", FRAME_MS),
        Quantity::linear("search passes (ms)", SEARCH_MS),
        Quantity::linear("vertices searched, all mirrors", SEARCHED),
        Quantity::linear(
            "share of mirror pixels that show the right object",
            AGREEMENT,
        ),
        Quantity::linear("share without the object seen there", MISSING),
        Quantity::linear("share with an object too many", EXTRA),
        Quantity::linear("mean FLIP", FLIP),
        Quantity::log("mean offset (px)", MEAN_PX),
    ]
}

/// Fig. 6: the same picture by several methods.
fn methods(scene: &str) -> Figure {
    let techniques = [
        search(9),
        with_grid(9, 10.0),
        "environment-map(update=frame)".to_owned(),
    ];
    let labels = ["all vertices", "10 % grid", "environment map"];
    let points = techniques.iter().enumerate();
    Figure {
        anchor: "methods",
        title: "A kitchen, by several methods".to_owned(),
        after: "Estalella et al. 2005, Fig. 6",
        question: "The reference beside the search of every vertex, of a tenth of them, and an \
                   environment map made in every frame. The paper finds the grid's picture the \
                   smoothest, and the map's wrong for what is near."
            .to_owned(),
        axis: names("method", &labels),
        series: vec![Series {
            label: "pictures".to_owned(),
            points: points
                .map(|(x, technique)| Point::new(x as f64, scene, technique).shown())
                .collect(),
        }],
        quantities: picture_quantities(),
        quotes: vec![
            quote(
                "all vertices",
                "1.3 frames a second: 769 ms",
                "pictures",
                0.0,
            ),
            quote("10 % grid", "10 frames a second: 100 ms", "pictures", 1.0),
        ],
        analysis: methods_analysis,
    }
}

fn methods_analysis(results: &Results<'_>) -> Vec<String> {
    let at = |x, path| results.at("pictures", x, path);
    let mut sentences = Vec::new();
    if let (Some(all), Some(grid)) = (at(0.0, FRAME_MS), at(1.0, FRAME_MS)) {
        sentences.push(format!(
            "A frame takes {} of the time with the grid; in the paper 0.13, where searching every vertex \
             was nearly all of a frame.",
            short(grid / all)
        ));
    }
    if let (Some(all), Some(grid)) = (at(0.0, SEARCH_MS), at(1.0, SEARCH_MS)) {
        sentences.push(format!(
            "The search itself takes {} of the time.",
            short(grid / all)
        ));
    }
    if let (Some(all), Some(grid)) = (at(0.0, AGREEMENT), at(1.0, AGREEMENT)) {
        let winner = if grid > all {
            "the grid"
        } else {
            "all vertices"
        };
        sentences.push(format!(
            "More mirror pixels show the right object with {winner}: {} % of all with every vertex \
             searched, {} % with the grid.",
            short(100.0 * all),
            short(100.0 * grid)
        ));
    }
    sentences
}

/// The paper's densities in per cent.
const DENSITIES: [f64; 4] = [4.1, 5.5, 9.6, 14.3];

/// Fig. 7: grids of several densities.
fn density(scene: &str) -> Figure {
    let points = |iterations| {
        let grids =
            DENSITIES.map(|percent| Point::new(percent, scene, with_grid(iterations, percent)));
        let all = Point::new(100.0, scene, search(iterations));
        grids.into_iter().chain([all])
    };
    Figure {
        anchor: "density",
        title: "How many grid vertices a mesh needs".to_owned(),
        after: "Estalella et al. 2005, Fig. 7",
        question: "Grids with a share of the vertices of each mesh, against searching them all (100 %). \
                   The paper sees no difference above 10 %. The same with 25 steps tells apart what the \
                   search misses and what the interpolation does."
            .to_owned(),
        axis: Axis::log("grid vertices (% of the mesh's)"),
        series: vec![
            Series {
                label: "9 steps".to_owned(),
                points: points(9).map(Point::shown).collect(),
            },
            Series {
                label: "25 steps".to_owned(),
                points: points(25).collect(),
            },
        ],
        quantities: picture_quantities(),
        quotes: vec![
            quote("4.1 %", "16.3 frames a second: 61 ms", "9 steps", 4.1),
            quote("5.5 %", "13.6 frames a second: 74 ms", "9 steps", 5.5),
            quote("9.6 %", "10.1 frames a second: 99 ms", "9 steps", 9.6),
            quote("14.3 %", "8.3 frames a second: 120 ms", "9 steps", 14.3),
        ],
        analysis: density_analysis,
    }
}

fn density_analysis(results: &Results<'_>) -> Vec<String> {
    let at = |x, path| results.at("25 steps", x, path);
    let mut sentences = Vec::new();
    if let (Some(sparse), Some(dense)) = (at(4.1, FRAME_MS), at(14.3, FRAME_MS)) {
        let nine = |x| results.at("9 steps", x, FRAME_MS);
        let nine = nine(4.1)
            .zip(nine(14.3))
            .map_or(dense / sparse, |(a, b)| b / a);
        sentences.push(format!(
            "From 4.1 to 14.3 % a frame takes {} times as long with 9 steps (in the paper 2.0 times) and {} \
             times with 25.",
            short(nine),
            short(dense / sparse)
        ));
    }
    if let (Some(tenth), Some(all)) = (at(9.6, AGREEMENT), at(100.0, AGREEMENT)) {
        let lost = 100.0 * (all - tenth);
        let claim = if lost < 1.0 { "holds" } else { "does not hold" };
        sentences.push(format!(
            "With searches that have settled, 9.6 % of the vertices show the wrong object at {} % more of the \
             mirror pixels than all of them do: that a tenth cannot be told from all {claim} here, if one \
             pixel in a hundred is what can be told.",
            short(lost)
        ));
    }
    if let (Some(tenth), Some(all)) = (at(9.6, MEAN_PX), at(100.0, MEAN_PX)) {
        sentences.push(format!(
            "The mean offset of a vertex is {} px with that grid and {} px without.",
            short(tenth),
            short(all)
        ));
    }
    sentences
}

/// Fig. 8: numbers of iterations.
fn iterations(scene: Option<&str>) -> Figure {
    let series = |label: &str, scene: &str, shown: bool| Series {
        label: label.to_owned(),
        points: [3, 5, 7, 9, 15, 25]
            .into_iter()
            .map(|iterations| {
                let point = Point::new(f64::from(iterations), scene, search(iterations));
                if shown && iterations <= 9 {
                    point.shown()
                } else {
                    point
                }
            })
            .collect(),
    };
    let mut all = vec![series("kitchen", scene.unwrap_or(KITCHEN), true)];
    if scene.is_none() {
        all.push(series("sphere", "prototype-sphere", false));
        all.push(series("ellipsoid", "prototype-ellipsoid", false));
    }
    Figure {
        anchor: "iterations",
        title: "How many steps a search needs".to_owned(),
        after: "Estalella et al. 2005, Fig. 8",
        question: "Every vertex searched with a fixed number of steps. Beyond nine the paper sees no \
                   improvement. On a sphere and an ellipsoid the error of each vertex is known exactly."
            .to_owned(),
        axis: Axis::linear("steps at most"),
        series: all,
        quantities: vec![
            Quantity::log("median offset (px)", MEDIAN_PX),
            Quantity::log("offset that 5 % of the vertices exceed (px)", P95_PX),
            Quantity::linear("evaluations per vertex", EVALUATIONS),
            Quantity::linear("share of mirror pixels that show the right object", AGREEMENT),
            Quantity::linear("search passes (ms)", SEARCH_MS),
        ],
        quotes: Vec::new(),
        analysis: iterations_analysis,
    }
}

fn iterations_analysis(results: &Results<'_>) -> Vec<String> {
    let mut sentences = Vec::new();
    for series in ["sphere", "ellipsoid"] {
        let at = |x| results.at(series, x, MEDIAN_PX);
        if let (Some(three), Some(five), Some(seven), Some(nine)) =
            (at(3.0), at(5.0), at(7.0), at(9.0))
        {
            sentences.push(format!(
                "Median offsets on the {series} after 3, 5, 7 and 9 steps: {}, {}, {} and {} px; two steps \
                 divide the error by {}.",
                short(three),
                short(five),
                short(seven),
                short(nine),
                short((three / nine).cbrt())
            ));
        }
    }
    let right = |x| results.at("kitchen", x, AGREEMENT);
    if let (Some(nine), Some(more)) = (right(9.0), right(25.0)) {
        let gain = 100.0 * (more - nine);
        let claim = if gain < 1.0 { "holds" } else { "does not hold" };
        sentences.push(format!(
            "From 9 to 25 steps {} % of the mirror pixels of the kitchen become right: that more than nine \
             bring nothing to see {claim} here, if one pixel in a hundred is to be seen. What is left after \
             nine are the few vertices that settle late: near the mirror, or seen at a grazing angle.",
            short(gain)
        ));
    }
    sentences
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
                   corners are found all but exactly (60 steps)."
                .to_owned(),
        axis: Axis::log("edge of a cell (radii of the mirror)"),
        series: vec![Series {
            label: "grid".to_owned(),
            points: [0.1, 0.25, 0.5, 1.0].into_iter().map(point).collect(),
        }],
        quantities: vec![
            Quantity::log("mean offset (px)", MEAN_PX),
            Quantity::log("offset that 5 % of the vertices exceed (px)", P95_PX),
        ],
        quotes: Vec::new(),
        analysis: |results| {
            let power = super::results::power(&results.curve("grid", MEAN_PX));
            let power = power.map(|power| {
                format!(
                    "The mean error grows as the edge to the power {}; interpolation that is exact to first \
                     order gives 2 where cells are small against the mirror and their distance from it.",
                    short(power)
                )
            });
            power.into_iter().collect()
        },
    }
}

/// A sweep of a constant of the search that the paper does not give.
fn constant(anchor: &'static str, title: &str, option: &str, values: &[f64]) -> Figure {
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
            "The paper adapts the length of the steps but gives no constants. `{option}` is varied here, the \
             other constants as they are by default; nine steps."
        ),
        axis: Axis::linear(option),
        series: vec![
            series("sphere", "prototype-sphere"),
            series("ellipsoid", "prototype-ellipsoid"),
        ],
        quantities: vec![
            Quantity::log("median offset (px)", MEDIAN_PX),
            Quantity::log("offset that 5 % of the vertices exceed (px)", P95_PX),
        ],
        quotes: Vec::new(),
        analysis: constant_analysis,
    }
}

fn constant_analysis(results: &Results<'_>) -> Vec<String> {
    let best = |series: &str, path| {
        let curve = results.curve(series, path).into_iter();
        curve.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(x, _)| x)
    };
    let sentence = |series: &str| {
        let (median, tail) = (best(series, MEDIAN_PX)?, best(series, P95_PX)?);
        Some(format!(
            "On the {series} the median is best at {}, the tail at {}.",
            short(median),
            short(tail)
        ))
    };
    ["sphere", "ellipsoid"]
        .into_iter()
        .filter_map(sentence)
        .collect()
}

/// What becomes of triangles that the mirror hides in part.
fn silhouette() -> Figure {
    const SCENE: &str = "sphere-touching";
    let series = |label: &str, technique: fn(&str) -> String| Series {
        label: label.to_owned(),
        points: ["drop", "extend"]
            .into_iter()
            .enumerate()
            .map(|(x, hidden)| Point::new(x as f64, SCENE, technique(hidden)).shown())
            .collect(),
    };
    Figure {
        anchor: "silhouette",
        title: "Triangles that the mirror hides in part".to_owned(),
        after: "Estalella et al. 2005, section 6.1",
        question: "A floor that touches the mirror, things that run into it, one behind it. Triangles with \
                   a hidden vertex are dropped, or drawn with the vertex continued behind the tangent \
                   plane and cut where they are hidden."
            .to_owned(),
        axis: names("triangles with a hidden vertex", &["dropped", "continued"]),
        series: vec![
            series("reflector cube maps", |hidden| {
                format!("reflector-cubemap(hidden={hidden},depth=virtual)")
            }),
            series("reflector cube maps, 25 steps", |hidden| {
                format!("reflector-cubemap(iterations=25,hidden={hidden},depth=virtual)")
            }),
            series("linear", |hidden| format!("linear(hidden={hidden},depth=virtual)")),
        ],
        quantities: vec![
            Quantity::linear("share without the object seen there", MISSING),
            Quantity::linear("share with an object too many", EXTRA),
            Quantity::linear("share of mirror pixels that show the right object", AGREEMENT),
        ],
        quotes: Vec::new(),
        analysis: silhouette_analysis,
    }
}

fn silhouette_analysis(results: &Results<'_>) -> Vec<String> {
    let sentence = |series: &str| {
        let at = |x, path| results.at(series, x, path).map(|share| 100.0 * share);
        Some(format!(
            "“{series}”: missing falls from {} % of the mirror pixels to {} %, and {} % show an object too \
             many instead of {} %.",
            short(at(0.0, MISSING)?),
            short(at(1.0, MISSING)?),
            short(at(1.0, EXTRA)?),
            short(at(0.0, EXTRA)?)
        ))
    };
    let all = [
        "reflector cube maps",
        "reflector cube maps, 25 steps",
        "linear",
    ];
    all.into_iter().filter_map(sentence).collect()
}
/// Flicker over a camera path.
fn steadiness() -> Figure {
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
    let points = techniques.iter().enumerate();
    Figure {
        anchor: "steadiness",
        title: "Flicker, and how the grid removes it".to_owned(),
        after: "Estalella et al. 2005, section 5",
        question: "The camera moves slowly. A vertex flickers where its error changes from frame to \
                   frame; that a fixed number of steps flickers and a grid does not is the paper's claim."
            .to_owned(),
        axis: names("technique", &labels),
        series: vec![Series {
            label: "path".to_owned(),
            points: points
                .map(|(x, (_, technique))| Point {
                    frames: Some(FRAMES),
                    ..Point::new(x as f64, SCENE, technique)
                })
                .collect(),
        }],
        quantities: vec![
            Quantity::log("mean jitter (px a frame)", JITTER),
            Quantity::log("jitter that 1 % exceed (px a frame)", JITTER_P99),
            Quantity::linear("share of jumps above 2 px", JUMPS),
            Quantity::log("mean offset (px)", MEAN_PX),
        ],
        quotes: Vec::new(),
        analysis: steadiness_analysis,
    }
}

fn steadiness_analysis(results: &Results<'_>) -> Vec<String> {
    let at = |x, path| results.at("path", x, path);
    let sentence = |steps: &str, alone: f64, grid: f64| {
        let (mean, gridded) = (at(alone, JITTER)?, at(grid, JITTER)?);
        let (tail, tail_gridded) = (at(alone, JITTER_P99)?, at(grid, JITTER_P99)?);
        let verdict = if gridded < mean {
            "calms"
        } else {
            "does not calm"
        };
        Some(format!(
            "With {steps} steps the grid {verdict} the mean jitter: {} px a frame without it, {} px with it; \
             one change in a hundred exceeds {} and {} px.",
            short(mean),
            short(gridded),
            short(tail),
            short(tail_gridded)
        ))
    };
    [("5", 1.0, 4.0), ("9", 2.0, 5.0), ("25", 3.0, 6.0)]
        .into_iter()
        .filter_map(|(steps, alone, grid)| sentence(steps, alone, grid))
        .collect()
}

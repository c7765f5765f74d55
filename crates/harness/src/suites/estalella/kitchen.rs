//! Fig. 6, 7 and 8: a kitchen by several methods, by grids of several densities, and with several
//! numbers of iterations.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    AGREEMENT, EVALUATIONS, EXTRA, FLIP, FRAME_MS, MEAN_PX, MEDIAN_PX, MISSING, P95_PX, SEARCH_MS,
    SEARCHED,
};
use crate::suites::series::{Ask, Point, Series};

use super::claims;
use super::data::{search, with_grid};

pub const KITCHEN: &str = "kitchen";

/// On what the paper measured.
const PAPER: &str = "Xeon 3.2 GHz, GeForce 6800";

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

/// The three figures; `scene` is the user's.
pub fn figures(scene: Option<&str>) -> Vec<Figure> {
    let kitchen = scene.unwrap_or(KITCHEN);
    vec![methods(kitchen), density(kitchen), iterations(scene)]
}

/// How right a picture is.
fn picture_quantities() -> Vec<Quantity> {
    vec![
        Quantity::linear(FRAME_MS),
        Quantity::linear(SEARCH_MS).called("search passes (ms)"),
        Quantity::linear(SEARCHED).called("vertices searched, all mirrors"),
        Quantity::linear(AGREEMENT),
        Quantity::linear(MISSING),
        Quantity::linear(EXTRA),
        Quantity::linear(FLIP),
        Quantity::log(MEAN_PX),
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
        axis: Axis::names("method", labels),
        series: vec![Series {
            label: "pictures".to_owned(),
            points: points
                .map(|(x, technique)| Point::new(x as f64, scene, technique).shown())
                .collect(),
        }],
        quantities: picture_quantities(),
        quotes: const {
            &[
                quote(
                    "all vertices",
                    "1.3 frames a second: 769 ms",
                    "pictures",
                    0.0,
                ),
                quote("10 % grid", "10 frames a second: 100 ms", "pictures", 1.0),
            ]
        },
        claims: claims::METHODS,
    }
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
        quotes: const { &[
            quote("4.1 %", "16.3 frames a second: 61 ms", "9 steps", 4.1),
            quote("5.5 %", "13.6 frames a second: 74 ms", "9 steps", 5.5),
            quote("9.6 %", "10.1 frames a second: 99 ms", "9 steps", 9.6),
            quote("14.3 %", "8.3 frames a second: 120 ms", "9 steps", 14.3),
        ] },
        claims: claims::DENSITY,
    }
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
            Quantity::log(MEDIAN_PX),
            Quantity::log(P95_PX),
            Quantity::linear(EVALUATIONS).called("evaluations per vertex"),
            Quantity::linear(AGREEMENT),
            Quantity::linear(SEARCH_MS).called("search passes (ms)"),
        ],
        quotes: &[],
        claims: claims::ITERATIONS,
    }
}

//! The thesis' figures: a square of two triangles, and two triangles that crack.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    AGREEMENT, ANGLE, CRACK_PIXELS, DRAWN, EDGES, FLIP, FRAME_MS, JUNCTIONS, SEARCHED, WIDEST,
};
use crate::suites::series::{Ask, Point, Series};

use super::claims;
use super::data::{
    ADAPTIVE, BY_EYE, FULL, HALF, NONE, PAPERS, PIXEL, SQUARE, THRESHOLD, WHOLE_PIXELS, adaptive,
    adaptive_on_mesh, full, pixel, pixel_to, pixels_by_level, quantities, three_modes,
};
use super::labels::{HIDDEN, SEARCH, TO_FIVE};

/// Level limits: those of Fig. 6.3, and on to triangles smaller than pixels.
const LEVELS: u32 = 8;

const SQUARE_HIDDEN: &str = "sphere-square-hidden";
const HIDDEN_LEVELS: u32 = 4;

/// The level at which Fig. 5.3 and 5.4 are made.
const SHOWN_LEVEL: u32 = 5;

/// Thesis Fig. 1.5.
pub fn straight(scene: &str) -> Figure {
    let techniques = ["linear".to_owned(), full(SHOWN_LEVEL), pixel(HALF)];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| Point::new(f64::from(x), scene, technique).shown());
    Figure {
        anchor: "straight",
        title: "Straight edges where the mirror shows curves".to_owned(),
        after: "Szabo 2013, Fig. 1.5",
        question: "The corners of a square are reflected where they belong; what lies between is \
                   interpolated. The same square, split until its edges bend."
            .to_owned(),
        axis: Axis::names(
            "the square",
            ["its corners alone", "split five times", PIXEL],
        ),
        series: vec![Series::new(SEARCH, points)],
        quantities: quantities([Quantity::linear(FRAME_MS)]),
        quotes: const {
            &[Quote {
                what: "a square by the reflections of its corners",
                theirs: "“erroneous”",
                on: BY_EYE,
                ours: Some(Ask {
                    series: SEARCH,
                    x: 0.0,
                    path: EDGES,
                    unit: "px off at the edges (mean)",
                }),
            }]
        },
        claims: claims::STRAIGHT,
    }
}

/// Thesis Fig. 6.3.
pub fn by_level(scene: &str) -> Figure {
    Figure {
        anchor: "levels",
        title: "Cost and error against the level limit".to_owned(),
        after: "Szabo 2013, Fig. 6.3",
        question: format!(
            "A square of two triangles before a mirror sphere (or the scene asked for), split at most so \
             often; full splits all but what is hidden by all its corners, adaptive \
             where the edge error reaches {THRESHOLD}, by pixels the edges that are {HALF} px off. The line across the angular errors is what an \
             answer in whole pixels is off by: the median angle between what a pixel's centre and the \
             rest of that pixel truly show."
        ),
        axis: Axis::linear("level limit"),
        series: {
            let point = |x, technique| Point::new(x, scene, technique);
            let all = three_modes(LEVELS, point).into_iter();
            let hidden = |level: u32| {
                let x = f64::from(level);
                Point::new(x, SQUARE_HIDDEN, adaptive(level, THRESHOLD))
            };
            let hidden = Series::new(HIDDEN, (0..=HIDDEN_LEVELS).map(hidden));
            let own = (scene == SQUARE).then_some(hidden);
            all.chain([
                adaptive_on_mesh(LEVELS, point),
                pixels_by_level(LEVELS, point),
            ])
            .chain(own)
            .collect()
        },
        quantities: vec![
            Quantity::log(FRAME_MS),
            Quantity::log(SEARCHED),
            Quantity::linear(AGREEMENT),
            Quantity::log(ANGLE).beside(WHOLE_PIXELS),
            Quantity::linear(EDGES),
        ],
        quotes: const {
            &[
                Quote {
                    what: "level that adaptive reaches at a threshold of 0.001",
                    theirs: "never beyond 2",
                    on: PAPERS,
                    ours: None,
                },
                Quote {
                    what: "adaptive against full",
                    theirs: "“practically the same”",
                    on: BY_EYE,
                    ours: Some(Ask {
                        series: ADAPTIVE,
                        x: LEVELS as f64,
                        path: AGREEMENT,
                        unit: "of the mirror pixels right",
                    }),
                },
            ]
        },
        claims: claims::LEVELS,
    }
}

/// Thesis Fig. 5.3 and 5.4.
pub fn wireframes(scene: &str) -> Figure {
    let techniques = [
        "linear".to_owned(),
        full(SHOWN_LEVEL),
        adaptive(SHOWN_LEVEL, THRESHOLD),
        pixel(HALF),
    ];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| Point::new(f64::from(x), scene, technique).shown());
    Figure {
        anchor: "wireframes",
        title: "None, full, adaptive and by pixels".to_owned(),
        after: "Szabo 2013, Fig. 5.3 and 5.4",
        question: "The same reflection four times, shaded and as the triangles it is made of."
            .to_owned(),
        axis: Axis::names("tessellation", [NONE, "full, 5 levels", ADAPTIVE, PIXEL]),
        series: vec![Series::new(SEARCH, points)],
        quantities: quantities([Quantity::linear(FRAME_MS), Quantity::log(DRAWN)]),
        quotes: const {
            &[Quote {
                what: "full and adaptive tessellation",
                theirs: "“similar visual quality”",
                on: BY_EYE,
                ours: Some(Ask {
                    series: SEARCH,
                    x: 2.0,
                    path: AGREEMENT,
                    unit: "of the mirror pixels right with adaptive",
                }),
            }]
        },
        claims: claims::WIREFRAMES,
    }
}

/// Thesis Fig. 6.4.
const SHOWN_LEVELS: [u32; 4] = [0, 2, 3, 4];

/// Thesis Fig. 6.4.
pub fn visible_levels(scene: &str) -> Figure {
    let points = (0..)
        .zip(SHOWN_LEVELS)
        .map(|(x, level)| Point::new(f64::from(x), scene, full(level)).shown());
    let by_pixels = (0..)
        .zip(SHOWN_LEVELS)
        .map(|(x, level)| Point::new(f64::from(x), scene, pixel_to(level)));
    Figure {
        anchor: "visible",
        title: "Levels 0, 2, 3 and 4".to_owned(),
        after: "Szabo 2013, Fig. 6.4",
        question: "Every triangle split so often, but for the hidden ones. What is there to see after level 3?"
            .to_owned(),
        axis: Axis::names("level", ["0", "2", "3", "4"]),
        series: vec![Series::new(FULL, points), Series::new(PIXEL, by_pixels)],
        quantities: quantities([
            Quantity::linear(FRAME_MS),
            Quantity::log(FLIP),
        ]),
        quotes: const { &[Quote {
            what: "after level 3",
            theirs: "“almost no visible difference”",
            on: BY_EYE,
            ours: Some(Ask {
                series: FULL,
                x: 2.0,
                path: ANGLE,
                unit: "degrees off at level 3 (median)",
            }),
        }] },
        claims: claims::VISIBLE,
    }
}

/// Thesis Fig. 6.5, CESCG Fig. 10a.
const CRACK_THRESHOLDS: [&str; 4] = ["0.1", "0.01", "0.001", "0.0001"];

/// Thesis Fig. 6.5, CESCG Fig. 10a.
pub fn cracks(scene: &str) -> Figure {
    let names = ["none", "0.1", "0.01", "0.001", "0.0001", "full", PIXEL];
    let adaptive = CRACK_THRESHOLDS.map(|threshold| adaptive(SHOWN_LEVEL, threshold));
    let techniques = [
        vec!["linear".to_owned()],
        adaptive.to_vec(),
        vec![full(SHOWN_LEVEL), pixel(HALF)],
    ]
    .concat();
    let points = (0..).zip(techniques).map(|(x, technique)| {
        let point = Point::new(f64::from(x), scene, technique);
        if [THRESHOLD, PIXEL].contains(&names[x as usize]) {
            point.shown()
        } else {
            point
        }
    });
    let first = [
        Quantity::linear(FRAME_MS),
        Quantity::linear(CRACK_PIXELS),
        Quantity::linear(WIDEST),
        Quantity::linear("coverage.holes"),
        Quantity::linear(JUNCTIONS),
    ];
    Figure {
        anchor: "crack",
        title: "Cracks where neighbours are split differently".to_owned(),
        after: "Szabo 2013, Fig. 6.5, and Szabo CESCG, Fig. 10a",
        question:
            "A triangle is split by its worst edge, whatever its neighbour does: where a split \
                   edge meets an unsplit one the surface tears. By pixels, an edge is split for both."
                .to_owned(),
        axis: Axis::names("threshold", names),
        series: vec![Series::new(TO_FIVE, points)],
        quantities: quantities(first),
        quotes: const {
            &[Quote {
                what: "where triangles split differently meet",
                theirs: "holes; “an extreme example”",
                on: BY_EYE,
                ours: Some(Ask {
                    series: TO_FIVE,
                    x: 3.0,
                    path: CRACK_PIXELS,
                    unit: "pixels in cracks at a threshold of 0.001",
                }),
            }]
        },
        claims: claims::CRACK,
    }
}

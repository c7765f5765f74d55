//! CESCG's figures: a scene of coarse and of fine models.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{AGREEMENT, ANGLE, CRACK_PIXELS, DRAWN, EDGES, FRAME_MS, SEARCHED};
use crate::suites::series::{Ask, Point, Series};

use super::claims;
use super::data::{
    ADAPTIVE, BY_EYE, HALF, NONE, PAPERS, PIXEL, TABLE, THRESHOLD, WHOLE_PIXELS, adaptive, full,
    pixel, pixels_by_level, quantities, three_modes,
};

/// The size at which full tessellation to level 4 (2.5 million triangles) fits the suite's time.
const SIZE: [u32; 2] = [320, 240];

/// Level limits of Fig. 9.
const LEVELS: u32 = 4;

const SEARCH: &str = "linear search";

/// A scene and the size in which it is measured.
pub struct Place {
    scene: String,
    size: Option<[u32; 2]>,
}

impl Place {
    /// The user's scene in its own size, or the table in the size for it.
    pub fn of(users: Option<&str>) -> Self {
        Self {
            scene: users.unwrap_or(TABLE).to_owned(),
            size: users.is_none().then_some(SIZE),
        }
    }

    pub fn point(&self, x: f64, technique: impl Into<String>) -> Point {
        Point {
            resolution: self.size,
            ..Point::new(x, self.scene.clone(), technique)
        }
    }
}

/// CESCG Fig. 7.
pub fn coarse_and_fine(place: &Place) -> Figure {
    let techniques = [
        "linear".to_owned(),
        adaptive(LEVELS, THRESHOLD),
        full(LEVELS),
        pixel(HALF),
    ];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| place.point(f64::from(x), technique).shown());
    Figure {
        anchor: "table",
        title: "A coarse cloth and candlestick beside a fine teapot".to_owned(),
        after: "Szabo CESCG, Fig. 7",
        question:
            "Adaptive tessellation should split the coarse models and leave the fine one alone."
                .to_owned(),
        axis: Axis::names("tessellation", [NONE, ADAPTIVE, "full, 4 levels", PIXEL]),
        series: vec![Series::new(SEARCH, points)],
        quantities: quantities([Quantity::log(FRAME_MS), Quantity::log(DRAWN)]),
        quotes: const {
            &[
                Quote {
                    what: "without tessellation",
                    theirs: "“visibly wrong”",
                    on: BY_EYE,
                    ours: Some(right(SEARCH, 0.0)),
                },
                Quote {
                    what: "adaptive",
                    theirs: "“as if … fully tessellated”",
                    on: BY_EYE,
                    ours: Some(right(SEARCH, 1.0)),
                },
            ]
        },
        claims: claims::TABLE,
    }
}

/// The share of mirror pixels that show the right object.
const fn right(series: &'static str, x: f64) -> Ask {
    Ask {
        series,
        x,
        path: AGREEMENT,
        unit: "of the mirror pixels right",
    }
}

/// CESCG Fig. 8, from none to full.
const THRESHOLDS: [&str; 8] = ["1", "0.1", "0.03", "0.01", "0.003", "0.001", "0.0001", "0"];

/// CESCG Fig. 8.
pub fn thresholds(place: &Place) -> Figure {
    let points = (0..).zip(THRESHOLDS).map(|(x, threshold)| {
        let technique = match threshold {
            "0" => full(LEVELS),
            _ => adaptive(LEVELS, threshold),
        };
        let point = place.point(f64::from(x), technique);
        match threshold {
            "1" | "0.1" | "0.01" | "0.001" | "0" => point.shown(),
            _ => point,
        }
    });
    Figure {
        anchor: "thresholds",
        title: "From no tessellation to full, by the threshold".to_owned(),
        after: "Szabo CESCG, Fig. 8",
        question: format!(
            "The threshold decides between accuracy and time; up to {LEVELS} levels. At 0 every triangle is \
             split: full tessellation. Last, beside them, by pixels."
        ),
        axis: Axis::names("threshold", THRESHOLDS.into_iter().chain([PIXEL])),
        series: vec![
            Series::new(ADAPTIVE, points),
            Series::new(
                PIXEL,
                [place.point(THRESHOLDS.len() as f64, pixel(HALF)).shown()],
            ),
        ],
        quantities: quantities([
            Quantity::log(FRAME_MS),
            Quantity::log(DRAWN),
            Quantity::linear(CRACK_PIXELS),
        ]),
        quotes: const {
            &[
                Quote {
                    what: "threshold of 0.1 or larger",
                    theirs: "too high",
                    on: BY_EYE,
                    ours: Some(right(ADAPTIVE, 1.0)),
                },
                Quote {
                    what: "threshold of 0.01, the finer end of what is recommended",
                    theirs: "“perfectly acceptable”",
                    on: BY_EYE,
                    ours: Some(right(ADAPTIVE, 3.0)),
                },
                Quote {
                    what: "threshold near 0",
                    theirs: "no longer interactive",
                    on: PAPERS,
                    ours: Some(Ask {
                        series: ADAPTIVE,
                        x: 7.0,
                        path: FRAME_MS,
                        unit: "ms",
                    }),
                },
            ]
        },
        claims: claims::THRESHOLDS,
    }
}

/// CESCG Fig. 9.
pub fn counts(place: &Place) -> Figure {
    Figure {
        anchor: "counts",
        title: "Vertices by level and mode".to_owned(),
        after: "Szabo CESCG, Fig. 9",
        question: format!(
            "How many triangles (three vertices each, as the papers draw them) and how many searches a level \
             limit leads to; adaptive at a threshold of {THRESHOLD}, by pixels at {HALF} px."
        ),
        axis: Axis::linear("level limit"),
        series: {
            let point = |x, technique| place.point(x, technique);
            let mut series = three_modes(LEVELS, point);
            series.push(pixels_by_level(LEVELS, point));
            series
        },
        quantities: vec![
            Quantity::log(DRAWN),
            Quantity::log(SEARCHED),
            Quantity::log(FRAME_MS),
            Quantity::linear(AGREEMENT),
            Quantity::log(ANGLE).beside(WHOLE_PIXELS),
            Quantity::linear(EDGES),
        ],
        quotes: const {
            &[Quote {
                what: "adaptive against full",
                theirs: "fewer vertices, fewer searches",
                on: "a diagram",
                ours: Some(Ask {
                    series: ADAPTIVE,
                    x: LEVELS as f64,
                    path: DRAWN,
                    unit: "triangles at the highest limit",
                }),
            }]
        },
        claims: claims::COUNTS,
    }
}

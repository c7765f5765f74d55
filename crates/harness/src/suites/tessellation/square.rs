//! The thesis' figures: a square of two triangles, and two triangles that crack.

use crate::show::number::{count, short};
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{
    AGREEMENT, ANGLE, CRACK_PIXELS, DRAWN, EDGES, FLIP, FLOOR, FRAME_MS, JUNCTIONS, SEARCHED,
};
use crate::suites::results::Results;
use crate::suites::series::{Ask, Point, Series};

use super::data::{
    ADAPTIVE, BY_EYE, FULL, NONE, PAPERS, THRESHOLD, WHOLE_PIXELS, adaptive, adaptive_on_mesh,
    full, quantities, spared, three_modes, verdict,
};

/// Level limits: those of Fig. 6.3, and on to triangles smaller than pixels.
const LEVELS: u32 = 8;

/// The level at which Fig. 5.3 and 5.4 are made.
const SHOWN_LEVEL: u32 = 5;

/// Series of the figures that show methods side by side.
const SEARCH: &str = "linear search";

/// Thesis Fig. 1.5.
pub fn straight(scene: &str) -> Figure {
    let techniques = ["linear".to_owned(), full(SHOWN_LEVEL)];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| Point::new(f64::from(x), scene, technique).shown());
    Figure {
        anchor: "straight",
        title: "Straight edges where the mirror shows curves".to_owned(),
        after: "Szabo 2013, Fig. 1.5",
        question: "The corners of a square are reflected where they belong; what lies between is \
                   interpolated. The same square, split until its edges bend."
            .to_owned(),
        axis: Axis::names("the square", ["its corners alone", "split five times"]),
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
        analysis: straight_analysis,
    }
}

fn straight_analysis(results: &Results<'_>) -> Vec<String> {
    let at = |x, path| results.at(SEARCH, x, path);
    let (Some(edges), Some(bent)) = (at(0.0, EDGES), at(1.0, EDGES)) else {
        return Vec::new();
    };
    let (Some(right), Some(split)) = (at(0.0, AGREEMENT), at(1.0, AGREEMENT)) else {
        return Vec::new();
    };
    vec![format!(
        "The straight edges lie {} px on average from where they belong, and {} % of the mirror pixels show the right \
         object; split five times, {} px and {} %. That the first picture is wrong and the second as it \
         should be {}.",
        short(edges),
        short(100.0 * right),
        short(bent),
        short(100.0 * split),
        verdict(edges > 1.0 && bent < 1.0)
    )]
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
             where the edge error reaches {THRESHOLD}. The line across the angular errors is what an \
             answer in whole pixels is off by: the median angle between what a pixel's centre and the \
             rest of that pixel truly show."
        ),
        axis: Axis::linear("level limit"),
        series: {
            let point = |x, technique| Point::new(x, scene, technique);
            let all = three_modes(LEVELS, point).into_iter();
            all.chain([adaptive_on_mesh(LEVELS, point)]).collect()
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
        analysis: level_analysis,
    }
}

fn level_analysis(results: &Results<'_>) -> Vec<String> {
    let mut sentences: Vec<String> = spared(results).into_iter().collect();
    sentences.extend(depth(results));
    let last = f64::from(LEVELS);
    let at = |series, path| results.at(series, last, path);
    sentences.extend(cheaper(results, last));
    sentences.extend(alike(results, [(FULL, last), (ADAPTIVE, last)]));
    sentences.extend(floor(&results.curve(FULL, ANGLE), at(FULL, FLOOR)));
    sentences
}

/// How deep adaptive went.
fn depth(results: &Results<'_>) -> Option<String> {
    let triangles = results.last(ADAPTIVE)?.triangles.as_ref()?;
    let deepest = triangles.by_level.iter().rposition(|count| *count > 0)?;
    let beyond: u64 = triangles.by_level.iter().skip(3).sum();
    Some(format!(
        "It goes to level {deepest}, and {} % of its triangles are smaller than level 2: “never beyond level 2” \
         {}. Of its triangles {} are at the limit and would be split further.",
        short(100.0 * beyond as f64 / triangles.drawn as f64),
        verdict(deepest <= 2),
        count(triangles.unfinished)
    ))
}

/// Whether adaptive costs less than full, where nine frames in ten say the same.
fn cheaper(results: &Results<'_>, limit: f64) -> Option<String> {
    let at = |series, path| results.at(series, limit, path);
    let [full, adaptive] = [at(FULL, FRAME_MS)?, at(ADAPTIVE, FRAME_MS)?];
    let slowest = at(ADAPTIVE, "time_ms.frame.p95")?;
    let fastest = at(FULL, "time_ms.frame.p5")?;
    let said = match slowest < fastest {
        true => verdict(true),
        false => "cannot be told here from the times' scatter",
    };
    Some(format!(
        "At a limit of {limit} a frame takes {} ms with full and {} ms with adaptive tessellation: that \
         adaptive costs less {said}.",
        short(full),
        short(adaptive)
    ))
}

/// Whether adaptive and full tessellation look the same, by what can be counted.
fn alike(results: &Results<'_>, [full, adaptive]: [(&str, f64); 2]) -> Option<String> {
    let at = |(series, x): (&str, f64), path| results.at(series, x, path);
    let (all, some) = (at(full, AGREEMENT)?, at(adaptive, AGREEMENT)?);
    let (all_angle, some_angle) = (at(full, ANGLE)?, at(adaptive, ANGLE)?);
    let (all_edges, some_edges) = (at(full, EDGES)?, at(adaptive, EDGES)?);
    let (all_torn, some_torn) = (at(full, CRACK_PIXELS)?, at(adaptive, CRACK_PIXELS)?);
    Some(format!(
        "Full and adaptive show the right object at {} and {} % of the mirror pixels, with a median angular \
         error of {}° and {}°, edges {} and {} px off on average, and {} and {} pixels in cracks: that the two \
         look practically the same {}, if cracks, one pixel in a hundred and half a pixel at the edges are what \
         can be told.",
        short(100.0 * all),
        short(100.0 * some),
        short(all_angle),
        short(some_angle),
        short(all_edges),
        short(some_edges),
        count(all_torn as u64),
        count(some_torn as u64),
        verdict(all - some < 0.01 && some_edges - all_edges < 0.5 && some_torn <= all_torn)
    ))
}

/// Where the median angular error stops falling. The search answers with whole pixels: `floor` is
/// what that alone is off by.
pub(super) fn floor(angles: &[(f64, f64)], floor: Option<f64>) -> Option<String> {
    let floor = floor?;
    let reached = angles
        .iter()
        .position(|(_, angle)| *angle <= OF_FLOOR * floor);
    let falls = |angles: &[(f64, f64)]| angles.windows(2).all(|pair| pair[1].1 < pair[0].1);
    let (first, last) = (angles.first()?, angles.last()?);
    let least = angles.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let after = match least.0 < last.0 {
        true => format!(
            "It is least at level {}, {}°, and {}° at level {}",
            least.0,
            short(least.1),
            short(last.1),
            last.0
        ),
        false => format!("It is {}° at level {}", short(last.1), last.0),
    };
    Some(match reached {
        Some(index) => format!(
            "Answers in whole pixels are off by {}° (median). With full tessellation the median angular error \
             {} from {}° at level {} to {}° at level {}, where it is for the first time within a tenth of that \
             floor. {after}: triangles larger than a pixel average over the answers of their corners and come \
             below the floor, triangles smaller than pixels show each corner's rounding.",
            short(floor),
            if falls(&angles[..=index]) {
                "falls level by level"
            } else {
                "goes"
            },
            short(first.1),
            first.0,
            short(angles[index].1),
            angles[index].0
        ),
        None => format!(
            "Answers in whole pixels are off by {}° (median). With full tessellation the median angular error \
             goes from {}° at level {} to {}° at level {}: more triangles would still help.",
            short(floor),
            short(first.1),
            first.0,
            short(last.1),
            last.0
        ),
    })
}

/// Within a tenth of the floor is at the floor.
const OF_FLOOR: f64 = 1.1;

/// Thesis Fig. 5.3 and 5.4.
pub fn wireframes(scene: &str) -> Figure {
    let techniques = [
        "linear".to_owned(),
        full(SHOWN_LEVEL),
        adaptive(SHOWN_LEVEL, THRESHOLD),
    ];
    let points = (0..).zip(techniques);
    let points = points.map(|(x, technique)| Point::new(f64::from(x), scene, technique).shown());
    Figure {
        anchor: "wireframes",
        title: "None, full and adaptive".to_owned(),
        after: "Szabo 2013, Fig. 5.3 and 5.4",
        question: "The same reflection three times, shaded and as the triangles it is made of."
            .to_owned(),
        axis: Axis::names("tessellation", [NONE, "full, 5 levels", ADAPTIVE]),
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
        analysis: |results| {
            let [full, adaptive] = [(SEARCH, 1.0), (SEARCH, 2.0)];
            alike(results, [full, adaptive]).into_iter().collect()
        },
    }
}

/// Thesis Fig. 6.4.
const SHOWN_LEVELS: [u32; 4] = [0, 2, 3, 4];

/// Thesis Fig. 6.4.
pub fn visible_levels(scene: &str) -> Figure {
    let points = (0..)
        .zip(SHOWN_LEVELS)
        .map(|(x, level)| Point::new(f64::from(x), scene, full(level)).shown());
    Figure {
        anchor: "visible",
        title: "Levels 0, 2, 3 and 4".to_owned(),
        after: "Szabo 2013, Fig. 6.4",
        question: "Every triangle split so often, but for the hidden ones. What is there to see after level 3?"
            .to_owned(),
        axis: Axis::names("level", ["0", "2", "3", "4"]),
        series: vec![Series::new(FULL, points)],
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
        analysis: visible_analysis,
    }
}

fn visible_analysis(results: &Results<'_>) -> Vec<String> {
    let pair = |path| {
        let at = |x| results.at(FULL, x, path);
        at(2.0).zip(at(3.0))
    };
    let (Some(edges), Some(right), Some(angle), Some(flip)) =
        (pair(EDGES), pair(AGREEMENT), pair(ANGLE), pair(FLIP))
    else {
        return Vec::new();
    };
    let changed = 100.0 * (right.1 - right.0);
    vec![format!(
        "From level 3 to level 4 edges go from {} to {} px off on average and {} % more of the mirror pixels show the \
         right object: that almost nothing is left to see {}, if one pixel in a hundred and half a pixel at \
         the edges are what can be told. Inside the square the median angular error still goes from {}° to \
         {}°; mean FLIP from {} to {}.",
        short(edges.0),
        short(edges.1),
        short(changed),
        verdict(changed < 1.0 && edges.0 - edges.1 < 0.5),
        short(angle.0),
        short(angle.1),
        short(flip.0),
        short(flip.1)
    )]
}

/// Thesis Fig. 6.5, CESCG Fig. 10a.
const CRACK_THRESHOLDS: [&str; 4] = ["0.1", "0.01", "0.001", "0.0001"];

/// Thesis Fig. 6.5, CESCG Fig. 10a.
pub fn cracks(scene: &str) -> Figure {
    let names = ["none", "0.1", "0.01", "0.001", "0.0001", "full"];
    let adaptive = CRACK_THRESHOLDS.map(|threshold| adaptive(SHOWN_LEVEL, threshold));
    let techniques = [
        vec!["linear".to_owned()],
        adaptive.to_vec(),
        vec![full(SHOWN_LEVEL)],
    ]
    .concat();
    let points = (0..).zip(techniques).map(|(x, technique)| {
        let point = Point::new(f64::from(x), scene, technique);
        if names[x as usize] == THRESHOLD {
            point.shown()
        } else {
            point
        }
    });
    let first = [
        Quantity::linear(FRAME_MS),
        Quantity::linear(CRACK_PIXELS),
        Quantity::linear("coverage.widest_crack_px"),
        Quantity::linear(JUNCTIONS),
    ];
    Figure {
        anchor: "crack",
        title: "Cracks where neighbours are split differently".to_owned(),
        after: "Szabo 2013, Fig. 6.5, and Szabo CESCG, Fig. 10a",
        question:
            "A triangle is split by its worst edge, whatever its neighbour does: where a split \
                   edge meets an unsplit one the surface tears."
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
        analysis: crack_analysis,
    }
}

const TO_FIVE: &str = "up to 5 levels";
/// Where full tessellation stands on that figure's axis.
const FULL_AT: f64 = 5.0;

fn crack_analysis(results: &Results<'_>) -> Vec<String> {
    let pixels = results.curve(TO_FIVE, CRACK_PIXELS);
    let junctions = results.curve(TO_FIVE, JUNCTIONS);
    let most = |curve: &[(f64, f64)]| curve.iter().map(|(_, value)| *value).fold(0.0, f64::max);
    let (cracks, met) = (most(&pixels), most(&junctions));
    if pixels.is_empty() || junctions.is_empty() {
        return Vec::new();
    }
    vec![if cracks > 0.0 {
        format!(
            "The published rule leaves up to {} pixels of cracks, and at one threshold or another up to {} \
             T-junctions, as both papers say; full tessellation, which splits all alike, has {} of the \
             latter.",
            count(cracks as u64),
            count(met as u64),
            count(results.at(TO_FIVE, FULL_AT, JUNCTIONS).unwrap_or(0.0) as u64)
        )
    } else {
        format!(
            "Up to {} T-junctions, and none opens a crack of a whole pixel here.",
            count(met as u64)
        )
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_said_to_be_reached_only_when_it_is() {
        let angles = [(0.0, 9.0), (1.0, 3.0), (2.0, 1.05), (3.0, 1.2)];
        let said = |angles: &[(f64, f64)], at| floor(angles, at).unwrap_or_default();
        assert!(
            said(&angles, Some(1.0))
                .contains("falls level by level from 9° at level 0 to 1.05° at level 2")
        );
        assert!(said(&angles, Some(0.9)).contains("more triangles would still help"));
        let back = [(0.0, 3.0), (1.0, 9.0), (2.0, 1.0)];
        assert!(said(&back, Some(1.0)).contains("goes from 3°"));
        assert_eq!(floor(&angles, None), None);
        assert_eq!(floor(&[], Some(1.0)), None);
    }
}

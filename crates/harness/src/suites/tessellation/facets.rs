//! A mirror of flat facets, of which CESCG shows a picture.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity, Quote};
use crate::suites::paths::{AGREEMENT, FRAME_MS};
use crate::suites::series::{Ask, Point, Series};

use super::claims;
use super::data::{BY_EYE, NONE, PIXEL, THRESHOLD, adaptive, full, pixel_to, quantities};
use super::labels::FOUR;

/// The scene's fine floor, split twice, is 180 000 triangles.
const SIZE: [u32; 2] = [320, 240];
const LEVEL: u32 = 2;

const EIGHT: &str = "with eight neighbours";

/// CESCG Fig. 10b.
pub fn facets(scene: &str) -> Figure {
    let techniques = |search: &str| {
        ["linear".to_owned(), full(LEVEL), adaptive(LEVEL, THRESHOLD)]
            .map(|technique| technique.replacen("linear", search, 1))
    };
    let points = |search| {
        let points = (0..).zip(techniques(search));
        points.map(|(x, technique)| Point {
            resolution: Some(SIZE),
            ..Point::new(f64::from(x), scene, technique)
        })
    };
    let mut four = Series::new(FOUR, points("linear"));
    four.points[0].picture = true;
    let mut eight = Series::new(EIGHT, points("linear(neighbours=8)"));
    eight.points[0].picture = true;
    let by_pixels = Point {
        resolution: Some(SIZE),
        ..Point::new(3.0, scene, pixel_to(LEVEL))
    };
    Figure {
        anchor: "facets",
        title: "A mirror of flat facets".to_owned(),
        after: "Szabo CESCG, Fig. 10b",
        question:
            "The search assumes one reflection point for each vertex. In facets a vertex is seen several times, \
             or not at all where the best point is a crease; and on a facet all normals are the same. \
             Does splitting triangles help?"
                .to_owned(),
        axis: Axis::names("tessellation", [NONE, "full, 2 levels", "adaptive, 2 levels", "by pixels, 2 levels"]),
        series: vec![four, eight, Series::new(PIXEL, [by_pixels])],
        quantities: quantities([Quantity::log(FRAME_MS)]),
        quotes: const { &[Quote {
            what: "a polygonal mirror",
            theirs: "“an example”",
            on: BY_EYE,
            ours: Some(Ask {
                series: FOUR,
                x: 0.0,
                path: AGREEMENT,
                unit: "of the mirror pixels right",
            }),
        }] },
        claims: claims::FACETS,
    }
}

//! What a grid's cells must be like: their edge against the distance to the mirror, and trees of cells
//! against the published grid.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, FLIP, FRAME_MS, MEAN_PX, MISSING, P95_PX, SEARCHED};
use crate::suites::series::{Point, Series};

use super::claims::{self, ALL, PUBLISHED, TREE};
use super::data::search;

/// Steps after which a search has settled: the error that is left is that of interpolation.
const STEPS: u32 = 25;

fn with(refinement: &str) -> String {
    format!("{}+grid({refinement})", search(STEPS))
}

/// Vertices of a square before a ball, by the names of their scenes.
const MESHES: [(&str, &str); 3] = [
    ("sphere-grid-300", "300 vertices"),
    ("sphere-grid-1k", "1k vertices"),
    ("sphere-grid-3k", "3k vertices"),
];
/// Extent of the square's box along its sides, world units: half a side of 0.8, turned by 18°.
const EXTENT: f64 = 2.016;
/// Distance of the square's centre from the ball, world units.
const DISTANCE: f64 = 0.944;
/// Cells along a side of the square's box.
const CELLS: [f64; 4] = [8.0, 5.0, 3.0, 2.0];

/// The error of interpolation against the edge of the cells.
pub fn edges() -> Figure {
    let series = MESHES.map(|(scene, label)| {
        let points = CELLS.map(|cells| {
            let edge = EXTENT / cells;
            Point::new(edge / DISTANCE, scene, with(&format!("cell={edge:.4}")))
        });
        Series::new(label, points)
    });
    Figure {
        anchor: "edges",
        title: "How large a cell may be".to_owned(),
        after: "Estalella et al. 2005, section 5",
        question: "The paper gives grid vertices as a share of the mesh's, and finds a tenth enough. Here one \
                   square before a ball has more and more vertices, in grids with the same cells. If it is \
                   the cells' edge against the distance to the mirror that counts, the curves lie on one another."
            .to_owned(),
        axis: Axis::log("edge of the cells ÷ distance of the square's centre to the mirror"),
        series: series.into(),
        quantities: vec![Quantity::log(MEAN_PX), Quantity::log(P95_PX), Quantity::linear(AGREEMENT)],
        quotes: &[],
        claims: claims::EDGES,
    }
}

/// What is searched against what is seen, by the published grid and ours.
pub fn trees(scene: &str) -> Figure {
    let series = |label: &str, refinements: &[&str]| {
        let points = refinements.iter().map(|refinement| Point {
            along: Some(SEARCHED),
            ..Point::new(0.0, scene, with(refinement))
        });
        Series::new(label, points)
    };
    let all = Point {
        along: Some(SEARCHED),
        ..Point::new(0.0, scene, search(STEPS))
    };
    let published = ["fraction=0.041", "fraction=0.096", "fraction=0.143"];
    let trees = [
        "cells=octree,error=1",
        "cells=octree,error=0.5",
        "cells=octree",
    ];
    let polished = [
        "cells=octree,error=1,polish=1",
        "cells=octree,error=0.5,polish=1",
    ];
    Figure {
        anchor: "trees",
        title: "Cells where the picture asks for them".to_owned(),
        after: "ours, after Estalella et al. 2005, section 8",
        question: "The paper's outlook asks for a hierarchy of grids by what the picture shows. Here a tree of \
                   cells around each mesh is divided, in every frame and for each mirror, where the image of a \
                   cell's centre misses the mean of its corners' by more than 1, 0.5 and 0.25 px; with polish, \
                   a Newton step follows from each interpolated point. Beside them the published grids of 4.1, \
                   9.6 and 14.3 %, and one whose cells with hidden and reflected corners are searched."
            .to_owned(),
        axis: Axis::log("searches, all mirrors"),
        series: vec![
            series(PUBLISHED, &published),
            series("9.6 %, mixed cells searched", &["fraction=0.096,mixed=search"]),
            series("9.6 %, polished", &["fraction=0.096,polish=1"]),
            series(TREE, &trees),
            series("octree, polished", &polished),
            Series::new(ALL, [all]),
        ],
        quantities: vec![
            Quantity::linear(AGREEMENT),
            Quantity::linear(MISSING),
            Quantity::linear(FLIP),
            Quantity::log(MEAN_PX),
            Quantity::log(P95_PX),
            Quantity::linear(FRAME_MS),
        ],
        quotes: &[],
        claims: claims::TREES,
    }
}

//! What a grid's cells must be like: their edge against the distance to the mirror, and trees of cells
//! against the published grid.

use crate::show::number::short;
use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, FLIP, FRAME_MS, MEAN_PX, MISSING, P95_PX, SEARCHED};
use crate::suites::results::{Results, power};
use crate::suites::series::{Point, Series};

use super::data::search;

/// A search that has settled: what is left is what interpolation misses.
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
        analysis: edges_analysis,
    }
}

/// How far apart the numbers of several curves are at one place that count as the same.
const SAME: f64 = 1.25;

fn edges_analysis(results: &Results<'_>) -> Vec<String> {
    let curves = MESHES.map(|(_, label)| results.curve(label, MEAN_PX));
    edges_sentence(&curves).into_iter().collect()
}

/// Of curves of the mean offset, which have the same places; `None` where some are not measured.
fn edges_sentence(curves: &[Vec<(f64, f64)>]) -> Option<String> {
    let places = curves.iter().map(Vec::len).max()?;
    if places < 2 || curves.iter().any(|curve| curve.len() < places) {
        return None;
    }
    let apart = (0..places).map(|place| {
        let at = curves.iter().map(|curve| curve[place].1);
        at.clone().fold(0.0, f64::max) / at.fold(f64::INFINITY, f64::min)
    });
    let apart = apart.fold(1.0, f64::max);
    let power = power(curves.last()?)?;
    let verdict = match apart <= SAME {
        true => {
            "how many vertices a mesh has does not matter, and a share of them says nothing by itself"
        }
        false => "the number of vertices matters as well",
    };
    Some(format!(
        "In cells of the same edge the mean offsets differ by a factor of at most {}: {verdict} (up to {} counts as \
         the same). The offset grows with the edge to the power {}.",
        short(apart),
        short(SAME),
        short(power)
    ))
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
        "cells=octree",
        "cells=octree,error=0.25",
    ];
    let polished = ["cells=octree,error=1,polish=1", "cells=octree,polish=1"];
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
        analysis: trees_analysis,
    }
}

const PUBLISHED: &str = "published grid";
const TREE: &str = "octree";
const ALL: &str = "all vertices";

fn trees_analysis(results: &Results<'_>) -> Vec<String> {
    let curves = [PUBLISHED, TREE, ALL].map(|series| results.curve(series, AGREEMENT));
    trees_sentences(&curves)
}

/// Of curves of the agreement against the searches: published grids, trees, all vertices.
fn trees_sentences([published, trees, all]: &[Vec<(f64, f64)>; 3]) -> Vec<String> {
    let most = |curve: &[(f64, f64)], limit: f64| {
        let within = curve
            .iter()
            .copied()
            .filter(|(searches, _)| *searches <= limit);
        within.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut sentences = Vec::new();
    if let (Some(tree), [whole]) = (most(trees, f64::INFINITY), all.as_slice()) {
        sentences.push(format!(
            "The finest tree takes {} % of the searches of all vertices and shows the right object at {} % of the \
             mirror pixels; all vertices show it at {} %.",
            short(100.0 * tree.0 / whole.0),
            short(100.0 * tree.1),
            short(100.0 * whole.1)
        ));
    }
    if let Some(grid) = most(published, f64::INFINITY)
        && let Some(tree) = most(trees, grid.0)
    {
        let verdict = match tree.1 > grid.1 {
            true => "more",
            false => "no more",
        };
        sentences.push(format!(
            "With no more searches than the densest published grid, a tree shows the right object at {verdict} \
             mirror pixels: {} % against {} %.",
            short(100.0 * tree.1),
            short(100.0 * grid.1)
        ));
    }
    sentences
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_vertices_is_said_to_matter_only_where_curves_part() {
        let curve = |factor: f64| {
            vec![
                (0.25, 0.1 * factor),
                (0.5, 0.4 * factor),
                (1.0, 1.6 * factor),
            ]
        };
        let said = |factors: &[f64]| {
            let curves: Vec<_> = factors.iter().map(|factor| curve(*factor)).collect();
            edges_sentence(&curves).unwrap_or_default()
        };
        let same = said(&[1.0, 1.2, 1.1]);
        assert!(
            same.contains("does not matter") && same.contains("power 2."),
            "{same}"
        );
        assert!(said(&[1.0, 1.5]).contains("matters as well"));
        assert_eq!(edges_sentence(&[curve(1.0), vec![(0.25, 0.1)]]), None);
        assert_eq!(edges_sentence(&[]), None);
    }

    #[test]
    fn trees_are_compared_with_grids_of_no_fewer_searches() {
        let grids = vec![(400.0, 0.8), (1400.0, 0.9)];
        let all = vec![(10_000.0, 0.96)];
        let said = |trees: &[(f64, f64)]| {
            trees_sentences(&[grids.clone(), trees.to_vec(), all.clone()]).join(" ")
        };
        let better = said(&[(1200.0, 0.93), (3000.0, 0.95)]);
        assert!(better.contains("takes 30 % of"), "{better}");
        assert!(
            better.contains("at more mirror pixels: 93 % against 90 %"),
            "{better}"
        );
        assert!(said(&[(1200.0, 0.9)]).contains("at no more mirror pixels"));
        assert!(
            !said(&[(1500.0, 0.95)]).contains("densest"),
            "it searches more"
        );
        assert_eq!(said(&[]), "");
    }
}

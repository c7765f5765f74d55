//! What the reflector cube maps are made from, and how fine they are.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{MEDIAN_PX, P95_PX};
use crate::suites::series::{Point, Series};

use super::claims;

/// Steps after which the error that is left is that of the maps.
const SETTLED: u32 = 40;
/// Steps of the paper's search.
const PAPER: u32 = 9;

/// By the tessellation that the maps are drawn from, by their size, and by how the bisector is projected.
pub fn figures() -> [Figure; 3] {
    [
        figure(
            "map-tessellation",
            "How finely the mirror in the maps is tessellated",
            "The paper draws the maps from triangles with interpolated positions and normals, of a mesh that \
             may be much finer than the one on the screen, at no cost while rendering. By default maps of \
             analytic mirrors are exact here; in this sweep they are drawn from so many segments around.",
            "tessellation",
            "segments around",
            &[8, 16, 32, 64, 128, 256],
        ),
        figure(
            "map-size",
            "How many texels the maps have",
            "Maps of so many texels along an edge of a face, each with the mirror's exact point and normal, \
             interpolated in between. The paper gives no size.",
            "size",
            "texels along an edge",
            &[8, 16, 32, 64, 128, 256, 512],
        ),
        projections(),
    ]
}

/// A sweep of a number of the maps.
fn figure(
    anchor: &'static str,
    title: &str,
    question: &str,
    option: &str,
    unit: &str,
    values: &[u32],
) -> Figure {
    let series = |label: &str, scene: &str, iterations: u32| Series {
        label: label.to_owned(),
        points: values
            .iter()
            .map(|value| {
                let technique =
                    format!("reflector-cubemap(iterations={iterations},{option}={value})");
                Point::new(f64::from(*value), scene, technique)
            })
            .collect(),
    };
    Figure {
        anchor,
        title: title.to_owned(),
        after: "Estalella et al. 2005, section 4.1",
        question: question.to_owned(),
        axis: Axis::log(unit),
        series: vec![
            series("sphere, settled", "prototype-sphere", SETTLED),
            series("ellipsoid, settled", "prototype-ellipsoid", SETTLED),
            series("ellipsoid, 9 steps", "prototype-ellipsoid", PAPER),
        ],
        quantities: vec![Quantity::log(MEDIAN_PX), Quantity::log(P95_PX)],
        quotes: &[],
        claims: claims::MAPS,
    }
}

/// The two projections of the bisector, by the number of steps.
fn projections() -> Figure {
    let series = |label: &str, scene: &str, projection: &str| Series {
        label: label.to_owned(),
        points: [3, 5, 7, 9, 15, 25]
            .into_iter()
            .map(|iterations| {
                let technique =
                    format!("reflector-cubemap(iterations={iterations},projection={projection})");
                Point::new(f64::from(iterations), scene, technique)
            })
            .collect(),
    };
    Figure {
        anchor: "projection",
        title: "How the bisector is projected".to_owned(),
        after: "Estalella et al. 2005, section 4.2",
        question: "The paper takes the difference between the points where the rays along bisector and \
                   normal meet the face of the cube. By default the search here takes the derivative of \
                   the central projection at the point reached. On a sphere the two differ in second order."
            .to_owned(),
        axis: Axis::linear("steps at most"),
        series: vec![
            series("sphere, published", "prototype-sphere", "published"),
            series("sphere, ours", "prototype-sphere", "ours"),
            series("ellipsoid, published", "prototype-ellipsoid", "published"),
            series("ellipsoid, ours", "prototype-ellipsoid", "ours"),
        ],
        quantities: vec![Quantity::log(MEDIAN_PX), Quantity::log(P95_PX)],
        quotes: &[],
        claims: claims::PROJECTION,
    }
}

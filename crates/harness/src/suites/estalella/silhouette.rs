//! Hidden vertices: what becomes of triangles that the mirror hides in part.

use crate::show::plot::Axis;
use crate::suites::figure::{Figure, Quantity};
use crate::suites::paths::{AGREEMENT, EXTRA, MISSING};
use crate::suites::series::{Point, Series};

use super::claims;

/// Dropped or continued.
pub fn figure() -> Figure {
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
        question: "A floor that touches the mirror, things that run into it, one behind it, and a ring through \
                   it. Triangles with a hidden vertex are dropped, or drawn with the vertex continued behind \
                   the tangent plane and cut where they are hidden. The linear search as published walks on \
                   the mirror's visible pixels and cannot cross the ring, which parts them. Where it continues vertices it walks on the \
                   mirrors as they are without the objects before them."
            .to_owned(),
        axis: Axis::names("triangles with a hidden vertex", ["dropped", "continued"]),
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
            Quantity::linear(MISSING),
            Quantity::linear(EXTRA),
            Quantity::linear(AGREEMENT),
        ],
        quotes: &[],
        claims: claims::SILHOUETTE,
    }
}

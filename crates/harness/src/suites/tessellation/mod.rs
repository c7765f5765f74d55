//! `catoptric bench tessellation`: adaptive against full tessellation of the reflected geometry,
//! Szabo 2013, chapter 5 and section 6.2, and Szabo CESCG, section 5.
//!
//! What the papers show as pictures and times stands here beside what they could not measure:
//! error against a ray-traced truth, so that "almost no visible difference" becomes a number.
//! The thesis' figures are in `square`, those of the other paper in `table` and `facets`, and what
//! both say without a figure in `more`.

mod by_pixels;
mod claims;
mod data;
mod facets;
mod geometry;
mod labels;
mod more;
mod pixels;
mod square;
mod table;

use crate::suites::figure::Figure;
use crate::suites::suite::{Asked, Budget, Layout, Suite};

use self::data::{CRACK, FACETS, SQUARE};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "tessellation",
    title: "Tessellation of the reflected geometry",
    why: "Straight edges between reflection points are not the curves that the mirror shows. How \
          far must triangles be split, what does it cost, and what does splitting only where an \
          error asks for it save?",
    figures,
    judged: None,
    pictures: Some(geometry::make),
    timing: Budget::Whole(90.0),
    resolution: None,
    layout: Layout::Figures,
};

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    let scene = asked.scene;
    let square = scene.unwrap_or(SQUARE);
    let table = table::Place::of(scene);
    let mut figures = vec![
        square::straight(square),
        square::wireframes(square),
        square::by_level(square),
        square::visible_levels(square),
        square::cracks(scene.unwrap_or(CRACK)),
        table::coarse_and_fine(&table),
        table::thresholds(&table),
        table::counts(&table),
        facets::facets(scene.unwrap_or(FACETS)),
    ];
    figures.push(pixels::curve("pixels", square, by_pixels::SQUARE));
    if scene.is_none() {
        figures.extend([
            pixels::curve("pixels-table", data::TABLE, by_pixels::MANY),
            pixels::curve("pixels-ellipsoid", "ellipsoid", by_pixels::MANY),
        ]);
    }
    figures.extend(more::figures(scene));
    figures
}

//! `catoptric bench estalella`: search in reflector cube maps and interpolation from a grid,
//! Estalella et al. 2005.
//!
//! Fig. 6 to 8 on a kitchen, with exact errors beside them on the mirrors whose reflection points
//! are known ([`kitchen`]); what cells must be like ([`cells`]); the constants that the paper leaves
//! open ([`constants`]); what the maps are made from and how fine they are ([`maps`]); hidden vertices
//! ([`silhouette`]); steadiness over a camera path ([`steadiness`]). Fig. 4 and 5 are pictures of what
//! the search does ([`pictures`]).

mod cells;
mod claims;
mod constants;
mod data;
mod kitchen;
mod maps;
mod pictures;
mod silhouette;
mod steadiness;

use crate::suites::figure::Figure;
use crate::suites::suite::{Asked, Budget, Layout, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "estalella",
    title: "Reflector cube maps and grid interpolation",
    why: "How exact is a search of a fixed number of steps in maps of the mirror, how many vertices \
          must be searched, and what becomes of those that the mirror hides?",
    figures,
    judged: None,
    pictures: Some(pictures::make),
    timing: Budget::Whole(90.0),
    resolution: None,
    layout: Layout::Figures,
};

fn figures(asked: &Asked<'_>) -> Vec<Figure> {
    let scene = asked.scene;
    let mut figures = kitchen::figures(scene);
    figures.push(cells::trees(scene.unwrap_or(kitchen::KITCHEN)));
    if scene.is_none() {
        figures.push(cells::edges());
        figures.extend(constants::figures());
        figures.extend(maps::figures());
        figures.extend([silhouette::figure(), steadiness::figure()]);
    }
    figures
}

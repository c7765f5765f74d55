//! `catoptric bench estalella`: search in reflector cube maps and interpolation from a grid,
//! Estalella et al. 2005.
//!
//! Fig. 6 to 8 on a kitchen, with exact errors beside them on the mirrors whose reflection points
//! are known ([`kitchen`]); the constants that the paper leaves open ([`constants`]); hidden
//! vertices ([`silhouette`]); steadiness over a camera path ([`steadiness`]). Fig. 4 and 5 are
//! pictures of what the search does ([`pictures`]).

mod constants;
mod kitchen;
mod pictures;
mod silhouette;
mod steadiness;

use crate::plot::{Axis, Scale};

use super::{Figure, Suite};

/// The suite.
pub const SUITE: Suite = Suite {
    name: "estalella",
    title: "Reflector cube maps and grid interpolation",
    why: "How exact is a search of a fixed number of steps in maps of the mirror, how many vertices \
          must be searched, and what becomes of those that the mirror hides?",
    figures,
    pictures: Some(pictures::make),
    timing_s: 90.0,
};

const MEDIAN_PX: &str = "vertices.offset_px.p50";
const MEAN_PX: &str = "vertices.offset_px.mean";
const P95_PX: &str = "vertices.offset_px.p95";
const AGREEMENT: &str = "object_agreement";
const MISSING: &str = "coverage.missing";
const EXTRA: &str = "coverage.extra";

/// The search as the paper runs it: hidden vertices continued, true virtual depth.
fn search(iterations: u32) -> String {
    format!("reflector-cubemap(iterations={iterations},hidden=extend,depth=virtual)")
}

/// With so many per cent of a mesh's vertices in its grid.
fn with_grid(iterations: u32, percent: f64) -> String {
    let fraction = (percent * 10.0).round() / 1000.0;
    format!("{}+grid(fraction={fraction})", search(iterations))
}

fn figures(scene: Option<&str>) -> Vec<Figure> {
    let mut figures = kitchen::figures(scene);
    if scene.is_none() {
        figures.extend(constants::figures());
        figures.extend([silhouette::figure(), steadiness::figure()]);
    }
    figures
}

fn names(label: &str, names: &[&str]) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.iter().map(|name| (*name).to_owned()).collect()),
    }
}

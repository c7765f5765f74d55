//! `catoptric bench cubemap`: cubemap tracing, Číž 2017, chapter 5, and what the thesis lacks: the
//! comparison with the truth for every cell of its table. `--full` measures the whole grid.

mod claims;
mod data;
mod grid;
mod heat;
mod labels;
mod levels;
mod options;
mod printed;
mod published;
mod results;
mod skipped;
mod sweeps;
mod techniques;

use crate::suites::figure::Figure;
use crate::suites::suite::{Budget, Layout, Picture, Studio, Suite};

/// The suite with a grid that fits a quarter of an hour on two cores.
pub const SUITE: Suite = Suite {
    name: "cubemap",
    title: "Cubemap tracing",
    why: "What do a few cube maps of distance give in place of a ray tracer: how exact are they by \
          criterion, sampling, acceleration, face size and number, and what do they cost? Unless a \
          figure says otherwise: pictures of 160×120, two maps of 256² placed automatically, rays of \
          twice the scene's diagonal, a thousand steps a ray.",
    figures: |asked| figures(asked.scene, grid::DEFAULT),
    judged: None,
    pictures: Some(pictures),
    timing: Budget::Whole(90.0),
    resolution: None,
    layout: Layout::Figures,
};

/// The suite with every cell of Table 5.2.
pub const FULL: Suite = Suite {
    name: "cubemap-full",
    title: "Cubemap tracing, the whole grid",
    figures: |asked| figures(asked.scene, grid::FULL),
    timing: Budget::Whole(900.0),
    resolution: None,
    layout: Layout::Figures,
    ..SUITE
};

fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let mut pictures = heat::pictures(studio)?;
    pictures.extend(skipped::pictures(studio)?);
    pictures.extend(levels::pictures(studio)?);
    pictures.extend(results::pictures(studio)?);
    Ok(pictures)
}

fn figures(scene: Option<&str>, grid: grid::Grid) -> Vec<Figure> {
    let mut figures = vec![grid.figure(scene)];
    if scene.is_none() {
        figures.extend([published::figure(grid.windows), results::figure()]);
    }
    let own = scene.map(|scene| [scene]);
    let scenes = own.as_ref().map_or(data::SCENES.as_slice(), |scene| scene);
    figures.extend(options::figures(scenes));
    figures.extend(sweeps::figures(scene, scenes));
    figures.extend(techniques::figures(scene));
    figures
}

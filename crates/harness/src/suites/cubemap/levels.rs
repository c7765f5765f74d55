//! Fig. 4.1 and 4.2: the levels of the pyramid of distances, least and greatest.

use anyhow::Context;
use catoptric_frame::{Image, write_png_rgb8};
use catoptric_metrics::maps::{Colormap, colorize};
use catoptric_reflect::{Answer, DistanceLevel, Question};
use catoptric_scene::Scene;

use crate::output::PICTURES as FOLDER;
use crate::show::pictures::slug;
use crate::suites::suite::{Picture, Studio};

/// One map, so that its six faces are all there is.
const TECHNIQUE: &str = "cubemap-trace(size=128,objects=1,pyramid=sound)";
/// Faces of a cube.
const FACES: usize = 6;
/// From one level shown to the next, the finest being the single texels.
const STEP: usize = 2;
/// Pixels a side of a face in the picture, and between faces.
const SIDE: usize = 96;
const GAP: usize = 4;

/// Draws least and greatest distances: a row a level, a column a face.
pub fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let name = studio.scene.unwrap_or("box");
    let scene = Scene::load(name, &crate::run::load::load_options(studio.common))?;
    let spec = crate::run::load::parse(TECHNIQUE)?;
    let Ok(rendered) = crate::run::render::render(&studio.setup.gpu, &spec, &scene) else {
        return Ok(Vec::new());
    };
    let Some(Answer::DistanceLevels(levels)) = rendered.ask(Question::DistanceLevels)? else {
        return Ok(Vec::new());
    };
    let shown: Vec<&DistanceLevel> = levels.iter().step_by(STEP).collect();
    let distances = levels[0].ranges.iter().map(|range| range[0]);
    let farthest = distances.fold(0.0, f32::max);
    let sides: Vec<_> = shown.iter().map(|level| level.side.to_string()).collect();
    let picture = |(bound, which): (usize, &str)| {
        let map = arranged(&shown, bound);
        let path = format!("{FOLDER}/{}.levels-{which}.png", slug(&scene.name));
        let file = studio.draft.file(&path)?;
        write_png_rgb8(&colorize(&map, [0.0, farthest], Colormap::Magma), &file)
            .with_context(|| format!("cannot write {}", file.display()))?;
        Ok(Picture {
            figure: "pyramids",
            path,
            size: map.size(),
            caption: format!(
                "{}: {which} distance in each cell of the pyramid, dark 0, light {farthest:.1}; faces \
                 +x −x +y −y +z −z of the first map, from top to bottom with {} cells a side (Fig. \
                 4.1 and 4.2).",
                scene.name,
                sides.join(", ")
            ),
            alt: format!("Levels of the pyramid of {which} distances, a row a level"),
        })
    };
    ["least", "greatest"]
        .into_iter()
        .enumerate()
        .map(picture)
        .collect()
}

/// The first map's faces beside each other, the levels below each other, all in one size; NaN in the
/// gaps.
fn arranged(levels: &[&DistanceLevel], bound: usize) -> Image<f32> {
    let width = FACES * (SIDE + GAP) - GAP;
    let height = levels.len() * (SIDE + GAP) - GAP;
    let value = |x: usize, y: usize| {
        let (face, column) = (x / (SIDE + GAP), x % (SIDE + GAP));
        let (row, line) = (y / (SIDE + GAP), y % (SIDE + GAP));
        if column >= SIDE || line >= SIDE {
            return f32::NAN;
        }
        let level = levels[row];
        let side = level.side as usize;
        let (column, line) = (column * side / SIDE, line * side / SIDE);
        level.ranges[(face * side + line) * side + column][bound]
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let values = pixels.map(|(x, y)| value(x, y)).collect();
    Image::from_vec([width as u32, height as u32], values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_stand_side_by_side_and_levels_below_each_other() {
        let level = |side: u32| DistanceLevel {
            side,
            ranges: (0..FACES as u32 * side * side)
                .map(|cell| [cell as f32, 100.0 + cell as f32])
                .collect(),
        };
        let (fine, coarse) = (level(2), level(1));
        let map = arranged(&[&fine, &coarse], 1);
        let (side, next) = (SIDE as u32, (SIDE + GAP) as u32);
        assert_eq!(*map.at(0, 0), 100.0);
        assert_eq!(*map.at(side - 1, side - 1), 103.0);
        assert_eq!(*map.at(next, 0), 104.0);
        assert_eq!(*map.at(next, next), 101.0);
        assert!(map.at(side, 0).is_nan());
    }
}

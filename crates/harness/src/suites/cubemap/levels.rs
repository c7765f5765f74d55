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
    let pictures = ["least", "greatest"].into_iter().enumerate().map(picture);
    let mut pictures = pictures.collect::<anyhow::Result<Vec<_>>>()?;
    pictures.extend(lanes(studio, &scene)?);
    Ok(pictures)
}

/// Levels of the compute version: of each cell 32 parts, by turns 8 by 4 and 4 by 8.
const LANES: [[u32; 2]; 4] = [[1024, 1024], [256, 128], [32, 32], [8, 4]];
/// The maps that the compute version is described for.
const LANES_TECHNIQUE: &str = "cubemap-trace(size=1024,objects=1,stage=compute)";
/// Pixels a side of a face in its picture.
const WIDE: usize = 256;

/// Fig. 4.2: the levels that the lanes of the compute version test, of one face.
fn lanes(studio: &Studio<'_>, scene: &Scene) -> anyhow::Result<Option<Picture>> {
    let spec = crate::run::load::parse(LANES_TECHNIQUE)?;
    let Ok(rendered) = crate::run::render::render(&studio.setup.gpu, &spec, scene) else {
        return Ok(None);
    };
    let Some(Answer::DistanceLevels(levels)) = rendered.ask(Question::DistanceLevels)? else {
        return Ok(None);
    };
    let finest = &levels[0];
    let bounds = [f32::min, f32::max];
    let cells = LANES.map(|sides| bounds.map(|bound| gathered(finest, sides, bound)));
    let farthest = finest
        .ranges
        .iter()
        .map(|range| range[0])
        .fold(0.0, f32::max);
    let width = LANES.len() * (WIDE + GAP) - GAP;
    let height = bounds.len() * (WIDE + GAP) - GAP;
    let value = |x: usize, y: usize| {
        let (level, column) = (x / (WIDE + GAP), x % (WIDE + GAP));
        let (bound, line) = (y / (WIDE + GAP), y % (WIDE + GAP));
        if column >= WIDE || line >= WIDE {
            return f32::NAN;
        }
        let [across, down] = LANES[level].map(|side| side as usize);
        cells[level][bound][line * down / WIDE * across + column * across / WIDE]
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let map = Image::from_vec(
        [width as u32, height as u32],
        pixels.map(|(x, y)| value(x, y)).collect(),
    );
    let path = format!("{FOLDER}/{}.lanes.png", slug(&scene.name));
    let file = studio.draft.file(&path)?;
    write_png_rgb8(&colorize(&map, [0.0, farthest], Colormap::Magma), &file)
        .with_context(|| format!("cannot write {}", file.display()))?;
    let sides = LANES.map(|[across, down]| format!("{across}×{down}"));
    Ok(Some(Picture {
        figure: "stages",
        path,
        size: map.size(),
        caption: format!(
            "{}: the levels of the compute version on the first face, {} cells, least distances above, greatest \
             below, dark 0, light {farthest:.1} (Fig. 4.2).",
            scene.name,
            sides.join(", ")
        ),
        alt: "Four levels of distances, coarser and coarser".to_owned(),
    }))
}

/// The first face in so many cells, each with the least or greatest of its texels.
fn gathered(
    finest: &DistanceLevel,
    [across, down]: [u32; 2],
    bound: fn(f32, f32) -> f32,
) -> Vec<f32> {
    let side = finest.side as usize;
    let (across, down) = (across as usize, down as usize);
    let mut cells = vec![None; across * down];
    for (place, range) in finest.ranges[..side * side].iter().enumerate() {
        let cell = (place / side) * down / side * across + (place % side) * across / side;
        let least: Option<f32> = cells[cell];
        cells[cell] = Some(least.map_or(range[0], |least| bound(least, range[0])));
    }
    cells.into_iter().flatten().collect()
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
    fn cells_gather_the_least_and_the_greatest() {
        let finest = DistanceLevel {
            side: 4,
            ranges: (0..96).map(|texel| [texel as f32; 2]).collect(),
        };
        assert_eq!(gathered(&finest, [2, 1], f32::min), [0.0, 2.0]);
        assert_eq!(gathered(&finest, [2, 1], f32::max), [13.0, 15.0]);
        assert_eq!(gathered(&finest, [4, 4], f32::max).len(), 16);
    }

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

//! Fig. 5.2 and 2.4: the three test scenes, and what an environment map is made of and makes of them.

use anyhow::Context;
use catoptric_frame::png::srgb8_from_linear;
use catoptric_frame::{Image, write_png_rgb8};
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_scene::{Fov, Scene};
use glam::DVec3;

use crate::output::PICTURES as FOLDER;
use crate::show::pictures::slug;
use crate::show::plot::Axis;
use crate::suites::figure::Figure;
use crate::suites::series::{Point, Series};
use crate::suites::shelf;
use crate::suites::suite::{Picture, Studio};

use super::claims;
use super::data::{SIZE, quantities};
use super::labels::{MAPPED, TRACED};

/// Small, middle and large; of a teapot each.
const SCENES: [(&str, &str); 3] = [
    ("small (S0)", "box-teapot"),
    ("room", "room"),
    ("large (S1)", "atrium-teapot"),
];

/// Faces of a cube in the order +x −x +y −y +z −z, and what is up on each.
const FACES: [(DVec3, DVec3); 6] = [
    (DVec3::X, DVec3::Y),
    (DVec3::NEG_X, DVec3::Y),
    (DVec3::Y, DVec3::NEG_Z),
    (DVec3::NEG_Y, DVec3::Z),
    (DVec3::Z, DVec3::Y),
    (DVec3::NEG_Z, DVec3::Y),
];
/// Where each face stands in the cross, in faces from the left and from the top.
const CROSS: [(u32, u32); 6] = [(2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1)];
/// Pixels a side of a face.
const SIDE: u32 = 160;
const BESIDE: [u8; 3] = [24, 24, 28];

/// The three scenes by both techniques.
pub fn figure() -> Figure {
    let series = |label, technique: &str| {
        let points = SCENES.iter().enumerate();
        let points = points.map(|(x, (_, scene))| Point {
            resolution: Some(SIZE.map(|side| 2 * side)),
            ..Point::new(x as f64, *scene, technique).shown()
        });
        Series::new(label, points)
    };
    Figure {
        anchor: "results",
        title: "The test scenes, and an environment map of them".to_owned(),
        after: "Číž 2017, Fig. 5.2 and 2.4",
        question: "A teapot in a small scene, in a room and in an atrium, as in the thesis: by tracing in cube maps \
                   and by looking up an environment map, whose six faces are shown for the first scene."
            .to_owned(),
        axis: Axis::names("scene", SCENES.map(|(name, _)| name)),
        series: vec![
            series(TRACED, shelf::CUBEMAP.1),
            series(MAPPED, shelf::ENVIRONMENT_MAP.1),
        ],
        quantities: quantities(),
        quotes: &[],
        claims: claims::RESULTS,
    }
}

/// Draws the six faces that an environment map of the first scene has, as a cross.
pub fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    if studio.scene.is_some() {
        return Ok(Vec::new());
    }
    let options = crate::run::load::load_options(studio.common);
    let mut scene = Scene::load(SCENES[0].1, &options)?;
    let center = scene.mirrors[0].shape.center();
    scene.mirrors.clear();
    let mut cross = Image::from_vec(
        [4 * SIDE, 3 * SIDE],
        vec![BESIDE; (12 * SIDE * SIDE) as usize],
    );
    for ((ahead, up), (column, row)) in FACES.into_iter().zip(CROSS) {
        scene.camera.eye = center;
        scene.camera.target = center + ahead;
        scene.camera.up = up;
        scene.camera.fov = Fov::Y(90.0);
        let tracer = Tracer::new(&scene)?;
        let face = tracer.render(&RenderOptions::new([SIDE; 2], Truth::FirstBounce));
        for y in 0..SIDE {
            for x in 0..SIDE {
                let color = srgb8_from_linear(*face.color.at(x, y));
                *cross.at_mut(column * SIDE + x, row * SIDE + y) = color;
            }
        }
    }
    let path = format!("{FOLDER}/{}.faces.png", slug(&scene.name));
    let file = studio.draft.file(&path)?;
    write_png_rgb8(&cross, &file).with_context(|| format!("cannot write {}", file.display()))?;
    Ok(vec![Picture {
        figure: "results",
        path,
        size: cross.size(),
        caption: format!(
            "{}: the scene from the middle of the mirror on the six faces of a cube (Fig. 2.4).",
            scene.name
        ),
        alt: "Six square views unfolded into a cross".to_owned(),
    }])
}

//! Position and normal maps (Fig. 3.1), and the paths of both searches to one vertex (Fig. 4.2).

use anyhow::Context;
use catoptric_frame::png::srgb8_from_linear;
use catoptric_frame::{Image, Status as Pixel, VertexResult, VertexState, write_png_rgb8};
use catoptric_reflect::{Answer, Output, Question, Visit};
use catoptric_scene::Scene;
use glam::{IVec2, Vec2, Vec3};

use crate::output::PICTURES as FOLDER;
use crate::show::number::count;
use crate::show::pictures::slug;
use crate::suites::suite::{Picture, Studio};

/// Scene of the pictures where the user names none.
const SCENE: &str = "sphere-objects-1k";
/// Scene of the maps then: on a sphere around the origin, positions and normals look the same.
const SCENE_OF_MAPS: &str = "ellipsoid";

/// Both searches, and what their path is called.
const PATHS: [(&str, &str); 2] = [
    ("linear", "walk"),
    ("ray-hierarchy(repair=enlarge)", "descent"),
];

/// All pictures, under the first figure.
pub fn make(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let name = studio.scene.unwrap_or(SCENE);
    let scene = catoptric_scene::open(name, &crate::run::load::load_options(studio.common))?;
    let mut outputs = Vec::new();
    for (technique, _) in PATHS {
        let spec = crate::run::load::parse(technique)?;
        match crate::run::render::render(&studio.setup.gpu, &spec, &scene) {
            Ok(rendered) => outputs.push(rendered.output),
            // The rows of this technique say why.
            Err(_) => return Ok(Vec::new()),
        }
    }
    let mut pictures = match studio.scene {
        Some(_) => maps(studio, &scene, &outputs[0])?,
        None => {
            let options = crate::run::load::load_options(studio.common);
            let scene = catoptric_scene::open(SCENE_OF_MAPS, &options)?;
            let spec = crate::run::load::parse(PATHS[0].0)?;
            match crate::run::render::render(&studio.setup.gpu, &spec, &scene) {
                Ok(rendered) => maps(studio, &scene, &rendered.output)?,
                Err(_) => Vec::new(),
            }
        }
    };
    if let Some((index, mirror)) = example(&scene, &outputs) {
        for ((technique, kind), output) in PATHS.into_iter().zip(&outputs) {
            let result = output.vertices.iter().flatten().nth(index);
            let result = result.expect("both searches answer for the same vertices");
            pictures.push(path(
                studio, &scene, technique, kind, output, result, mirror,
            )?);
        }
    }
    Ok(pictures)
}

fn save(
    studio: &Studio<'_>,
    scene: &Scene,
    kind: &str,
    image: &Image<[u8; 3]>,
    caption: String,
    alt: String,
) -> anyhow::Result<Picture> {
    let path = format!("{FOLDER}/{}.{kind}.png", slug(&scene.name));
    let file = studio.draft.file(&path)?;
    write_png_rgb8(image, &file).with_context(|| format!("cannot write {}", file.display()))?;
    Ok(Picture {
        figure: "objects",
        path,
        size: image.size(),
        caption,
        alt,
    })
}

/// Fig. 3.1: what every search looks in.
fn maps(studio: &Studio<'_>, scene: &Scene, output: &Output) -> anyhow::Result<Vec<Picture>> {
    let frame = &output.frame;
    let (Some(primary), Some(reflected)) = (&frame.primary, &frame.reflected) else {
        return Ok(Vec::new());
    };
    let mask = reflected.status.map(|status| *status != Pixel::NotMirror);
    let maps = [
        ("position", &primary.position, "positions"),
        ("normal", &primary.normal, "normals"),
    ];
    let map = |(kind, map, what): (&str, &Image<Vec3>, &str)| {
        let caption = format!(
            "{}: {what} of the mirror as red, green and blue (Fig. 3.1).",
            scene.name
        );
        let alt = format!("Map of the mirror's {what}, x, y and z as red, green and blue");
        save(studio, scene, kind, &as_rgb(map, &mask), caption, alt)
    };
    maps.into_iter().map(map).collect()
}

/// Vectors as colours, each component stretched over its range inside the mask; grey outside.
fn as_rgb(map: &Image<Vec3>, mask: &Image<bool>) -> Image<[u8; 3]> {
    let pixels = || {
        map.pixels()
            .iter()
            .copied()
            .zip(mask.pixels().iter().copied())
    };
    let inside = || pixels().filter_map(|(value, inside)| inside.then_some(value));
    let low = inside().reduce(Vec3::min).unwrap_or_default();
    let high = inside().reduce(Vec3::max).unwrap_or_default();
    let span = (high - low).max(Vec3::splat(f32::MIN_POSITIVE));
    let colors = pixels().map(|(value, inside)| match inside {
        true => (255.0 * (value - low) / span)
            .to_array()
            .map(|channel| channel.round() as u8),
        false => [128; 3],
    });
    Image::from_vec(map.size(), colors.collect())
}

/// Of the answers that both searches find, the one with the middle number of steps of the walk:
/// its place among the results, and the index of its mirror.
fn example(scene: &Scene, outputs: &[Output]) -> Option<(usize, usize)> {
    let found = |output: &Output, index: usize| {
        let result = output.vertices.as_ref()?.get(index)?;
        (result.state == VertexState::Found && !result.stand_in).then_some(*result)
    };
    let results = outputs[0].vertices.as_ref()?.len();
    let shared = (0..results).filter(|index| outputs.iter().all(|o| found(o, *index).is_some()));
    let mut shared: Vec<usize> = shared.collect();
    shared.sort_by_key(|index| found(&outputs[0], *index).map(|result| result.steps));
    let index = *shared.get(shared.len() / 2)?;
    let id = found(&outputs[0], index)?.mirror;
    let mirror = (0..scene.mirrors.len()).find(|mirror| scene.mirror_id(*mirror) == id)?;
    Some((index, mirror))
}

/// Fig. 4.2: where a search looked for one vertex.
fn path(
    studio: &Studio<'_>,
    scene: &Scene,
    technique: &str,
    kind: &str,
    output: &Output,
    result: &VertexResult,
    mirror: usize,
) -> anyhow::Result<Picture> {
    let spec = crate::run::load::parse(technique)?;
    // Objects have the ids from 1 on.
    let object = &scene.objects[result.object as usize - 1];
    let vertex = object.mesh.positions[result.vertex as usize];
    let size = crate::run::load::size(scene);
    let gpu = &studio.setup.gpu;
    let prepared = catoptric_reflect::prepare(gpu, &spec, scene, size)?;
    let question = Question::Path {
        point: vertex,
        mirror,
    };
    let Some(Answer::Path(visits)) = prepared.ask(question)? else {
        anyhow::bail!("{technique} is no search")
    };
    let dim = |color: &Vec3| srgb8_from_linear(*color).map(|channel| channel / 2);
    let mut image = output.frame.color.map(dim);
    draw(&mut image, &visits, result.at);
    let caption = format!(
        "{}: the {kind} of “{technique}” to one vertex, {} steps (Fig. 4.2). {} The answer is circled.",
        scene.name,
        count(visits.len() as u64),
        match kind {
            "walk" => "The line goes from texel to texel.",
            _ => "A dot is a sphere's centre, from blue at the top level to yellow at the pixels.",
        }
    );
    let alt = format!("Picture with a line across the mirror: the {kind} of the search");
    save(studio, scene, kind, &image, caption, alt)
}

/// Draws the way from visit to visit, and a circle around the answer.
fn draw(image: &mut Image<[u8; 3]>, visits: &[Visit], answer: Vec2) {
    let top = visits.iter().map(|visit| visit.level).max().unwrap_or(0);
    let color = |level: u32| {
        let share = level as f32 / top.max(1) as f32;
        let color = Vec3::new(255.0, 210.0, 40.0).lerp(Vec3::new(60.0, 130.0, 255.0), share);
        color.to_array().map(|channel| channel as u8)
    };
    for pair in visits.windows(2) {
        let [from, to] = [pair[0].at, pair[1].at];
        let length = from.distance(to).ceil().max(1.0) as u32;
        for step in 0..=length {
            let at = from.lerp(to, step as f32 / length as f32);
            dot(image, at, 0, color(pair[1].level));
        }
    }
    for visit in visits.iter().filter(|visit| visit.level > 0) {
        dot(image, visit.at, 2, color(visit.level));
    }
    const SIDES: u32 = 64;
    for side in 0..SIDES {
        let angle = std::f32::consts::TAU * side as f32 / SIDES as f32;
        dot(
            image,
            answer + 9.0 * Vec2::from_angle(angle),
            1,
            [60, 230, 90],
        );
    }
}

/// A square of pixels around a place in image coordinates.
fn dot(image: &mut Image<[u8; 3]>, at: Vec2, radius: i32, color: [u8; 3]) {
    let [width, height] = image.size().map(|side| side as i32);
    let center = at.floor().as_ivec2();
    for y in -radius..=radius {
        for x in -radius..=radius {
            let pixel = center + IVec2::new(x, y);
            if pixel.cmpge(IVec2::ZERO).all() && pixel.cmplt(IVec2::new(width, height)).all() {
                *image.at_mut(pixel.x as u32, pixel.y as u32) = color;
            }
        }
    }
}

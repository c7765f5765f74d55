//! Pictures of the virtual geometry itself: the edges of the triangles over what they show.

use anyhow::Context;
use catoptric_frame::write_png;
use catoptric_scene::Scene;

use crate::output::PICTURES as FOLDER;
use crate::run::load::load_options;
use crate::show::pictures::slug;
use crate::suites::pictures::geometry;
use crate::suites::suite::{Picture, Studio};

use super::data::{CRACK, HALF, SQUARE, TABLE, THRESHOLD, adaptive, full, pixel};

/// All pictures: figure, scene, technique, and what became of the triangles.
pub fn make(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let square = studio.scene.unwrap_or(SQUARE);
    let crack = studio.scene.unwrap_or(CRACK);
    let table = studio.scene.unwrap_or(TABLE);
    let wanted = [
        ("wireframes", square, "linear".to_owned(), "not split"),
        ("wireframes", square, full(5), "split five times"),
        (
            "wireframes",
            square,
            adaptive(5, THRESHOLD),
            "split where needed",
        ),
        ("wireframes", square, pixel(HALF), "split by pixels"),
        ("crack", crack, adaptive(5, THRESHOLD), "split where needed"),
        ("crack", crack, pixel(HALF), "split by pixels"),
        ("table", table, "linear".to_owned(), "not split"),
        ("table", table, adaptive(4, THRESHOLD), "split where needed"),
        ("table", table, pixel(HALF), "split by pixels"),
    ];
    let pictures = wanted
        .into_iter()
        .map(|(figure, scene, technique, what)| wireframe(studio, figure, scene, &technique, what));
    pictures.collect()
}

fn wireframe(
    studio: &Studio<'_>,
    figure: &'static str,
    scene: &str,
    technique: &str,
    what: &str,
) -> anyhow::Result<Picture> {
    let scene = Scene::load(scene, &load_options(studio.common))?;
    let image = geometry(&studio.setup.gpu, &scene, technique, "wireframe")?;
    let names = [&scene.name, technique].map(slug);
    let path = format!("{FOLDER}/{}.wireframe.png", names.join("."));
    let file = studio.draft.file(&path)?;
    write_png(&image, &file).with_context(|| format!("cannot write {}", file.display()))?;
    Ok(Picture {
        figure,
        path,
        size: image.size(),
        caption: format!(
            "{}, {what}: the edges of the virtual triangles.",
            scene.name
        ),
        alt: format!("The reflection with the edges of its triangles, {what}"),
    })
}

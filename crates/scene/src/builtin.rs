//! The scenes that come with the program.

use crate::{LoadOptions, Scene};

/// What `list scenes` says of a built-in scene.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct SceneInfo {
    /// Built-in name.
    pub name: String,
    /// What the scene is for.
    pub why: String,
    /// False where a model is missing.
    pub available: bool,
    /// Why it is not available.
    pub reason: Option<String>,
    /// Number of objects; 0 where not available, as the counts below.
    pub objects: usize,
    /// Number of mirrors.
    pub mirrors: usize,
    /// Unique vertex positions of all objects.
    pub vertices: usize,
    /// Triangles of all objects.
    pub triangles: usize,
}

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../scenes/", $name, ".toml")))),*]
    };
}

/// Scenes with a file of their own.
const SCENES: [(&str, &str); 22] = scenes![
    "sphere-square",
    "sphere-objects-1k",
    "sphere-objects-20k",
    "spheres",
    "planar",
    "bowl",
    "ellipsoid",
    "sphere-table",
    "sphere-touching",
    "crack",
    "faceted",
    "kitchen",
    "box",
    "room",
    "atrium",
    "torus",
    "saddle",
    "prototype-sphere",
    "prototype-ellipsoid",
    "prototype-bowl",
    "teapot-ball",
    "sponza-ball",
];

/// Scenes made from a template: one grid of about so many vertices.
const GRIDS: [(&str, &str); 2] = [
    (
        "sphere-grid-",
        include_str!("../../../scenes/template-sphere-grid.toml"),
    ),
    (
        "sphere-grid-full-",
        include_str!("../../../scenes/template-sphere-grid-full.toml"),
    ),
];

/// Sizes of the grids: the name's ending and the cells along each side.
const GRID_SIZES: [(&str, u32); 7] = [
    ("100", 9),
    ("300", 16),
    ("1k", 31),
    ("3k", 54),
    ("10k", 99),
    ("30k", 172),
    ("100k", 315),
];

/// Names of all built-in scenes.
pub fn names() -> Vec<String> {
    let grids = GRIDS.iter().flat_map(|(family, _)| {
        GRID_SIZES
            .iter()
            .map(move |(size, _)| format!("{family}{size}"))
    });
    SCENES
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .chain(grids)
        .collect()
}

/// The scene file of a built-in scene.
pub fn text(name: &str) -> Option<String> {
    if let Some((_, text)) = SCENES.iter().find(|(known, _)| *known == name) {
        return Some((*text).to_owned());
    }
    GRIDS.iter().find_map(|(family, template)| {
        let size = name.strip_prefix(family)?;
        let (_, cells) = GRID_SIZES.iter().find(|(known, _)| *known == size)?;
        Some(template.replace("n = 8 ", &format!("n = {cells} ")))
    })
}

/// Every built-in scene, loaded to be counted.
pub fn list(options: &LoadOptions) -> Vec<SceneInfo> {
    names()
        .into_iter()
        .map(|name| info(name, options))
        .collect()
}

fn info(name: String, options: &LoadOptions) -> SceneInfo {
    match Scene::load(&name, options) {
        Ok(scene) => SceneInfo {
            available: true,
            reason: None,
            objects: scene.objects.len(),
            mirrors: scene.mirrors.len(),
            vertices: scene.vertex_count(),
            triangles: scene.triangle_count(),
            why: scene.why,
            name,
        },
        Err(error) => SceneInfo {
            why: why(&name),
            available: false,
            reason: Some(error.to_string()),
            objects: 0,
            mirrors: 0,
            vertices: 0,
            triangles: 0,
            name,
        },
    }
}

/// The `why` of a scene that could not be loaded.
fn why(name: &str) -> String {
    let parsed: Option<toml::Table> = text(name).and_then(|text| text.parse().ok());
    let why = parsed.as_ref().and_then(|table| table.get("why")?.as_str());
    why.unwrap_or_default().to_owned()
}

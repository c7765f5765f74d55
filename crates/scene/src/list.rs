//! What can be said of the built-in scenes.

use crate::builtin::{names, text};
use crate::load_options::LoadOptions;
use crate::scene::Scene;

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

/// Every built-in scene, loaded to be counted.
pub fn builtin(options: &LoadOptions) -> Vec<SceneInfo> {
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

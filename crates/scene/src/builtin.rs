//! The scenes that come with the program.

use crate::LoadOptions;

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

/// Names of all built-in scenes.
pub fn names() -> Vec<String> {
    Vec::new()
}

/// Every built-in scene, loaded to be counted.
pub fn list(options: &LoadOptions) -> Vec<SceneInfo> {
    let _ = options;
    Vec::new()
}

//! From a name or a path to a complete scene.

use std::path::PathBuf;

use crate::error::suggest;
use crate::{Scene, SceneError, builtin};

/// How to load a scene.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Folder of models that are not beside the scene file.
    pub models: Option<PathBuf>,
    /// Replaces the scene file's resolution: width and height in pixels.
    pub resolution: Option<[u32; 2]>,
}

/// Loads a built-in scene by its name, or a scene file by its path (ending in `.toml`).
pub fn open(name_or_path: &str, options: &LoadOptions) -> Result<Scene, SceneError> {
    let _ = options;
    let names = builtin::names();
    let suggestion = suggest(name_or_path, names.iter().map(String::as_str));
    Err(SceneError::Unknown { name: name_or_path.to_owned(), suggestion })
}

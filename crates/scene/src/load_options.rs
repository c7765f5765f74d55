//! What a scene is loaded with.

use std::path::PathBuf;

/// How to load a scene.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// Folder of models that are not beside the scene file.
    pub models: Option<PathBuf>,
    /// Replaces the scene file's resolution: width and height in pixels. Points that are
    /// constructed backwards from image positions depend on it.
    pub resolution: Option<[u32; 2]>,
}

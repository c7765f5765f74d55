//! From a name or a path to a complete scene.

use std::path::Path;

use crate::file::{Origin, read};
use crate::load_options::LoadOptions;
use crate::loading::Loading;
use crate::suggest::suggest;
use crate::{Scene, SceneError, builtin};

/// Loads a built-in scene by its name, or a scene file by its path (ending in `.toml`).
pub fn open(name_or_path: &str, options: &LoadOptions) -> Result<Scene, SceneError> {
    if let Some(text) = builtin::text(name_or_path) {
        let file = &format!("{name_or_path}.toml");
        return read(
            &text,
            Origin {
                name: name_or_path,
                file,
                folder: None,
                options,
                loading: Loading::default(),
            },
        );
    }
    let path = Path::new(name_or_path);
    if path.extension().is_none_or(|extension| extension != "toml") {
        let names = builtin::names();
        let mut suggestion = suggest(name_or_path, names.iter().map(String::as_str));
        if suggestion.is_empty() {
            suggestion =
                "; `catoptric list scenes` names the scenes, and files end in .toml".to_owned();
        }
        return Err(SceneError::Unknown {
            name: name_or_path.to_owned(),
            suggestion,
        });
    }
    let text = crate::text::read(path, "TOML")?;
    let text = String::from_utf8(text).map_err(|error| SceneError::File {
        file: name_or_path.to_owned(),
        message: format!(
            "is not UTF-8 text (byte {} is none of it): save it as UTF-8",
            error.utf8_error().valid_up_to() + 1
        ),
    })?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let folder = Some(path.parent().unwrap_or(Path::new("")).to_owned());
    read(
        &text,
        Origin {
            name: &stem,
            file: name_or_path,
            folder,
            options,
            loading: Loading::default(),
        },
    )
}

impl Scene {
    /// Loads a built-in scene by its name, or a scene file by its path; the same as [`open`].
    pub fn load(name_or_path: &str, options: &LoadOptions) -> Result<Self, SceneError> {
        open(name_or_path, options)
    }
}

//! Where a scene's text comes from, and what its parts are called.

use std::path::PathBuf;

use crate::document::Table;
use crate::loading::Loading;
use crate::{LoadOptions, SceneError};

/// Where a scene's text comes from and where its models may lie.
pub(crate) struct Origin<'a> {
    /// Name of the scene.
    pub name: &'a str,
    /// For messages.
    pub file: &'a str,
    /// Folder of the scene file; `None` for a built-in scene.
    pub folder: Option<PathBuf>,
    pub options: &'a LoadOptions,
    /// What the scene has made so far.
    pub loading: Loading,
}

/// The `name` of an object or mirror, or else what it is called in messages (`object 2`).
pub(super) fn name(table: &Table<'_>) -> Result<String, SceneError> {
    match table.string("name")? {
        Some("") => Err(table.error("name", "must not be empty")),
        Some(name) if name.contains(char::is_control) => {
            let message = format_args!("must have no control characters: `{name}`");
            Err(table.error("name", message))
        }
        Some(name) => Ok(name.to_owned()),
        None => Ok(table.owner().to_owned()),
    }
}

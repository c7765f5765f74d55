//! What can be wrong with a scene, as one clear message.

use std::fmt::Display;

/// Why a scene could not be loaded. `Display` is one line that names file, line and key.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// Something is wrong at a line of a scene, OBJ or MTL file.
    #[error("{file}:{line}: {message}")]
    AtLine {
        /// As given by the user, or `NAME.toml` of a built-in scene.
        file: String,
        /// From 1.
        line: usize,
        /// What is wrong, naming the key.
        message: String,
    },
    /// A file cannot be used as a whole.
    #[error("{file}: {message}")]
    File {
        /// Path of the file.
        file: String,
        /// What is wrong.
        message: String,
    },
    /// A model that the scene asks for is neither beside it nor in the models folder.
    #[error("{file}:{line}: {owner}: no file `{model}` {searched}")]
    MissingModel {
        /// Scene file.
        file: String,
        /// Line of the `mesh` key, from 1.
        line: usize,
        /// The object or mirror that asks, as in other messages.
        owner: String,
        /// The value of `mesh`.
        model: String,
        /// Where it was looked for.
        searched: String,
    },
    /// Neither a built-in scene nor a file.
    #[error("no built-in scene and no file `{name}`{suggestion}")]
    Unknown {
        /// As given by the user.
        name: String,
        /// ` (did you mean …?)`, or where the names are listed.
        suggestion: String,
    },
}

impl SceneError {
    /// Says of an error in a model which scene file asks for the model.
    pub(crate) fn used_by(mut self, user: impl Display) -> Self {
        if let Self::AtLine { message, .. } | Self::File { message, .. } = &mut self {
            *message = format!("{message} ({user})");
        }
        self
    }
}

//! Errors of the program, and the exit code that each leads to.

use std::error::Error;
use std::io;
use std::process::ExitCode;

use catoptric_frame::FrameError;
use catoptric_reference::ReferenceError;
use catoptric_reflect::{GpuError, SpecError};
use catoptric_scene::SceneError;

use crate::terminal::say;

/// How the program ends when it could run at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Everything asked for was done.
    Done,
    /// A row failed or a gate tripped.
    FellShort,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Done => Self::SUCCESS,
            Outcome::FellShort => Self::from(1),
        }
    }
}

/// A fault in what the user gave us: exit code 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct BadInput(pub String);

/// Shorthand for an error that is the user's to mend.
pub fn bad_input(message: impl Into<String>) -> anyhow::Error {
    BadInput(message.into()).into()
}

/// The exit code of an error: 3 where no graphics adapter can be used, 2 where the input is to blame,
/// 1 for everything else that broke on the way.
pub fn code(error: &anyhow::Error) -> u8 {
    if error.chain().any(|cause| cause.is::<GpuError>()) {
        return 3;
    }
    if error.chain().any(is_of_the_input) {
        return 2;
    }
    1
}

/// Whether a cause lies in what the user gave us.
fn is_of_the_input(cause: &(dyn Error + 'static)) -> bool {
    if let Some(error) = cause.downcast_ref::<io::Error>() {
        return is_of_the_path(error.kind());
    }
    match cause.downcast_ref::<FrameError>() {
        Some(FrameError::Write { .. } | FrameError::Png { .. }) => false,
        Some(_) => true,
        None => {
            cause.is::<BadInput>()
                || cause.is::<SceneError>()
                || cause.is::<SpecError>()
                || cause.is::<ReferenceError>()
        }
    }
}

/// Whether a file cannot be read or written because of what its path names, not because of, say, a
/// full disk.
fn is_of_the_path(kind: io::ErrorKind) -> bool {
    matches!(
        kind,
        io::ErrorKind::NotFound
            | io::ErrorKind::PermissionDenied
            | io::ErrorKind::NotADirectory
            | io::ErrorKind::IsADirectory
            | io::ErrorKind::AlreadyExists
            | io::ErrorKind::ReadOnlyFilesystem
            | io::ErrorKind::InvalidFilename
            | io::ErrorKind::InvalidInput
            | io::ErrorKind::InvalidData
    )
}

/// Says on stderr what is odd in a scene's files, though it can be shown.
pub fn warn(scene: &catoptric_scene::Scene) {
    for warning in &scene.warnings {
        say(&format!("catoptric: warning: {warning}"));
    }
}

#[cfg(test)]
mod tests {
    use anyhow::Context;
    use catoptric_reflect::ReflectError;

    use super::*;

    fn io(kind: io::ErrorKind) -> anyhow::Error {
        let error = Err::<(), _>(io::Error::from(kind));
        let error = error.context("cannot write record.json");
        error.expect_err("an error")
    }

    #[test]
    fn the_input_is_to_blame_for_what_it_says() {
        for error in [
            bad_input("no such metric"),
            io(io::ErrorKind::NotFound),
            io(io::ErrorKind::PermissionDenied),
            catoptric_reflect::parse("no-such-technique")
                .expect_err("a misspelt name")
                .into(),
        ] {
            assert_eq!(code(&error), 2, "{error:#}");
        }
    }

    #[test]
    fn nothing_else_is_the_inputs_fault() {
        let full = |path: &str| FrameError::Write {
            path: path.into(),
            source: io::ErrorKind::StorageFull.into(),
        };
        for error in [
            io(io::ErrorKind::StorageFull),
            full("picture.exr").into(),
            ReflectError::OtherScene.into(),
            anyhow::anyhow!("a template that cannot be filled"),
        ] {
            assert_eq!(code(&error), 1, "{error:#}");
        }
        assert_eq!(code(&GpuError::no_adapter().into()), 3);
    }
}

//! Errors of the program, and the exit code that each leads to.

use std::process::ExitCode;

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

/// The exit code of an error: 3 where no graphics adapter can be used, 1 where a measurement
/// broke down on the way, 2 for everything the input is to blame for.
pub fn code(error: &anyhow::Error) -> u8 {
    for cause in error.chain() {
        if cause.is::<catoptric_reflect::GpuError>() {
            return 3;
        }
        if cause.is::<catoptric_reflect::ReflectError>() {
            return 1;
        }
    }
    2
}

//! What was made on a device, and what went wrong on it.

use std::sync::{Arc, Mutex, PoisonError};

use super::error::BuildError;

/// What was made, and the first thing that went wrong, since the last [`Budget::begin`].
#[derive(Clone, Debug, Default)]
pub(super) struct Budget(Arc<Mutex<State>>);

#[derive(Debug, Default)]
struct State {
    bytes: u64,
    fault: Option<BuildError>,
}

impl Budget {
    fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The first of all since the last [`Budget::begin`] counts.
    pub(super) fn note(&self, fault: BuildError) {
        self.state().fault.get_or_insert(fault);
    }

    /// Begins to count and to look for faults.
    pub(super) fn begin(&self) {
        *self.state() = State::default();
    }

    /// The first fault since then; it is told once.
    pub(super) fn take_fault(&self) -> Option<BuildError> {
        self.state().fault.take()
    }

    /// Bytes of what was made since then.
    pub(super) fn bytes(&self) -> u64 {
        self.state().bytes
    }

    /// Adds what is about to be made.
    pub(super) fn add(&self, bytes: u64) {
        self.state().bytes += bytes;
    }

    /// Takes off what was made for a moment.
    pub(super) fn forget(&self, bytes: u64) {
        let mut state = self.state();
        state.bytes = state.bytes.saturating_sub(bytes);
    }

    /// Notes what the device reports.
    pub(super) fn note_error(&self, error: &wgpu::Error) {
        self.note(match error {
            wgpu::Error::OutOfMemory { .. } => BuildError::OutOfMemory,
            other => BuildError::Device(one_line(&other.to_string())),
        });
    }
}

/// wgpu's errors have a line a cause.
fn one_line(text: &str) -> String {
    let lines = text.lines().map(str::trim);
    let lines: Vec<_> = lines.filter(|line| !line.is_empty()).collect();
    lines.join("; ")
}

//! Ctrl-C and other signals that ask the program to end: what is finished is kept, what is not begun
//! is left out, and nothing half-written stays.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use super::progress::Progress;

/// Set by the first signal: what is finished is kept, what is not begun is left out.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Prints that a signal was received; set while there is something finished to keep.
static SPEAKER: OnceLock<Progress> = OnceLock::new();

/// The exit code of a program that was told to end: that of Ctrl-C, as shells have it.
const TOLD_TO_END: i32 = 130;

/// True after a signal that asks to end.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// From now on Ctrl-C, SIGTERM and SIGHUP end the program without temporary files or a half-made
/// folder left behind.
pub fn end_cleanly() {
    let handler = || {
        let first = !INTERRUPTED.swap(true, Ordering::Relaxed);
        match SPEAKER.get() {
            Some(speaker) if first => speaker.remark(
                "interrupted: finishing this scene, then keeping what there is (again to stop at once)",
            ),
            _ => {
                catoptric_frame::abandon_writes();
                std::process::exit(TOLD_TO_END);
            }
        }
    };
    // Without the handler a signal ends the program at once, which is no reason to refuse work.
    let _ = ctrlc::set_handler(handler);
}

/// From now on the first signal asks to stop after what is being done, a second one stops at once.
pub fn keep_what_is_finished(progress: &Progress) {
    // One that measures twice speaks as before.
    let _ = SPEAKER.set(progress.clone());
}

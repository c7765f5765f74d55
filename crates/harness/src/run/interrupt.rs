//! Ctrl-C: what is finished is kept, what is not begun is left out.

use std::sync::atomic::{AtomicBool, Ordering};

use super::progress::Progress;

/// Set by Ctrl-C: what is finished is kept, what is not begun is left out.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// True after Ctrl-C.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// From now on Ctrl-C asks to stop after what is being done, a second one stops at once.
pub fn keep_what_is_finished(progress: &Progress) {
    let speaker = progress.clone();
    let handler = move || {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        speaker.remark(
            "interrupted: finishing this scene, then keeping what there is (again to stop at once)",
        );
    };
    // Without the handler an interrupt ends the program at once, which is no reason to refuse work.
    let _ = ctrlc::set_handler(handler);
}

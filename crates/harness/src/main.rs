//! `catoptric`: how exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The library does all of it; this is its command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    hush_wayland();
    catoptric::cli::main()
}

/// Vulkan drivers on Linux ask for Wayland although nothing is to be shown. Wayland's library then writes
/// a line to stderr each time if `XDG_RUNTIME_DIR` is no absolute path. So the variable is set to a folder
/// in which there is no Wayland socket.
#[cfg(all(unix, not(target_vendor = "apple")))]
fn hush_wayland() {
    const FOLDER: &str = "XDG_RUNTIME_DIR";
    let set = std::env::var_os(FOLDER).is_some_and(|folder| {
        let folder = std::path::Path::new(&folder);
        folder.is_absolute()
    });
    let elsewhere = std::env::temp_dir();
    if !set && elsewhere.is_absolute() {
        #[allow(
            unsafe_code,
            reason = "the environment is changed before any other thread is started"
        )]
        // SAFETY: this is the first thing that the program does; no other thread reads it.
        unsafe {
            std::env::set_var(FOLDER, elsewhere);
        }
    }
}

#[cfg(not(all(unix, not(target_vendor = "apple"))))]
fn hush_wayland() {}

//! Puts the revision of the sources into the program.

use std::path::Path;
use std::process::Command;

/// Folders whose files make the program what it is, from this crate's.
const SOURCES: [&str; 3] = ["..", "../../shaders", "../../scenes"];

fn main() {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    let revision = git(&[
        "describe",
        "--always",
        "--dirty",
        "--abbrev=12",
        "--exclude=*",
    ]);
    println!(
        "cargo::rustc-env=CATOPTRIC_REVISION={}",
        revision.unwrap_or_default()
    );
    for folder in SOURCES {
        println!("cargo::rerun-if-changed={folder}");
    }
    // The log of HEAD grows with every commit and every checkout.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"])
        && Path::new(&log).exists()
    {
        println!("cargo::rerun-if-changed={log}");
    }
}

//! `catoptric export`: a scene for another renderer.

mod mitsuba;
mod ply;
mod sides;

use std::path::Path;

use crate::cli::Common;
use crate::exit::{Outcome, bad_input};
use crate::setup;

/// Writes a scene into a folder that Mitsuba 3 loads as it is.
pub fn run(name: &str, folder: &Path, common: &Common) -> anyhow::Result<Outcome> {
    if common.bounces == 0 {
        return Err(bad_input("--bounces must be at least 1: a mirror reflects"));
    }
    let scene = catoptric_scene::open(name, &setup::load_options(common))?;
    if folder.exists() && !folder.is_dir() {
        return Err(bad_input(format!(
            "cannot write into {}: it is no folder",
            folder.display()
        )));
    }
    mitsuba::write(&scene, common.bounces, folder)?;
    if !common.quiet {
        eprintln!(
            "{}: {} objects, {} mirrors for Mitsuba 3",
            folder.join(mitsuba::SCENE_FILE).display(),
            scene.objects.len(),
            scene.mirrors.len()
        );
    }
    Ok(Outcome::Done)
}

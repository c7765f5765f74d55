//! `catoptric export`: a scene for another renderer.

use std::path::PathBuf;

use crate::exit::{Outcome, bad_input};
use crate::export::mitsuba;
use crate::options::Common;
use crate::run::load::load_options;
use crate::terminal::say;

/// What `export` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in name or scene file
    pub scene: String,
    /// Folder to write `scene.xml` and what belongs to it into; Mitsuba 3 loads it as it is
    #[arg(long, value_name = "DIR")]
    pub mitsuba: PathBuf,
}

/// Writes a scene into a folder that Mitsuba 3 loads as it is.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let (name, folder) = (&args.scene, &args.mitsuba);
    if common.bounces == 0 {
        return Err(bad_input("--bounces must be at least 1: a mirror reflects"));
    }
    let scene = catoptric_scene::open(name, &load_options(common))?;
    crate::exit::warn(&scene);
    if folder.exists() && !folder.is_dir() {
        return Err(bad_input(format!(
            "cannot write into {}: it is no folder",
            folder.display()
        )));
    }
    mitsuba::write(&scene, common.bounces, folder)?;
    if !common.quiet {
        say(&format!(
            "{}: {} objects, {} mirrors for Mitsuba 3",
            folder.join(mitsuba::SCENE_FILE).display(),
            scene.objects.len(),
            scene.mirrors.len()
        ));
    }
    Ok(Outcome::Done)
}

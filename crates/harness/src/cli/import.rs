//! `catoptric import`: a scene from elsewhere as a scene file of ours.

use std::path::PathBuf;

use catoptric_scene::LoadOptions;

use crate::exit::{Outcome, bad_input};
use crate::import::{self, Choice};
use crate::options::Common;
use crate::terminal::say;

/// What `import` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// glTF 2 (.gltf, .glb), Mitsuba 3 (.xml) or PBRT (.pbrt)
    pub file: PathBuf,
    /// Metals of this roughness or less are mirrors
    #[arg(long, value_name = "X", default_value_t = 0.15, value_parser = roughness)]
    pub roughness: f64,
    /// Name of an object or a material whose surfaces are mirrors; may be given several times
    #[arg(long, value_name = "NAME")]
    pub mirror: Vec<String>,
}

fn roughness(text: &str) -> Result<f64, String> {
    let number = text.parse().ok();
    number
        .filter(|number| (0.0..=1.0).contains(number))
        .ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// Reads a file, writes a folder, and loads what it wrote.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let folder = common
        .output
        .as_ref()
        .ok_or_else(|| bad_input("say where to: -o DIR"))?;
    if folder.exists() && !folder.is_dir() {
        return Err(bad_input(format!(
            "cannot write into {}: it is no folder",
            folder.display()
        )));
    }
    let choice = Choice {
        roughness: args.roughness,
        mirrors: args.mirror.clone(),
    };
    let found = import::read(&args.file, &choice)?;
    let (path, notes) = import::write(&found, &args.file, folder)?;
    let scene = catoptric_scene::open(&path.to_string_lossy(), &LoadOptions::default())?;
    crate::exit::warn(&scene);
    if common.quiet {
        return Ok(Outcome::Done);
    }
    for what in &found.left_out {
        say(&format!("left out: {what}"));
    }
    for note in &notes {
        say(note);
    }
    say(&format!(
        "{}: {} objects, {} mirrors, {} triangles",
        path.display(),
        scene.objects.len(),
        scene.mirrors.len(),
        scene.triangle_count()
    ));
    if scene.mirrors.is_empty() {
        let mut materials: Vec<&str> = Vec::new();
        for thing in &found.things {
            let material = match thing.material.as_str() {
                "" => thing.name.as_str(),
                material => material,
            };
            if !materials.contains(&material) {
                materials.push(material);
            }
        }
        materials.truncate(20);
        say(&format!(
            "no mirror is in it: name one by --mirror NAME, a thing or a material, such as {}",
            materials.join(", ")
        ));
    }
    Ok(Outcome::Done)
}

//! `catoptric render`: a technique's picture of a scene, in a file.

use crate::exit::{Outcome, bad_input};
use crate::options::Common;
use crate::record::Status;
use crate::run::load::{check_size, open_gpu, parse, size};
use crate::run::render::render;
use crate::terminal::say;

use super::picture::{open, target, write};

/// What `render` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in name or scene file
    pub scene: String,
    /// Such as `linear(residual=cross)` (`list techniques`)
    #[arg(short, long)]
    pub technique: String,
}

/// Renders a scene by a technique into a file.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let name = &args.scene;
    let path = target(common)?;
    let spec = parse(&args.technique)?;
    let scene = open(name, common)?;
    let gpu = open_gpu(common)?;
    check_size(size(&scene), gpu.info().max_image, "this adapter")?;
    match render(&gpu, &spec, &scene) {
        Ok(rendered) => write(&rendered.output.frame, &path, common),
        Err((Status::NotApplicable, reason)) => Err(bad_input(format!(
            "{spec} does not apply to {name}: {reason}"
        ))),
        Err((_, reason)) => {
            say(&format!("catoptric: {spec} on {name}: {reason}"));
            Ok(Outcome::FellShort)
        }
    }
}

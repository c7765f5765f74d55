//! `catoptric render`: a technique's picture of a scene, in a file.

use crate::exit::{Outcome, bad_input};
use crate::export::vectors::{Convention, convert};
use crate::options::Common;
use crate::record::Status;
use crate::run::load::{check_size, open_gpu, parse, size};
use crate::run::render::render_frame;
use crate::terminal::say;

use super::picture::{check_frame, open, target, write};

/// What `render` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in name or scene file
    pub scene: String,
    /// Such as `linear(residual=cross)` (`list techniques`)
    #[arg(short, long)]
    pub technique: String,
    /// Frame of the scene's motion, the first being 0. From 1 on a technique of the family motion says in
    /// an EXR where each reflection was a frame before (`motion.X`, `motion.Y`, `motion.valid`)
    #[arg(long, value_name = "N")]
    pub frame: Option<u32>,
    /// Write the motion also as other programs read it, with the distance of the virtual image
    /// (`mv.X`, `mv.Y`, `mv.distance`)
    #[arg(long, value_name = "CONVENTION", value_enum)]
    pub vectors: Option<Convention>,
}

/// Renders a scene by a technique into a file.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let name = &args.scene;
    let path = target(common)?;
    let spec = parse(&args.technique)?;
    let scene = open(name, common)?;
    let frame = args.frame.unwrap_or(0);
    check_frame(&scene, frame)?;
    let gpu = open_gpu(common)?;
    check_size(size(&scene), gpu.info().max_image, "this adapter")?;
    match render_frame(&gpu, &spec, &scene, frame) {
        Ok(mut picture) => {
            if let Some(convention) = args.vectors {
                if picture.motion.is_none() {
                    return Err(bad_input(format!(
                        "--vectors: {spec} at frame {frame} has no motion to write; a technique of the \
                         family motion has, from --frame 1 on"
                    )));
                }
                convert(&mut picture, scene.at(frame).camera.eye, convention);
            }
            write(&picture, &path, common)
        }
        Err((Status::NotApplicable, reason)) => Err(bad_input(format!(
            "{spec} does not apply to {name}: {reason}"
        ))),
        Err((_, reason)) => {
            say(&format!("catoptric: {spec} on {name}: {reason}"));
            Ok(Outcome::FellShort)
        }
    }
}

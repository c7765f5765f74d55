//! `catoptric reference`: a scene's truth, ray-traced into a file.

use catoptric_reference::{Follow, RenderOptions, Tracer, Truth};

use crate::exit::Outcome;
use crate::options::{Common, TruthArg, samples};
use crate::run::load::{check_size, size};
use crate::run::progress::Progress;

use super::picture::{check_frame, open, target, write};

/// What `reference` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in name or scene file
    pub scene: String,
    /// What reflected rays see
    #[arg(long, value_enum, default_value_t)]
    pub truth: TruthArg,
    /// Samples a pixel, a square number: a regular grid, averaged in colour only
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = samples)]
    pub samples: u32,
    /// Frame of the scene's motion, the first being 0. From 1 on an EXR says also where each reflection
    /// was a frame before (`motion.X`, `motion.Y`, `motion.valid`), under truth first-bounce
    #[arg(long, value_name = "N")]
    pub frame: Option<u32>,
}

/// Longest side of a picture that only the CPU makes.
const LONGEST_SIDE: u32 = 16_384;

/// Ray-traces a scene into a file.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let name = &args.scene;
    let path = target(common)?;
    let scene = open(name, common)?;
    let size = size(&scene);
    check_size(size, LONGEST_SIDE, "the reference")?;
    let frame = args.frame.unwrap_or(0);
    check_frame(&scene, frame)?;
    let tracer = Tracer::new(&scene.at(frame))?;
    // What other bounces show has no single reflection point to follow.
    let follows = frame > 0 && args.truth == TruthArg::FirstBounce;
    let progress = Progress::new(size[1] as usize * (1 + usize::from(follows)), common.quiet);
    progress.doing(format!("{name}: tracing"));
    let step = |_, _| progress.step();
    let truth = match args.truth {
        TruthArg::FirstBounce => Truth::FirstBounce,
        TruthArg::Full => Truth::Full {
            bounces: common.bounces,
        },
    };
    let mut picture = tracer.render(&RenderOptions {
        size,
        truth,
        samples: args.samples.isqrt(),
        progress: Some(&step),
    });
    if follows {
        progress.doing(format!("{name}: following reflections to the frame before"));
        let follow = Follow::new(&scene, [frame, frame - 1], size)?;
        picture.motion = Some(follow.layer(Some(&step)));
    }
    progress.finish();
    write(&picture, &path, common)
}

//! `catoptric reference`: a scene's truth, ray-traced into a file.

use catoptric_reference::{RenderOptions, Tracer, Truth};

use crate::exit::{Outcome, bad_input};
use crate::options::{Common, TruthArg};
use crate::run::load::{check_size, size};
use crate::run::progress::Progress;

use super::picture::{open, target, write};

/// What `reference` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Built-in name or scene file
    pub scene: String,
    /// What reflected rays see
    #[arg(long, value_enum, default_value_t)]
    pub truth: TruthArg,
    /// Samples a pixel, a square number: a regular grid, averaged in colour only
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub samples: u32,
}

/// Longest side of a picture that only the CPU makes.
const LONGEST_SIDE: u32 = 16_384;

/// Ray-traces a scene into a file.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let (name, samples) = (&args.scene, args.samples);
    let path = target(common)?;
    let side = samples.isqrt();
    if side * side != samples {
        return Err(bad_input(format!(
            "--samples {samples} is no regular grid in a pixel: give a square number, such as {}",
            (side + 1) * (side + 1)
        )));
    }
    let scene = open(name, common)?;
    let size = size(&scene);
    check_size(size, LONGEST_SIDE, "the reference")?;
    let tracer = Tracer::new(&scene)?;
    let progress = Progress::new(size[1] as usize, common.quiet);
    progress.doing(format!("{name}: tracing"));
    let step = |_, _| progress.step();
    let truth = match args.truth {
        TruthArg::FirstBounce => Truth::FirstBounce,
        TruthArg::Full => Truth::Full {
            bounces: common.bounces,
        },
    };
    let frame = tracer.render(&RenderOptions {
        size,
        truth,
        samples: side,
        progress: Some(&step),
    });
    progress.finish();
    write(&frame, &path, common)
}

//! `catoptric bench`: the sweeps behind a paper's figures.

use crate::exit::Outcome;
use crate::options::{Common, seconds};
use crate::show::layers::Extent;
use crate::suites::part::Part;
use crate::suites::{self, runner};

/// What `bench` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Name of the suite
    pub suite: String,
    /// Every cell of the paper's grid, where the suite by itself measures a part (`cubemap`)
    #[arg(long)]
    pub full: bool,
    /// A scene of yours (or a built-in one) in place of the suite's own, wherever that makes sense
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Seconds of timing in all, shared by everything that is measured; default: by the suite
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_budget: Option<f64>,
    /// Write positions, distances, normals and offsets beside the pictures too, for the inspector of the
    /// page: objects, colours and errors are always written
    #[arg(long)]
    pub layers: bool,
    /// The K-th of N parts, for one of several machines: `page` joins their records
    #[arg(long, value_name = "K/N")]
    pub part: Option<Part>,
}

/// Runs a suite and writes its page.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let suite = match args.full {
        false => suites::find(&args.suite)?,
        true => suites::whole(suites::find(&args.suite)?)?,
    };
    let choice = runner::Choice {
        scene: args.scene.as_deref(),
        seconds: args.time_budget,
        extent: Extent::of(args.layers),
        part: args.part,
    };
    runner::run(suite, choice, common)
}

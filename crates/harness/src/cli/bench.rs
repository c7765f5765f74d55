//! `catoptric bench`: the sweeps behind a paper's figures.

use crate::exit::Outcome;
use crate::options::{Common, seconds};
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
}

/// Runs a suite and writes its page.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let suite = match args.full {
        false => suites::find(&args.suite)?,
        true => suites::whole(suites::find(&args.suite)?)?,
    };
    runner::run(suite, args.scene.as_deref(), args.time_budget, common)
}

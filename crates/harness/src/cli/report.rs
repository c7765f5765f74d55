//! `catoptric report`: measure a suite of scenes and write one page about it.

use clap::ValueEnum;

use crate::exit::Outcome;
use crate::options::{Common, seconds};
use crate::suites::{report, runner};

/// What `report` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// Which scenes and techniques
    #[arg(long, value_enum, default_value_t)]
    pub suite: SuiteArg,
    /// Seconds of timing for each scene, shared by the techniques; default: by the suite
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_budget: Option<f64>,
}

/// Suites of the `report` command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum SuiteArg {
    /// A handful of scenes, small pictures: three minutes at most on two cores
    #[default]
    Quick,
    /// Every available scene at 640×480
    Full,
}

/// Measures the suite and writes the page, by default into the folder `report`.
pub fn run(args: &Args, common: &Common) -> anyhow::Result<Outcome> {
    let suite = match args.suite {
        SuiteArg::Quick => &report::QUICK,
        SuiteArg::Full => &report::FULL,
    };
    runner::run(suite, None, args.time_budget, common)
}

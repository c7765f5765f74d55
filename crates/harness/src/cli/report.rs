//! `catoptric report`: measure a suite of scenes and write one page about it.

use clap::ValueEnum;

use crate::exit::Outcome;
use crate::options::{Common, seconds};
use crate::show::layers::Extent;
use crate::suites::part::Part;
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
    /// A scene of yours (or a built-in one) in place of the suite's own
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,
    /// Write positions, distances, normals and offsets beside the pictures too, for the inspector of the
    /// page: objects, colours and errors are always written
    #[arg(long)]
    pub layers: bool,
    /// The K-th of N parts, for one of several machines: `page` joins their records
    #[arg(long, value_name = "K/N")]
    pub part: Option<Part>,
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
    let choice = runner::Choice {
        scene: args.scene.as_deref(),
        seconds: args.time_budget,
        extent: Extent::of(args.layers),
        part: args.part,
    };
    runner::run(suite, choice, common)
}

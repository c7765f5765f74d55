//! The command line: names, options and their help.

use clap::{Parser, Subcommand};

use crate::check::case::Request;
use crate::options::Common;

use super::{
    bench, claims, compare, completions, diff, export, import, list, page, reference, render,
    report, summary,
};

/// How exact, how fast and how steady is a real-time reflection on a curved mirror?
#[derive(Debug, Parser)]
#[command(name = "catoptric", version, arg_required_else_help = true, after_help = EXIT_CODES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Options of every command.
    #[command(flatten)]
    pub common: Common,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 a measurement failed or a --require gate tripped, \
                          2 bad input, 3 no usable graphics adapter.\n\
                          The result goes to stdout, messages and progress to stderr.";

/// The program's verbs.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Say what there is
    List(list::Args),
    /// Ray-trace a scene's truth into a picture (-o FILE.exr with all layers, or FILE.png)
    Reference(reference::Args),
    /// Render a scene by a technique into a picture (-o FILE.exr with all layers, or FILE.png)
    Render(render::Args),
    /// Measure techniques against the truth: error, work and time
    Compare(compare::Args),
    /// Run the sweeps behind a paper's figures (-o DIR, default `bench-SUITE`)
    #[command(after_help = crate::suites::help())]
    Bench(bench::Args),
    /// Measure a suite of scenes and write one page about it (-o DIR, default `report`)
    Report(report::Args),
    /// Lay recorded runs on one page, or beside an earlier one (-o DIR, default `page`, or -o FILE.md)
    Page(page::Args),
    /// Our image metrics on any two pictures (EXR; the first is taken for the truth)
    Diff(diff::Args),
    /// The short table of a recorded run (Markdown), on stdout or spliced into a text
    Summary(summary::Args),
    /// What became of the papers' claims, by recorded runs of `bench`, on stdout or spliced into a text
    Claims(claims::Args),
    /// Write a scene for another renderer
    Export(export::Args),
    /// Take over a scene from elsewhere (-o DIR): glTF 2, Mitsuba 3, PBRT
    Import(import::Args),
    /// Compare our tracer with pictures that another renderer made of the same scenes
    Check(Request),
    /// Describe the graphics adapter and test its clock
    Doctor,
    /// Write the completions of a shell to stdout
    Completions(completions::Args),
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}

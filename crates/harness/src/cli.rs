//! The command line: names, options and their help.

use std::path::PathBuf;

use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

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

/// Options that every command understands.
#[derive(Clone, Debug, Default, Args)]
pub struct Common {
    /// Picture size; default: the scene's own
    #[arg(long, global = true, value_name = "WxH", value_parser = resolution)]
    pub resolution: Option<[u32; 2]>,
    /// Folder of models that scenes name but do not bring along
    #[arg(long, global = true, value_name = "DIR", env = "CATOPTRIC_MODELS",
          value_parser = OsStringValueParser::new().map(PathBuf::from))]
    pub models: Option<PathBuf>,
    /// Graphics adapter, by a part of its name (`list adapters`)
    #[arg(long, global = true, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Mirror bounces that the truth `full` follows
    #[arg(long, global = true, value_name = "N", default_value_t = 8)]
    pub bounces: u32,
    /// How the result is written
    #[arg(long, global = true, value_enum, default_value_t)]
    pub format: Format,
    /// File or folder to write; .json, .csv and .md say how
    #[arg(short, long, global = true, value_name = "PATH")]
    pub output: Option<PathBuf>,
    /// No progress and no remarks on stderr
    #[arg(long, global = true)]
    pub quiet: bool,
}

/// The program's verbs.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Say what there is
    List {
        /// Of what
        #[arg(value_enum)]
        what: Listing,
    },
    /// Ray-trace a scene's truth into a picture (-o FILE.exr with all layers, or FILE.png)
    Reference {
        /// Built-in name or scene file
        scene: String,
        /// What reflected rays see
        #[arg(long, value_enum, default_value_t)]
        truth: TruthArg,
        /// Samples a pixel, a square number: a regular grid, averaged in colour only
        #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=4096))]
        samples: u32,
    },
    /// Render a scene by a technique into a picture (-o FILE.exr with all layers, or FILE.png)
    Render {
        /// Built-in name or scene file
        scene: String,
        /// Such as `linear(residual=cross)` (`list techniques`)
        #[arg(short, long)]
        technique: String,
    },
    /// Measure techniques against the truth: error, work and time
    Compare(CompareArgs),
    /// Run the sweeps behind a paper's figures (-o DIR, default `bench-SUITE`)
    #[command(after_help = crate::suites::help())]
    Bench(BenchArgs),
    /// Measure a suite of scenes and write one page about it (-o DIR, default `report`)
    Report {
        /// Which scenes and techniques
        #[arg(long, value_enum, default_value_t)]
        suite: SuiteArg,
        /// Seconds of timing for each scene, shared by the techniques; default: by the suite
        #[arg(long, value_name = "SECONDS", value_parser = seconds)]
        time_budget: Option<f64>,
    },
    /// Our image metrics on any two pictures (EXR; the first is taken for the truth)
    Diff {
        /// The truth
        reference: PathBuf,
        /// What is judged
        test: PathBuf,
    },
    /// The short table of a recorded run (Markdown), on stdout or spliced into a text
    Summary {
        /// A run's record.json
        record: PathBuf,
        /// Text with the lines `<!-- summary: begin -->` and `<!-- summary: end -->`
        #[arg(long, value_name = "FILE")]
        into: Option<PathBuf>,
    },
    /// Write a scene for another renderer
    Export {
        /// Built-in name or scene file
        scene: String,
        /// Folder to write `scene.xml` and what belongs to it into; Mitsuba 3 loads it as it is
        #[arg(long, value_name = "DIR")]
        mitsuba: PathBuf,
    },
    /// Compare our tracer with pictures that another renderer made of the same scenes
    Check(CheckArgs),
    /// Describe the graphics adapter and test its clock
    Doctor,
}

/// What `compare` is asked.
#[derive(Clone, Debug, Args)]
pub struct CompareArgs {
    /// Built-in names or scene files
    #[arg(required = true)]
    pub scenes: Vec<String>,
    /// Such as `linear(residual=cross)`; several are allowed (`list techniques`)
    #[arg(short, long = "technique", value_name = "TECHNIQUE", required = true, num_args = 1..)]
    pub techniques: Vec<String>,
    /// Earlier results (JSON): say what got better or worse (with --format json on stderr, with csv
    /// instead of the records)
    #[arg(long, value_name = "RECORD")]
    pub against: Option<PathBuf>,
    /// Gate such as `angular_error_deg.p99<=0.05`: exit code 1 where a row breaks it
    #[arg(long, value_name = "METRIC<=X")]
    pub require: Vec<String>,
    /// Seconds of timing for each scene, shared by the techniques
    #[arg(long, value_name = "SECONDS", default_value_t = 6.0, value_parser = seconds)]
    pub time_budget: f64,
    /// Follow so many frames of the scene's motion: jitter and jumps of the reflection points, and
    /// the cost of a moving frame
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub frames: Option<u32>,
}

/// What `bench` is asked.
#[derive(Clone, Debug, Args)]
pub struct BenchArgs {
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

/// What `check` is asked.
#[derive(Clone, Debug, Args)]
pub struct CheckArgs {
    /// One picture; without it, all that are stored
    pub file: Option<PathBuf>,
    /// The scene it shows: built-in name or scene file
    #[arg(long)]
    pub scene: Option<String>,
    /// Folder of the stored pictures, their sidecars and `scenes` [default: reference]
    #[arg(long, value_name = "DIR", conflicts_with = "file")]
    pub images: Option<PathBuf>,
    /// What its reflected rays see; default: as the picture or its sidecar says, else what fits
    #[arg(long, value_enum)]
    pub truth: Option<TruthArg>,
    /// Where our reflected rays start; default: both ways for Mitsuba's pictures with a sidecar
    #[arg(long, value_enum)]
    pub start: Option<StartArg>,
    /// Samples a pixel it was made with, in a regular grid; default: as its sidecar says, else 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub samples: Option<u32>,
}

/// Where reflected rays start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StartArg {
    /// On the mirror
    Surface,
    /// Off the mirror, as far as Mitsuba moves them
    Mitsuba,
    /// Once so, once so
    Both,
}

/// What `list` lists.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Listing {
    /// Built-in scenes
    Scenes,
    /// Techniques with their options
    Techniques,
    /// Graphics adapters
    Adapters,
}

/// How results are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Aligned columns for people
    #[default]
    Table,
    /// An array with one object a row
    Json,
    /// Comma-separated, one line a row
    Csv,
    /// A Markdown table
    Markdown,
}

/// Truth of the `reference` command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TruthArg {
    /// Reflected rays see everything but mirrors
    #[default]
    FirstBounce,
    /// Mirrors are seen in mirrors, up to --bounces
    Full,
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

/// Parses `640x480`.
fn resolution(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once(['x', 'X', '×']);
    let parsed = sides.and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    match parsed {
        None => Err("expected WIDTHxHEIGHT in pixels, such as 640x480".to_owned()),
        Some([0, _] | [_, 0]) => Err("a picture needs at least one pixel each way".to_owned()),
        Some(size) => Ok(size),
    }
}

/// Parses a positive number of seconds.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("expected a positive number of seconds".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn resolutions() {
        assert_eq!(resolution("640x480"), Ok([640, 480]));
        assert_eq!(resolution("8×4"), Ok([8, 4]));
        for bad in ["0x0", "640", "x", "640x", "-1x3", "1.5x2", ""] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
    }
}

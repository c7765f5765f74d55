//! Chores that need some logic, as `cargo xtask <CHORE>`.
//!
//! * `report` sets the machine up and writes the comparison report.
//! * `test` sets the machine up and runs every test.
//! * `ci` does what a change must pass: formatting, lints, documentation, `test`.
//! * `new` writes what a new technique or a new metric starts from.
//! * `fuzz` feeds made-up input to everything that is read from outside.
//! * `drivers` compares what the techniques answer on two Vulkan drivers.
//! * `embree` measures Embree beside our ray tracer, on the same rays.
//!
//! Each step is printed before it runs; the first that fails ends the chore with its exit code.
//! Exit code 3 means that the machine lacks something and it could not be installed.

mod ci;
mod drivers;
mod embree;
mod new;
mod setup;
mod step;

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::Result;
use clap::{Parser, Subcommand};

use setup::Need;
use step::Step;

/// The exit code for a machine that lacks a driver or a compiler.
const NOT_SET_UP: u8 = 3;

#[derive(Parser)]
#[command(
    name = "cargo xtask",
    bin_name = "cargo xtask",
    about = "Chores of this workspace"
)]
struct Cli {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Write the comparison report (the quick suite, unless another is named)
    Report {
        /// Passed on to `catoptric report`
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        args: Vec<OsString>,
    },
    /// Run every test; a test that needs a graphics adapter fails without one
    Test,
    /// Check formatting, lints and documentation, then run every test
    Ci,
    /// Feed made-up scenes, meshes, pictures, names and records to what reads them; every run tries
    /// other inputs
    Fuzz {
        /// In all, shared by the targets
        #[arg(long, default_value_t = 5.0, value_parser = minutes)]
        minutes: f64,
        /// Only this one: scene, mesh, texture, exr, name or record
        target: Option<String>,
    },
    /// Compare what the techniques answer on this machine's driver and on another: SwiftShader, where
    /// Chromium has brought it, or the one of VK_DRIVER_FILES' manifest that is named
    Drivers {
        /// The other driver's manifest (JSON)
        manifest: Option<PathBuf>,
    },
    /// Measure Embree beside our ray tracer on the same rays, and check that hits agree
    Embree,
    /// Write the files and lines that something new starts from: they compile and run
    New {
        /// What it is to be
        kind: new::Kind,
        /// Its name on the command line, such as `two-steps`
        name: String,
    },
}

fn main() -> ExitCode {
    match run(Cli::parse().chore) {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// The root of the working tree from which `cargo run` started this program.
fn root() -> PathBuf {
    let here = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let here = here.unwrap_or_else(|| env!("CARGO_MANIFEST_DIR").into());
    here.join("../..")
}

/// Runs a chore; the answer is its exit code.
fn run(chore: Chore) -> Result<u8> {
    if let Chore::New { kind, name } = &chore {
        for path in new::write(&root(), *kind, name)? {
            println!("{}", path.display());
        }
        return Ok(0);
    }
    let mut skipped = Vec::new();
    let (needs, mut steps): (&[Need], Vec<Step>) = match &chore {
        Chore::Report { args } => (&[Need::Vulkan], vec![report(args.clone())]),
        Chore::Test => (&[Need::Vulkan, Need::CppCompiler], vec![test()]),
        Chore::Ci => {
            let (mut steps, lines) = ci::checks();
            skipped = lines;
            let (tests, line) = ci::tests(test());
            skipped.extend(line);
            steps.push(tests);
            (&[Need::Vulkan, Need::CppCompiler], steps)
        }
        Chore::Fuzz { minutes, target } => (&[], vec![fuzz(*minutes, target.as_deref())]),
        Chore::Drivers { manifest } => match drivers::other(manifest.as_deref()) {
            Ok(manifest) => (&[Need::Vulkan], drivers::steps(&manifest)),
            Err(message) => {
                eprintln!("xtask: {message}");
                return Ok(NOT_SET_UP);
            }
        },
        Chore::Embree => (&[Need::CppCompiler, Need::Embree], vec![]),
        Chore::New { .. } => (&[], vec![]),
    };
    if let Err(message) = setup::provide(needs)? {
        eprintln!("xtask: {message}");
        return Ok(NOT_SET_UP);
    }
    if matches!(chore, Chore::Embree) {
        steps.push(compare_embree(embree::compile()?));
    }
    for step in steps {
        let code = step.run()?;
        if code != 0 {
            eprintln!("xtask: `{}` failed with exit code {code}", step.shown());
            return Ok(code);
        }
    }
    for line in skipped {
        eprintln!("xtask: {line}");
    }
    Ok(0)
}

/// The report, of the quick suite unless the arguments name one.
fn report(args: Vec<OsString>) -> Step {
    let mut step = Step::cargo("run --release -p catoptric -- report");
    let names_suite = args
        .iter()
        .filter_map(|a| a.to_str())
        .any(|a| a == "--suite" || a.starts_with("--suite="));
    if !names_suite {
        step.args.extend(["--suite", "quick"].map(OsString::from));
    }
    step.args.extend(args);
    step
}

/// A length of time that can be waited for.
fn minutes(text: &str) -> Result<f64, String> {
    let minutes: f64 = text.parse().map_err(|error| format!("{error}"))?;
    let sensible = (0.0..=10_000.0).contains(&minutes);
    sensible
        .then_some(minutes)
        .ok_or_else(|| "0 to 10000".to_owned())
}

/// The fuzz targets, one after the other, each beginning with an input with which no earlier run
/// began.
fn fuzz(minutes: f64, target: Option<&str>) -> Step {
    let mut step = Step::cargo("test --release --workspace --test fuzz -- --nocapture");
    step.args.push("--test-threads=1".into());
    if let Some(target) = target {
        step.args.extend(["--exact", target].map(OsString::from));
    }
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let first = now.map_or(0, |since| since.as_secs()) << 32;
    step.env = vec![
        (
            "CATOPTRIC_FUZZ_SECONDS",
            (60.0 * minutes).ceil().to_string(),
        ),
        ("CATOPTRIC_FUZZ_FIRST", first.to_string()),
    ];
    step
}

/// Our tracer and Embree, whose program this is.
fn compare_embree(program: PathBuf) -> Step {
    let mut step = Step::cargo("bench --workspace --bench embree -- --embree");
    step.args.push(program.into());
    step
}

/// All tests, none of which may be skipped for want of an adapter.
fn test() -> Step {
    Step {
        env: vec![("CATOPTRIC_REQUIRE_GPU", "1".to_owned())],
        ..Step::cargo("test --release --workspace")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(words: &str) -> Chore {
        Cli::try_parse_from(words.split_whitespace())
            .unwrap_or_else(|e| panic!("{e}"))
            .chore
    }

    fn shown_report(words: &str) -> String {
        match parse(words) {
            Chore::Report { args } => report(args).shown(),
            _ => panic!("not a report"),
        }
    }

    #[test]
    fn a_report_is_quick_and_takes_arguments() {
        assert_eq!(
            shown_report("xtask report"),
            "cargo run --release -p catoptric -- report --suite quick"
        );
        assert_eq!(
            shown_report("xtask report --models dir -o out"),
            "cargo run --release -p catoptric -- report --suite quick --models dir -o out"
        );
    }

    #[test]
    fn a_named_suite_replaces_the_quick_one() {
        assert_eq!(
            shown_report("xtask report --suite full"),
            "cargo run --release -p catoptric -- report --suite full"
        );
        assert_eq!(
            shown_report("xtask report --suite=full"),
            "cargo run --release -p catoptric -- report --suite=full"
        );
    }

    #[test]
    fn tests_require_an_adapter() {
        assert_eq!(
            test().shown(),
            "CATOPTRIC_REQUIRE_GPU=1 cargo test --release --workspace"
        );
    }
}

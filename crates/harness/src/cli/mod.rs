//! The command line: one file per command, and the options of each.

mod args;
mod bench;
mod check;
mod claims;
mod compare;
mod completions;
mod diff;
mod doctor;
mod export;
mod import;
mod list;
mod page;
mod picture;
mod reference;
mod render;
mod report;
mod splice;
mod summary;
mod unused;

use std::process::ExitCode;

use clap::FromArgMatches;

use crate::exit::{self, Outcome, bad_input};
use crate::options::Common;
use crate::run::interrupt;
use crate::terminal::{plain, say};

use self::args::{Cli, Command};

/// The program: reads the command line, does what it says, and answers with an exit code.
pub fn main() -> ExitCode {
    interrupt::end_cleanly();
    let matches = unused::command().try_get_matches();
    let (matches, cli) = match matches.and_then(|all| Ok((Cli::from_arg_matches(&all)?, all))) {
        Ok((cli, matches)) => (matches, cli),
        Err(error) => return misread(&error),
    };
    match unused::refuse(&matches).and_then(|()| run(cli)) {
        Ok(outcome) => outcome.into(),
        Err(error) => {
            say(&format!("catoptric: {error:#}"));
            ExitCode::from(exit::code(&error))
        }
    }
}

/// Says what is wrong with a command line, or the help that was asked for.
fn misread(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    if plain(&text) == text {
        // In colour, where the terminal has some. Where nobody can read it, it is lost.
        let _ = error.print();
    } else {
        say(text.trim_end());
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

fn run(Cli { command, common }: Cli) -> anyhow::Result<Outcome> {
    let common = settled(common)?;
    match command {
        Command::List(args) => list::run(&args, &common),
        Command::Reference(args) => reference::run(&args, &common),
        Command::Render(args) => render::run(&args, &common),
        Command::Compare(args) => compare::run(&args, &common),
        Command::Bench(args) => bench::run(&args, &common),
        Command::Report(args) => report::run(&args, &common),
        Command::Page(args) => page::run(&args, &common),
        Command::Diff(args) => diff::run(&args, &common),
        Command::Summary(args) => summary::run(&args, &common),
        Command::Claims(args) => claims::run(&args, &common),
        Command::Export(args) => export::run(&args, &common),
        Command::Import(args) => import::run(&args, &common),
        Command::Check(args) => check::run(&args, &common),
        Command::Completions(args) => completions::run(&args, unused::for_shells()),
        Command::Doctor => doctor::run(&common),
    }
}

/// The common options, checked as far as every command can: an empty `--models` (or variable) is
/// none, any other must be a folder.
fn settled(mut common: Common) -> anyhow::Result<Common> {
    common.models = common
        .models
        .filter(|folder| !folder.as_os_str().is_empty());
    match &common.models {
        Some(folder) if !folder.is_dir() => Err(bad_input(format!(
            "--models (or the variable CATOPTRIC_MODELS): no folder {}",
            folder.display()
        ))),
        _ => Ok(common),
    }
}

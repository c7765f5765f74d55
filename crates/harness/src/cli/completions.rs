//! `catoptric completions`: what a shell must know to complete our command lines.

use clap_complete::Shell;

use crate::exit::Outcome;
use crate::show::print;

/// What `completions` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// The shell
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Writes a script that the shell reads.
pub fn run(args: &Args, mut command: clap::Command) -> anyhow::Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "catoptric", &mut script);
    print::text(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}

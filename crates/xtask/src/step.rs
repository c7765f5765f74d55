//! One call of a program: what a chore is made of.

use std::env;
use std::ffi::OsString;
use std::process::Command;

use anyhow::{Context, Result};

/// One call of a program, cargo unless said otherwise.
pub struct Step {
    /// The program.
    pub program: &'static str,
    /// Variables set for it.
    pub env: Vec<(&'static str, String)>,
    /// Its arguments.
    pub args: Vec<OsString>,
}

impl Step {
    /// A call of cargo with these arguments, separated by blanks.
    pub fn cargo(args: &str) -> Self {
        Self::of("cargo", args)
    }

    /// A call of a program with these arguments, separated by blanks.
    pub fn of(program: &'static str, args: &str) -> Self {
        Self {
            program,
            env: Vec::new(),
            args: args.split_whitespace().map(OsString::from).collect(),
        }
    }

    /// The command as one would type it.
    pub fn shown(&self) -> String {
        let mut words: Vec<String> = self
            .env
            .iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        words.push(self.program.into());
        words.extend(self.args.iter().map(|a| a.to_string_lossy().into_owned()));
        words.join(" ")
    }

    /// Prints and runs the command; the answer is its exit code (1 if a signal ended it).
    pub fn run(&self) -> Result<u8> {
        eprintln!("xtask: {}", self.shown());
        let program = match self.program {
            "cargo" => env::var_os("CARGO").unwrap_or_else(|| "cargo".into()),
            other => other.into(),
        };
        let status = Command::new(program)
            .args(&self.args)
            .envs(self.env.iter().map(|(key, value)| (key, value)))
            .status()
            .with_context(|| format!("cannot run `{}`", self.shown()))?;
        Ok(status
            .code()
            .map_or(1, |code| u8::try_from(code).unwrap_or(1)))
    }
}

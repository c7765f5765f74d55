//! `catoptric`: how exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The library does all of it; this is its command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    catoptric::cli::main()
}

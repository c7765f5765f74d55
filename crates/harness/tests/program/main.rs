//! The program as it is run: arguments in; exit code, text and files out.

#[path = "../support/mod.rs"]
mod support;

#[cfg(unix)]
mod browser;
mod check;
mod claims;
mod cli;
mod export;
mod goldens;
mod import;
#[cfg(unix)]
mod killed;
mod measuring;
mod odd_pictures;
mod robust;
mod rooms;
mod runs;

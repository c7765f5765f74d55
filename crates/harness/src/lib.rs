//! How exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The whole program is one pipeline, [`run::measure()`]: load a scene, trace its reference, render
//! it by every technique, compare, time, record.
//!
//! The modules, from the bottom up; a module uses only those before it:
//!
//! - [`terminal`], [`exit`](mod@exit), [`options`], [`input`], [`output`]: text for the terminal,
//!   exit codes, common options, reading and writing of files;
//! - [`record`]: what was measured, its file and its schema, gates and comparisons of its numbers;
//! - [`show`] makes tables, plots, sentences, pages and pictures of records and frames, and [`run`]
//!   makes the records; neither uses the other;
//! - [`suites`]: the sweeps behind the papers' figures and the report: what to measure, and the
//!   claims that read the outcome;
//! - [`check`] compares the reference with another renderer's pictures, [`export`](mod@export)
//!   writes scenes for one, [`import`] takes over scenes from elsewhere;
//! - [`cli`]: the command line, one file per command.

pub mod check;
pub mod cli;
pub mod exit;
pub mod export;
pub mod import;
pub mod input;
pub mod options;
pub mod output;
pub mod record;
pub mod run;
pub mod show;
pub mod suites;
pub mod terminal;

//! How exact, how fast and how steady is a real-time reflection on a curved mirror?
//!
//! The whole reads as one sentence, [`run::measure()`]: load a scene, trace its reference, render it
//! by every technique, compare, time, record.
//!
//! The rooms, from the bottom up; a room knows only those before it:
//!
//! - [`terminal`], [`exit`](mod@exit), [`options`], [`input`], [`output`]: what is said, how the program
//!   ends, what it is asked, reads and writes;
//! - [`record`]: what was measured, its file and its schema, what is asked of its numbers;
//! - [`show`] makes tables, plots, sentences, pages and pictures of records and frames, and
//!   [`run`] makes the records; neither knows the other;
//! - [`suites`]: the sweeps behind the papers' figures and the report: what to measure, and the
//!   claims that read the outcome;
//! - [`check`] holds the reference against another renderer's pictures, [`export`](mod@export)
//!   writes scenes for one, [`import`] takes over scenes from elsewhere;
//! - [`cli`]: the command line, a file a verb.

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

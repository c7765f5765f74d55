//! Progress and remarks on stderr, never on stdout.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::terminal::{in_a_line, say};

/// What is said while working: a bar where stderr is a terminal, and remarks unless quiet.
#[derive(Clone, Debug)]
pub struct Progress {
    bar: ProgressBar,
    quiet: bool,
}

impl Progress {
    /// A bar of `steps` steps, hidden if `quiet` or where nobody watches.
    pub fn new(steps: usize, quiet: bool) -> Self {
        let visible = !quiet && std::io::stderr().is_terminal();
        let target = if visible {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(steps as u64), target);
        if let Ok(style) = ProgressStyle::with_template(
            "{bar:20} {pos}/{len} {elapsed:>4}, {eta} left: {wide_msg}",
        ) {
            bar.set_style(style);
        }
        if visible {
            bar.enable_steady_tick(Duration::from_millis(250));
        }
        Self { bar, quiet }
    }

    /// Says what is being done now.
    pub fn doing(&self, what: impl Into<String>) {
        self.bar.set_message(in_a_line(&what.into()).into_owned());
    }

    /// Says what is being done now, and which share of it is.
    pub fn part(&self, what: &str, done: usize, all: usize) {
        let percent = 100 * done / all.max(1);
        self.doing(format!("{what}, {percent} %"));
    }

    /// One step is finished.
    pub fn step(&self) {
        self.steps(1);
    }

    /// So many steps are finished, or not needed.
    pub fn steps(&self, steps: usize) {
        self.bar.inc(steps as u64);
    }

    /// Steps that are not finished.
    pub fn left(&self) -> u64 {
        self.bar
            .length()
            .unwrap_or_default()
            .saturating_sub(self.bar.position())
    }

    /// A remark that stays on the screen when the bar is gone.
    pub fn remark(&self, text: &str) {
        if !self.quiet {
            self.bar.suspend(|| say(text));
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

//! What a change must pass before it is tested.

use crate::setup::on_path;
use crate::step::Step;

/// A check by a program that does not come with Rust: it is run where the program is installed.
struct Tool {
    /// The program that must be on the path.
    program: &'static str,
    /// The check, as one would type it.
    check: (&'static str, &'static str),
    /// How the program is installed.
    install: &'static str,
}

/// Spelling, the format of TOML files, licences and sources of dependencies, unused dependencies.
const TOOLS: [Tool; 4] = [
    Tool {
        program: "typos",
        check: ("typos", ""),
        install: "cargo install typos-cli",
    },
    Tool {
        program: "taplo",
        check: ("taplo", "fmt --check"),
        install: "cargo install taplo-cli",
    },
    Tool {
        program: "cargo-deny",
        check: ("cargo", "deny check bans licenses sources"),
        install: "cargo install cargo-deny",
    },
    Tool {
        program: "cargo-machete",
        check: ("cargo", "machete"),
        install: "cargo install cargo-machete",
    },
];

/// Names under which Chromium may be installed; with it, the tests use the pages in a browser.
const BROWSERS: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];

/// The checks, quick ones first, and a line about each that is skipped.
pub fn checks() -> (Vec<Step>, Vec<String>) {
    checks_where(on_path)
}

/// The tests, told which of this machine's programs they must use, and a line about the tests that
/// are skipped.
pub fn tests(all: Step) -> (Step, Option<String>) {
    tests_where(all, on_path)
}

fn tests_where(mut all: Step, installed: impl Fn(&str) -> bool) -> (Step, Option<String>) {
    if BROWSERS.into_iter().any(installed) {
        all.env.push(("CATOPTRIC_REQUIRE_BROWSER", "1".to_owned()));
        return (all, None);
    }
    let line = "skipped the tests of the pages in a browser: chromium is not installed \
                (Debian, Ubuntu: apt-get install chromium)";
    (all, Some(line.to_owned()))
}

/// The checks on a machine where `installed` says which of those programs there are.
fn checks_where(installed: impl Fn(&str) -> bool) -> (Vec<Step>, Vec<String>) {
    let mut steps = vec![Step::cargo("fmt --all --check")];
    let mut skipped = Vec::new();
    for tool in &TOOLS {
        let step = Step::of(tool.check.0, tool.check.1);
        if installed(tool.program) {
            steps.push(step);
        } else {
            skipped.push(format!(
                "skipped `{}`: {} is not installed ({})",
                step.shown(),
                tool.program,
                tool.install
            ));
        }
    }
    steps.push(Step::cargo(
        "clippy --release --workspace --all-targets -- -D warnings",
    ));
    steps.push(Step {
        env: vec![("RUSTDOCFLAGS", "-Dwarnings".to_owned())],
        ..Step::cargo("doc --release --workspace --no-deps")
    });
    (steps, skipped)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(steps: &[Step]) -> Vec<String> {
        steps.iter().map(Step::shown).collect()
    }

    #[test]
    fn a_tool_that_is_installed_checks() {
        let (steps, skipped) = checks_where(|_| true);
        assert_eq!(steps.len(), 3 + TOOLS.len());
        assert!(shown(&steps).contains(&"taplo fmt --check".to_owned()));
        assert!(skipped.is_empty());
    }

    #[test]
    fn the_pages_are_tested_where_there_is_a_browser() {
        let tests = || Step::cargo("test");
        let (step, line) = tests_where(tests(), |program| program == "google-chrome");
        assert_eq!(step.shown(), "CATOPTRIC_REQUIRE_BROWSER=1 cargo test");
        assert_eq!(line, None);
        let (step, line) = tests_where(tests(), |_| false);
        assert_eq!(step.shown(), "cargo test");
        assert!(line.is_some_and(|line| line.contains("chromium is not installed")));
    }

    #[test]
    fn a_tool_that_is_missing_is_skipped_by_name() {
        let (steps, skipped) = checks_where(|program| program != "cargo-machete");
        assert!(!shown(&steps).contains(&"cargo machete".to_owned()));
        assert_eq!(
            skipped,
            [
                "skipped `cargo machete`: cargo-machete is not installed (cargo install cargo-machete)"
            ]
        );
    }
}

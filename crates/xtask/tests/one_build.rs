//! No third-party crate is built twice: whatever command builds it, it has the same features.
//!
//! Cargo builds a crate with the features that the selected packages ask for, those of tests and
//! benches only where these are built. Two selections that ask for different features of one crate build
//! it, and all that stands on it, twice. Here the trees that `cargo tree` shows for the commands of
//! the README are compared with the tree of the tests.

use std::collections::BTreeSet;
use std::env;
use std::process::Command;

/// What the commands select, without tests: `cargo xtask`, `cargo run -p catoptric`, `cargo build`.
const SELECTIONS: [&str; 3] = ["--package=xtask", "--package=catoptric", "--workspace"];

/// The edges to follow, and how `cargo tree` calls them: what runs on the target, and with it what
/// runs while building, which has features of its own.
const EDGES: [&str; 2] = ["normal,no-proc-macro", "normal,build"];

/// One third-party crate, with its version, and the features it is built with.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Built {
    package: String,
    features: String,
}

/// The lines of `cargo tree --prefix none --format {p}|{f}`, without the packages of this workspace:
/// those have a path in parentheses.
fn third_party(tree: &str) -> BTreeSet<Built> {
    tree.lines()
        .filter_map(|line| line.trim_end_matches(" (*)").split_once('|'))
        .map(|(package, features)| Built {
            package: package.trim_end_matches(" (proc-macro)").to_owned(),
            features: features.to_owned(),
        })
        .filter(|built| !built.package.contains('('))
        .collect()
}

/// The tree of a selection, as `cargo tree` shows it.
fn tree(selection: &str, edges: &str) -> BTreeSet<Built> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--locked", "--prefix=none", "--format={p}|{f}"])
        .args([selection, "--edges", edges])
        .output()
        .expect("cargo runs");
    assert!(
        output.status.success(),
        "cargo tree {selection}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    third_party(&String::from_utf8(output.stdout).expect("cargo prints UTF-8"))
}

/// What a selection builds that the tests build otherwise, as a message; empty where all is shared.
fn built_again(selection: &BTreeSet<Built>, tests: &BTreeSet<Built>) -> String {
    let mut message = String::new();
    for built in selection.difference(tests) {
        message += &format!("  {} with [{}]", built.package, built.features);
        for other in tests.iter().filter(|other| other.package == built.package) {
            message += &format!(", in the tests with [{}]", other.features);
        }
        message.push('\n');
    }
    message
}

#[test]
#[cfg_attr(
    windows,
    ignore = "windows-sys has more features with the program than with xtask"
)]
fn every_command_builds_third_party_crates_with_the_features_of_the_tests() {
    for edges in EDGES {
        let tests = tree("--workspace", &format!("{edges},dev"));
        for selection in SELECTIONS {
            let selected = tree(selection, edges);
            assert!(!selected.is_empty(), "{selection} has no third-party crate");
            let again = built_again(&selected, &tests);
            assert!(
                again.is_empty(),
                "{selection} and the tests build these crates with different features:\n{again}\
                 ask for the tests' features in the Cargo.toml of the selected package too"
            );
        }
    }
}

#[test]
fn different_features_are_noticed() {
    let tests = third_party("naga v30.0.1|hlsl-out,msl-out\nserde v1.0.229|std (*)\n");
    let same = third_party("serde v1.0.229|std\nxtask v0.1.0 (/tmp/xtask)|\n");
    assert_eq!(built_again(&same, &tests), "");
    let other = third_party("naga v30.0.1|hlsl-out\nserde v1.0.229|std\n");
    assert_eq!(
        built_again(&other, &tests),
        "  naga v30.0.1 with [hlsl-out], in the tests with [hlsl-out,msl-out]\n"
    );
}

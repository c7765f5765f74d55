//! Recorded runs on a page, beside earlier ones, and what a terminal is told.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use crate::support::{catoptric, code, refused, stderr, stdout};

fn row(technique: &str, adapter: &str, agreement: f64, part: Option<&str>) -> Value {
    json!({ "schema_version": 1, "scene": "bowl", "technique": technique, "resolution": [8, 6],
            "status": "ok", "adapter": { "name": adapter, "driver": "d", "backend": "b", "software": true },
            "object_agreement": agreement, "work": { "total": 3.0 },
            "time_ms": { "frame": { "median": 5.0, "median_low": 4.9, "median_high": 5.1 } },
            "meta": { "scene_hash": "h", "revision": "r", "date": "2026-01-02T03:04:05Z", "part": part,
                      "command": "catoptric compare" } })
}

fn record(folder: &Path, name: &str, rows: &[Value]) -> String {
    let path = folder.join(name);
    std::fs::write(&path, Value::Array(rows.to_vec()).to_string()).expect("written");
    path.to_str().expect("UTF-8").to_owned()
}

#[test]
fn a_changed_option_is_all_that_a_page_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let old = [
        row("linear", "a", 0.9, None),
        row("ray-hierarchy(repair=enlarge)", "a", 0.8, None),
    ];
    let new = [
        row("linear", "a", 0.9, None),
        row("ray-hierarchy(repair=stop)", "a", 0.7, None),
    ];
    let (old, new) = (
        record(folder.path(), "old.json", &old),
        record(folder.path(), "new.json", &new),
    );
    let output = catoptric(&[
        "page",
        &new,
        "--against",
        &old,
        "-o",
        &at("page"),
        "--junit",
        &at("j.xml"),
    ]);
    assert_eq!((code(&output), stderr(&output)), (0, ""));
    let page = std::fs::read_to_string(at("page/index.html")).expect("a page");
    let changes = page
        .split("id=\"adapter-1\"")
        .next()
        .expect("changes first");
    assert!(changes.contains("repair=enlarge") && changes.contains("repair=stop"));
    assert!(
        changes.contains("1 appeared, 1 vanished, 1 unchanged"),
        "{changes}"
    );
    assert!(!changes.contains(">linear<"), "{changes}");
    let output = catoptric(&["page", &new, "--against", &old, "-o", &at("c.md")]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let comment = std::fs::read_to_string(at("c.md")).expect("a comment");
    assert!(
        comment.contains("repair=stop") && !comment.contains("| linear"),
        "{comment}"
    );
    let junit = std::fs::read_to_string(at("j.xml")).expect("XML");
    let document = roxmltree::Document::parse(&junit).expect("XML");
    let failed = document
        .descendants()
        .filter(|node| node.has_tag_name("failure"));
    assert_eq!(failed.count(), 1, "{junit}");
}

#[test]
fn parts_and_adapters_are_joined() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let second = record(
        folder.path(),
        "2.json",
        &[row("newton", "a", 0.9, Some("2/2"))],
    );
    let first = record(
        folder.path(),
        "1.json",
        &[row("linear", "a", 0.9, Some("1/2"))],
    );
    let other = record(
        folder.path(),
        "3.json",
        &[row("linear", "another", 0.9, None)],
    );
    let output = catoptric(&["page", &second, &first, &other, "-o", &at("page")]);
    assert_eq!((code(&output), stderr(&output)), (0, ""));
    let joined: Value =
        serde_json::from_slice(&std::fs::read(at("page/record.json")).expect("rows"))
            .expect("JSON");
    let names: Vec<_> = joined
        .as_array()
        .into_iter()
        .flatten()
        .map(|row| &row["technique"])
        .collect();
    assert_eq!(names, ["linear", "newton", "linear"]);
    let page = std::fs::read_to_string(at("page/index.html")).expect("a page");
    for adapter in ["<h2>a, d</h2>", "<h2>another, d</h2>"] {
        assert!(page.contains(adapter), "{adapter}");
    }
    assert!(!page.contains("Missing"));
    assert!(refused(&["page", &first, &first, "-o", &at("x")]).contains("--against"));
    assert!(refused(&["page", &at("page/record.json"), "-o", &at("page")]).contains("overwritten"));
    assert!(refused(&["page", &first, "-o", &at("x.json")]).contains("folder"));
}

#[test]
fn techniques_fit_eighty_columns_and_nothing_else_is_said() {
    let output = Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .args(["list", "techniques"])
        .env("COLUMNS", "80")
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .expect("the program starts");
    assert_eq!((code(&output), stderr(&output)), (0, ""));
    for line in stdout(&output).lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let one = catoptric(&["list", "techniques", "linear"]);
    for part in ["start=center", "neighbours=4", "Szabo 2013"] {
        assert!(stdout(&one).contains(part), "{part}");
    }
    assert!(refused(&["list", "techniques", "liner"]).contains("linear"));
    let adapters = Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .args(["list", "adapters"])
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .expect("the program starts");
    assert!(
        !stderr(&adapters).contains("XDG_RUNTIME_DIR"),
        "{}",
        stderr(&adapters)
    );
}

#[test]
fn shells_get_completions_of_the_options_that_a_command_uses() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = catoptric(&["completions", shell]);
        assert_eq!((code(&output), stderr(&output)), (0, ""), "{shell}");
        assert!(stdout(&output).contains("compare"), "{shell}");
    }
    let help = catoptric(&["export", "--help"]);
    assert!(stdout(&help).contains("--bounces") && !stdout(&help).contains("--adapter"));
}

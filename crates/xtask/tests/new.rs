//! What `cargo xtask new` writes compiles, is listed, has shaders that link, and passes its tests:
//! one of each kind is made in a copy of the tree.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What is made: kind and name.
const MADE: [[&str; 2]; 4] = [
    ["search", "made-search"],
    ["refinement", "made-refinement"],
    ["image-order", "made-image-order"],
    ["metric", "made-metric"],
];

/// What of the tree is copied.
const COPIED: [&str; 5] = ["Cargo.toml", "Cargo.lock", "crates", "scenes", "shaders"];

/// Put into the manifest of the technique crate: its sources are compiled as one test, and nothing
/// else of them is.
const AS_A_TEST: &str = "
[[test]]
name = \"made\"
path = \"src/lib.rs\"
";

/// Copies a file or a folder. What is the same already keeps its time, so that cargo does not compile
/// it anew; what is too much is removed.
fn copy(from: &Path, to: &Path) {
    if from.is_file() {
        let bytes = fs::read(from).expect("a file");
        if fs::read(to).ok().as_ref() != Some(&bytes) {
            fs::write(to, bytes).expect("can be written");
        }
        return;
    }
    fs::create_dir_all(to).expect("a folder can be made");
    let names = |folder: &Path| {
        let entries = fs::read_dir(folder).expect("a folder");
        entries.map(|entry| entry.expect("an entry").file_name())
    };
    for name in names(from) {
        copy(&from.join(&name), &to.join(&name));
    }
    for extra in names(to).filter(|name| !from.join(name).exists()) {
        let extra = to.join(extra);
        let removed = if extra.is_dir() {
            fs::remove_dir_all(extra)
        } else {
            fs::remove_file(extra)
        };
        removed.expect("can be removed");
    }
}

fn cargo() -> std::ffi::OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// A copy of the tree with something new of each kind.
fn tree_with_new() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let tmp = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [made, built] = ["new-made", "new-built"].map(|name| tmp.join(name));
    fs::create_dir_all(&made).expect("a folder can be made");
    for name in COPIED {
        copy(&root.join(name), &made.join(name));
    }
    let manifest = made.join("crates/reflect/Cargo.toml");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    let text = text.replacen("[lib]\n", "[lib]\npath = \"nothing.rs\"\n", 1);
    fs::write(&manifest, text + AS_A_TEST).expect("can be written");
    fs::write(made.join("crates/reflect/nothing.rs"), "//! Nothing.\n").expect("can be written");
    for [kind, name] in MADE {
        let status = Command::new(env!("CARGO_BIN_EXE_xtask"))
            .args(["new", kind, name])
            .env("CARGO_MANIFEST_DIR", made.join("crates/xtask"))
            .status()
            .expect("xtask runs");
        assert!(status.success(), "cargo xtask new {kind} {name}");
    }
    let formatted = Command::new(cargo())
        .args(["fmt", "--all", "--check"])
        .current_dir(&made)
        .status()
        .expect("cargo runs");
    assert!(formatted.success(), "what is made is not formatted");
    copy(&made, &built);
    built
}

#[test]
fn what_is_made_compiles_and_runs() {
    let tree = tree_with_new();
    let target = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .expect("the target folder");
    // Third-party crates are found built; ours are built quickly, not for speed.
    let quickly = ["frame", "metrics", "reflect", "scene"]
        .map(|name| format!("--config=profile.release.package.catoptric-{name}.opt-level=0"));
    // Whole words: other tests tell of what is made too, and are slow where they are built quickly.
    let made = MADE.map(|[kind, name]| match kind {
        "metric" => format!("{}::", name.replace('-', "_")),
        _ => format!("::{}::", name.replace('-', "_")),
    });
    let output = Command::new(cargo())
        .args(["test", "--release", "--workspace"])
        .args(["--test=made", "--test=controls"])
        .args(quickly)
        .args(["--", "every_program_is_valid"])
        .args(&made)
        .env("CARGO_TARGET_DIR", target)
        .current_dir(&tree)
        .output()
        .expect("cargo runs");
    let stdout = String::from_utf8_lossy(&output.stdout);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{stdout}\n{stderr}");
    for tests in made {
        assert!(stdout.contains(&tests), "no test of {tests}\n{stdout}");
    }
    let table = fs::read_to_string(tree.join("crates/harness/src/record/table.rs"));
    assert!(table.expect("text").contains("\"more.made_metric\""));
    assert!(stdout.contains("every_program_is_valid"), "{stdout}");
}

//! Running the program, and looking at what it says.
#![allow(dead_code, reason = "no test file needs all of it")]

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// Small enough for a software adapter, large enough to show every object.
pub const SIZE: [&str; 2] = ["--resolution", "96x72"];

pub fn catoptric(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .args(args)
        .env_remove("CATOPTRIC_MODELS")
        .output()
        .expect("the program starts")
}

pub fn code(output: &Output) -> i32 {
    output.status.code().expect("the program ends by itself")
}

pub fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).expect("UTF-8")
}

pub fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).expect("UTF-8")
}

pub fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {output:?}"))
}

/// True where an adapter is there; false means skip. Fails instead of skipping where
/// `CATOPTRIC_REQUIRE_GPU=1` says that there must be one.
pub fn gpu_or_skip() -> bool {
    let doctor = catoptric(&["doctor", "--quiet"]);
    if code(&doctor) != 3 {
        return true;
    }
    let required = std::env::var("CATOPTRIC_REQUIRE_GPU").is_ok_and(|value| value == "1");
    assert!(
        !required,
        "CATOPTRIC_REQUIRE_GPU=1, and there is no adapter: {}",
        stderr(&doctor)
    );
    eprintln!("skipped: {}", stderr(&doctor));
    false
}

/// The message of an input that is refused: exit code 2, nothing on stdout, one line on stderr
/// unless clap adds its usage.
pub fn refused(args: &[&str]) -> String {
    let output = catoptric(args);
    assert_eq!(code(&output), 2, "{args:?}: {output:?}");
    assert_eq!(stdout(&output), "", "{args:?}");
    assert!(!stderr(&output).is_empty(), "{args:?}");
    stderr(&output).to_owned()
}

pub fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect()
}

/// Rows of a scene by several techniques, in its own size.
pub fn rows(scene: &str, techniques: &[&str]) -> Vec<Value> {
    let given = techniques.iter().flat_map(|technique| ["-t", technique]);
    let args: Vec<&str> = ["compare", scene, "--format", "json", "--time-budget", "0.1"]
        .into_iter()
        .chain(given)
        .collect();
    let output = catoptric(&args);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    match json(&output) {
        Value::Array(rows) => rows,
        other => panic!("no array: {other}"),
    }
}

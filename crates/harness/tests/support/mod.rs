//! Measuring with the library, running the program, and looking at what it says.
#![allow(dead_code, reason = "no test file needs all of it")]

use std::path::Path;
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::Duration;

use ::catoptric::options::Common;
use ::catoptric::record::{Record, Status};
use ::catoptric::run;
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
    /// Why there is none; asked once, since the program tests its clock before it answers.
    static MISSING: OnceLock<Option<String>> = OnceLock::new();
    let missing = MISSING.get_or_init(|| {
        let doctor = catoptric(&["doctor", "--quiet"]);
        (code(&doctor) == 3).then(|| stderr(&doctor).to_owned())
    });
    let Some(reason) = missing else {
        return true;
    };
    let required = std::env::var("CATOPTRIC_REQUIRE_GPU").is_ok_and(|value| value == "1");
    assert!(
        !required,
        "CATOPTRIC_REQUIRE_GPU=1, and there is no adapter: {reason}"
    );
    eprintln!("skipped: {reason}");
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

/// Rows of scenes by techniques as the library measures them, in pictures of `size` or of each
/// scene's own, timed for so many seconds a scene. No row may have failed.
pub fn measured(
    scenes: &[&str],
    techniques: &[&str],
    size: Option<[u32; 2]>,
    seconds: f64,
) -> Vec<Value> {
    measured_over(scenes, techniques, size, seconds, None)
}

/// The same, over so many frames of each scene's motion.
pub fn measured_over(
    scenes: &[&str],
    techniques: &[&str],
    size: Option<[u32; 2]>,
    seconds: f64,
    frames: Option<u32>,
) -> Vec<Value> {
    let owned =
        |names: &[&str]| -> Vec<String> { names.iter().map(|name| (*name).to_owned()).collect() };
    let timing = Duration::from_secs_f64(seconds);
    let wanted = run::product(&owned(scenes), &owned(techniques), timing, frames);
    let common = Common {
        resolution: size,
        quiet: true,
        ..Common::default()
    };
    let setup = run::Setup::new(&wanted, &common).expect("scenes, techniques and an adapter");
    let rows = run::measure(&setup, |_, _| Ok(())).expect("measurements");
    for row in &rows {
        assert_ne!(row.status, Status::Failed, "{:?}", row.reason);
    }
    rows.iter().map(Record::to_value).collect()
}

/// A number of a row, by its JSON pointer.
pub fn number(row: &Value, pointer: &str) -> f64 {
    let value = row.pointer(pointer).and_then(Value::as_f64);
    value.unwrap_or_else(|| panic!("{pointer} of {row}"))
}

//! The command line at its edges: arguments that are no text, options that a command cannot use, names
//! that command a terminal, readers that are gone, signals. No panic, nothing ignored in silence.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::support::{catoptric, code, files, gpu_or_skip, json, refused, stderr, stdout};

fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_catoptric"));
    command.env_remove("CATOPTRIC_MODELS");
    command
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn at(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).to_string_lossy().into_owned()
}

const RECORD: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../results/2026-12-01-llvmpipe/record.json"
);

#[test]
fn numbers_beyond_all_bounds_are_refused() {
    for (args, says) in [
        (
            &[
                "compare",
                "sphere-square",
                "-t",
                "linear",
                "--time-budget",
                "2e19",
            ][..],
            "seconds",
        ),
        (&["report", "--time-budget", "2e19"], "seconds"),
        (&["bench", "control", "--time-budget", "1e300"], "seconds"),
        (
            &[
                "export",
                "spheres",
                "--mitsuba",
                "m",
                "--bounces",
                "4294967295",
            ],
            "0 to 1000",
        ),
        (
            &["compare", "spheres", "-t", "linear+full+full"],
            "one refinement",
        ),
        (
            &["reference", "spheres", "--samples", "x", "-o", "o.exr"],
            "square number from 1 to 4096",
        ),
    ] {
        assert!(refused(args).contains(says), "{args:?}");
    }
}

#[test]
fn an_option_that_a_command_cannot_use_is_refused() {
    for (args, says) in [
        (
            &["export", "spheres", "--mitsuba", "m", "-o", "x"][..],
            "--mitsuba DIR says where to",
        ),
        (
            &["list", "adapters", "--adapter", "zzz"],
            "`list adapters` does not use --adapter",
        ),
        (&["list", "techniques", "--models", "."], "--models"),
        (
            &["--resolution", "8x6", "doctor"],
            "`doctor` does not use --resolution",
        ),
        (&["report", "--format", "json"], "record.json"),
        (
            &[
                "render",
                "spheres",
                "-t",
                "linear",
                "-o",
                "a.png",
                "--bounces",
                "3",
            ],
            "--bounces",
        ),
        (&["diff", "a.exr", "b.exr", "--adapter", "zzz"], "--adapter"),
        (&["check", "--adapter", "zzz"], "--adapter"),
        (
            &["summary", RECORD, "--into", "a.md", "-o", "b.md"],
            "--into",
        ),
    ] {
        assert!(refused(args).contains(says), "{args:?}: {}", refused(args));
    }
}

#[test]
fn a_summary_goes_where_it_is_told_to() {
    let folder = folder();
    for (name, begins) in [("a.md", "Recorded "), ("a.csv", "scene,"), ("a.json", "[")] {
        let output = catoptric(&["summary", RECORD, "-o", &at(&folder, name)]);
        assert_eq!((code(&output), stdout(&output)), (0, ""), "{output:?}");
        let text = std::fs::read_to_string(at(&folder, name)).expect("a summary");
        assert!(text.starts_with(begins), "{name}: {text}");
    }
}

#[test]
fn a_record_is_read_as_any_editor_writes_it() {
    let folder = folder();
    let record = std::fs::read_to_string(RECORD).expect("a record");
    std::fs::write(at(&folder, "bom.json"), format!("\u{feff}{record}")).expect("a record");
    let output = catoptric(&["summary", &at(&folder, "bom.json"), "--format", "csv"]);
    assert_eq!(code(&output), 0, "{output:?}");
    for (bytes, says) in [
        (&b"\xff\xfe[\0]\0"[..], "UTF-16"),
        (b"[1,", "is no JSON"),
        (
            b"{\"name\": \"somebody\"}",
            "a record is what `compare -o FILE.json` writes",
        ),
    ] {
        std::fs::write(at(&folder, "other.json"), bytes).expect("a file");
        let args = ["compare", "spheres", "-t", "linear", "--against"];
        let message = refused(&[&args[..], &[&at(&folder, "other.json")]].concat());
        assert!(
            message.contains(says) && message.contains("other.json"),
            "{message}"
        );
    }
}

#[test]
fn a_page_is_written_into_a_folder() {
    if !gpu_or_skip() {
        return;
    }
    let folder = folder();
    let message = refused(&["report", "-o", &at(&folder, "r.json"), "--quiet"]);
    assert!(message.contains("a folder is written here"), "{message}");
    std::fs::create_dir(at(&folder, "site")).expect("a folder");
    std::fs::write(at(&folder, "site/index.html"), "<title>mine</title>").expect("a page");
    let message = refused(&["report", "-o", &at(&folder, "site"), "--quiet"]);
    assert!(
        message.contains("was not written by catoptric"),
        "{message}"
    );
    assert_eq!(files(folder.path()), ["site"]);
    assert_eq!(files(&folder.path().join("site")), ["index.html"]);
}

#[test]
fn what_is_no_file_name_is_refused_before_the_work() {
    let folder = folder();
    let long = format!("{}.exr", "n".repeat(251));
    let small = [
        "reference",
        "sphere-square",
        "--resolution",
        "8x6",
        "--quiet",
        "-o",
    ];
    let output = catoptric(&[&small[..], &[&at(&folder, &long)]].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    assert_eq!(files(folder.path()), [long.as_str()]);
    // A scene that would take long.
    let large = [
        "reference",
        "sphere-square",
        "--resolution",
        "4096x4096",
        "-o",
    ];
    let longer = format!("n{long}");
    assert!(refused(&[&large[..], &[&at(&folder, &longer)]].concat()).contains("cannot write"));
    if cfg!(unix) {
        let message = refused(&[&large[..], &["/dev/null"]].concat());
        assert!(message.contains("is a device"), "{message}");
        let compare = [
            "compare",
            "sphere-square",
            "-t",
            "linear",
            "-o",
            "/dev/null",
        ];
        assert!(refused(&compare).contains("is a device"));
    }
    assert_eq!(files(folder.path()), [long.as_str()]);
}

#[cfg(target_os = "linux")]
fn full() -> Stdio {
    let full = std::fs::File::options().write(true).open("/dev/full");
    full.expect("a device that is always full").into()
}

#[cfg(target_os = "linux")]
#[test]
fn who_cannot_be_told_anything_gets_the_work_done() {
    let folder = folder();
    let mut reference = program();
    reference.args(["reference", "sphere-square", "--resolution", "8x6", "-o"]);
    reference.arg(at(&folder, "o.exr")).stderr(full());
    assert_eq!(reference.status().expect("a program").code(), Some(0));
    assert_eq!(files(folder.path()), ["o.exr"]);
    let status = |args: &[&str]| program().args(args).stderr(full()).status();
    assert_eq!(
        status(&["reference", "no-such"]).expect("an end").code(),
        Some(2)
    );
    assert_eq!(
        status(&["compare", "--nonsense"]).expect("an end").code(),
        Some(2)
    );
    if gpu_or_skip() {
        let compare = [
            "compare",
            "sphere-square",
            "-t",
            "linear",
            "--resolution",
            "8x6",
        ];
        let budget = ["--time-budget", "0.01"];
        let ended = status(&[&compare[..], &budget].concat());
        assert_eq!(ended.expect("an end").code(), Some(0));
    }
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_gone_away_is_no_error() {
    let mut listing = program();
    listing.args(["list", "scenes", "--format", "json"]);
    let mut child = listing
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("a program");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("an end");
    assert_eq!((code(&output), stderr(&output)), (0, ""), "{output:?}");
}

#[test]
fn names_do_not_command_a_terminal() {
    let folder = folder();
    let clear = "\u{1b}[2J\u{9b}2J";
    let scene = format!(
        "why = \"x\"\n[camera]\neye = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 34.0\n[[object]]\n\
         name = \"\\u001b[2J\"\nshape = \"{}\"\n",
        "\\u009b2J"
    );
    std::fs::write(at(&folder, "scene.toml"), scene).expect("a scene");
    std::fs::write(
        at(&folder, "a.json"),
        format!("{{\"scene\": \"{}\"}}", "\\u001b[2J"),
    )
    .expect("a sidecar");
    let to = at(&folder, "a.exr");
    let odd = |args: &[&str]| {
        let output = catoptric(args);
        assert_eq!(code(&output), 2, "{output:?}");
        let said = format!("{}{}", stdout(&output), stderr(&output));
        assert!(
            !said.contains('\u{1b}') && !said.contains('\u{9b}'),
            "{said:?}"
        );
        assert!(said.contains("2J"), "{said:?}");
    };
    odd(&["reference", clear, "-o", &to]);
    odd(&["reference", &at(&folder, "scene.toml"), "-o", &to]);
    odd(&["compare", "spheres", "-t", clear]);
    odd(&["compare", "spheres", "-t", "linear", "--time-budget", clear]);
    odd(&["bench", clear]);
    odd(&["compare", "spheres", "-t", "linear", "--against", clear]);
}

#[cfg(unix)]
#[test]
fn an_argument_need_not_be_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    if !gpu_or_skip() {
        return;
    }
    let parent = folder();
    let inside = parent.path().join(OsStr::from_bytes(b"n\xff"));
    std::fs::create_dir(&inside).expect("a folder");
    let run = |verb: &[&str], to: &Path, more: &[&OsStr]| -> Output {
        let mut command = program();
        command
            .args(verb)
            .args(["--resolution", "8x6", "--time-budget", "0.01", "--quiet"]);
        command
            .arg("-o")
            .arg(to)
            .args(more)
            .output()
            .expect("an end")
    };
    let compare = ["compare", "sphere-square", "-t", "linear"];
    let record = inside.join("r.json");
    let output = run(&compare, &record, &[]);
    assert_eq!(code(&output), 0, "{output:?}");
    let against = [OsStr::new("--against"), record.as_os_str()];
    let output = run(&compare, &inside.join("s.json"), &against);
    assert_eq!(code(&output), 0, "{output:?}");
    let models = [OsStr::new("--models"), inside.as_os_str()];
    let output = run(
        &["bench", "control", "--scene", "sphere-square"],
        &inside.join("b"),
        &models,
    );
    assert_eq!(code(&output), 0, "{output:?}");
    let page = std::fs::read_to_string(inside.join("b/index.html")).expect("a page");
    assert!(
        page.contains("n\u{fffd}/b"),
        "the command, as far as it can be shown"
    );
}

#[cfg(unix)]
#[test]
fn a_signal_leaves_no_temporary_file() {
    let folder = folder();
    let to = at(&folder, "o.exr");
    for pause in [0, 5, 20, 60, 150, 300] {
        let mut child = program()
            .args([
                "reference",
                "sphere-table",
                "--resolution",
                "640x480",
                "-o",
                &to,
            ])
            .stderr(Stdio::null())
            .spawn()
            .expect("a program");
        std::thread::sleep(std::time::Duration::from_millis(pause));
        let id = child.id().to_string();
        let sent = Command::new("kill")
            .args(["-TERM", &id])
            .stderr(Stdio::null())
            .status();
        let _ = sent.expect("kill");
        let ended = child.wait().expect("an end");
        let left = files(folder.path());
        assert!(left.is_empty() || left == ["o.exr"], "{ended:?}: {left:?}");
    }
}

#[test]
fn what_a_killed_program_left_is_swept_by_the_next() {
    let folder = folder();
    std::fs::write(at(&folder, ".catoptric-old.tmp"), "killed").expect("a file");
    let args = [
        "reference",
        "sphere-square",
        "--resolution",
        "8x6",
        "--quiet",
        "-o",
    ];
    let output = catoptric(&[&args[..], &[&at(&folder, "o.exr")]].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    assert_eq!(files(folder.path()), ["o.exr"]);
}

#[test]
fn each_diagram_is_in_the_file_that_its_name_says() {
    if !gpu_or_skip() {
        return;
    }
    let folder = folder();
    let to = at(&folder, "b");
    let args = [
        "bench",
        "estalella",
        "--scene",
        "sphere-square",
        "--quiet",
        "-o",
        &to,
    ];
    let more = ["--resolution", "16x12", "--time-budget", "0.01"];
    let output = catoptric(&[&args[..], &more].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    // The record's own name of each number: what the diagram is about.
    let called = [
        (
            "density.vertices.searched.svg",
            "vertices searched, all mirrors",
        ),
        (
            "density.coverage.missing.svg",
            "share of mirror pixels with an object missing",
        ),
        ("iterations.work.evaluations.svg", "evaluations per vertex"),
    ];
    for (file, title) in called {
        let svg = std::fs::read_to_string(folder.path().join("b/figures").join(file));
        let svg = svg.unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(
            svg.contains(&format!("<title>{title} against ")),
            "{file}: {svg:.300}"
        );
    }
    let page = std::fs::read_to_string(folder.path().join("b/index.html")).expect("a page");
    for file in files(&folder.path().join("b/figures")) {
        assert!(
            file.starts_with('.') || page.contains(&file),
            "{file} is not on the page"
        );
    }
    let rows = catoptric(&["summary", &at(&folder, "b/record.json"), "--format", "json"]);
    assert!(json(&rows).as_array().is_some_and(|rows| !rows.is_empty()));
}

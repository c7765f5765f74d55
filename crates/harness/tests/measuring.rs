//! Commands that need an adapter; skipped where there is none, unless `CATOPTRIC_REQUIRE_GPU=1`.

#[path = "../src/schema.rs"]
#[allow(
    dead_code,
    reason = "a module of the program, of which only the check is needed here"
)]
mod schema;
mod support;

use serde_json::Value;
use support::{SIZE, catoptric, code, gpu_or_skip, json, stderr, stdout};

#[test]
fn records_keep_to_the_schema_in_the_order_asked_for() {
    if !gpu_or_skip() {
        return;
    }
    let cross = "linear(residual=cross)";
    let args = [
        "compare",
        "sphere-square",
        "teapot-ball",
        "spheres",
        "-t",
        "linear",
        "-t",
        cross,
    ];
    let output = catoptric(
        &[
            &args,
            SIZE.as_slice(),
            &["--format", "json", "--time-budget", "0.1"],
        ]
        .concat(),
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = json(&output);
    assert_eq!(
        schema::violations(&schema::records(), &rows),
        Vec::<String>::new()
    );
    let names = |row: &Value| {
        format!("{} {} {}", row["scene"], row["technique"], row["status"]).replace('"', "")
    };
    let found: Vec<String> = rows.as_array().into_iter().flatten().map(names).collect();
    let expected = ["sphere-square", "teapot-ball", "spheres"]
        .into_iter()
        .flat_map(|scene| {
            let status = if scene == "teapot-ball" {
                "not-applicable"
            } else {
                "ok"
            };
            ["linear", cross].map(|technique| format!("{scene} {technique} {status}"))
        });
    assert_eq!(found, expected.collect::<Vec<_>>());
    assert!(rows[0]["coverage"]["mirror_pixels"].as_u64() > Some(100));
    assert!(
        rows[0]["vertices"]["searched"] == 4 && rows[0]["work"]["evaluations"].as_f64() > Some(1.0)
    );
    assert!(rows[0]["time_ms"]["wall"]["median"].as_f64() > Some(0.0));
    assert!(rows[2]["reason"].is_string() && rows[2]["coverage"].is_null());
}

#[test]
fn a_gate_trips_and_the_row_is_printed_all_the_same() {
    if !gpu_or_skip() {
        return;
    }
    let run = |gate: &str| {
        let args = [
            "compare",
            "sphere-square",
            "-t",
            "linear",
            "--time-budget",
            "0.1",
            "--format",
            "json",
        ];
        catoptric(&[&args, SIZE.as_slice(), &["--require", gate]].concat())
    };
    let held = run("object_agreement>=0");
    assert_eq!(code(&held), 0, "{}", stderr(&held));
    let tripped = run("object_agreement>=1.1");
    assert_eq!(code(&tripped), 1);
    assert!(
        stderr(&tripped).contains("object_agreement >= 1.1"),
        "{}",
        stderr(&tripped)
    );
    assert_eq!(json(&tripped).as_array().map(Vec::len), Some(1));
    assert_eq!(
        code(&run("temporal.jumps<=1")),
        1,
        "a metric that is null holds nothing"
    );
}

#[test]
fn a_run_compared_with_itself_is_unchanged_but_for_time() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder
        .path()
        .join("record.json")
        .to_string_lossy()
        .into_owned();
    let args = [
        &[
            "compare",
            "sphere-square",
            "-t",
            "linear",
            "--time-budget",
            "0.1",
        ],
        SIZE.as_slice(),
    ]
    .concat();
    assert_eq!(
        code(&catoptric(&[args.as_slice(), &["-o", &path]].concat())),
        0
    );
    let kept: Value =
        serde_json::from_slice(&std::fs::read(&path).expect("a record")).expect("JSON");
    assert_eq!(
        schema::violations(&schema::records(), &kept),
        Vec::<String>::new()
    );
    assert!(
        kept[0]["raw"]["wall_ms"]
            .as_array()
            .is_some_and(|samples| samples.len() >= 5)
    );
    let again = catoptric(&[args.as_slice(), &["--against", &path, "--format", "csv"]].concat());
    let changed = stdout(&again)
        .lines()
        .skip(1)
        .filter(|line| !line.contains(",time_ms"));
    assert!(
        changed.clone().all(|line| line.contains("unchanged")),
        "{}",
        stdout(&again)
    );
}

#[test]
fn a_technique_renders_a_picture_with_all_layers() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for name in ["a.exr", "a.png"] {
        let path = at(name);
        let output = catoptric(
            &[
                &["render", "spheres", "-t", "linear", "-o", &path],
                SIZE.as_slice(),
            ]
            .concat(),
        );
        assert_eq!((code(&output), stdout(&output)), (0, ""), "{output:?}");
    }
    let facts = json(&catoptric(&[
        "diff",
        &at("a.exr"),
        &at("a.exr"),
        "--format",
        "json",
    ]));
    assert!(facts["object_agreement"] == 1.0, "{facts}");
    let limit = catoptric(&[
        "render",
        "spheres",
        "-t",
        "linear",
        "--resolution",
        "60000x8",
        "-o",
        &at("b.exr"),
    ]);
    assert_eq!(code(&limit), 2, "{limit:?}");
}

#[test]
fn a_report_is_one_folder_that_needs_nothing_else() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let output = catoptric(
        &[
            &[
                "report",
                "--quiet",
                "--time-budget",
                "0.1",
                "-o",
                &path.to_string_lossy(),
            ],
            SIZE.as_slice(),
        ]
        .concat(),
    );
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = std::fs::read_to_string(path.join("index.html")).expect("a page");
    assert!(!page.contains("http://") && !page.contains("https://"));
    let sources = page
        .split("src=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next());
    assert!(sources.clone().count() > 20);
    for source in sources {
        assert!(path.join(source).is_file(), "{source}");
    }
    let rows: Value =
        serde_json::from_slice(&std::fs::read(path.join("record.json")).expect("a record"))
            .expect("JSON");
    let mut scenes: Vec<&str> = rows
        .as_array()
        .into_iter()
        .flatten()
        .filter(|row| row["status"] == "ok")
        .filter_map(|row| row["scene"].as_str())
        .collect();
    scenes.dedup();
    assert!(scenes.len() >= 6, "{scenes:?}");
}

#[test]
fn a_suite_on_a_scene_of_ones_own_is_one_folder() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let to = path.to_string_lossy();
    let args = ["bench", "search", "--scene", "sphere-square", "--quiet"];
    let more = ["--time-budget", "0.1", "-o", &to];
    let output = catoptric(&[args.as_slice(), &more, SIZE.as_slice()].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = std::fs::read_to_string(path.join("index.html")).expect("a page");
    let named = |attribute: &str| -> Vec<String> {
        let start = format!("{attribute}=\"");
        let parts = page.split(&start).skip(1);
        let found = parts.filter_map(|rest| rest.split('"').next());
        found
            .filter(|name| !name.starts_with('#'))
            .map(str::to_owned)
            .collect()
    };
    let files = [named("src"), named("href")].concat();
    assert!(files.len() > 10, "{files:?}");
    for file in files {
        assert!(path.join(&file).is_file(), "{file}");
    }
    assert!(page.contains("bench search --scene sphere-square"));
    let rows: Value =
        serde_json::from_slice(&std::fs::read(path.join("record.json")).expect("a record"))
            .expect("JSON");
    let violations = schema::violations(&schema::records(), &rows);
    assert_eq!(violations, Vec::<String>::new());
}

#[test]
fn frames_give_jitter_and_a_still_scene_has_none() {
    if !gpu_or_skip() {
        return;
    }
    let args = ["compare", "sphere-table", "-t", "linear(start=previous)"];
    let more = ["--frames", "3", "--time-budget", "0.1", "--format", "json"];
    let output = catoptric(&[args.as_slice(), &more, SIZE.as_slice()].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = json(&output);
    let temporal = &rows[0]["temporal"];
    assert_eq!(temporal["frames"], 3);
    assert_eq!(temporal["jitter_px"]["max"], 0.0, "{temporal}");
    assert_eq!(temporal["jumps"], 0.0);
    // From its own last answer a walk looks at its neighbours, four at most, once and stays.
    assert_eq!(temporal["steps"], 1.0, "{temporal}");
    assert!(temporal["evaluations"].as_f64() <= Some(5.0), "{temporal}");
    let violations = schema::violations(&schema::records(), &rows);
    assert_eq!(violations, Vec::<String>::new());
}

#[test]
fn nothing_is_left_where_nothing_can_be_written() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "kept").expect("a file");
    let below = file.join("out").to_string_lossy().into_owned();
    let file = file.to_string_lossy().into_owned();
    for path in [&file, &below] {
        for command in [&["report"][..], &["bench", "search"]] {
            let output = catoptric(&[command, &["--quiet", "-o", path]].concat());
            assert_eq!((code(&output), stdout(&output)), (2, ""), "{output:?}");
            assert!(stderr(&output).contains(path.as_str()), "{output:?}");
        }
    }
    assert_eq!(std::fs::read_to_string(&file).ok().as_deref(), Some("kept"));
}

#[test]
fn doctor_tests_the_clock() {
    if !gpu_or_skip() {
        return;
    }
    let facts = json(&catoptric(&["doctor", "--format", "json"]));
    assert!(
        facts["adapter"]["name"]
            .as_str()
            .is_some_and(|name| !name.is_empty()),
        "{facts}"
    );
    assert!(!facts["timestamps"].is_null() && !facts["limits"].is_null());
}

#[test]
fn an_interrupted_run_keeps_what_was_finished() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("record.json");
    let scenes = ["sphere-square"; 30];
    let child = std::process::Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .arg("compare")
        .args(scenes)
        .args([
            "-t",
            "linear",
            "--time-budget",
            "1",
            "--format",
            "json",
            "-o",
        ])
        .arg(&path)
        .args(SIZE)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    while !path.exists() {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let interrupt = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(interrupt.expect("kill").success());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("interrupted after"),
        "{}",
        stderr(&output)
    );
    let kept: Value =
        serde_json::from_slice(&std::fs::read(&path).expect("a record")).expect("JSON");
    let rows = kept.as_array().map_or(0, Vec::len);
    assert!((1..scenes.len()).contains(&rows), "{rows}");
    assert_eq!(json(&output).as_array().map(Vec::len), Some(rows));
}

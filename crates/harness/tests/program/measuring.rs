//! Commands that need an adapter; skipped where there is none, unless `CATOPTRIC_REQUIRE_GPU=1`.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use crate::support::{SIZE, catoptric, code, gpu_or_skip, json, stderr, stdout};
use ::catoptric::record::schema;
use catoptric_frame::Frame;
use catoptric_frame::png::srgb8_from_linear;
use serde_json::Value;

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
    assert_eq!(channels(&at("a.exr")), CHANNELS);
    let frame = Frame::read_exr(at("a.exr")).expect("the picture just written");
    let shown = image::open(at("a.png")).expect("a picture").to_rgb8();
    let pixels: Vec<[u8; 3]> = shown.pixels().map(|pixel| pixel.0).collect();
    let colors = frame.color.pixels().iter();
    let expected: Vec<[u8; 3]> = colors.map(|color| srgb8_from_linear(*color)).collect();
    assert_eq!([shown.width(), shown.height()], frame.color.size());
    assert_eq!(pixels, expected);

    // It shows what the reference shows, up to the technique's error, which is not none.
    let truth = at("truth.exr");
    let traced = catoptric(&[&["reference", "spheres", "-o", &truth], SIZE.as_slice()].concat());
    assert_eq!(code(&traced), 0, "{traced:?}");
    let facts = json(&catoptric(&[
        "diff",
        &truth,
        &at("a.exr"),
        "--format",
        "json",
    ]));
    let agreement = facts["object_agreement"].as_f64().expect("a share");
    assert!((0.5..1.0).contains(&agreement), "{facts}");
    assert!(
        facts["angular_error_deg"]["p50"].as_f64() > Some(0.0),
        "{facts}"
    );
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

/// Channels of every picture with all layers: those of the picture formats' contract, and which
/// pixels are resolved.
const CHANNELS: [&str; 16] = [
    "B",
    "G",
    "R",
    "primary.id",
    "primary.normal.X",
    "primary.normal.Y",
    "primary.normal.Z",
    "primary.position.X",
    "primary.position.Y",
    "primary.position.Z",
    "reflected.distance",
    "reflected.id",
    "reflected.position.X",
    "reflected.position.Y",
    "reflected.position.Z",
    "reflected.status",
];

/// Names of an EXR's channels, in the file's (alphabetical) order.
fn channels(path: &str) -> Vec<String> {
    let meta = exr::meta::MetaData::read_from_file(path, false).expect("an EXR");
    let channels = meta.headers[0].channels.list.iter();
    channels.map(|channel| channel.name.to_string()).collect()
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
                // All scenes take minutes, and are no other than these.
                "--part",
                "1/3",
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
    // The name of SVG's elements leads nowhere.
    let links = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!links.contains("http://") && !links.contains("https://"));
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
    assert!(scenes.len() >= 3, "{scenes:?}");
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
    // Something is said to move, and goes nowhere.
    let still = "\n[motion]\nframes = 3\n[[motion.move]]\nname = \"ball\"\ntranslate = [0, 0, 0]\n";
    let text = include_str!("../../../../scenes/sphere-table.toml").to_owned() + still;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("still.toml");
    std::fs::write(&path, text).expect("a scene file");
    let scene = path.to_string_lossy();
    let args = ["compare", &scene, "-t", "linear(start=previous)"];
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
fn the_least_agreement_over_the_frames_is_known_of_every_technique() {
    if !gpu_or_skip() {
        return;
    }
    let args = ["compare", "moving-ball-all", "-t", "ray-trace", "linear"];
    let more = [
        "--frames",
        "12",
        "--time-budget",
        "0.05",
        "--format",
        "json",
    ];
    let output = catoptric(&[args.as_slice(), &more, SIZE.as_slice()].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = json(&output);
    let least = |row: usize| rows[row]["temporal"]["object_agreement_min"].as_f64();
    // Where everything has moved, it is still the reference of that frame that a picture is judged
    // by; and a technique that searches no vertices has no jitter.
    assert!(least(0) > Some(0.995), "{}", rows[0]["temporal"]);
    assert!(rows[0]["temporal"]["jitter_px"].is_null());
    assert_eq!(rows[0]["temporal"]["frames"], 12);
    let first = rows[1]["object_agreement"].as_f64();
    assert!(
        least(1) <= first && least(1) > Some(0.8),
        "{}",
        rows[1]["temporal"]
    );
    assert!(rows[1]["temporal"]["jitter_px"]["mean"].as_f64() > Some(0.0));
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
fn a_scene_without_motion_has_no_frames_to_follow() {
    if !gpu_or_skip() {
        return;
    }
    let args = ["compare", "sphere-table", "-t", "linear", "--frames", "3"];
    let more = ["--time-budget", "0.05", "--format", "json"];
    let output = catoptric(&[args.as_slice(), &more, SIZE.as_slice()].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = json(&output);
    assert!(rows[0]["temporal"].is_null(), "{}", rows[0]["temporal"]);
    assert!(
        stderr(&output).contains("no [motion]"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn records_are_written_as_their_file_is_called() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rows.csv");
    let to = path.to_string_lossy();
    // A name for the defaults, in another order and spelling.
    let technique = "linear(residual=cross, neighbours=8, start=center)";
    let args = ["compare", "sphere-square", "-t", technique, "-o", &to];
    let more = ["--time-budget", "0.05", "--format", "json"];
    let output = catoptric(&[args.as_slice(), &more, SIZE.as_slice()].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(
        json(&output)[0]["technique"],
        "linear(neighbours=8,residual=cross)"
    );
    let written = std::fs::read_to_string(&path).expect("a table");
    let lines: Vec<&str> = written.lines().collect();
    assert_eq!(lines.len(), 2, "{written}");
    assert!(
        lines[0].starts_with("scene,technique,resolution,"),
        "{written}"
    );
    assert!(lines[1].starts_with("sphere-square,\"linear(neighbours=8,residual=cross)\""));
}

/// Starts the program, waits until it has written `record`, interrupts it, and lets it end.
fn interrupted(args: &[&str], record: &Path) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .args(args)
        .env_remove("CATOPTRIC_MODELS")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    while !record.exists() {
        let ended = child.try_wait().expect("a child of ours");
        assert!(ended.is_none(), "ended without a record: {ended:?}");
        std::thread::sleep(Duration::from_millis(20));
    }
    let interrupt = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(interrupt.expect("kill").success());
    child.wait_with_output().expect("the program ends")
}

/// The rows of a record, checked against the schema.
fn recorded(path: &Path) -> Vec<Value> {
    let text = std::fs::read(path).expect("a record");
    let rows: Value = serde_json::from_slice(&text).expect("JSON");
    let violations = schema::violations(&schema::records(), &rows);
    assert_eq!(violations, Vec::<String>::new());
    rows.as_array().cloned().unwrap_or_default()
}

#[test]
fn an_interrupted_comparison_keeps_what_was_finished() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("record.json");
    let to = path.to_string_lossy();
    let scenes = [
        "sphere-square",
        "sphere-drawn-8",
        "sphere-drawn-16",
        "sphere-drawn-32",
        "sphere-grid-100",
        "sphere-grid-300",
        "spheres",
        "planar",
        "ellipsoid",
        "torus",
        "room",
        "box",
    ];
    let more = [
        "-t",
        "linear",
        "--time-budget",
        "1",
        "--format",
        "json",
        "-o",
        &to,
    ];
    let args = [&["compare"], scenes.as_slice(), &more, SIZE.as_slice()].concat();
    let output = interrupted(&args, &path);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("interrupted after"),
        "{}",
        stderr(&output)
    );
    let rows = recorded(&path).len();
    assert!((1..scenes.len()).contains(&rows), "{rows}");
    assert_eq!(json(&output).as_array().map(Vec::len), Some(rows));
}

#[test]
fn an_interrupted_report_is_a_page_of_what_was_finished() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let (record, to) = (path.join("record.json"), path.to_string_lossy());
    let args = ["report", "--time-budget", "1", "-o", &to];
    let output = interrupted(&[args.as_slice(), &SIZE].concat(), &record);
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(
        stderr(&output).contains("interrupted after"),
        "{}",
        stderr(&output)
    );
    let rows = recorded(&record);
    let (first, last) = (&rows[0]["scene"], &rows[rows.len() - 1]["scene"]);
    let page = std::fs::read_to_string(path.join("index.html")).expect("a page");
    assert!(page.contains("<b>Not finished:</b>"));
    for scene in [first, last] {
        assert!(page.contains(scene.as_str().expect("a name")), "{scene}");
    }
    // The last scene of the suite is not among them.
    assert!(
        !rows.iter().any(|row| row["scene"] == "sphere-touching"),
        "{last}"
    );
}

#[test]
fn progress_fills_where_a_scene_is_not_there() {
    use ::catoptric::{options::Common, run};
    if !gpu_or_skip() {
        return;
    }
    let names = |name: &str| [name.to_owned()];
    let wanted = run::product(
        &names("teapot-ball"),
        &names("linear"),
        Duration::from_millis(1),
        None,
    );
    let common = Common {
        quiet: true,
        ..Common::default()
    };
    let setup = run::Setup::new(&wanted, &common).expect("an adapter");
    let begun = setup.progress.left();
    let mut left = begun;
    let rows = run::measure(&setup, |_, _| {
        left = setup.progress.left();
        Ok(())
    });
    assert_eq!(rows.expect("rows").len(), 1);
    assert_eq!((begun > 0, left), (true, 0));
}

//! The program as a user meets it, as far as no adapter is needed: arguments in; exit code, stdout,
//! stderr and files out.

use crate::support::{SIZE, catoptric, code, files, json, refused, stderr, stdout};
use serde_json::Value;

#[test]
fn scenes_are_listed_with_what_they_hold() {
    let output = catoptric(&["list", "scenes", "--format", "json"]);
    assert_eq!(code(&output), 0);
    let rows = json(&output);
    let rows = rows.as_array().expect("an array");
    assert!(rows.len() >= 20);
    for row in rows {
        let mut keys: Vec<&str> = row
            .as_object()
            .expect("an object")
            .keys()
            .map(String::as_str)
            .collect();
        keys.sort_unstable();
        assert_eq!(
            keys,
            [
                "available",
                "mirrors",
                "name",
                "objects",
                "reason",
                "triangles",
                "vertices",
                "why"
            ]
        );
        assert_eq!(row["available"] == true, row["reason"].is_null(), "{row}");
        assert!(row["why"].as_str().is_some_and(|why| !why.is_empty()));
    }
    let table = rows
        .iter()
        .find(|row| row["name"] == "sphere-table")
        .expect("the table scene");
    assert!(
        table["available"] == true
            && table["mirrors"] == 1
            && table["triangles"].as_u64() > Some(100)
    );
    let sponza = rows
        .iter()
        .find(|row| row["name"] == "sponza-ball")
        .expect("the Sponza scene");
    assert!(
        sponza["available"] == false && sponza["reason"].is_string(),
        "{sponza}"
    );
}

#[test]
fn techniques_are_listed_with_their_options() {
    let output = catoptric(&["list", "techniques", "--format", "json"]);
    assert_eq!(code(&output), 0);
    let rows = json(&output);
    let linear = rows
        .as_array()
        .into_iter()
        .flatten()
        .find(|row| row["name"] == "linear")
        .expect("linear");
    assert_eq!(linear["available"], true);
    let options = linear["options"].as_array().expect("options");
    for name in ["start", "neighbours", "residual"] {
        assert!(
            options.iter().any(|option| option["name"] == name),
            "{name} in {linear}"
        );
    }
    let mut all = rows.as_array().into_iter().flatten();
    assert!(all.all(|row| row["available"] == true && row["reason"].is_null()));
}

#[test]
fn listings_come_in_every_format() {
    for (format, start) in [
        ("table", "name "),
        ("csv", "name,available,"),
        ("markdown", "| name"),
    ] {
        let output = catoptric(&["list", "scenes", "--format", format]);
        assert!(
            stdout(&output).starts_with(start),
            "{format}: {}",
            stdout(&output)
        );
    }
    let adapters = catoptric(&["list", "adapters", "--format", "json"]);
    assert!([0, 3].contains(&code(&adapters)), "{adapters:?}");
}

#[test]
fn listings_go_into_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for (name, start) in [
        ("a.json", "["),
        ("a.csv", "name,"),
        ("a.md", "| name"),
        ("a", "search: "),
    ] {
        let output = catoptric(&["list", "techniques", "-o", &at(name)]);
        assert_eq!((code(&output), stdout(&output)), (0, ""), "{output:?}");
        let text = std::fs::read_to_string(at(name)).expect("a listing");
        assert!(text.starts_with(start), "{name}: {text}");
    }
    let nowhere = at("nowhere/a.json");
    assert!(refused(&["list", "techniques", "-o", &nowhere]).contains(&nowhere));
}

#[test]
fn suites_are_listed_where_one_asks() {
    let output = catoptric(&["bench", "--help"]);
    assert_eq!(code(&output), 0);
    for suite in ["search", "tessellation", "estalella", "cubemap"] {
        let line = |line: &&str| line.trim_start().starts_with(suite);
        assert!(stdout(&output).lines().any(|text| line(&text)), "{suite}");
    }
    let message = refused(&["bench", "foo"]);
    assert!(message.contains("there are: search,") && !message.contains("did you mean"));
}

#[test]
fn a_pair_is_measured_once() {
    let message = |args: &[&str]| refused(&[&["compare"], args].concat());
    let twice = message(&["spheres", "-t", "linear", "linear"]);
    assert!(twice.contains("`linear` is given twice"), "{twice}");
    let same = message(&["spheres", "-t", "linear", "linear(residual=dot)"]);
    assert!(same.contains("are one technique, `linear`"), "{same}");
    let option = message(&["spheres", "-t", "linear(neighbours=4,neighbours=8)"]);
    assert!(option.contains("`neighbours` is given twice"), "{option}");
    let scene = message(&["spheres", "planar", "spheres", "-t", "linear"]);
    assert!(scene.contains("scene `spheres` is given twice"), "{scene}");

    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, SCENE).expect("a scene file");
        path.to_string_lossy().into_owned()
    };
    let (a, b) = (file("a/s.toml"), file("b/s.toml"));
    let collide = message(&[&a, &b, "-t", "linear"]);
    assert!(
        collide.contains("both be recorded as scene `s`"),
        "{collide}"
    );
    let spheres = file("spheres.toml");
    let collide = message(&["spheres", &spheres, "-t", "linear"]);
    assert!(
        collide.contains("both be recorded as scene `spheres`"),
        "{collide}"
    );
    let again = file("a/../a/s.toml");
    let twice = message(&[&a, &again, "-t", "linear"]);
    assert!(twice.contains("given twice"), "{twice}");
}

#[test]
fn a_models_folder_is_there_or_not_named() {
    let list = |models: &[&str], variable: &str| {
        std::process::Command::new(env!("CARGO_BIN_EXE_catoptric"))
            .args(["list", "scenes", "--format", "csv"])
            .args(models)
            .env("CATOPTRIC_MODELS", variable)
            .output()
            .expect("the program starts")
    };
    assert_eq!(code(&list(&[], "")), 0);
    for output in [list(&["--models", "/no/such"], ""), list(&[], "/no/such")] {
        assert_eq!((code(&output), stdout(&output)), (2, ""), "{output:?}");
        assert!(stderr(&output).contains("no folder /no/such"), "{output:?}");
    }
}

#[test]
fn a_baseline_is_a_record() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("old.json");
    let to = path.to_string_lossy();
    let message = |text: &str| {
        std::fs::write(&path, text).expect("a file");
        let message = refused(&["compare", "spheres", "-t", "linear", "--against", &to]);
        assert!(message.len() < 300, "{message}");
        message
    };
    let row = r#"{ "schema_version": 1, "scene": "spheres", "technique": "linear",
        "resolution": [4, 4], "status": "ok", "meta": {}, "object_agreement": "much" }"#;
    let object = message(&format!("{{ \"rows\": [{row}] }}"));
    assert!(
        object.contains("an object is not of type array"),
        "{object}"
    );
    let number = message(&format!("[{row}]"));
    assert!(
        number.contains("spheres, linear: `object_agreement` is \"much\", not a number"),
        "{number}"
    );
}

#[test]
fn bad_names_are_refused_with_the_nearest() {
    assert!(refused(&["compare", "sphere-tabel", "-t", "linear"]).contains("sphere-table"));
    assert!(refused(&["compare", "sphere-table", "-t", "liner"]).contains("linear"));
    assert!(
        refused(&["compare", "sphere-table", "-t", "linear(residul=cross)"]).contains("residual")
    );
    assert!(
        refused(&["compare", "sphere-table", "-t", "linear(residual=corss)"]).contains("cross")
    );
    assert!(
        refused(&["compare", "no/such/scene.toml", "-t", "linear"]).contains("no/such/scene.toml")
    );
    let techniques = json(&catoptric(&["list", "techniques", "--format", "json"]));
    let unbuilt = techniques.as_array().into_iter().flatten().find_map(|row| {
        let name = row["name"].as_str().filter(|name| !name.starts_with('+'))?;
        (row["available"] == false).then_some(name)
    });
    if let Some(name) = unbuilt {
        let message = refused(&["compare", "sphere-table", "-t", name]);
        assert_eq!(message.matches(name).count(), 1, "{message}");
    }
    assert!(refused(&["compare", "sphere-table", "-t", "full"]).contains("`linear+full`"));
    let nonsense = refused(&["compare", "bogus-name", "-t", "linear"]);
    assert!(
        nonsense.contains("list scenes") && !nonsense.contains("did you mean"),
        "{nonsense}"
    );
    refused(&["compare", "sphere-table"]);
    refused(&["compare", "-t", "linear"]);
    refused(&[]);
}

#[test]
fn bad_options_are_refused() {
    for size in ["0x0", "0x48", "640", "axb", "99999999999x1"] {
        assert!(
            refused(&[
                "compare",
                "sphere-table",
                "-t",
                "linear",
                "--resolution",
                size
            ])
            .contains(size)
        );
    }
    let compare =
        |extra: &[&str]| refused(&[&["compare", "sphere-table", "-t", "linear"], extra].concat());
    assert!(compare(&["--require", "angular_eror_deg.p99<=1"]).contains("angular_error_deg.p99"));
    assert!(compare(&["--require", "offset_px.mean<=1"]).contains("`vertices.offset_px.mean`?"));
    assert!(compare(&["--require", "object_agreement"]).contains("METRIC<=X"));
    assert!(compare(&["-o", "rows.xls"]).contains("to .json, .csv or .md"));
    assert!(compare(&["--against", "no-such-record.json"]).contains("no-such-record.json"));
    compare(&["--time-budget", "-1"]);
    compare(&["--format", "xml"]);
    assert!(refused(&["bench", "serach"]).contains("did you mean `search`?"));
    for odd in ["0", "8"] {
        let samples = ["reference", "sphere-table", "--samples", odd, "-o", "x.exr"];
        assert!(refused(&samples).contains("samples"));
    }
}

#[test]
fn nothing_is_written_where_something_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    assert!(refused(&["reference", "sphere-tabel", "-o", &at("a.exr")]).contains("sphere-table"));
    assert!(refused(&["reference", "sphere-table", "-o", &at("a.jpg")]).contains(".exr"));
    assert!(refused(&["reference", "sphere-table"]).contains("-o"));
    assert!(
        refused(&["reference", "sphere-table", "-o", &at("nowhere/a.exr")]).contains("nowhere")
    );
    assert!(
        refused(&[
            "reference",
            "sphere-table",
            "--resolution",
            "70000x1",
            "-o",
            &at("a.exr")
        ])
        .contains("70000x1")
    );
    let large = ["reference", "sphere-table", "--resolution", "16384x16384"];
    assert!(refused(&[&large[..], &["-o", &at("a.exr")]].concat()).contains("too large"));
    assert!(
        refused(&["render", "sphere-table", "-t", "liner", "-o", &at("a.exr")]).contains("linear")
    );
    std::fs::write(folder.path().join("odd.toml"), "why = \"x\"\nspeed = 3\n")
        .expect("a scene file");
    let message = refused(&["reference", &at("odd.toml"), "-o", &at("a.exr")]);
    assert!(
        message.contains("odd.toml:") && message.contains("speed"),
        "{message}"
    );
    assert_eq!(files(folder.path()), ["odd.toml"]);
}

/// A scene that is fine: a quad before a ball, seen at 96×72.
const SCENE: &str = r#"why = "For tests."
[camera]
eye = [0.0, 0.5, 4.0]
target = [0.0, 0.0, 0.0]
fov_y = 34.0
resolution = [96, 72]
[background]
color = [0.1, 0.1, 0.1]
[[object]]
name = "quad"
shape = "quad"
transform = { translate = [0.0, -1.0, 0.0] }
[[mirror]]
name = "ball"
shape = "sphere"
center = [0.0, 0.0, 0.0]
radius = 1.0
"#;

#[test]
fn a_faulty_scene_is_refused_with_file_line_and_key() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let write =
        |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect(name);
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    write("empty.obj", "# nothing\n");
    write(
        "nan.obj",
        &(corners.replace("1 0 0", "nan 0 0") + "f 1 2 3\n"),
    );
    write("range.obj", &(corners.to_owned() + "f 1 2 9\n"));
    let quad = "shape = \"quad\"";
    // What is replaced by what, and what the message says.
    let faults: [(&str, &str, &[&str]); 13] = [
        (
            quad,
            "mesh = \"gone.obj\"",
            &["scene.toml:11:", "`gone.obj`"],
        ),
        (quad, "mesh = \"empty.obj\"", &["empty.obj:", "no face"]),
        (quad, "mesh = \"nan.obj\"", &["nan.obj:2:", "finite"]),
        (quad, "mesh = \"range.obj\"", &["range.obj:4:", "9"]),
        (quad, "shape = \"quda\"", &["scene.toml:11:", "`quad`"]),
        (
            "radius = 1.0",
            "radius = 0.0",
            &["scene.toml:17:", "`radius`"],
        ),
        (
            "radius = 1.0",
            "raduis = 1.0",
            &["scene.toml:17:", "`radius`"],
        ),
        (
            "translate = [0.0, -1.0, 0.0]",
            "scale = 0.0",
            &["scene.toml:12:", "`scale`"],
        ),
        (
            "eye = [0.0, 0.5, 4.0]",
            "eye = [0.0, 0.5, 0.1]",
            &["scene.toml:3:", "`eye`"],
        ),
        (
            "eye = [0.0, 0.5, 4.0]",
            "eye = [0.0, nan, 4.0]",
            &["scene.toml:3:", "`eye`"],
        ),
        ("[96, 72]", "[0, 72]", &["scene.toml:6:", "`resolution`"]),
        (
            "[96, 72]",
            "[20000, 72]",
            &["scene.toml:6:", "`resolution`"],
        ),
        ("fov_y = 34.0", "fov_y = 34.0.0", &["scene.toml:5:"]),
    ];
    for (part, fault, says) in faults {
        write("scene.toml", &SCENE.replacen(part, fault, 1));
        let message = refused(&["reference", &at("scene.toml"), "-o", &at("a.exr")]);
        for text in says {
            assert!(message.contains(text), "{fault}: {message}");
        }
        assert_eq!(message.lines().count(), 1, "{fault}: {message}");
    }
    let mut kept = files(folder.path());
    kept.sort_unstable();
    assert_eq!(kept, ["empty.obj", "nan.obj", "range.obj", "scene.toml"]);
}

#[test]
fn a_mirror_outside_the_view_is_a_picture_without_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let text = SCENE.replace("center = [0.0, 0.0, 0.0]", "center = [50.0, 0.0, 0.0]");
    std::fs::write(folder.path().join("scene.toml"), text).expect("a scene file");
    let output = catoptric(&["reference", &at("scene.toml"), "-o", &at("a.exr")]);
    assert_eq!(code(&output), 0, "{output:?}");
    assert!(
        stderr(&output).contains("no mirror is in view"),
        "{output:?}"
    );
    let facts = json(&catoptric(&[
        "diff",
        &at("a.exr"),
        &at("a.exr"),
        "--format",
        "json",
    ]));
    assert_eq!(facts["coverage"]["mirror_pixels"], 0);
    // Colour is that of the whole pictures, and that is said.
    assert!(
        facts["object_agreement"].is_null() && facts["color"]["mae"] == 0.0,
        "{facts}"
    );
    assert!(
        facts["note"]
            .as_str()
            .is_some_and(|note| note.contains("no pixel reflects in both")),
        "{facts}"
    );
}

#[test]
fn without_a_driver_the_package_is_named() {
    let run = |args: &[&str]| {
        std::process::Command::new(env!("CARGO_BIN_EXE_catoptric"))
            .args(args)
            .env("VK_ICD_FILENAMES", "/nonexistent")
            .env("VK_DRIVER_FILES", "/nonexistent")
            .output()
            .expect("the program starts")
    };
    let adapters = run(&["list", "adapters", "--format", "json"]);
    if code(&adapters) == 0 {
        let adapters = stdout(&adapters);
        eprintln!("skipped: an adapter that needs no Vulkan driver: {adapters}");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("out");
    let to = path.to_string_lossy();
    for args in [
        ["compare", "sphere-square", "-t", "linear", "-o", &to].as_slice(),
        &["report", "-o", &to],
        &["bench", "search", "-o", &to],
        &["doctor"],
        &["list", "adapters"],
    ] {
        let output = run(args);
        assert_eq!((code(&output), stdout(&output)), (3, ""), "{output:?}");
        assert!(stderr(&output).contains("adapter"), "{output:?}");
        if cfg!(target_os = "linux") {
            assert!(
                stderr(&output).contains("mesa-vulkan-drivers"),
                "{output:?}"
            );
        }
        assert!(!path.exists(), "{args:?} leaves nothing behind");
    }
}

#[test]
fn an_adapter_that_is_not_there_is_exit_code_3() {
    let output = catoptric(&[
        "compare",
        "sphere-table",
        "-t",
        "linear",
        "--adapter",
        "no such adapter",
    ]);
    assert_eq!((code(&output), stdout(&output)), (3, ""), "{output:?}");
    // What to install is said where nothing is there, not where the name is wrong.
    let none = stderr(&output).contains("there is none");
    let advises = stderr(&output).contains("mesa-vulkan-drivers");
    assert_eq!(none, advises, "{output:?}");
    assert!(
        stderr(&output).contains("named \"no such adapter\""),
        "{output:?}"
    );
    // The input's faults come first.
    refused(&[
        "compare",
        "sphere-tabel",
        "-t",
        "linear",
        "--adapter",
        "no such adapter",
    ]);
}

#[test]
fn a_reference_compared_with_itself_has_no_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr").to_string_lossy().into_owned();
    let traced = catoptric(&[&["reference", "spheres", "-o", &path], SIZE.as_slice()].concat());
    assert_eq!((code(&traced), stdout(&traced)), (0, ""), "{traced:?}");
    assert_eq!(files(folder.path()), ["a.exr"]);
    let facts = json(&catoptric(&["diff", &path, &path, "--format", "json"]));
    assert!(
        facts["coverage"]["mirror_pixels"].as_u64() > Some(100),
        "{facts}"
    );
    assert_eq!(facts["object_agreement"], 1.0);
    assert_eq!(facts["angular_error_deg"]["max"], 0.0);
    assert_eq!(
        (&facts["color"]["mae"], &facts["color"]["flip"]),
        (&Value::from(0.0), &Value::from(0.0))
    );
    assert!(facts["color"]["psnr"].is_null());
}

#[test]
fn a_difference_is_seen_and_painted() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let reference = |truth: &str, path: &str| {
        let output = catoptric(
            &[
                &["reference", "spheres", "--truth", truth, "-o", path],
                SIZE.as_slice(),
            ]
            .concat(),
        );
        assert_eq!(code(&output), 0, "{output:?}");
    };
    reference("first-bounce", &at("first.exr"));
    reference("full", &at("full.exr"));
    let output = catoptric(&[
        "diff",
        &at("full.exr"),
        &at("first.exr"),
        "--format",
        "json",
        "-o",
        &at("map.png"),
    ]);
    let facts = json(&output);
    assert!(facts["object_agreement"].as_f64() < Some(1.0), "{facts}");
    assert!(facts["color"]["mae"].as_f64() > Some(0.0), "{facts}");
    let map = image::open(folder.path().join("map.png")).expect("a picture");
    assert_eq!((map.width(), map.height()), (96, 72));
}

#[test]
fn pictures_of_two_sizes_are_not_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for (name, size) in [("a.exr", "8x6"), ("b.exr", "6x8")] {
        assert_eq!(
            code(&catoptric(&[
                "reference",
                "sphere-square",
                "--resolution",
                size,
                "-o",
                &at(name)
            ])),
            0
        );
    }
    assert!(refused(&["diff", &at("a.exr"), &at("b.exr")]).contains("8x6"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_not_the_inputs_fault() {
    let full = std::fs::File::options().write(true).open("/dev/full");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_catoptric"))
        .args(["list", "scenes"])
        .stdout(full.expect("a device that is always full"))
        .stderr(std::process::Stdio::piped())
        .output()
        .expect("the program starts");
    assert_eq!(code(&output), 1, "{}", stderr(&output));
    assert!(stderr(&output).contains("cannot write to stdout"));
}

//! The program as a user meets it, as far as no adapter is needed: arguments in; exit code, stdout,
//! stderr and files out.

mod support;

use serde_json::Value;
use support::{SIZE, catoptric, code, files, json, refused, stderr, stdout};

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
    let unavailable = rows
        .as_array()
        .into_iter()
        .flatten()
        .filter(|row| row["available"] == false);
    assert!(
        unavailable.clone().count() > 0 && unavailable.clone().all(|row| row["reason"].is_string())
    );
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
    assert_eq!(
        code(&catoptric(&["list", "adapters", "--format", "json"])),
        0
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
    assert!(compare(&["--require", "object_agreement"]).contains("METRIC<=X"));
    assert!(compare(&["--against", "no-such-record.json"]).contains("no-such-record.json"));
    compare(&["--time-budget", "-1"]);
    compare(&["--format", "xml"]);
    assert!(refused(&["bench", "serach"]).contains("did you mean `search`?"));
    assert!(
        refused(&["reference", "sphere-table", "--samples", "0", "-o", "x.exr"])
            .contains("samples")
    );
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
    assert!(
        refused(&["render", "sphere-table", "-t", "liner", "-o", &at("a.exr")]).contains("linear")
    );
    assert!(refused(&["report", "-o", "/proc/no/folder"]).contains("/proc/no/folder"));
    std::fs::write(folder.path().join("odd.toml"), "why = \"x\"\nspeed = 3\n")
        .expect("a scene file");
    let message = refused(&["reference", &at("odd.toml"), "-o", &at("a.exr")]);
    assert!(
        message.contains("odd.toml:") && message.contains("speed"),
        "{message}"
    );
    assert_eq!(files(folder.path()), ["odd.toml"]);
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
    assert!(!stderr(&output).is_empty());
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

//! What is written for Mitsuba: complete, and refused where it cannot be.

use std::path::Path;

use crate::support::{catoptric, code, files, refused, stderr};

fn export(scene: &str, folder: &Path, more: &[&str]) {
    let folder = folder.to_str().expect("UTF-8");
    let output = catoptric(&[&["export", scene, "--mitsuba", folder], more].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(output.stdout.is_empty());
}

/// Every file that a scene names is there, and nothing else.
fn files_are_those_named(folder: &Path) {
    let xml = std::fs::read_to_string(folder.join("scene.xml")).expect("a scene");
    let mut named: Vec<&str> = xml
        .split(r#"<string name="filename" value=""#)
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    named.sort_unstable();
    let mut there: Vec<String> = ["meshes", "textures"]
        .iter()
        .filter(|part| folder.join(part).is_dir())
        .flat_map(|part| {
            let names = files(&folder.join(part)).into_iter();
            names.map(move |name| format!("{part}/{name}"))
        })
        .collect();
    there.sort();
    assert_eq!(named, there);
}

#[test]
fn a_scene_is_complete() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("scene");
    export(
        "sphere-table",
        &scene,
        &["--resolution", "64x48", "--bounces", "2"],
    );
    files_are_those_named(&scene);
    let xml = std::fs::read_to_string(scene.join("scene.xml")).expect("a scene");
    for part in [
        r#"<default name="width" value="64"/>"#,
        r#"<default name="max_depth" value="3"/>"#,
        r#"<string name="fov_axis" value="y"/>"#,
        r#"<boolean name="jitter" value="false"/>"#,
        r#"<shape type="sphere" id="mirror_"#,
    ] {
        assert!(xml.contains(part), "{part}");
    }
    let ids: serde_json::Value =
        serde_json::from_slice(&std::fs::read(scene.join("scene.json")).expect("ids"))
            .expect("JSON");
    assert_eq!(ids["bounces"], 2);
    assert_eq!(ids["scene_hash"].as_str().map(str::len), Some(64));
    for entry in ids["ids"].as_array().expect("ids") {
        for shape in entry["shapes"].as_array().expect("shapes") {
            let id = format!(r#"id="{}""#, shape.as_str().expect("a name"));
            assert!(xml.contains(&id), "{id}");
        }
    }
}

#[test]
fn every_kind_of_mirror_and_paint_is_written() {
    for scene in ["bowl", "ellipsoid", "planar", "spheres", "prototype-sphere"] {
        let folder = tempfile::tempdir().expect("a folder");
        export(scene, folder.path(), &["--quiet"]);
        files_are_those_named(folder.path());
    }
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference/scenes");
    for name in ["by-hand", "teapot"] {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = scenes.join(format!("{name}.toml"));
        export(scene.to_str().expect("UTF-8"), folder.path(), &["--quiet"]);
        files_are_those_named(folder.path());
    }
}

#[test]
fn what_cannot_be_written_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "").expect("written");
    let message = refused(&[
        "export",
        "planar",
        "--mitsuba",
        file.to_str().expect("UTF-8"),
    ]);
    assert!(message.contains("no folder"), "{message}");
    let new = folder.path().join("new");
    let new = new.to_str().expect("UTF-8");
    assert!(refused(&["export", "plenar", "--mitsuba", new]).contains("planar"));
    assert!(refused(&["export", "planar", "--mitsuba", new, "--bounces", "0"]).contains("bounces"));
    assert_eq!(files(folder.path()), ["file"]);
}

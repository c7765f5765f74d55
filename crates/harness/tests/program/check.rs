//! The truth against Mitsuba's stored pictures, on a machine without Mitsuba; and that a scene which
//! is not the one in the picture is noticed.

use std::path::{Path, PathBuf};

use crate::support::{catoptric, code, files, json, refused, stderr, stdout};
use tempfile::TempDir;

fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference")
}

/// A folder with one stored picture, its sidecar and all scenes.
fn copy(name: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let scenes = folder.path().join("scenes");
    std::fs::create_dir(&scenes).expect("a folder");
    for file in [format!("{name}.exr"), format!("{name}.json")] {
        std::fs::copy(reference().join(&file), folder.path().join(&file)).expect("a stored file");
    }
    for file in files(&reference().join("scenes")) {
        std::fs::copy(reference().join("scenes").join(&file), scenes.join(&file)).expect("a scene");
    }
    folder
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// Replaces text in a scene's file; it must be there.
fn edit(folder: &Path, file: &str, from: &str, to: &str) {
    let path = folder.join("scenes").join(file);
    let before = std::fs::read_to_string(&path).expect("a scene");
    assert!(before.contains(from), "{file} has no `{from}`");
    std::fs::write(&path, before.replace(from, to)).expect("written");
}

/// With its sidecar a picture is stale; without it the layers say what is wrong.
fn is_noticed(folder: &TempDir, name: &str, layer: &str) {
    let maps = folder.path().join("maps");
    let stale = catoptric(&["check", "--images", text(folder.path()), "-o", text(&maps)]);
    assert_eq!(code(&stale), 1, "{}", stdout(&stale));
    assert!(stderr(&stale).contains("stale"), "{}", stderr(&stale));
    assert!(stdout(&stale).contains("stale") && !stdout(&stale).contains(" ok"));

    std::fs::remove_file(folder.path().join(format!("{name}.json"))).expect("a sidecar");
    let picture = folder.path().join(format!("{name}.exr"));
    let scene = folder.path().join("scenes").join(format!("{name}.toml"));
    let args = [
        "check",
        text(&picture),
        "--scene",
        text(&scene),
        "-o",
        text(&maps),
    ];
    let measured = catoptric(&[&args[..], &["--format", "json"]].concat());
    assert_eq!(code(&measured), 1, "{}", stdout(&measured));
    let rows = json(&measured);
    let short = |row: &&serde_json::Value| row["verdict"] == "falls short";
    let short: Vec<_> = rows
        .as_array()
        .expect("rows")
        .iter()
        .filter(short)
        .collect();
    assert!(short.iter().any(|row| row["layer"] == layer), "{short:#?}");
    let map = format!("{name}-surface-{}.png", layer.replace(' ', ""));
    assert!(files(&maps).contains(&map), "{:?}", files(&maps));
}

#[test]
fn the_tracer_agrees_with_every_stored_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let maps = folder.path().join("maps");
    let output = catoptric(&["check", "--format", "json", "-o", text(&maps)]);
    assert_eq!(code(&output), 0, "{}\n{}", stdout(&output), stderr(&output));
    let rows = json(&output);
    let rows = rows.as_array().expect("rows");
    for name in files(&reference()) {
        if let Some(name) = name.strip_suffix(".exr") {
            let layers = rows.iter().filter(|row| row["picture"] == *name);
            let starts = layers.clone().filter(|row| row["layer"] == "R G B").count();
            assert_eq!(starts, 2, "{name}: both starts of rays");
        }
    }
    for row in rows {
        assert_eq!(row["verdict"], "ok", "{row}");
        assert!(
            row["pixels"].as_u64().is_some_and(|pixels| pixels > 0),
            "{row}"
        );
    }
    assert!(!maps.exists(), "maps are written of what falls short only");
}

#[test]
fn a_deleted_triangle_is_noticed() {
    let folder = copy("by-hand");
    edit(
        folder.path(),
        "crate.obj",
        "f 5/1 6/2 7/3 8/4\n",
        "f 5/1 6/2 7/3\n",
    );
    is_noticed(&folder, "by-hand", "primary.position");
}

#[test]
fn a_camera_a_thousandth_aside_is_noticed() {
    let folder = copy("plane");
    edit(
        folder.path(),
        "plane.toml",
        "eye = [1.0, 0.8, 3.6]",
        "eye = [1.001, 0.8, 3.6]",
    );
    is_noticed(&folder, "plane", "primary.position");
}

#[test]
fn two_swapped_colours_are_noticed() {
    let folder = copy("sphere");
    let (box_, ring) = ("color = [0.85, 0.30, 0.06]", "color = [0.10, 0.50, 0.35]");
    edit(
        folder.path(),
        "sphere.toml",
        box_,
        "color = [0.0, 0.0, 0.0]",
    );
    edit(folder.path(), "sphere.toml", ring, box_);
    edit(
        folder.path(),
        "sphere.toml",
        "color = [0.0, 0.0, 0.0]",
        ring,
    );
    is_noticed(&folder, "sphere", "R G B per surface");
}

#[test]
fn any_renderers_picture_can_be_checked() {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = folder.path().join("mine.exr");
    let maps = folder.path().join("maps");
    let [picture, maps] = [&picture, &maps].map(|path| text(path));
    for (truth, expected) in [
        (&["--truth", "first-bounce"][..], "first-bounce"),
        (&["--truth", "full", "--bounces", "3"], "full, 3"),
    ] {
        let render = [
            "reference",
            "spheres",
            "--resolution",
            "48x40",
            "-o",
            picture,
        ];
        assert_eq!(code(&catoptric(&[&render[..], truth].concat())), 0);
        let output = catoptric(&["check", picture, "--scene", "spheres", "-o", maps]);
        assert_eq!(code(&output), 0, "{}", stdout(&output));
        assert!(stdout(&output).contains(expected), "{}", stdout(&output));
        let other = catoptric(&["check", picture, "--scene", "sphere-square", "-o", maps]);
        assert_eq!(code(&other), 1);
    }
}

#[test]
fn fewer_layers_and_half_floats_are_enough() {
    use exr::prelude::*;
    let folder = tempfile::tempdir().expect("a folder");
    let whole = folder.path().join("whole.exr");
    let maps = folder.path().join("maps");
    let render = [
        "reference",
        "sphere-square",
        "--resolution",
        "40x32",
        "-o",
        text(&whole),
    ];
    assert_eq!(code(&catoptric(&render)), 0);
    let frame = catoptric_frame::Frame::read_exr(&whole).expect("a picture");
    let (primary, reflected) = (
        frame.primary.expect("layers"),
        frame.reflected.expect("layers"),
    );
    let check = |name: &str, shift: f32| {
        let picture = folder.path().join(name);
        let channel = |axis: usize| {
            let pixels = frame.color.pixels().iter();
            FlatSamples::F16(pixels.map(|color| f16::from_f32(color[axis])).collect())
        };
        let position = |axis: usize| {
            let pixels = reflected.position.pixels().iter();
            FlatSamples::F16(pixels.map(|at| f16::from_f32(at[axis] + shift)).collect())
        };
        let ids = |image: &catoptric_frame::Image<u32>| FlatSamples::U32(image.pixels().to_vec());
        let list: SmallVec<[AnyChannel<FlatSamples>; 4]> = [
            ("R", channel(0)),
            ("G", channel(1)),
            ("B", channel(2)),
            ("primary.id", ids(&primary.id)),
            ("reflected.id", ids(&reflected.id)),
            ("reflected.position.X", position(0)),
            ("reflected.position.Y", position(1)),
            ("reflected.position.Z", position(2)),
        ]
        .into_iter()
        .map(|(name, samples)| AnyChannel::new(name, samples))
        .collect();
        let image = Image::from_channels((40, 32), AnyChannels::sort(list));
        image.write().to_file(&picture).expect("written");
        let args = [
            "check",
            text(&picture),
            "--scene",
            "sphere-square",
            "-o",
            text(&maps),
        ];
        let output = catoptric(&args);
        (code(&output), stdout(&output).to_owned())
    };
    let (code, table) = check("half.exr", 0.0);
    assert_eq!(code, 0, "{table}");
    assert!(table.contains("reflected.position") && !table.contains("primary.position"));
    let (code, table) = check("shifted.exr", 0.01);
    assert_eq!(code, 1, "{table}");
}

#[test]
fn bad_input_is_refused() {
    let folder = copy("sphere");
    let picture = folder.path().join("sphere.exr");
    let picture = text(&picture);
    assert!(refused(&["check", "--scene", "spheres"]).contains("FILE.exr"));
    assert!(refused(&["check", "missing.exr", "--scene", "spheres"]).contains("missing.exr"));
    let size = [
        "check",
        picture,
        "--scene",
        "spheres",
        "--resolution",
        "8x8",
    ];
    assert!(refused(&size).contains("128x128"));
    assert!(refused(&["check", picture, "--scene", "spheers"]).contains("spheres"));
    std::fs::write(folder.path().join("sphere.json"), "{").expect("written");
    assert!(refused(&["check", picture, "--scene", "spheres"]).contains("sphere.json"));
    std::fs::remove_file(folder.path().join("sphere.json")).expect("a sidecar");
    assert!(refused(&["check", picture]).contains("--scene"));
    let empty = tempfile::tempdir().expect("a folder");
    assert!(refused(&["check", "--images", text(empty.path())]).contains("no picture"));
}

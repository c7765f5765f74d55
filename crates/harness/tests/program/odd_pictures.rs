//! `diff` and `check` on pictures as other programs leave them: headers lost, NaN in them, rounded to
//! 16 bits, far from the origin. A right picture holds, and of a wrong one it is said what is wrong.

use std::path::{Path, PathBuf};

use crate::support::{catoptric, code, files, json, refused, stderr, stdout};
use catoptric_frame::{Frame, Status};
use exr::image::{FlatImage, FlatSamples};
use exr::prelude::{WritableImage, f16, read_all_flat_layers_from_file};
use glam::Vec3;
use serde_json::Value;
use tempfile::TempDir;

/// A ball over a floor, both of them `east` of the origin.
fn scene(folder: &Path, east: f64) -> PathBuf {
    let text = format!(
        r#"why = "For tests."
[camera]
eye = [{east}, 0.5, 4.0]
target = [{east}, 0.0, 0.0]
fov_y = 34.0
[background]
color = [0.1, 0.1, 0.1]
[[object]]
name = "floor"
shape = "quad"
transform = {{ scale = 3.0, translate = [{east}, -1.0, 0.0] }}
[[mirror]]
name = "ball"
shape = "sphere"
center = [{east}, 0.0, 0.0]
radius = 1.0
"#
    );
    let path = folder.join("scene.toml");
    std::fs::write(&path, text).expect("a scene file");
    path
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// The truth of [`scene`], and its file.
fn traced(folder: &TempDir, east: f64, size: &str) -> (PathBuf, PathBuf) {
    let scene = scene(folder.path(), east);
    let path = folder.path().join("a.exr");
    let args = ["reference", text(&scene), "--resolution", size, "--quiet"];
    let output = catoptric(&[&args[..], &["-o", text(&path)]].concat());
    assert_eq!(code(&output), 0, "{output:?}");
    (scene, path)
}

/// Writes a file again with something else in it.
fn rewritten(path: &Path, name: &str, change: impl Fn(&mut FlatImage)) -> PathBuf {
    let mut image = read_all_flat_layers_from_file(path).expect("an EXR file");
    change(&mut image);
    let to = path.with_file_name(name);
    image.write().to_file(&to).expect("written");
    to
}

/// Writes a frame again with something else in it.
fn changed(path: &Path, name: &str, change: impl Fn(&mut Frame)) -> PathBuf {
    let mut frame = Frame::read_exr(path).expect("a frame");
    change(&mut frame);
    let to = path.with_file_name(name);
    frame.write_exr(&to).expect("written");
    to
}

fn diff(a: &Path, b: &Path) -> Value {
    let output = catoptric(&["diff", text(a), text(b), "--format", "json"]);
    assert_eq!(code(&output), 0, "{output:?}");
    json(&output)
}

fn note(facts: &Value) -> &str {
    facts["note"].as_str().unwrap_or_default()
}

#[test]
fn a_picture_that_lost_its_names_and_status_is_compared_by_its_ids() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, a) = traced(&folder, 0.0, "48x36");
    let bare = rewritten(&a, "b.exr", |image| {
        let layer = &mut image.layer_data[0];
        layer.attributes.other.clear();
        let list = &mut layer.channel_data.list;
        list.retain(|channel| channel.name != *"reflected.status");
    });
    assert_eq!(note(&diff(&a, &a)), "");
    for (first, second) in [(&a, &bare), (&bare, &a), (&bare, &bare)] {
        let facts = diff(first, second);
        assert!(facts["coverage"]["mirror_pixels"].as_u64() > Some(100));
        assert_eq!(facts["object_agreement"], 1.0, "{facts}");
        assert_eq!(facts["color"]["mae"], 0.0, "{facts}");
        assert!(note(&facts).contains("reflected.status"), "{facts}");
    }
    assert!(note(&diff(&a, &bare)).contains("named as in"));
    let renamed = changed(&a, "c.exr", |frame| {
        frame.names[0].name = "carpet".to_owned();
    });
    assert!(note(&diff(&a, &renamed)).contains("`floor` and `carpet`"));
}

#[test]
fn pixels_that_are_no_numbers_are_counted_and_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, a) = traced(&folder, 0.0, "48x36");
    let nan = Vec3::splat(f32::NAN);
    let one = changed(&a, "one.exr", |frame| *frame.color.at_mut(24, 18) = nan);
    let facts = diff(&a, &one);
    assert_eq!(facts["color"]["left_out"], 1, "{facts}");
    assert!(
        note(&facts).contains("1 mirror pixels whose colour"),
        "{facts}"
    );

    let all = |frame: &mut Frame| frame.color.pixels_mut().fill(nan);
    let facts = diff(&a, &changed(&a, "all.exr", all));
    assert_eq!(facts["object_agreement"], 1.0, "{facts}");
    assert!(facts["color"].is_null() && note(&facts).contains("colour is a number"));

    let colors = |frame: &mut Frame| {
        (frame.primary, frame.reflected) = (None, None);
        frame.names.clear();
    };
    let some = changed(&one, "colors.exr", colors);
    let facts = diff(&a, &some);
    assert!(
        note(&facts).contains("left out of the means: 1 pixels"),
        "{facts}"
    );
    let none = changed(&some, "none.exr", all);
    let message = refused(&["diff", text(&a), text(&none)]);
    assert!(
        message.contains("nothing of") && message.contains("none.exr"),
        "{message}"
    );
}

#[test]
fn without_a_mirror_pixel_colour_is_compared_and_that_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, a) = traced(&folder, 0.0, "48x36");
    let away = changed(&a, "b.exr", |frame| {
        let layers = frame.reflected.as_mut().expect("layers");
        layers.status.pixels_mut().fill(Status::NotMirror);
    });
    let facts = diff(&a, &away);
    assert!(
        facts["object_agreement"].is_null() && facts["color"]["mae"] == 0.0,
        "{facts}"
    );
    assert!(note(&facts).contains("no pixel reflects in both pictures (only in the first:"));
}

#[test]
fn a_map_is_a_png_and_never_a_picture_that_is_compared() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, a) = traced(&folder, 0.0, "8x6");
    let before = std::fs::read(&a).expect("a file");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    for name in ["a.exr", "x.json"] {
        let message = refused(&["diff", text(&a), text(&a), "-o", &at(name)]);
        assert!(
            message.contains(".png") && message.contains(name),
            "{message}"
        );
    }
    let called = at("a.png");
    std::fs::copy(&a, &called).expect("a copy");
    let message = refused(&["diff", &called, text(&a), "-o", &called]);
    assert!(message.contains("overwritten"), "{message}");
    assert_eq!(std::fs::read(&a).expect("a file"), before);
    assert_eq!(std::fs::read(&called).expect("a file"), before);
}

/// Checks a picture; whether it holds, and what is said.
fn holds(picture: &Path, scene: &Path) -> (bool, String) {
    let maps = picture.with_file_name("maps");
    let args = [
        "check",
        text(picture),
        "--scene",
        text(scene),
        "-o",
        text(&maps),
    ];
    let output = catoptric(&args);
    let said = format!("{}{}", stdout(&output), stderr(&output));
    assert!([0, 1].contains(&code(&output)), "{said}");
    (code(&output) == 0, said)
}

/// The picture as a renderer in 32 bits sees it: mirror points off by some roundings of their
/// coordinates, normals made from them; and turned by an angle beside.
fn in_32_bits(frame: &mut Frame, center: Vec3, angle: f32) {
    let primary = frame.primary.as_mut().expect("layers");
    let mut state = 1_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let size = primary.id.size();
    let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    for (x, y) in pixels
        .filter(|(x, y)| *primary.id.at(*x, *y) == 2)
        .collect::<Vec<_>>()
    {
        let at = *primary.position.at(x, y);
        let off =
            Vec3::new(random(), random(), random()) * at.abs().max_element() * 0.5 * f32::EPSILON;
        *primary.position.at_mut(x, y) = at + off;
        let turned = Vec3::new(random(), random(), random()) * angle;
        *primary.normal.at_mut(x, y) = (at + off - center + turned).normalize();
    }
}

#[test]
fn a_right_picture_far_from_the_origin_holds_and_a_wrong_one_does_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, a) = traced(&folder, 1000.0, "64x48");
    let center = Vec3::new(1000.0, 0.0, 0.0);
    let right = changed(&a, "right.exr", |frame| in_32_bits(frame, center, 0.0));
    let (held, said) = holds(&right, &scene);
    assert!(held, "{said}");
    let wrong = changed(&a, "wrong.exr", |frame| in_32_bits(frame, center, 0.02));
    let (held, said) = holds(&wrong, &scene);
    assert!(!held && said.contains("primary.normal"), "{said}");

    // Near the origin as much is wrong as ever.
    let (scene, a) = traced(&folder, 0.0, "64x48");
    let right = changed(&a, "right.exr", |frame| in_32_bits(frame, Vec3::ZERO, 0.0));
    assert!(holds(&right, &scene).0);
    let wrong = changed(&a, "wrong.exr", |frame| in_32_bits(frame, Vec3::ZERO, 1e-4));
    assert!(!holds(&wrong, &scene).0);
}

#[test]
fn what_is_infinite_hides_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, a) = traced(&folder, 0.0, "48x36");
    // In 16 bits, with one infinite coordinate and all others far off.
    let halves = |by: f32, first: f32| {
        move |image: &mut FlatImage| {
            let channels = &mut image.layer_data[0].channel_data.list;
            let mut channels = channels.iter_mut();
            let channel = channels.find(|channel| channel.name == *"primary.position.X");
            let samples = &mut channel.expect("a channel").sample_data;
            let mut all: Vec<f32> = samples.values_as_f32().map(|value| value + by).collect();
            all[0] = first;
            *samples = FlatSamples::F16(all.into_iter().map(f16::from_f32).collect());
        }
    };
    let (held, said) = holds(&rewritten(&a, "right.exr", halves(0.0, 0.0)), &scene);
    assert!(held, "{said}");
    let infinite = rewritten(&a, "wrong.exr", halves(0.5, f32::INFINITY));
    let (held, said) = holds(&infinite, &scene);
    assert!(!held && said.contains("primary.position"), "{said}");

    let infinite = changed(&a, "color.exr", |frame| {
        *frame.color.at_mut(24, 18) = Vec3::splat(f32::INFINITY);
    });
    let (held, said) = holds(&infinite, &scene);
    assert!(!held && said.contains("NaN or infinite"), "{said}");
}

#[test]
fn a_picture_without_anything_to_compare_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, a) = traced(&folder, 0.0, "8x6");
    let bare = rewritten(&a, "b.exr", |image| {
        let channels = &mut image.layer_data[0].channel_data.list;
        channels.retain(|channel| channel.name == *"reflected.status");
        if let FlatSamples::F32(samples) = &mut channels[0].sample_data {
            samples.fill(0.0);
        }
    });
    let path = folder.path().join("away.toml");
    let away = std::fs::read_to_string(&scene).expect("a scene");
    let away = away.replace("center = [0, 0.0, 0.0]", "center = [90.0, 0.0, 0.0]");
    std::fs::write(&path, away).expect("a scene");
    let message = refused(&["check", text(&bare), "--scene", text(&path)]);
    assert!(message.contains("no pixel of any layer"), "{message}");
}

#[test]
fn a_sidecar_is_checked_and_a_missing_picture_is_said_to_be_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, a) = traced(&folder, 0.0, "8x6");
    let sidecar = folder.path().join("a.json");
    for (settings, says) in [
        (
            r#"{"samples": 4294836225}"#,
            "`settings.samples` must be a whole number from 1 to 4096",
        ),
        (r#"{"samples": 1000000000000}"#, "not 1000000000000"),
        (r#"{"samples": 0}"#, "not 0"),
        (r#"{"samples": "four"}"#, "not \"four\""),
        (r#"{"samples": 5}"#, "square number"),
        (r#"{"bounces": 4294967295}"#, "`settings.bounces`"),
    ] {
        let text_of = format!(r#"{{"scene": "sphere-square", "settings": {settings}}}"#);
        std::fs::write(&sidecar, text_of).expect("a sidecar");
        let message = refused(&["check", text(&a)]);
        assert!(
            message.contains(says) && message.contains("a.json"),
            "{message}"
        );
    }
    std::fs::write(&sidecar, r#"{"scene": 3}"#).expect("a sidecar");
    assert!(refused(&["check", text(&a)]).contains("`scene` must be a text, not 3"));
    let gone = folder.path().join("gone.exr");
    assert!(refused(&["check", text(&gone)]).contains("there is no such file"));
    assert!(!files(folder.path()).contains(&"check-errors".to_owned()));
}

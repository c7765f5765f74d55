//! Techniques of image order against the truth; skipped where there is no adapter, unless
//! `CATOPTRIC_REQUIRE_GPU=1`.

use crate::support::{gpu_or_skip, measured, number};
use serde_json::Value;

/// Of techniques that should be exact: rounding at the edges of objects, a pixel in a thousand.
const EXACT: f64 = 0.999;
/// Degrees between the shown and the true point, 99 of 100 pixels: a pixel is a tenth of a degree.
const EXACT_DEG: f64 = 0.05;
/// Mirror pixels with the right object that two maps of 512² reach, and those they leave open.
const TRACED: f64 = 0.95;
const OPEN: f64 = 0.02;
/// Largest difference between rays looked at texel by texel and at even steps, share of mirror pixels.
const SAME_BY_TEXELS: f64 = 0.005;
/// Mirror pixels with the right object where all rays start hidden from the first of two maps.
const NOT_HIDDEN: f64 = 0.98;
/// Share of those that the first map resolves.
const HIDDEN: f64 = 0.02;
/// Mirror pixels with the right object where rays run along the seams of a map.
const ALONG_SEAMS: f64 = 0.995;
/// Published skips are not sound: texel by texel they lose a few pixels, in the plane and off it.
const LOOSE: &str = "sampling=texel,pyramid=published";

fn compare(scenes: &[&str], techniques: &[&str]) -> Vec<Value> {
    measured(scenes, techniques, Some([96, 72]), 0.05)
}

#[test]
fn a_flat_mirror_is_the_mirrored_view() {
    if !gpu_or_skip() {
        return;
    }
    let rows = compare(&["planar", "bowl"], &["planar"]);
    assert!(number(&rows[0], "/object_agreement") >= EXACT);
    assert!(number(&rows[0], "/angular_error_deg/p99") <= EXACT_DEG);
    assert_eq!(rows[1]["status"], "not-applicable");
    assert_eq!(rows[1]["reason"], "mirror `bowl` is not a plane");
}

#[test]
fn two_maps_resolve_nearly_everything_and_beat_the_environment_map() {
    if !gpu_or_skip() {
        return;
    }
    let traced =
        "cubemap-trace(criterion=analytic,objects=2,size=512,sampling=texel,pyramid=sound)";
    let rows = compare(
        &["sphere-table", "sphere-objects-1k", "sphere-touching"],
        &["environment-map", traced],
    );
    for pair in rows.chunks(2) {
        let [environment, traced] = pair else {
            panic!("a row is missing")
        };
        let agreement = number(traced, "/object_agreement");
        assert!(agreement >= TRACED, "{agreement}");
        assert!(agreement > number(environment, "/object_agreement"));
        let open = &traced["coverage"]["unresolved"];
        assert!(open.as_f64().unwrap_or(0.0) <= OPEN, "{open}");
        let by_map = traced["resolved_by"].as_array().cloned();
        let by_map: Vec<f64> = (by_map.iter().flatten())
            .filter_map(Value::as_f64)
            .collect();
        assert!(by_map.len() == 2 && by_map.iter().sum::<f64>() >= 1.0 - OPEN);
    }
}

#[test]
fn more_bounces_come_nearer_to_the_truth_with_mirrors_in_mirrors() {
    if !gpu_or_skip() {
        return;
    }
    let technique =
        |bounces| format!("cubemap-trace(sampling=texel,pyramid=sound,bounces={bounces})");
    let rows = compare(&["bowl"], &[&technique(1), &technique(3)]);
    let full = |row: &Value| number(row, "/against_full/object_agreement");
    assert!(full(&rows[1]) > full(&rows[0]) + 0.05, "{rows:?}");
    assert!(full(&rows[1]) > number(&rows[1], "/object_agreement"));
}

/// Pixels that show another object than the truth, and how many may: rounding at edges.
fn wrong_in_full(row: &Value) -> (f64, f64) {
    let pixels = number(row, "/coverage/mirror_pixels");
    let wrong = (1.0 - number(row, "/against_full/object_agreement")) * pixels;
    (wrong.round(), (1e-4 * pixels).max(2.0))
}

#[test]
fn beams_with_bounces_show_mirrors_in_mirrors_as_the_truth_does() {
    if !gpu_or_skip() {
        return;
    }
    // As many as the truth `full` has where nothing else is asked for.
    let bounces = catoptric::options::Common::default().bounces;
    let more = format!("beams(bounces={bounces})");
    let scenes = [
        "facing",
        "bowl",
        "box",
        "spheres",
        "room",
        "torus",
        "saddle",
        "kitchen",
        "faceted",
        "mirrors-8",
    ];
    let rows = compare(&scenes, &[&more]);
    for row in &rows {
        let (wrong, allowed) = wrong_in_full(row);
        assert!(wrong <= allowed, "{}: {wrong} pixels", row["scene"]);
    }
    // With one reflection the same scenes are far from it.
    let (wrong, allowed) = wrong_in_full(&compare(&["facing"], &["beams"])[0]);
    assert!(wrong > 100.0 * allowed, "{wrong}");
}

#[test]
fn texels_after_a_clear_one_show_what_samples_after_a_clear_one_do() {
    if !gpu_or_skip() {
        return;
    }
    let technique = |options| format!("cubemap-trace(bounces=3,restart=clear,{options})");
    let options = [
        "sampling=step",
        "sampling=texel",
        "sampling=texel,pyramid=sound",
        "sampling=texel,pyramid=published",
    ];
    let rows = compare(
        &["bowl"],
        &options.map(technique).each_ref().map(String::as_str),
    );
    let full = |row: &Value| number(row, "/against_full/object_agreement");
    for (row, options) in rows.iter().zip(options) {
        let (texels, steps) = (full(row), full(&rows[0]));
        assert!(
            (texels - steps).abs() <= SAME_BY_TEXELS,
            "{options}: {texels}, {steps}"
        );
    }
}

/// Everything twice, mirrored in the plane x = z; the map stands at the centre, so that this plane runs
/// along edges of the cube's faces, their middles and their diagonals.
const SYMMETRIC: &str = r#"why = "The same on both sides of the plane x = z."
background = { color = [0, 0, 0] }
camera = { eye = [EYE], target = [0, 0, 0], fov_y = 34 }

[[object]]
name = "room"
shape = "box"
n = 6
vertex_colors = true
transform = { scale = [6, 4, 6] }

[[object]]
name = "door"
shape = "box"
color = [0.8, 0.2, 0.1]
transform = { scale = [0.01, 1.5, 1.2], translate = [5.9, 0.3, 2] }

[[object]]
name = "door's image"
shape = "box"
color = [0.8, 0.2, 0.1]
transform = { scale = [1.2, 1.5, 0.01], translate = [2, 0.3, 5.9] }

[[object]]
name = "carpet"
shape = "box"
color = [0.1, 0.2, 0.8]
transform = { scale = [2, 0.01, 2], translate = [1, -3.95, 1] }

[[mirror]]
name = "ball"
shape = "sphere"
radius = 1
cubemaps = [[0, 0, 0]]
"#;

#[test]
fn rays_along_seams_and_edges_are_resolved_as_others_are() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let scene = |name: &str, eye: &str| {
        let path = folder.path().join(name);
        let text = SYMMETRIC.replace("EYE", eye);
        std::fs::write(&path, text).expect("the folder takes files");
        path.to_str().expect("a UTF-8 path").to_owned()
    };
    let scenes = [
        scene("in.toml", "3.4, 0.7, 3.4"),
        scene("off.toml", "4.1, 0.7, 2.5"),
    ];
    let techniques = [
        "sampling=step",
        "pyramid=published",
        "accept=any,pyramid=published",
        "pyramid=sound",
        "sampling=texel,pyramid=sound",
        "stage=compute",
        LOOSE,
    ];
    let named =
        techniques.map(|options| format!("cubemap-trace(objects=1,placement=scene,{options})"));
    let scenes = scenes.each_ref().map(String::as_str);
    // Odd sides: the middle column and row of pixels lie in planes of symmetry.
    let rows = measured(
        &scenes,
        &named.each_ref().map(String::as_str),
        Some([97, 73]),
        0.05,
    );
    let (within, beside) = rows.split_at(techniques.len());
    let open = |row: &Value| row["coverage"]["unresolved"].as_f64().unwrap_or(0.0);
    for ((within, beside), options) in within.iter().zip(beside).zip(techniques) {
        let all = open(within) <= open(beside) || options == LOOSE;
        assert!(all, "{options}: {} {}", open(within), open(beside));
        let agreement = number(within, "/object_agreement");
        assert!(agreement >= ALONG_SEAMS, "{options}: {agreement}");
    }
}

/// A board over the mirror and a ball between them; the first map looks down on the board, the second
/// sees the ball.
const BEHIND_A_BOARD: &str = r#"why = "What the first map shows is met from behind."
background = { color = [0.2, 0.3, 0.4] }
camera = { eye = [0, 1.4, 5], target = [0, 0.2, 0], fov_y = 34 }

[[object]]
name = "board"
shape = "grid"
color = [0.8, 0.2, 0.1]
transform = { scale = [6, 1, 6], translate = [0, 2, 0] }

[[object]]
name = "blue ball"
shape = "sphere"
segments = 32
color = [0.1, 0.2, 0.8]
transform = { scale = 0.35, translate = [0, 1.5, 0.2] }

[[mirror]]
name = "ball"
shape = "sphere"
radius = 1
cubemaps = [[0, 6, 0], [0, 0, 0]]
"#;

#[test]
fn a_map_in_which_a_ray_starts_hidden_is_not_certain() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("board.toml");
    std::fs::write(&path, BEHIND_A_BOARD).expect("the folder takes files");
    let techniques = [
        "sampling=step",
        "pyramid=sound",
        "restart=clear",
        "sampling=texel",
        "sampling=texel,pyramid=sound",
        "sampling=texel,restart=clear",
        "stage=compute",
    ];
    let named = techniques.map(|options| format!("cubemap-trace(placement=scene,{options})"));
    let scene = path.to_str().expect("a UTF-8 path");
    let rows = compare(&[scene], &named.each_ref().map(String::as_str));
    for (row, options) in rows.iter().zip(techniques) {
        let agreement = number(row, "/object_agreement");
        assert!(agreement >= NOT_HIDDEN, "{options}: {agreement}");
        let by_map = row["resolved_by"].as_array().cloned().unwrap_or_default();
        let first = by_map.first().and_then(Value::as_f64);
        assert!(
            first.is_some_and(|share| share < HIDDEN),
            "{options}: {by_map:?}"
        );
    }
}

#[test]
fn mirrors_in_maps_of_their_own_show_a_mirror_in_itself() {
    if !gpu_or_skip() {
        return;
    }
    let techniques = [
        "cubemap-trace(sampling=texel,pyramid=sound)",
        "cubemap-trace(sampling=texel,pyramid=sound,bounces=3,mirrors=apart)",
        "cubemap-trace(bounces=3,mirrors=apart)",
    ];
    let rows = compare(&["room"], &techniques);
    let full = |row: &Value| number(row, "/against_full/object_agreement");
    assert!(
        full(&rows[1]) > full(&rows[0]) && full(&rows[2]) > full(&rows[0]),
        "{rows:?}"
    );
}

#[test]
fn maps_are_added_as_long_as_they_are_worth_it() {
    if !gpu_or_skip() {
        return;
    }
    let technique =
        |objects| format!("cubemap-trace(sampling=texel,pyramid=sound,objects={objects})");
    let named = ["1", "auto"].map(technique);
    let rows = compare(&["kitchen"], &named.each_ref().map(String::as_str));
    let open = |row: &Value| row["coverage"]["unresolved"].as_f64().unwrap_or(0.0);
    let maps = rows[1]["resolved_by"].as_array().map_or(0, Vec::len);
    assert!((2..8).contains(&maps), "{rows:?}");
    // The second is worth it by far; what is left by all is not worth another one.
    assert!(open(&rows[1]) < 0.5 * open(&rows[0]), "{rows:?}");
    assert!(open(&rows[1]) <= OPEN, "{rows:?}");
}

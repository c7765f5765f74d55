//! Techniques of image order against the truth; skipped where there is no adapter, unless
//! `CATOPTRIC_REQUIRE_GPU=1`.

mod support;

use serde_json::Value;
use support::{gpu_or_skip, measured, number};

/// Of techniques that should be exact: rounding at the edges of objects, a pixel in a thousand.
const EXACT: f64 = 0.999;
/// Degrees between the shown and the true point, 99 of 100 pixels: a pixel is a tenth of a degree.
const EXACT_DEG: f64 = 0.05;
/// Mirror pixels with the right object that two maps of 512² reach, and those they leave open.
const TRACED: f64 = 0.95;
const OPEN: f64 = 0.02;

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

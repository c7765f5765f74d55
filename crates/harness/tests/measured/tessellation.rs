//! Tessellation judged by the truth; skipped without an adapter, unless `CATOPTRIC_REQUIRE_GPU=1`.

use crate::support::{gpu_or_skip, measured, measured_over, number};
use serde_json::Value;

fn compare(scene: &str, techniques: &[&str]) -> Vec<Value> {
    measured(&[scene], techniques, Some([320, 240]), 0.01)
}

#[test]
fn splitting_often_enough_shows_the_truth() {
    if !gpu_or_skip() {
        return;
    }
    let levels = [1, 2, 3, 4, 5, 6].map(|level| format!("linear+full(level={level})"));
    let techniques = levels.each_ref().map(String::as_str);
    let rows = compare("sphere-square", &techniques);
    let angle = |row: &Value| row["angular_error_deg"]["p50"].as_f64().expect("a median");
    // What answers in whole pixels are off by, whatever the triangles.
    let floor = rows[0]["pixel_angle_deg"]["p50"].as_f64().expect("a floor");
    const OF_FLOOR: f64 = 1.1;
    let is_at_floor = |row: &Value| angle(row) <= OF_FLOOR * floor;
    let reached = rows.iter().position(is_at_floor).expect("the floor");
    for pair in rows[..=reached].windows(2) {
        assert!(
            angle(&pair[0]) > angle(&pair[1]),
            "{}",
            pair[1]["technique"]
        );
    }
    assert!(rows[reached..].iter().all(is_at_floor));
    assert!(rows[5]["object_agreement"].as_f64() >= Some(0.99));
    // Searches that were run: the square's corners and three a split.
    assert!(rows[0]["vertices"]["searched"] == 4 + 3 * 2);
}

#[test]
fn the_published_rule_tears_the_surface() {
    if !gpu_or_skip() {
        return;
    }
    let rows = compare("crack", &["linear+adaptive", "linear+full(level=5)"]);
    let coverage = |row: usize, what: &str| rows[row]["coverage"][what].as_u64();
    assert!(coverage(0, "t_junctions") > Some(0) && coverage(0, "crack_pixels") > Some(10));
    assert_eq!(
        (coverage(1, "t_junctions"), coverage(1, "cracks")),
        (Some(0), Some(0))
    );
}

/// Szabo 2013, Fig. 6.3: "adaptive never exceeds level 2" at the threshold 0.001.
#[test]
fn the_published_threshold_splits_the_square_twice() {
    if !gpu_or_skip() {
        return;
    }
    let techniques = ["linear+adaptive(level=5,threshold=0.001)"];
    let rows = measured(&["sphere-square"], &techniques, None, 0.01);
    let levels = rows[0]["triangles"]["by_level"].as_array().expect("levels");
    let drawn: Vec<_> = levels.iter().map(|count| count.as_u64()).collect();
    assert!(drawn[2] > Some(0), "{drawn:?}");
    assert!(
        drawn[3..].iter().all(|count| *count == Some(0)),
        "{drawn:?}"
    );
    assert_eq!(rows[0]["vertices"]["hidden"], 0);
}

/// Cracks and T-junctions of each row, standing still and over all frames.
fn torn(rows: &[Value]) -> Vec<(String, [f64; 5])> {
    let paths = [
        "/coverage/cracks",
        "/coverage/crack_pixels",
        "/coverage/t_junctions",
        "/temporal/crack_pixels_max",
        "/temporal/t_junctions_max",
    ];
    let row = |row: &Value| {
        let name = format!("{} {}", row["scene"], row["technique"]);
        (name, paths.map(|path| number(row, path)))
    };
    let rows = rows.iter().map(row);
    rows.filter(|(_, counts)| *counts != [0.0; 5]).collect()
}

#[test]
fn a_surface_split_by_pixels_stays_whole_while_things_move() {
    if !gpu_or_skip() {
        return;
    }
    let scene = ["sphere-square-hidden"];
    let techniques = ["newton(start=tile)+pixel", "newton+adaptive"];
    let rows = measured_over(&scene, &techniques, Some([96, 72]), 0.01, Some(2));
    let found = torn(&rows[..1]);
    assert!(found.is_empty(), "{found:?}");
    // What is counted is there to be found.
    assert!(number(&rows[1], "/temporal/t_junctions_max") > 0.0);
    assert!(number(&rows[1], "/temporal/crack_pixels_max") > 0.0);
    assert!(number(&rows[1], "/temporal/triangles_changed") >= 0.0);
}

#[test]
fn splitting_by_pixels_shows_the_right_objects() {
    if !gpu_or_skip() {
        return;
    }
    let techniques = [
        "newton(start=tile,hidden=extend)+pixel(error=0.25)",
        "newton(start=tile,hidden=extend,fragments=exact)+pixel(error=0.25)",
    ];
    for scene in ["sphere-square", "sphere-table"] {
        let rows = compare(scene, &techniques);
        let right = |row: usize| number(&rows[row], "/object_agreement");
        assert!(right(0) >= 0.997, "{scene}: {}", right(0));
        assert!(right(1) >= 0.9995, "{scene}: {}", right(1));
        let angle = number(&rows[1], "/angular_error_deg/p99");
        assert!(angle <= 0.05, "{scene}: {angle}");
    }
}

#[test]
fn every_image_in_a_mirror_that_is_not_convex_is_whole_and_exact() {
    if !gpu_or_skip() {
        return;
    }
    let technique = "swept-boxes(hidden=extend,fragments=exact)+pixel(error=0.25)";
    // Of the saddle's mirror two pixels lie in a crack, at a fold near the rim.
    for (scene, most_cracked) in [("bowl", 0.0), ("torus", 0.0), ("saddle", 2.0)] {
        let rows = measured_over(&[scene], &[technique], Some([160, 120]), 0.01, None);
        let number = |path: &str| number(&rows[0], path);
        let right = number("/object_agreement");
        assert!(right >= 0.9995, "{scene}: {right}");
        let angle = number("/angular_error_deg/p99");
        assert!(angle <= 0.05, "{scene}: {angle}");
        let cracked = number("/coverage/crack_pixels");
        assert!(cracked <= most_cracked, "{scene}: {cracked}");
    }
}

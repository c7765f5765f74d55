//! The ray hierarchy's published flaws, on points whose reflection points are known.

use std::ops::RangeInclusive;

use crate::support::{gpu_or_skip, measured};
use serde_json::Value;

/// How far a measured value may be from the expected one, as a share of it: the expected values
/// come from an independent f64 program and other random vertices of the same distribution.
const THIRD: f64 = 1.0 / 3.0;

fn near(row: &Value, what: &str, found: Option<f64>, expected: f64) {
    let found = found.unwrap_or_else(|| panic!("{what}: {row}"));
    let technique = &row["technique"];
    assert!(
        (found - expected).abs() <= THIRD * expected,
        "{technique}: {what} is {found}, expected about {expected}"
    );
}

fn within(row: &Value, what: &str, found: Option<f64>, expected: RangeInclusive<f64>) {
    let found = found.unwrap_or_else(|| panic!("{what}: {row}"));
    let technique = &row["technique"];
    assert!(
        expected.contains(&found),
        "{technique}: {what} is {found}, expected {expected:?}"
    );
}

#[test]
fn the_sphere_shows_the_published_flaws() {
    if !gpu_or_skip() {
        return;
    }
    let rows = measured(
        &["prototype-sphere"],
        &[
            "ray-hierarchy",
            "ray-hierarchy(repair=enlarge)",
            "ray-hierarchy(repair=enlarge,again=hole)",
            "ray-hierarchy(repair=enlarge,again=last)",
            "ray-hierarchy(repair=stop,stop=2)",
            "ray-hierarchy(repair=stop,stop=3)",
            "ray-hierarchy(repair=stop,stop=4)",
        ],
        None,
        0.1,
    );
    let [raw, enlarged, at_holes, at_last, two, three, four] = rows.as_slice() else {
        panic!("{} rows", rows.len())
    };
    let number = |row: &Value, pointer: &str| row.pointer(pointer).and_then(Value::as_f64);
    let share = |row: &Value, of: &str| {
        let part = number(row, &format!("/vertices/{of}"))?;
        Some(part / number(row, "/vertices/reflected")?)
    };
    let mean = |row: &Value| number(row, "/vertices/offset_px/mean");
    near(raw, "share of failed searches", share(raw, "failed"), 0.10);
    near(raw, "share of holes", share(raw, "hole"), 0.995);
    near(raw, "mean offset", mean(raw), 20.0);
    near(raw, "node tests", number(raw, "/work/node_tests"), 86.0);
    // The whole search again, for those that failed: a fifth more tests, as in the thesis, whose
    // times are 95 ms against 80.
    let tests = |row: &Value| number(row, "/work/node_tests");
    within(enlarged, "mean offset", mean(enlarged), 0.6..=1.1);
    within(enlarged, "node tests", tests(enlarged), 95.0..=115.0);
    let of_all = share(enlarged, "enlarged");
    within(enlarged, "share enlarged", of_all, 0.08..=0.15);
    // At every hole on the way: twice the tests and twice the error.
    within(at_holes, "mean offset", mean(at_holes), 1.3..=2.0);
    within(at_holes, "node tests", tests(at_holes), 180.0..=220.0);
    let p95 = number(at_holes, "/vertices/offset_px/p95");
    near(at_holes, "95th percentile", p95, 4.6);
    let of_all = share(at_holes, "enlarged");
    within(at_holes, "share enlarged", of_all, 0.99..=1.0);
    // At the last texel only: it repairs next to nothing.
    near(at_last, "mean offset", mean(at_last), 19.8);
    near(at_last, "node tests", tests(at_last), 90.0);
    near(two, "mean offset", mean(two), 3.6);
    near(three, "mean offset", mean(three), 8.7);
    near(four, "mean offset", mean(four), 20.0);
}

//! Newton's method between pixels, on points whose reflection points are known.

use crate::support::{gpu_or_skip, measured};

/// An f64 program converged for 99.5 % (ellipsoid) and more; here the rim is reached as well.
const FAILED: f64 = 0.005;
/// In pixels: the same program's means are 0.0036 and 0.0048 without the rim, which adds a little.
const MEAN: f64 = 0.01;
/// In pixels: an answer that is not within it is a wrong one.
const WORST: f64 = 0.5;
/// From the mirror's centre the program took 6.6 and 6.4 steps.
const STEPS: f64 = 8.0;

#[test]
fn answers_are_exact_to_a_hundredth_of_a_pixel() {
    if !gpu_or_skip() {
        return;
    }
    for scene in ["prototype-sphere", "prototype-ellipsoid"] {
        let rows = measured(&[scene], &["newton"], None, 0.1);
        let number = |pointer: &str| rows[0].pointer(pointer).and_then(|value| value.as_f64());
        let number =
            |pointer: &str| number(pointer).unwrap_or_else(|| panic!("{pointer}: {rows:?}"));
        let failed = number("/vertices/failed") / number("/vertices/reflected");
        assert!(failed <= FAILED, "{scene}: {failed} failed");
        assert!(
            number("/vertices/offset_px/mean") <= MEAN,
            "{scene}: {rows:?}"
        );
        assert!(
            number("/vertices/offset_px/max") <= WORST,
            "{scene}: {rows:?}"
        );
        assert!(number("/work/steps") <= STEPS, "{scene}: {rows:?}");
    }
}

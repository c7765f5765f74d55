//! A mirror that reaches behind the plane of the eye: triangles with one corner's reflection point
//! there are clipped where their virtual images are. Skipped where there is no adapter, unless
//! `CATOPTRIC_REQUIRE_GPU=1`.

use crate::support::{gpu_or_skip, measured};
use serde_json::Value;

/// A ball beside the eye, a floor under both and a wall to the left; squares of three units, so
/// that those at the right edge of the picture go far behind the eye.
const SCENE: &str = r#"
why = "A mirror that reaches behind the eye's plane."
camera = { eye = [0.0, 0.0, 0.0], target = [0.9, 0.0, -1.0], fov_y = 110.0 }

[[object]]
name = "floor"
shape = "grid"
n = 4
transform = { scale = [6.0, 1.0, 6.0], translate = [0.0, -1.0, 0.0] }

[[object]]
name = "wall"
shape = "grid"
n = 4
transform = { scale = [6.0, 1.0, 6.0], rotate_deg = [0.0, 0.0, -90.0], translate = [-3.0, 0.0, 0.0] }

[[mirror]]
name = "ball"
shape = "sphere"
center = [2.6, 0.0, -0.6]
radius = 2.2
"#;

/// Straight edges in place of curved ones, at squares so large: a pixel in a hundred.
const COARSE: f64 = 0.01;
/// What the triangles that reach behind the eye cover, at least.
const BEHIND: f64 = 0.05;

#[test]
fn triangles_that_reach_behind_the_eye_are_clipped_where_their_images_are() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("beside.toml");
    std::fs::write(&scene, SCENE).expect("writable");
    let scene = scene.to_str().expect("UTF-8");
    let in_space = "reflector-cubemap(iterations=40,hidden=extend,depth=virtual)";
    let on_screen = "reflector-cubemap(iterations=40,hidden=extend,depth=thesis)";
    let rows = measured(&[scene], &[in_space, on_screen], Some([96, 72]), 0.01);
    let coverage = |row: usize, what: &str| {
        let share = rows[row]["coverage"][what].as_f64();
        share.unwrap_or_else(|| panic!("{}", Value::to_string(&rows[row])))
    };
    let (missing, extra) = (coverage(0, "missing"), coverage(0, "extra"));
    assert!(missing < COARSE && extra < COARSE, "{missing} {extra}");
    // Without a place on the screen such triangles are left out.
    let missing = coverage(1, "missing");
    assert!(missing > BEHIND, "{missing}");
}

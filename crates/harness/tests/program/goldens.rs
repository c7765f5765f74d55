//! Small stored pictures of every technique: a picture that changes is seen, and explained in the
//! change that stores it anew (`CATOPTRIC_ACCEPT=1 cargo test --release --workspace --test program goldens::`).
//! Skipped without an adapter, unless `CATOPTRIC_REQUIRE_GPU=1`.

use std::path::{Path, PathBuf};

use crate::support::{catoptric, code, gpu_or_skip, stderr};
use catoptric_frame::{Frame, Image, write_png_rgb8};
use catoptric_metrics::{Colormap, MapKind, compare, error_map, motion_error};
use glam::Vec3;

/// Scene and technique of each golden; together they show every search, every refinement, every
/// technique of image order, mirrors of several shapes, several mirrors, and both
/// depth modes.
const GOLDENS: &[(&str, &str)] = &[
    ("spheres", "linear"),
    ("bowl", "linear(residual=cross,neighbours=8,depth=virtual)"),
    ("sphere-table", "linear(gbuffer=mesh,under=dark)"),
    ("sphere-square", "linear+full(level=2)"),
    ("sphere-table", "linear+adaptive(level=3)"),
    ("ellipsoid", "ray-hierarchy(repair=enlarge)"),
    ("spheres", "reflector-cubemap(size=64)"),
    ("sphere-objects-1k", "linear+grid"),
    ("sphere-objects-1k", "newton"),
    ("sphere-table", "newton+pixel"),
    ("sphere-square", "newton(fragments=exact)"),
    ("bowl", "swept-boxes"),
    ("planar", "planar"),
    ("ellipsoid", "ray-trace"),
    ("kitchen", "beams"),
    ("facing", "beams(bounces=4)"),
    ("ellipsoid", "environment-map(size=64)"),
    ("bowl", "cubemap-trace(size=64,accept=continuous,bounces=3)"),
    ("moving-saddle-all", "motion-none"),
    ("moving-ellipsoid-all", "motion-surface"),
    ("moving-plane-all", "motion-flat"),
    ("moving-bowl-all", "motion-lens"),
    ("moving-torus-all", "motion-newton"),
];

/// Of goldens that move: one whose reflections move by some pixels.
const FRAME: &str = "9";

const SIZE: &str = "56x42";

/// Largest golden, in bytes.
const LARGEST: u64 = 64 << 10;

/// Share of mirror pixels that must show the same object. Adapters round differently, so that a
/// pixel at an object's edge may go either way: a few of the thousand or so mirror pixels.
const SAME_OBJECT: f64 = 0.99;

/// Mean absolute difference of linear colour on the mirrors: such edge pixels differ by up to 1.
const SAME_COLOR: f64 = 0.01;

/// Mean angle at the mirror between the two points shown, in degrees. A pixel is 0.6 to 0.9 of
/// them; the few edge pixels are all that may differ by so much.
const SAME_POINT_DEG: f64 = 0.1;

/// Distance between two vectors at 95 % of the pixels that have one in both, and share of those that have
/// one in the golden alone.
const SAME_MOTION_PX: f64 = 0.01;
const SAME_ANSWERS: f64 = 0.02;

/// How the motion differs too much, if it does.
fn other_motion(golden: &Frame, actual: &Frame) -> Option<String> {
    if golden.motion.is_none() && actual.motion.is_none() {
        return None;
    }
    let error = match motion_error(golden, actual) {
        Ok(error) => error,
        Err(error) => return Some(error.to_string()),
    };
    let p95 = error.error_px.map_or(f64::INFINITY, |error| error.p95);
    let missing = error.missing.unwrap_or(1.0);
    let same = p95 <= SAME_MOTION_PX && missing <= SAME_ANSWERS;
    (!same).then(|| format!("vectors differ by {p95} px, {missing} of them are missing"))
}

/// What differs too much, if anything.
fn difference(golden: &Frame, actual: &Frame) -> Option<String> {
    if let Some(other) = other_motion(golden, actual) {
        return Some(other);
    }
    let comparison = compare(golden, actual).expect("two pictures of one size");
    let same_object = comparison.object_agreement.unwrap_or(0.0);
    let color = comparison.color.map_or(f64::INFINITY, |color| color.mae);
    let angle = comparison
        .angular_error_deg
        .map_or(f64::INFINITY, |angle| angle.mean);
    let same = same_object >= SAME_OBJECT && color <= SAME_COLOR && angle <= SAME_POINT_DEG;
    (!same).then(|| {
        format!(
            "objects agree on {same_object}, colours differ by {color}, points by {angle} degrees"
        )
    })
}

fn file_name(scene: &str, technique: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let technique: String = technique.chars().map(plain).collect();
    format!("{scene}.{}.exr", technique.trim_end_matches('-'))
}

fn goldens() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/goldens")
}

#[test]
fn pictures_are_as_stored() {
    if !gpu_or_skip() {
        return;
    }
    let accept = std::env::var("CATOPTRIC_ACCEPT").is_ok_and(|value| value == "1");
    let failed_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("goldens");
    std::fs::create_dir_all(&failed_folder).expect("a folder for what differs");
    let mut failures = Vec::new();
    for (scene, technique) in GOLDENS {
        let name = file_name(scene, technique);
        let golden = goldens().join(&name);
        let actual = failed_folder.join(&name);
        let to = if accept { &golden } else { &actual };
        let to = to.to_str().expect("a UTF-8 path");
        let mut args = vec!["render", scene, "-t", technique, "-o", to];
        args.extend(["--resolution", SIZE]);
        if scene.starts_with("moving-") {
            args.extend(["--frame", FRAME]);
        }
        let output = catoptric(&args);
        assert_eq!(code(&output), 0, "{name}: {}", stderr(&output));
        let size = std::fs::metadata(&golden).map(|data| data.len());
        match size {
            Ok(size) if size <= LARGEST => {}
            Ok(size) => failures.push(format!("{name} has {size} bytes, more than {LARGEST}")),
            Err(_) => {
                failures.push(format!("{name} is missing"));
                continue;
            }
        }
        if accept {
            continue;
        }
        let read = |path: &Path| Frame::read_exr(path).expect("a picture just written");
        let (golden, actual) = (read(&golden), read(&actual));
        if let Some(difference) = difference(&golden, &actual) {
            let map = error_map(MapKind::AbsColor, &golden, &actual).expect("one size");
            let map = catoptric_metrics::colorize(&map, [0.0, 1.0], Colormap::Magma);
            let path = failed_folder.join(&name).with_extension("error.png");
            write_png_rgb8(&map, &path).expect("the folder takes files");
            failures.push(format!("{name}: {difference}; see {}", path.display()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_technique_has_a_golden() {
    let specs: Vec<_> = (GOLDENS.iter())
        .map(|(_, technique)| catoptric_reflect::parse(technique).expect("a technique"))
        .collect();
    let shown = |name: &str| {
        specs.iter().any(|spec| {
            let refinement = spec.refinement().map(|options| options.name());
            spec.name() == name || refinement == Some(name)
        })
    };
    let all = catoptric_reflect::list();
    let without: Vec<_> = (all.iter().map(|info| info.name))
        .filter(|name| !shown(name))
        .collect();
    assert!(without.is_empty(), "without a golden: {without:?}");
}

#[test]
fn a_picture_moved_by_a_pixel_is_noticed() {
    for (scene, technique) in GOLDENS {
        let name = file_name(scene, technique);
        let golden = Frame::read_exr(goldens().join(&name)).expect("a stored golden");
        let mut moved = golden.clone();
        moved.color = shifted(&golden.color);
        // Right objects in the right colours, shown at the wrong points.
        let mut misplaced = golden.clone();
        if let Some(reflected) = &golden.reflected {
            let position = shifted::<Vec3>(&reflected.position);
            if let Some(misplaced) = &mut misplaced.reflected {
                misplaced.position = position.clone();
            }
            if let Some(moved) = &mut moved.reflected {
                moved.id = shifted(&reflected.id);
                moved.position = position;
            }
        }
        assert!(difference(&golden, &moved).is_some(), "{name}");
        assert!(difference(&golden, &misplaced).is_some(), "{name}");
        assert_eq!(difference(&golden, &golden), None, "{name}");
    }
}

/// An image moved right by a pixel.
fn shifted<T: Clone>(image: &Image<T>) -> Image<T> {
    let width = image.size()[0] as usize;
    let mut pixels = image.pixels().to_vec();
    for row in pixels.chunks_exact_mut(width) {
        row.rotate_right(1);
    }
    Image::from_vec(image.size(), pixels)
}

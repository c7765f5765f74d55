//! What moves, moves rigidly and keeps its vertices in order.

use catoptric_scene::{LoadOptions, Scene};
use glam::{DMat3, DVec3};

fn load(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moving.toml");
    std::fs::write(&path, text).unwrap();
    Scene::load(path.to_str().unwrap(), &LoadOptions::default()).unwrap()
}

const STILL: &str = r#"why = "A test."
[camera]
eye = [0.0, 1.0, 8.0]
target = [0.0, 1.0, 0.0]
fov_y = 40.0
[[object]]
name = "box"
shape = "box"
n = 2
transform = { scale = [0.3, 0.5, 0.2], rotate_deg = [10, 20, 30], translate = [3.0, 0.0, 0.0] }
[[mirror]]
name = "ball"
shape = "sphere"
center = [-3.0, 0.0, 0.0]
radius = 0.5
[[mirror]]
name = "egg"
shape = "ellipsoid"
center = [0.0, 3.0, 0.0]
radii = [0.5, 0.9, 0.3]
rotate_deg = [0, 30, 10]
[[mirror]]
name = "pane"
shape = "plane"
center = [0.0, -2.0, 0.0]
normal = [0.0, 1.0, 0.2]
size = [2.0, 1.0]
[[mirror]]
name = "bowl"
shape = "bowl"
center = [0.0, 0.0, -3.0]
radius = 1.0
axis = [0.3, 0.0, -1.0]
half_angle_deg = 70
[[mirror]]
name = "ring"
shape = "torus"
center = [3.0, 3.0, 0.0]
axis = [0.2, 1.0, 0.4]
major = 0.7
minor = 0.2
[[mirror]]
name = "saddle"
shape = "saddle"
center = [-3.0, 3.0, 0.0]
normal = [0.3, 0.2, 1.0]
size = [1.0, 1.4]
curvature = [0.8, -0.4]
[[mirror]]
name = "pot"
shape = "teapot"
n = 2
transform = { scale = 0.2 }
"#;

/// The same motion for everything: half a turn's third around y through a point, and a way.
fn moving() -> Scene {
    let step = |name| {
        format!(
            "[[motion.move]]\nname = \"{name}\"\ntranslate = [0.5, -0.25, 1.0]\nrotate_deg = [0, 60, 0]\nabout = [1, 2, 3]\n"
        )
    };
    let steps = [
        "box", "ball", "egg", "pane", "bowl", "ring", "saddle", "pot",
    ]
    .map(step);
    load(&format!("{STILL}[motion]\nframes = 5\n{}", steps.join("")))
}

fn pose(time: f64) -> impl Fn(DVec3) -> DVec3 {
    let turn = DMat3::from_rotation_y((60.0 * time).to_radians());
    let about = DVec3::new(1.0, 2.0, 3.0);
    move |point| about + turn * (point - about) + time * DVec3::new(0.5, -0.25, 1.0)
}

#[test]
fn objects_move_vertex_by_vertex() {
    let scene = moving();
    assert_eq!(scene.frames(), 5);
    for frame in 0..5 {
        let (posed, to) = (scene.at(frame), pose(f64::from(frame) / 4.0));
        let (before, after) = (&scene.objects[0].mesh, &posed.objects[0].mesh);
        assert_eq!(before.triangles, after.triangles);
        for (a, b) in before.positions.iter().zip(&after.positions) {
            let off = to(a.as_dvec3()).distance(b.as_dvec3());
            assert!(off < 1e-6, "frame {frame}: {off}");
        }
    }
}

#[test]
fn mirrors_move_as_surfaces_do() {
    let scene = moving();
    let (posed, to) = (scene.at(4), pose(1.0));
    let eye = scene.camera.eye;
    let mut hits = 0;
    for (before, after) in scene.mirrors.iter().zip(&posed.mirrors) {
        let proxy = before.shape.tessellate(16);
        let moved = after.shape.tessellate(16);
        for (corner, other) in proxy.positions.iter().zip(&moved.positions) {
            let target = corner.as_dvec3();
            if before.shape.is_analytic() {
                let ray =
                    |to: &dyn Fn(DVec3) -> DVec3| (to(eye), (to(target) - to(eye)).normalize());
                let (origin, dir) = ray(&|point| point);
                let (new_origin, new_dir) = ray(&to);
                let hit = before.shape.intersect(origin, dir, 0.0);
                let new = after.shape.intersect(new_origin, new_dir, 0.0);
                let Some((hit, new)) = hit.zip(new) else {
                    continue;
                };
                let normal = to(hit.position + hit.normal) - to(hit.position);
                // Grazing hits of rays aimed at the surface itself are known to a root of rounding.
                if hit.normal.dot(dir).abs() > 0.05 {
                    assert!(
                        to(hit.position).distance(new.position) < 1e-9,
                        "{}",
                        before.name
                    );
                    assert!(normal.distance(new.normal) < 1e-9, "{}", before.name);
                    hits += 1;
                }
            } else {
                assert!(
                    to(target).distance(other.as_dvec3()) < 1e-6,
                    "{}",
                    before.name
                );
            }
        }
    }
    assert!(hits > 200, "{hits}");
}

#[test]
fn frame_0_is_the_scene_as_written_and_the_last_one_stays() {
    let scene = moving();
    let still = load(STILL);
    assert_eq!(still.frames(), 1);
    assert_eq!(still.at(7).hash, still.hash);
    assert_eq!(scene.hash, still.hash, "motion changes no picture");
    assert_eq!(scene.at(0).hash, scene.hash);
    assert_eq!(scene.at(0).frames(), 1);
    assert_eq!(scene.at(4).hash, scene.at(9).hash);
    let mut hashes: Vec<_> = (0..5).map(|frame| scene.at(frame).hash).collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), 5);
}

#[test]
fn the_camera_orbits_or_follows_keys() {
    let orbit = load(&format!(
        "{STILL}[motion]\nframes = 3\ncamera = {{ orbit_deg = 180 }}\n"
    ));
    let eyes: Vec<DVec3> = (0..3).map(|frame| orbit.at(frame).camera.eye).collect();
    for (eye, expected) in eyes.iter().zip([[0.0, 8.0], [8.0, 0.0], [0.0, -8.0]]) {
        assert!(
            eye.distance(DVec3::new(expected[0], 1.0, expected[1])) < 1e-12,
            "{eye}"
        );
    }
    let keys = load(&format!(
        "{STILL}[motion]\nframes = 3\ncamera = {{ eye = [[1, 1, 7], [4, 2, 5]], target = [[1, 1, 0]] }}\n"
    ));
    let cameras: Vec<_> = (0..3).map(|frame| keys.at(frame).camera).collect();
    assert!(cameras[1].eye.distance(DVec3::new(1.0, 1.0, 7.0)) < 1e-12);
    assert!(cameras[2].eye.distance(DVec3::new(4.0, 2.0, 5.0)) < 1e-12);
    assert!(cameras[1].target.distance(DVec3::new(0.5, 1.0, 0.0)) < 1e-12);
    assert_eq!(cameras[2].up, DVec3::Y);
}

#[test]
fn by_default_an_object_turns_around_the_middle_of_its_box() {
    let scene = load(&format!(
        "{STILL}[motion]\nframes = 2\n[[motion.move]]\nname = \"box\"\nrotate_deg = [0, 0, 180]\n"
    ));
    let middle = |scene: &Scene| {
        let (low, high) = scene.objects[0].mesh.bounds().unwrap();
        (low + high) / 2.0
    };
    assert!(middle(&scene).distance(middle(&scene.at(1))) < 1e-6);
}

#[test]
fn every_shape_keeps_its_fingerprint() {
    // Recorded results and stored reference images name their scenes by these.
    let scene = moving();
    for (frame, expected) in [
        (
            0,
            "3de810b2d8c8078ae2e3276c379b18ff172c72909dd803d09f7a969733b47888",
        ),
        (
            4,
            "4b24df0fde6319f45db1c7cca3c4d6df019bf8bfabd63441aa20dd6bc58b5ae4",
        ),
    ] {
        assert_eq!(scene.at(frame).hash, expected, "frame {frame}");
    }
}

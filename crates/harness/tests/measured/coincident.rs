//! Surfaces that lie on one another: the reference and the techniques show the same of them, whichever
//! stands first in a file. Skipped where there is no adapter, unless `CATOPTRIC_REQUIRE_GPU=1`.

use std::path::Path;

use crate::support::gpu_or_skip;
use catoptric_frame::{Frame, Status};
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_reflect::{Gpu, Prefer};
use catoptric_scene::{LoadOptions, Scene, open};

const SIZE: [u32; 2] = [80, 60];

const VIEW: &str = "why = \"Two surfaces in one place.\"
camera = { eye = [0.4, 0.3, 5.0], target = [0, 0, 0], fov_y = 34 }
";

/// A scene that lies in a folder of its own, beside `files`.
fn scene(files: &[(&str, &str)], text: &str) -> Scene {
    let folder = tempfile::tempdir().expect("a folder");
    let folder: &Path = folder.path();
    for (name, content) in files {
        std::fs::write(folder.join(name), content).expect("the folder takes files");
    }
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("{VIEW}{text}")).expect("the folder takes files");
    let options = LoadOptions {
        resolution: Some(SIZE),
        ..LoadOptions::default()
    };
    open(path.to_str().expect("a UTF-8 path"), &options).expect("a scene")
}

fn truth(scene: &Scene) -> Frame {
    let tracer = Tracer::new(scene).expect("whole");
    let first = tracer.render(&RenderOptions::new(SIZE, Truth::FirstBounce));
    // Neither mirror stands in the way of rays that leave the other.
    let full = tracer.render(&RenderOptions::new(SIZE, Truth::Full { bounces: 4 }));
    assert!(first.color == full.color);
    first
}

fn drawn(gpu: &Gpu, scene: &Scene, technique: &str) -> Frame {
    let spec = catoptric_reflect::parse(technique).expect("a technique");
    let prepared = catoptric_reflect::prepare(gpu, &spec, scene, SIZE);
    prepared.expect("fits").render().expect("renders").frame
}

fn gpu() -> Option<Gpu> {
    gpu_or_skip().then(|| Gpu::new(None, Prefer::Software).expect("an adapter"))
}

fn count(frame: &Frame, status: Status) -> usize {
    let reflected = frame.reflected.as_ref().expect("all layers");
    let found = reflected.status.pixels().iter().filter(|s| **s == status);
    found.count()
}

/// Pixels of two frames whose status, first surface or reflected surface differ.
fn unlike(a: &Frame, b: &Frame) -> usize {
    let ids = |frame: &Frame| {
        let reflected = frame.reflected.as_ref().expect("all layers");
        let primary = frame.primary.as_ref().expect("all layers");
        let all = reflected.status.pixels().iter().zip(primary.id.pixels());
        let all = all.zip(reflected.id.pixels());
        all.map(|((status, first), seen)| (*status, *first, *seen))
            .collect::<Vec<_>>()
    };
    ids(a).iter().zip(ids(b)).filter(|(a, b)| **a != *b).count()
}

/// A square with corners 1 to 4, written with its front to +z, to −z, or to both sides.
fn square(faces: &str) -> String {
    format!("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n{faces}")
}

const FLOOR: &str = "object = [{ name = \"floor\", shape = \"grid\", n = 4, checker = { a = [1, 0, 0], \
                     b = [0, 1, 0] }, transform = { scale = 20, translate = [0, -3, 0] } }]\n";

/// Of some thousand mirror pixels, those at its edge.
const EDGE: usize = 12;

#[test]
fn a_mirror_written_for_both_sides_reflects_on_both() {
    let gpu = gpu();
    for (name, rotate) in [("facing", "[0, 0, 0]"), ("turned", "[20, 160, 33]")] {
        let mirror = format!(
            "{FLOOR}mirror = [{{ name = \"m\", mesh = \"m.obj\", transform = {{ rotate_deg = {rotate} }} }}]"
        );
        let both = [
            "f 1 2 3 4\nf 4 3 2 1\n",
            "f 4 3 2 1\nf 1 2 3 4\n",
            "f 4 3 2 1\nf 1 2 3 4\nf 2 3 4 1\nf 1 4 3 2\n",
        ];
        let mut frames = Vec::new();
        for (index, faces) in both.iter().enumerate() {
            let scene = scene(&[("m.obj", &square(faces))], &mirror);
            let truth = truth(&scene);
            assert_eq!(count(&truth, Status::Back), 0, "{name} {index}");
            assert!(count(&truth, Status::Resolved) > 800, "{name} {index}");
            if let Some(gpu) = &gpu {
                for technique in [
                    "ray-trace",
                    "ray-trace(gbuffer=mesh)",
                    "beams(bounces=4)",
                    "beams(bounces=4,gbuffer=mesh)",
                    "linear",
                    "cubemap-trace(size=64)",
                ] {
                    let drawn = drawn(gpu, &scene, technique);
                    assert_eq!(count(&drawn, Status::Back), 0, "{name} {index} {technique}");
                    if ["ray-trace", "beams(bounces=4)"].contains(&technique) {
                        let unlike = unlike(&truth, &drawn);
                        assert!(unlike <= EDGE, "{name} {index}: {unlike} pixels");
                    }
                }
            }
            frames.push(truth);
        }
        assert_eq!(unlike(&frames[0], &frames[1]), 0, "{name}");
        assert_eq!(unlike(&frames[0], &frames[2]), 0, "{name}");
    }
}

#[test]
fn flat_mirrors_back_to_back_reflect_on_both_sides_in_any_order() {
    let gpu = gpu();
    let plane = |name: &str, z: i32| {
        format!(
            "{{ name = \"{name}\", shape = \"plane\", center = [0, 0, 0], normal = [0, 0, {z}], \
             up = [0, 1, 0], size = [2, 2] }}"
        )
    };
    for [first, second] in [[1, -1], [-1, 1]] {
        let mirrors = format!(
            "{FLOOR}mirror = [{}, {}]",
            plane("a", first),
            plane("b", second)
        );
        let scene = scene(&[], &mirrors);
        let truth = truth(&scene);
        assert_eq!(count(&truth, Status::Back), 0);
        assert!(count(&truth, Status::Resolved) > 500);
        if let Some(gpu) = &gpu {
            for technique in ["ray-trace", "beams(bounces=4)"] {
                let drawn = drawn(gpu, &scene, technique);
                assert_eq!(count(&drawn, Status::Back), 0);
                let unlike = unlike(&truth, &drawn);
                assert!(unlike <= EDGE, "{technique}: {unlike} pixels");
            }
        }
    }
}

#[test]
fn a_mirror_on_a_wall_is_seen_before_it() {
    let gpu = gpu();
    let text = "object = [{ name = \"wall\", mesh = \"wall.obj\", transform = { rotate_deg = [7, 21, 3] } }]
mirror = [{ name = \"m\", mesh = \"m.obj\", transform = { rotate_deg = [7, 21, 3] } }]";
    let wall = square("f 2 3 4 1\n");
    let files = [
        ("wall.obj", wall.as_str()),
        ("m.obj", &square("f 1 2 3 4\n")),
    ];
    let scene = scene(&files, text);
    let truth = truth(&scene);
    let walls = |frame: &Frame| {
        let primary = frame.primary.as_ref().expect("all layers");
        primary.id.pixels().iter().filter(|id| **id == 1).count()
    };
    assert_eq!(walls(&truth), 0);
    assert!(count(&truth, Status::Resolved) > 800);
    if let Some(gpu) = &gpu {
        for technique in ["ray-trace", "linear(gbuffer=mesh)"] {
            let seen = walls(&drawn(gpu, &scene, technique));
            assert_eq!(seen, 0, "{technique}");
        }
    }
}

#[test]
fn thousands_of_coincident_triangles_take_no_longer_and_the_first_is_seen() {
    let gpu = gpu();
    let materials = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
    // The first of each kind is red, as is one written the other way round in between.
    let mut faces = "mtllib m.mtl\nusemtl red\nf 1 2 3\nf 1 3 4\nusemtl blue\n".to_owned();
    faces.push_str(&"f 1 2 3\nf 3 1 4\nf 3 2 1\nf 4 3 1\n".repeat(25_000));
    let files = [("m.mtl", materials), ("m.obj", &square(&faces))];
    let text =
        "object = [{ name = \"m\", mesh = \"m.obj\", transform = { translate = [1.8, 0, 1] } }]
mirror = [{ name = \"ball\", shape = \"sphere\", radius = 1 }]";
    let scene = scene(&files, text);
    let start = std::time::Instant::now();
    let truth = truth(&scene);
    // A few tenths of a second; square in the number of triangles it took minutes.
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
    let red = |frame: &Frame| {
        let primary = frame.primary.as_ref().expect("all layers");
        let seen = frame.color.pixels().iter().zip(primary.id.pixels());
        let seen = seen.filter(|(_, id)| **id == 1).map(|(color, _)| *color);
        seen.map(|color| color.x > 0.9 && color.z < 0.1)
            .collect::<Vec<_>>()
    };
    assert!(red(&truth).len() > 100 && red(&truth).iter().all(|red| *red));
    if let Some(gpu) = &gpu {
        let drawn = drawn(gpu, &scene, "ray-trace");
        assert!(red(&drawn).iter().all(|red| *red));
        let unlike = unlike(&truth, &drawn);
        assert!(unlike <= EDGE, "{unlike} pixels");
    }
}

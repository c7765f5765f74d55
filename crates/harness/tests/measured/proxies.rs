//! Open mirrors in pieces, with the closed meshes that they are cut of (Estalella et al. 2005, §6.2).

use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

use crate::support::{catoptric, code, gpu_or_skip, json};

/// A sphere, or a cap of it around +z or −z, as an OBJ file; with `sign` −1 its inside reflects.
struct Ball {
    center: [f64; 3],
    /// From which ring to which, of [`RINGS`] from +z to −z.
    rings: [usize; 2],
    sign: f64,
}

const SEGMENTS: usize = 64;
const RINGS: usize = 32;

impl Ball {
    /// Adds its vertices and faces to those of others, of which there are so many vertices.
    fn write(&self, text: &mut String, before: usize) -> usize {
        let [first, last] = self.rings;
        for ring in first..=last {
            let (sin, cos) = (TAU / 2.0 * ring as f64 / RINGS as f64).sin_cos();
            // The poles are single points.
            let sin = if ring % RINGS == 0 { 0.0 } else { sin };
            for segment in 0..SEGMENTS {
                let (y, x) = (TAU * segment as f64 / SEGMENTS as f64).sin_cos();
                let out = [x * sin, y * sin, cos];
                let at = [0, 1, 2].map(|axis| self.center[axis] + out[axis]);
                let normal = out.map(|along| self.sign * along);
                writeln!(text, "v {} {} {}", at[0], at[1], at[2]).expect("text");
                writeln!(text, "vn {} {} {}", normal[0], normal[1], normal[2]).expect("text");
            }
        }
        for ring in 0..last - first {
            for segment in 0..SEGMENTS {
                let next = (segment + 1) % SEGMENTS;
                let corner = |ring: usize, segment: usize| {
                    let index = before + ring * SEGMENTS + segment + 1;
                    format!("{index}//{index}")
                };
                let [a, b] = [corner(ring, segment), corner(ring, next)];
                let [c, d] = [corner(ring + 1, segment), corner(ring + 1, next)];
                writeln!(text, "f {a} {c} {d}\nf {a} {d} {b}").expect("text");
            }
        }
        (last - first + 1) * SEGMENTS
    }
}

fn obj(folder: &Path, name: &str, balls: &[Ball]) {
    let (mut text, mut vertices) = (String::new(), 0);
    for ball in balls {
        vertices += ball.write(&mut text, vertices);
    }
    std::fs::write(folder.join(name), text).expect("written");
}

const LEFT: [f64; 3] = [-0.8, 0.0, -1.0];
const RIGHT: [f64; 3] = [0.8, 0.0, 1.0];
const WHOLE: [usize; 2] = [0, RINGS];

const SCENE: &str = r#"
why = "An open mirror with a bulge and a dent."
[camera]
eye = [0.0, 0.4, 6.0]
target = [0.0, 0.0, 0.0]
fov_y = 30.0
[[object]]
name = "before the bulge"
shape = "grid"
n = 12
transform = { scale = 0.5, rotate_deg = [70.0, 0.0, 0.0], translate = [-1.2, 0.3, 2.5] }
[[object]]
name = "before the dent"
shape = "grid"
n = 12
transform = { scale = 0.5, rotate_deg = [70.0, 0.0, 0.0], translate = [0.9, 0.6, 4.0] }
[[mirror]]
name = "wave"
mesh = "wave.obj"
"#;

#[test]
fn an_open_mirror_in_pieces_is_searched_in_the_maps_of_its_proxies() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let ball = |center, rings, sign| Ball {
        center,
        rings,
        sign,
    };
    let bulge = ball(LEFT, [0, 8], 1.0);
    let dent = ball(RIGHT, [RINGS - 8, RINGS], -1.0);
    obj(folder, "wave.obj", &[bulge, dent]);
    obj(folder, "left.obj", &[ball(LEFT, WHOLE, 1.0)]);
    obj(folder, "right.obj", &[ball(RIGHT, WHOLE, 1.0)]);
    let compared = |proxies: &str| {
        let path = folder.join("scene.toml");
        std::fs::write(&path, format!("{SCENE}{proxies}")).expect("written");
        let path = path.to_string_lossy().into_owned();
        let size = ["--resolution", "160x120", "--format", "json"];
        let technique = "reflector-cubemap(iterations=40)";
        let output = catoptric(&[&["compare", &path, "-t", technique], &size[..]].concat());
        assert_eq!(code(&output), 0, "{output:?}");
        json(&output)[0].clone()
    };

    let open = compared("");
    assert_eq!(open["status"], "not-applicable");
    assert!(
        open["reason"]
            .as_str()
            .is_some_and(|reason| reason.contains("is open"))
    );

    let one = compared("proxy = [{ mesh = \"left.obj\" }]\n");
    let both = compared("proxy = [{ mesh = \"left.obj\" }, { mesh = \"right.obj\" }]\n");
    let of = |row: &serde_json::Value, path: &str| row.pointer(path).and_then(|v| v.as_f64());
    let recall = |row| of(row, "/vertices/recall").expect("a mesh mirror has exact points");
    let missing = |row| of(row, "/coverage/missing").expect("coverage");
    assert!(
        recall(&both) > recall(&one) + 0.2,
        "{} {}",
        recall(&both),
        recall(&one)
    );
    assert!(missing(&both) < missing(&one));
    let median = of(&both, "/vertices/offset_px/p50").expect("offsets");
    assert!(median < 0.2, "{median}");
    assert_eq!(both["vertices"]["solutions"]["spurious"], 0);
}

#[test]
fn a_proxy_is_a_closed_mesh_of_a_mesh_mirror() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let cap = || Ball {
        center: LEFT,
        rings: [0, 8],
        sign: 1.0,
    };
    obj(folder, "wave.obj", &[cap()]);
    for (body, says) in [
        ("proxy = [{ mesh = \"wave.obj\" }]\n", "is open"),
        (
            "proxy = [{ shape = \"sphere\", center = [0, 0, 0], radius = 1 }]\n",
            "needs no proxy",
        ),
        ("proxy = \"wave.obj\"\n", "an array of tables"),
        ("proxy = [{ mesh = \"none.obj\" }]\n", "none.obj"),
    ] {
        let path = folder.join("scene.toml");
        std::fs::write(&path, format!("{SCENE}{body}")).expect("written");
        let path = path.to_string_lossy().into_owned();
        let output = catoptric(&["reference", &path, "-o", "never.exr", "--resolution", "8x6"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(code(&output), 2, "{said}");
        assert!(
            said.contains(says) && said.contains("scene.toml:"),
            "{said}"
        );
    }
}

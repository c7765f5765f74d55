//! Textures on the GPU have the values that the reference sees, of 8 and of 16 bits; skipped where there
//! is no adapter, unless `CATOPTRIC_REQUIRE_GPU=1`.

use crate::support::gpu_or_skip;
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_reflect::{Gpu, Prefer};
use catoptric_scene::{LoadOptions, open};
use image::{ImageBuffer, Rgb};

const SIZE: [u32; 2] = [64, 48];

/// Two squares beside each other, with a picture each, one of them twice.
const SCENE: &str = "why = \"Two pictures.\"
camera = { eye = [0, 0, 5], target = [0, 0, 0], fov_y = 34 }
object = [
    { name = \"eight\", mesh = \"eight.obj\", transform = { translate = [-1, 0, -1] } },
    { name = \"sixteen\", mesh = \"sixteen.obj\", transform = { translate = [1, 0, -1] } },
]
mirror = [{ name = \"ball\", shape = \"sphere\", center = [0, 0, 1], radius = 0.3 }]
";

#[test]
fn colours_are_those_of_the_reference() {
    if !gpu_or_skip() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let value = |x: u32, y: u32, channel: u32| 7919 * (1 + x + 5 * y + 3 * channel) % 65_521;
    let all = |x: u32, y: u32| [0, 1, 2].map(|channel| value(x, y, channel));
    let sixteen = ImageBuffer::from_fn(7, 5, |x, y| Rgb(all(x, y).map(|value| value as u16)));
    sixteen.save(at("sixteen.png")).expect("is written");
    let eight = ImageBuffer::from_fn(6, 9, |x, y| Rgb(all(x, y).map(|value| (value >> 8) as u8)));
    eight.save(at("eight.png")).expect("is written");
    for name in ["eight", "sixteen"] {
        let materials =
            format!("newmtl a\nmap_Kd {name}.png\nnewmtl b\nKd 0.5 1 1\nmap_Kd {name}.png\n");
        std::fs::write(at(&format!("{name}.mtl")), materials).expect("is written");
        let square = format!(
            "mtllib {name}.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
             usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n"
        );
        std::fs::write(at(&format!("{name}.obj")), square).expect("is written");
    }
    std::fs::write(at("scene.toml"), SCENE).expect("is written");
    let options = LoadOptions {
        resolution: Some(SIZE),
        ..LoadOptions::default()
    };
    let path = at("scene.toml");
    let scene = open(path.to_str().expect("a UTF-8 path"), &options).expect("a scene");
    let truth = RenderOptions::new(SIZE, Truth::FirstBounce);
    let truth = Tracer::new(&scene).expect("whole").render(&truth);
    let gpu = Gpu::new(None, Prefer::Software).expect("an adapter");
    let spec = catoptric_reflect::parse("ray-trace").expect("a technique");
    let mut prepared = catoptric_reflect::prepare(&gpu, &spec, &scene, SIZE).expect("fits");
    let drawn = prepared.render().expect("renders").frame;
    let pairs = truth.color.pixels().iter().zip(drawn.color.pixels());
    let apart = pairs.map(|(a, b)| (*a - *b).abs().max_element());
    let apart: Vec<f32> = apart.collect();
    // The rasterizer interpolates texture coordinates; at edges of triangles a pixel may go either way.
    let off = apart.iter().filter(|apart| **apart > 2e-3).count();
    assert!(off <= 8, "{off} of {} pixels", apart.len());
}

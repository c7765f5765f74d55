//! Scenes from elsewhere: what comes back from our own export, and what files of other programs say.

use std::path::Path;

use catoptric::import::{self, Choice};
use catoptric_frame::Frame;
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_scene::{LoadOptions, Scene, Shape};
use glam::{DVec3, Vec3};

use crate::support::{catoptric, code, refused, stderr};

const SIZE: [u32; 2] = [160, 120];

fn load(name: &str) -> Scene {
    let options = LoadOptions {
        resolution: Some(SIZE),
        ..LoadOptions::default()
    };
    catoptric_scene::open(name, &options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn traced(size: [u32; 2], scene: &Scene) -> Frame {
    let tracer = Tracer::new(scene).expect("can be traced");
    tracer.render(&RenderOptions::new(size, Truth::FirstBounce))
}

/// Reads a file and loads what is written of it.
fn imported(file: &Path, mirrors: &[&str]) -> (Scene, Vec<String>) {
    let choice = Choice {
        roughness: 0.15,
        mirrors: mirrors.iter().map(|name| (*name).to_owned()).collect(),
    };
    let found = import::read(file, &choice).unwrap_or_else(|error| panic!("{error:#}"));
    let folder = tempfile::tempdir().expect("a folder");
    let (path, left_out) = import::write(&found, file, folder.path()).expect("written");
    let scene = load(path.to_str().expect("UTF-8"));
    (scene, [found.left_out, left_out].concat())
}

/// Whether Mitsuba has all parts of a scene: spheres, ellipsoids, rectangles, meshes with triangles.
fn is_theirs(scene: &Scene) -> bool {
    let mirror = |shape: &Shape| shape.primitive().is_some() || shape.as_mesh().is_some();
    scene.mirrors.iter().all(|m| mirror(&m.shape))
        && scene
            .objects
            .iter()
            .all(|object| !object.mesh.triangles.is_empty())
}

/// Most triangles of a scene that is tried: one sweep ends at a million.
const MOST_TRIANGLES: usize = 250_000;

/// Exports and imports the built-in scenes of these names that Mitsuba has all parts of; how many.
fn come_back(size: [u32; 2], chosen: impl Fn(&str) -> bool) -> usize {
    let mut tried = 0;
    for name in catoptric_scene::builtin::names() {
        let options = LoadOptions {
            resolution: Some(size),
            ..LoadOptions::default()
        };
        let Ok(scene) = catoptric_scene::open(&name, &options) else {
            // Its model is not here.
            continue;
        };
        if !chosen(&name) || !is_theirs(&scene) || scene.triangle_count() > MOST_TRIANGLES {
            continue;
        }
        let folder = tempfile::tempdir().expect("a folder");
        catoptric::export::mitsuba::write(&scene, 8, folder.path()).expect("exported");
        let (back, _) = imported(&folder.path().join("scene.xml"), &[]);
        same_picture(&name, size, &scene, &back);
        tried += 1;
    }
    tried
}

/// Whether a built-in scene is one of many that differ in a size or a motion.
fn is_of_a_sweep(name: &str) -> bool {
    ["sphere-grid", "sphere-drawn", "moving-"]
        .iter()
        .any(|start| name.starts_with(start))
}

#[test]
fn what_is_exported_for_mitsuba_comes_back() {
    let tried = come_back(SIZE, |name| !is_of_a_sweep(name));
    assert!(tried >= 30, "{tried}");
}

#[test]
fn so_does_what_is_exported_of_sweeps() {
    let tried = come_back([64, 48], is_of_a_sweep);
    assert!(tried >= 50, "{tried}");
}

fn same_picture(name: &str, size: [u32; 2], scene: &Scene, back: &Scene) {
    assert_eq!(scene.ids(), back.ids(), "{name}");
    let (a, b) = (traced(size, scene), traced(size, back));
    let [first, second] = [&a, &b].map(|frame| {
        let (primary, reflected) = (frame.primary.as_ref(), frame.reflected.as_ref());
        (primary.expect("layers"), reflected.expect("layers"))
    });
    let pairs = [
        (
            &first.0.id,
            &second.0.id,
            &first.0.position,
            &second.0.position,
        ),
        (
            &first.1.id,
            &second.1.id,
            &first.1.position,
            &second.1.position,
        ),
    ];
    for (layer, (ids, ids_back, at, at_back)) in pairs.into_iter().enumerate() {
        let pixels = ids.pixels().len();
        let same: Vec<bool> = (0..pixels)
            .map(|pixel| ids.pixels()[pixel] == ids_back.pixels()[pixel])
            .collect();
        let agree = same.iter().filter(|same| **same).count() as f64 / pixels as f64;
        assert!(agree >= 0.9999, "{name}, layer {layer}: {agree}");
        let worst = (0..pixels)
            .filter(|pixel| same[*pixel])
            .map(|pixel| (at.pixels()[pixel] - at_back.pixels()[pixel]).length())
            .fold(0.0f32, f32::max);
        assert!(worst <= 1e-6, "{name}, layer {layer}: {worst}");
    }
    let colors = a.color.pixels().iter().zip(b.color.pixels());
    let far = colors
        .filter(|(a, b)| (**a - **b).abs().max_element() > 1e-3)
        .count();
    assert!(
        far <= a.color.pixels().len() / 10_000,
        "{name}: {far} colours differ"
    );
}

fn write(folder: &Path, name: &str, text: &[u8]) -> std::path::PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("written");
    path
}

const XML: &str = r##"<scene version="3.0.0">
<default name="width" value="200"/>
<sensor type="perspective">
  <transform name="to_world"><lookat origin="0.5, 1, 5" target="0, 0.25, 0" up="0, 1, 0"/></transform>
  <float name="fov" value="40"/>
  <film type="hdrfilm"><integer name="width" value="$width"/><integer name="height" value="100"/></film>
</sensor>
<bsdf type="conductor" id="chrome"/>
<shape type="sphere" id="ball"><point name="center" x="0.1" y="1" z="0"/><float name="radius" value="0.7"/>
  <transform name="to_world"><scale value="2"/><translate x="1"/></transform><ref id="chrome"/></shape>
<shape type="rectangle" id="pane"><transform name="to_world"><scale x="2" y="3"/><rotate y="1" angle="90"/></transform>
  <bsdf type="twosided"><bsdf type="roughconductor"><float name="alpha" value="0.01"/></bsdf></bsdf></shape>
<shape type="rectangle" id="floor"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform>
  <bsdf type="diffuse"><texture name="reflectance" type="checkerboard"><rgb name="color0" value="1, 0, 0"/>
    <rgb name="color1" value="0, 0, 1"/><transform name="to_uv"><scale x="4" y="4"/></transform></texture></bsdf></shape>
<shape type="cube" id="box"><bsdf type="principled"><rgb name="base_color" value="#ff8000"/>
  <texture name="roughness" type="bitmap"><string name="filename" value="none.png"/></texture></bsdf></shape>
<shape type="hair" id="fur"/>
<emitter type="constant"><rgb name="radiance" value="0.5"/></emitter>
</scene>"##;

#[test]
fn shapes_of_mitsuba_are_where_the_file_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, left_out) = imported(&write(folder.path(), "a.xml", XML.as_bytes()), &[]);
    let names: Vec<_> = scene
        .ids()
        .into_iter()
        .map(|(_, name, mirror)| (name, mirror))
        .collect();
    let named = |name: &str, mirror| (name.to_owned(), mirror);
    let wanted = [
        named("floor", false),
        named("box", false),
        named("ball", true),
        named("pane", true),
    ];
    assert_eq!(names, wanted);
    assert_eq!(scene.camera.eye, DVec3::new(0.5, 1.0, 5.0));
    assert_eq!(scene.camera.target, DVec3::new(0.0, 0.25, 0.0));
    let Shape::Sphere(ball) = &scene.mirrors[0].shape else {
        panic!("{:?}", scene.mirrors[0].shape);
    };
    assert!(
        (ball.center - DVec3::new(1.2, 2.0, 0.0)).length() < 1e-12
            && (ball.radius - 1.4).abs() < 1e-12
    );
    let Shape::Plane(pane) = &scene.mirrors[1].shape else {
        panic!("{:?}", scene.mirrors[1].shape);
    };
    assert!(
        (pane.normal - DVec3::X).length() < 1e-12
            && (pane.size - glam::DVec2::new(4.0, 6.0)).length() < 1e-9
    );
    let floor = scene.objects[0].mesh.bounds().expect("corners");
    assert!(
        (floor.0 - Vec3::new(-3.0, 0.0, -3.0)).length() < 1e-6,
        "{floor:?}"
    );
    assert!(
        left_out
            .iter()
            .any(|what| what.contains("hair") && what.contains("fur")),
        "{left_out:?}"
    );
    assert!(
        left_out.iter().any(|what| what.contains("pane")),
        "both sides: {left_out:?}"
    );
    assert!(
        left_out.iter().any(|what| what.contains("`roughness`")),
        "a texture: {left_out:?}"
    );
}

const PBRT: &str = r#"# a comment
LookAt 0 1 5  0 0 0  0 1 0
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" [ 200 ] "integer yresolution" [ 100 ]
WorldBegin
MakeNamedMaterial "steel" "string type" "conductor" "float roughness" 0.01
AttributeBegin
  NamedMaterial "steel"
  Translate 1 2 3
  Scale 2 2 2
  Shape "sphere" "float radius" 0.25
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.1 0.2 0.3 ]
ObjectBegin "leaf"
Shape "trianglemesh" "point3 P" [ 0 0 0  1 0 0  0 1 0 ] "integer indices" [ 0 1 2 ]
ObjectEnd
Translate 5 0 0
ObjectInstance "leaf"
Shape "curve" "point3 P" [ 0 0 0 1 1 1 2 2 2 3 3 3 ]
"#;

#[test]
fn shapes_of_pbrt_are_where_the_file_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, left_out) = imported(&write(folder.path(), "a.pbrt", PBRT.as_bytes()), &[]);
    let Shape::Sphere(ball) = &scene.mirrors[0].shape else {
        panic!("{:?}", scene.mirrors[0].shape);
    };
    assert!(
        (ball.center - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-12
            && (ball.radius - 0.5).abs() < 1e-12
    );
    assert_eq!(scene.objects.len(), 1);
    assert_eq!(scene.objects[0].mesh.positions[1], Vec3::new(6.0, 0.0, 0.0));
    assert_eq!(scene.camera.fov, catoptric_scene::Fov::Y(45.0));
    assert!(
        left_out.iter().any(|what| what.contains("curve")),
        "{left_out:?}"
    );
    let (scene, _) = imported(&folder.path().join("a.pbrt"), &["diffuse"]);
    assert_eq!((scene.objects.len(), scene.mirrors.len()), (0, 2));
}

/// A triangle as glTF; its material a smooth metal, or its buffer cut by so many bytes.
fn gltf(cut: usize) -> String {
    use base64::Engine;
    let numbers: [f32; 9] = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
    let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes[..36 - cut]);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],
"nodes":[{{"name":"up","translation":[0,2,0],"children":[1,2]}},{{"name":"pane","mesh":0,"scale":[2,2,2]}},
{{"name":"eye","camera":0,"translation":[0,0,4]}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":0.7853981633974483,"znear":0.1,"aspectRatio":2}}}}],
"materials":[{{"name":"steel","pbrMetallicRoughness":{{"roughnessFactor":0.05}}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}},{{"attributes":{{"POSITION":0}},"mode":1}},
{{"attributes":{{"POSITION":0}}}}]}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{data}"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}]}}"#
    )
}

#[test]
fn nodes_and_materials_of_gltf() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = write(folder.path(), "a.gltf", gltf(0).as_bytes());
    let (scene, left_out) = imported(&file, &[]);
    assert_eq!((scene.objects.len(), scene.mirrors.len()), (1, 1));
    let mesh = &scene.objects[0].mesh;
    assert!(
        mesh.positions.contains(&Vec3::new(2.0, 2.0, 0.0)),
        "{:?}",
        mesh.positions
    );
    assert_eq!(scene.camera.eye, DVec3::new(0.0, 2.0, 4.0));
    assert!((scene.camera.target - DVec3::new(0.0, 2.0, 3.0)).length() < 1e-9);
    assert!(
        left_out.iter().any(|what| what.contains("lines")),
        "{left_out:?}"
    );
    let toml = "why = \"a\"\n[camera]\neye = [0, 2, 9]\ntarget = [0, 2, 0]\nfov_y = 40\n\
                [[object]]\nname = \"all\"\nmesh = \"a.gltf\"\n";
    let whole = load(
        write(folder.path(), "s.toml", toml.as_bytes())
            .to_str()
            .expect("UTF-8"),
    );
    assert_eq!(whole.objects[0].mesh.triangles.len(), 2);
    assert!(
        !whole.warnings.is_empty(),
        "lines are left out, and that is said"
    );
}

#[test]
fn meshes_of_other_kinds_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\n\
               property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
               property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n\
               0 1 0 255 255 255\n4 0 1 2 3\n";
    let stl = "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  \
               endloop\n endfacet\nendsolid a\n";
    for (name, text, triangles) in [("a.ply", ply, 2), ("a.stl", stl, 1)] {
        write(folder.path(), name, text.as_bytes());
        for kind in ["object", "mirror"] {
            let toml = format!(
                "why = \"a\"\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\nfov_y = 40\n[[{kind}]]\n\
                 name = \"m\"\nmesh = \"{name}\"\n"
            );
            let scene = load(
                write(folder.path(), "s.toml", toml.as_bytes())
                    .to_str()
                    .expect("UTF-8"),
            );
            let mesh = match kind {
                "object" => scene.objects[0].mesh.clone(),
                _ => scene.mirrors[0].shape.as_mesh().expect("a mesh").clone(),
            };
            assert_eq!(mesh.triangles.len(), triangles, "{name} as {kind}");
        }
    }
}

#[test]
fn bad_files_are_refused_with_their_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let refused_file = |name: &str, text: &[u8]| {
        let file = write(folder.path(), name, text);
        let message = refused(&[
            "import",
            file.to_str().expect("UTF-8"),
            "-o",
            out.to_str().expect("UTF-8"),
        ]);
        assert!(!out.join("scene.toml").exists(), "{message}");
        message
    };
    let said = |message: String, parts: &[&str]| {
        for part in parts {
            assert!(message.contains(part), "{part}: {message}");
        }
    };
    said(refused_file("a.obj", b"v 0 0 0"), &["a.obj", ".pbrt"]);
    said(
        refused_file("a.xml", b"<scene>\n<shape type=sphere/></scene>"),
        &["a.xml:2"],
    );
    said(
        refused_file("a.xml", b"<scene>\n<shape type=\"sphere\">\n<float name=\"radius\" value=\"x\"/></shape></scene>"),
        &["a.xml:3", "`radius`", "`x`"],
    );
    said(
        refused_file("a.xml", b"<scene><shape type=\"ply\">\n<string name=\"filename\" value=\"no.ply\"/></shape></scene>"),
        &["a.xml:1", "no.ply"],
    );
    said(
        refused_file("a.pbrt", b"WorldBegin\nShap \"sphere\""),
        &["a.pbrt:2", "`Shap`"],
    );
    said(
        refused_file(
            "a.pbrt",
            b"WorldBegin\nShape \"sphere\" \"float radius\" [ -1 ]",
        ),
        &["a.pbrt:2", "-1"],
    );
    said(
        refused_file("a.pbrt", b"WorldBegin\n\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 7 ]"),
        &["a.pbrt:3", "7", "3 points"],
    );
    said(refused_file("a.gltf", b"{\n\"asset\": 1 }"), &["a.gltf:2"]);
    said(
        refused_file("a.gltf", gltf(4).as_bytes()),
        &["a.gltf", "36 bytes"],
    );
    said(
        refused_file("a.glb", b"glTF\x02\0\0\0\xff\xff\xff\xff"),
        &["a.glb"],
    );
    let file = write(folder.path(), "ok.pbrt", PBRT.as_bytes());
    let file = file.to_str().expect("UTF-8");
    let to = out.to_str().expect("UTF-8");
    said(
        refused(&["import", file, "-o", to, "--mirror", "steal"]),
        &["steal", "steel"],
    );
    let good = catoptric(&["import", file, "-o", to]);
    assert_eq!(code(&good), 0, "{}", stderr(&good));
    assert!(
        stderr(&good).contains("left out: the shape `curve` of ok.pbrt, line 19"),
        "{}",
        stderr(&good)
    );
}

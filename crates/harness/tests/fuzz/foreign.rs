//! Inputs of other programs' kinds: models (glTF, PLY, STL) and scenes (Mitsuba's XML, PBRT), each a
//! good one with something changed.

use base64::Engine;
use catoptric_scene::Random;

use super::inputs::random;
use super::mutate::{self, once_in, one};
use super::targets::Input;

/// A scene file around a mesh.
const AROUND: &str = "why = \"fuzz\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov_y = 40\n";

/// A square in bytes: positions, texture coordinates, indices.
fn square() -> Vec<u8> {
    let positions: [f32; 12] = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let uvs: [f32; 8] = [0., 0., 1., 0., 1., 1., 0., 1.];
    let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
    let mut bytes: Vec<u8> = positions.iter().flat_map(|n| n.to_le_bytes()).collect();
    bytes.extend(uvs.iter().flat_map(|n| n.to_le_bytes()));
    bytes.extend(indices.iter().flat_map(|n| n.to_le_bytes()));
    bytes
}

/// The same as glTF; its buffer in the text, or elsewhere.
fn gltf(uri: Option<String>) -> String {
    let uri = uri.map_or_else(String::new, |uri| format!(",\"uri\":\"{uri}\""));
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1]}}],
"nodes":[{{"name":"a","mesh":0,"scale":[2,2,2],"children":[2]}},{{"camera":0,"translation":[0,0,5]}},
{{"mesh":0,"rotation":[0,0,1,0],"translation":[1,0,0]}}],
"cameras":[{{"type":"perspective","perspective":{{"yfov":0.8,"znear":0.1}}}}],
"materials":[{{"name":"m","pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0,1],"roughnessFactor":0.0}}}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":0,"mode":4}}]}}],
"buffers":[{{"byteLength":92{uri}}}],
"bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},{{"buffer":0,"byteOffset":80,"byteLength":12}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
{{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},{{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR",
"sparse":{{"count":1,"indices":{{"bufferView":2,"componentType":5123}},"values":{{"bufferView":2}}}}}}]}}"#
    )
}

/// The same as binary glTF.
fn glb() -> Vec<u8> {
    let mut text = gltf(None).into_bytes();
    while !text.len().is_multiple_of(4) {
        text.push(b' ');
    }
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    let data = square();
    bytes.extend(((12 + 8 + text.len() + 8 + data.len()) as u32).to_le_bytes());
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(text);
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(data);
    bytes
}

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n\
property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n\
property list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n0 1 0 255 0 0\n\
4 0 1 2 3\n3 0 2 3\n";

fn binary_ply() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n\
property float y\nproperty float z\nelement face 1\nproperty list uint uint vertex_index\nend_header\n"
        .to_vec();
    bytes.extend(&square()[..48]);
    for number in [4_u32, 0, 1, 2, 3] {
        bytes.extend(number.to_le_bytes());
    }
    bytes
}

const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
endfacet\nendsolid a\n";

fn binary_stl() -> Vec<u8> {
    let mut bytes = vec![b's'; 80];
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend([0; 12]);
    bytes.extend(&square()[..36]);
    bytes.extend([0; 2]);
    bytes
}

/// A model that a scene file names.
pub fn model(seed: u64) -> Input {
    let mut random = random(seed);
    let data = base64::engine::general_purpose::STANDARD.encode(square());
    let uri = format!("data:application/octet-stream;base64,{data}");
    let (name, bytes): (&'static str, Vec<u8>) = match random.below(6) {
        0 => ("m.gltf", gltf(Some(uri)).into_bytes()),
        1 => ("m.glb", glb()),
        2 => ("m.ply", PLY.as_bytes().to_vec()),
        3 => ("m.ply", binary_ply()),
        4 => ("m.stl", STL.as_bytes().to_vec()),
        _ => ("m.stl", binary_stl()),
    };
    let bytes = changed(&mut random, bytes);
    let kind = one(&mut random, &["object", "mirror"]);
    let scene = format!("{AROUND}[[{kind}]]\nname = \"m\"\nmesh = \"{name}\"\n");
    Input(vec![("s.toml", scene.into_bytes()), (name, bytes)])
}

fn changed(random: &mut Random, bytes: Vec<u8>) -> Vec<u8> {
    match (once_in(random, 8), String::from_utf8(bytes)) {
        (true, Ok(text)) => text.into_bytes(),
        (false, Ok(text)) if once_in(random, 2) => mutate::text(random, &text),
        (_, Ok(text)) => mutate::bytes(random, text.into_bytes()),
        (true, Err(error)) => error.into_bytes(),
        (false, Err(error)) => mutate::bytes(random, error.into_bytes()),
    }
}

/// What a scene of Mitsuba begins with.
const XML: &str = r##"<scene version="3.0.0"><default name="w" value="64"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
<float name="fov" value="40"/><film type="hdrfilm"><integer name="width" value="$w"/></film></sensor>
<bsdf type="twosided" id="gold"><bsdf type="roughconductor"><float name="alpha" value="0.05"/></bsdf></bsdf>
<texture type="checkerboard" id="check"><rgb name="color0" value="0.1, 0.2, 0.3"/><transform name="to_uv"><scale x="4" y="4"/></transform></texture>
<bsdf type="diffuse" id="floor"><ref name="reflectance" id="check"/></bsdf>
<shape type="shapegroup" id="g"><shape type="sphere"><ref id="gold"/></shape></shape>
"##;

/// What may follow.
const XML_PARTS: [&str; 11] = [
    r##"<shape type="sphere"><point name="center" x="0" y="1" z="0"/><float name="radius" value="0.5"/><ref id="gold"/></shape>"##,
    r##"<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="3"/></transform><ref id="floor"/></shape>"##,
    r##"<shape type="cube"><transform name="to_world"><matrix value="1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="#ff8000"/></bsdf></shape>"##,
    r##"<shape type="disk"><boolean name="flip_normals" value="true"/></shape>"##,
    r##"<shape type="ply"><string name="filename" value="m.ply"/><boolean name="face_normals" value="true"/></shape>"##,
    r##"<shape type="obj"><string name="filename" value="m.obj"/><ref id="gold"/></shape>"##,
    r##"<shape type="instance"><ref id="g"/><transform name="to_world"><scale x="1" y="2" z="1"/></transform></shape>"##,
    r##"<emitter type="constant"><rgb name="radiance" value="0.5"/></emitter>"##,
    r##"<shape type="rectangle" id="lamp"><emitter type="area"><spectrum name="radiance" value="400:1, 500:2, 700:3"/></emitter></shape>"##,
    r##"<shape type="rectangle"><bsdf type="principled"><texture name="base_color" type="bitmap"><string name="filename" value="t.png"/>
<transform name="to_uv"><scale x="2" y="2"/></transform></texture><float name="metallic" value="0.2"/></bsdf></shape>"##,
    r##"<include filename="more.xml"/>"##,
];

/// A shape that becomes tens of thousands of triangles, which take their time.
const XML_ROUND: &str = r##"<shape type="sphere"><transform name="to_world"><scale x="1" y="2" z="3"/></transform></shape>"##;

const PBRT: &str = r##"LookAt 0 1 5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" [ 64 ] "integer yresolution" [ 48 ]
Include "more.pbrt"
WorldBegin
Texture "check" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4 "rgb tex1" [1 0 0]
MakeNamedMaterial "floor" "string type" "diffuse" "texture reflectance" "check"
ObjectBegin "thing"
  Shape "plymesh" "string filename" "m.ply"
  ReverseOrientation
  Shape "disk" "float height" 0.2
ObjectEnd
"##;

const PBRT_PARTS: [&str; 9] = [
    r##"LightSource "infinite" "rgb L" [ 0.1 0.2 0.3 ]"##,
    r##"AttributeBegin
  Material "conductor" "float roughness" 0.01
  Translate 0 1 0
  Shape "sphere" "float radius" 0.5
AttributeEnd"##,
    r##"NamedMaterial "floor"
Shape "trianglemesh" "point3 P" [ -3 0 -3  3 0 -3  3 0 3  -3 0 3 ] "integer indices" [ 0 1 2 0 2 3 ]
  "point2 uv" [ 0 0 1 0 1 1 0 1 ] "normal N" [ 0 1 0 0 1 0 0 1 0 0 1 0 ]"##,
    r##"ObjectInstance "thing""##,
    r##"Rotate 30 0 1 0
Scale 1 2 1 ObjectInstance "thing""##,
    r##"Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]"##,
    r##"Texture "picture" "spectrum" "imagemap" "string filename" "t.png" "float uscale" [ 2 ]
Material "coateddiffuse" "texture reflectance" "picture"
Shape "bilinearmesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]"##,
    r##"AttributeBegin
  CoordSysTransform "camera" ConcatTransform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 2 1 ]
  AreaLightSource "diffuse" "blackbody L" 3000
  Shape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ]
AttributeEnd"##,
    r##"Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" [ 400 1 700 2 ]
Shape "loopsubdiv" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ] "integer levels" 2"##,
];

const PBRT_ROUND: &str = r##"Scale 1 2 3 Material "diffuse" Shape "sphere""##;

/// A text of the first part and some of the others; rarely of the last, which is slow.
fn some(random: &mut Random, first: &str, parts: &[&str], round: &str) -> String {
    let mut text = first.to_owned();
    for part in parts {
        if once_in(random, 2) {
            text += part;
            text.push('\n');
        }
    }
    if once_in(random, 64) {
        text += round;
        text.push('\n');
    }
    text
}

/// A scene of another renderer.
pub fn import(seed: u64) -> Input {
    let mut random = random(seed);
    let random = &mut random;
    let data = base64::engine::general_purpose::STANDARD.encode(square());
    let uri = format!("data:application/octet-stream;base64,{data}");
    let (name, bytes): (&'static str, Vec<u8>) = match random.below(8) {
        0..=3 => {
            let text = some(random, XML, &XML_PARTS, XML_ROUND);
            ("s.xml", format!("{text}</scene>\n").into_bytes())
        }
        4..=6 => (
            "s.pbrt",
            some(random, PBRT, &PBRT_PARTS, PBRT_ROUND).into_bytes(),
        ),
        _ => match once_in(random, 2) {
            true => ("s.gltf", gltf(Some(uri)).into_bytes()),
            false => ("s.glb", glb()),
        },
    };
    Input(vec![
        (name, changed(random, bytes)),
        ("m.ply", PLY.as_bytes().to_vec()),
        ("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
        ("t.png", super::inputs::PICTURES[0].clone()),
        ("more.pbrt", b"Sampler \"halton\"\n".to_vec()),
        (
            "more.xml",
            b"<scene version=\"3.0.0\"><shape type=\"cube\"/></scene>".to_vec(),
        ),
    ])
}

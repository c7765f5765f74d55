//! The inputs of each target, by their numbers: texts by a grammar, and damaged files that were good.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use catoptric_frame::Frame;
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_scene::{LoadOptions, Random};
use serde_json::{Value, json};

use super::mutate::{self, NUMBERS, TEXTS, once_in, one};
use super::targets::Input;

pub fn random(seed: u64) -> Random {
    Random::new(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5eed)
}

/// A scene around what is tried.
const AROUND: &str = "why = \"fuzz\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov_y = 40\n";

/// Texts of the built-in scenes.
static SCENES: LazyLock<Vec<String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let entries = fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|found| found == "toml"))
        .collect();
    paths.sort();
    let texts = paths.iter().map(fs::read_to_string);
    texts.map(|text| text.expect("a text")).collect()
});

/// Half are built-in scenes with something changed, half are written by a grammar.
pub fn scene(seed: u64) -> Input {
    let mut random = random(seed);
    let text = match once_in(&mut random, 2) {
        true => {
            let text = one(&mut random, &SCENES).clone();
            mutate::text(&mut random, &text)
        }
        false => by_grammar(&mut random).into_bytes(),
    };
    Input(vec![("s.toml", text)])
}

/// Keys of an object or a mirror, and what they take.
const KEYS: [(&str, Kind); 37] = [
    ("shape", Kind::Shape),
    ("mesh", Kind::Text),
    ("texture", Kind::Text),
    ("center", Kind::Vector),
    ("radius", Kind::Number),
    ("radii", Kind::Vector),
    ("rotate_deg", Kind::Vector),
    ("normal", Kind::Vector),
    ("up", Kind::Vector),
    ("size", Kind::Pair),
    ("axis", Kind::Vector),
    ("half_angle_deg", Kind::Number),
    ("major", Kind::Number),
    ("minor", Kind::Number),
    ("tube", Kind::Number),
    ("curvature", Kind::Pair),
    ("segments", Kind::Count),
    ("n", Kind::Count),
    ("turn_deg", Kind::Number),
    ("profile", Kind::Pairs),
    ("tessellation", Kind::Count),
    ("facets", Kind::Bool),
    ("cubemaps", Kind::Vectors),
    ("transform", Kind::Transform),
    ("repeat", Kind::Repeat),
    ("color", Kind::Vector),
    ("checker", Kind::Checker),
    ("vertex_colors", Kind::Bool),
    ("positions", Kind::Vectors),
    ("triangles", Kind::Indices),
    ("colors", Kind::Vectors),
    ("count", Kind::Count),
    ("seed", Kind::Count),
    ("t", Kind::Pair),
    ("mirror", Kind::Text),
    ("mtl", Kind::Text),
    ("unknown", Kind::Number),
];

const SHAPES: [&str; 16] = [
    "quad",
    "grid",
    "box",
    "sphere",
    "torus",
    "lathe",
    "cylinder",
    "cone",
    "teapot",
    "triangles",
    "points",
    "ellipsoid",
    "plane",
    "bowl",
    "saddle",
    "nothing",
];

/// Kinds of values.
#[derive(Clone, Copy)]
enum Kind {
    Number,
    Count,
    Pair,
    Vector,
    Vectors,
    Pairs,
    Indices,
    Bool,
    Text,
    Shape,
    Transform,
    Repeat,
    Checker,
}

impl Kind {
    const ALL: [Self; 13] = [
        Self::Number,
        Self::Count,
        Self::Pair,
        Self::Vector,
        Self::Vectors,
        Self::Pairs,
        Self::Indices,
        Self::Bool,
        Self::Text,
        Self::Shape,
        Self::Transform,
        Self::Repeat,
        Self::Checker,
    ];

    /// A value, as TOML writes it.
    fn value(self, random: &mut Random) -> String {
        if once_in(random, 40) {
            return one(random, &Self::ALL).value(random);
        }
        let list = |random: &mut Random, of: Self, most: usize| {
            let count = random.below(most + 1);
            let items: Vec<_> = (0..count).map(|_| of.value(random)).collect();
            format!("[{}]", items.join(", "))
        };
        match self {
            Self::Number if once_in(random, 30) => (*one(random, &NUMBERS)).to_owned(),
            Self::Number => format!("{:.3}", random.between(-2.0, 4.0)),
            Self::Count if once_in(random, 30) => (*one(random, &NUMBERS)).to_owned(),
            Self::Count => random.below(12).to_string(),
            Self::Pair => {
                let [a, b] = [(); 2].map(|()| Self::Number.value(random));
                format!("[{a}, {b}]")
            }
            Self::Vector => {
                let [a, b, c] = [(); 3].map(|()| Self::Number.value(random));
                format!("[{a}, {b}, {c}]")
            }
            Self::Vectors => list(random, Self::Vector, 6),
            Self::Pairs => list(random, Self::Pair, 6),
            Self::Indices => {
                let triangle = |random: &mut Random| {
                    let [a, b, c] = [(); 3].map(|()| random.below(6));
                    format!("[{a}, {b}, {c}]")
                };
                let count = random.below(4);
                let items: Vec<_> = (0..count).map(|_| triangle(random)).collect();
                format!("[{}]", items.join(", "))
            }
            Self::Bool => once_in(random, 2).to_string(),
            Self::Text => format!("{:?}", one(random, &["ball", "m.obj", "", "..", "é"])),
            Self::Shape => format!("{:?}", one(random, &SHAPES)),
            Self::Transform => format!(
                "{{ scale = {}, rotate_deg = {}, translate = {} }}",
                Self::Number.value(random),
                Self::Vector.value(random),
                Self::Vector.value(random)
            ),
            Self::Repeat => format!(
                "[{{ count = {}, translate = {} }}, {{ count = {}, rotate_deg = {} }}]",
                Self::Count.value(random),
                Self::Vector.value(random),
                Self::Count.value(random),
                Self::Vector.value(random)
            ),
            Self::Checker => format!(
                "{{ a = {}, b = {}, cells = {} }}",
                Self::Vector.value(random),
                Self::Vector.value(random),
                Self::Count.value(random)
            ),
        }
    }
}

/// An object or a mirror of a shape, with the keys that this shape needs and some that it does not.
fn part(random: &mut Random, table: &str, name: &str) -> String {
    let shape = *one(random, &SHAPES);
    let needs: &[&str] = match shape {
        "sphere" => &["center", "radius"],
        "torus" if table == "object" => &["radius", "tube"],
        "torus" => &["center", "axis", "major", "minor"],
        "lathe" => &["profile"],
        "triangles" => &["positions", "triangles"],
        "points" => &["count", "seed", "t", "mirror"],
        "ellipsoid" => &["center", "radii"],
        "plane" => &["center", "normal", "size"],
        "bowl" => &["center", "radius", "axis", "half_angle_deg"],
        "saddle" => &["center", "normal", "size", "curvature"],
        _ => &[],
    };
    let mut text = format!("\n[[{table}]]\nname = \"{name}\"\nshape = \"{shape}\"\n");
    let needed = KEYS.iter().filter(|(key, _)| needs.contains(key));
    let mut keys: Vec<_> = needed.collect();
    for _ in 0..random.below(3) {
        keys.push(one(random, &KEYS));
    }
    for (key, kind) in keys {
        if !once_in(random, 20) {
            text += &format!("{key} = {}\n", kind.value(random));
        }
    }
    text
}

fn by_grammar(random: &mut Random) -> String {
    let mut text = AROUND.to_owned();
    for _ in 0..=random.below(2) {
        text += &part(random, "object", "thing");
    }
    for _ in 0..=random.below(2) {
        text += &part(random, "mirror", "ball");
    }
    if once_in(random, 5) {
        let frames = Kind::Count.value(random);
        text += &format!("\n[motion]\nframes = {frames}\n[[motion.move]]\nname = \"ball\"\n");
        text += &format!("translate = {}\n", Kind::Vector.value(random));
    }
    text
}

/// A mesh as an object, and as a mirror.
const MESH: &str = "\n[[object]]\nname = \"o\"\nmesh = \"m.obj\"\n\n[[mirror]]\nname = \"m\"\n\
                    shape = \"sphere\"\ncenter = [0, 0, -9]\nradius = 0.5\n";

/// A line of an OBJ file.
fn statement(random: &mut Random) -> String {
    let number = |random: &mut Random| match once_in(random, 60) {
        true => (*one(random, &NUMBERS)).to_owned(),
        false => format!("{:.2}", random.between(-2.0, 2.0)),
    };
    let index = |random: &mut Random| match once_in(random, 60) {
        true => (*one(random, &NUMBERS)).to_owned(),
        false => match random.below(8) {
            0 => format!("-{}", 1 + random.below(3)),
            _ => (1 + random.below(9)).to_string(),
        },
    };
    let numbers = |random: &mut Random, count: usize| {
        let all: Vec<_> = (0..count).map(|_| number(random)).collect();
        all.join(" ")
    };
    match random.below(24) {
        0..8 => format!("v {}", numbers(random, 3)),
        8 => format!("vt {}", numbers(random, 2)),
        9 => format!("vn {}", numbers(random, 3)),
        10 => format!("usemtl {}", one(random, &["a", "b", "", "é", "no"])),
        11 => format!("s {}", one(random, &["off", "1", "2", "0", "-1", "x"])),
        12 => format!("{} 1 2", one(random, &["l", "p", "g", "o", "curv", "#"])),
        13 => "mtllib m.mtl".to_owned(),
        14 => (*one(random, &TEXTS)).to_owned(),
        _ => {
            let corners = *one(random, &[1, 2, 3, 3, 3, 3, 4, 4, 5, 6, 9, 12]);
            let form = random.below(4);
            let corner = |random: &mut Random| {
                let [v, t, n] = [(); 3].map(|()| index(random));
                match form {
                    0 => format!("{v}/{t}"),
                    1 => format!("{v}//{n}"),
                    2 => format!("{v}/{t}/{n}"),
                    _ => v,
                }
            };
            let all: Vec<_> = (0..corners).map(|_| corner(random)).collect();
            let joined = *one(random, &[" ", " ", " ", " \\\n"]);
            format!("f {}", all.join(joined))
        }
    }
}

/// A line of an MTL file.
fn material(random: &mut Random) -> String {
    let number = |random: &mut Random| match once_in(random, 20) {
        true => (*one(random, &NUMBERS)).to_owned(),
        false => format!("{:.2}", random.unit()),
    };
    match random.below(8) {
        0 | 1 => format!("newmtl {}", one(random, &["a", "b", "", "é"])),
        2 | 3 => {
            let count = 1 + random.below(4);
            let all: Vec<_> = (0..count).map(|_| number(random)).collect();
            format!("Kd {}", all.join(" "))
        }
        4 => format!(
            "map_Kd {}",
            one(random, &["t.png", "no.png", "-s 2 2 t.png", "-o", ""])
        ),
        5 => format!("Ns {}", number(random)),
        6 => (*one(random, &TEXTS)).to_owned(),
        _ => format!("map_Kd -o {} {} t.png", number(random), number(random)),
    }
}

pub fn mesh(seed: u64) -> Input {
    let mut random = random(seed);
    let mut lines = vec!["mtllib m.mtl".to_owned()];
    lines.extend((0..8).map(|i| format!("v {} {} {}", i % 2, i / 2 % 2, i / 4)));
    lines.extend((0..9).map(|i| format!("vt {} {}\nvn {} 1 0", i % 3, i / 3, i % 2)));
    lines.extend((0..random.below(30)).map(|_| statement(&mut random)));
    let materials: Vec<_> = (0..random.below(8))
        .map(|_| material(&mut random))
        .collect();
    let mut obj = lines.join("\n").into_bytes();
    let mut mtl = materials.join("\n").into_bytes();
    if once_in(&mut random, 3) {
        obj = mutate::bytes(&mut random, obj);
        mtl = mutate::bytes(&mut random, mtl);
    }
    Input(vec![
        ("s.toml", format!("{AROUND}{MESH}").into_bytes()),
        ("m.obj", obj),
        ("m.mtl", mtl),
        ("t.png", PICTURES[0].clone()),
    ])
}

/// Good pictures of both kinds, in several layouts of their texels.
pub static PICTURES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let rgb = image::RgbImage::from_fn(9, 5, |x, y| image::Rgb([x as u8 * 20, y as u8 * 40, 99]));
    let rgb = image::DynamicImage::from(rgb);
    let layouts = [
        rgb.clone(),
        rgb.to_luma8().into(),
        rgb.to_luma_alpha8().into(),
        rgb.to_rgba8().into(),
        rgb.to_rgb16().into(),
    ];
    let encoded = |picture: &image::DynamicImage, format| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture
            .write_to(&mut bytes, format)
            .expect("it can be encoded");
        bytes.into_inner()
    };
    let png = layouts.iter();
    let mut all: Vec<_> = png.map(|it| encoded(it, image::ImageFormat::Png)).collect();
    let jpeg = layouts[..2].iter();
    all.extend(jpeg.map(|it| encoded(it, image::ImageFormat::Jpeg)));
    all
});

/// The check sum of a PNG chunk.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |mut crc, byte| {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xedb8_8320 & 0_u32.wrapping_sub(crc & 1));
        }
        crc
    })
}

/// Makes the check sums of a PNG's chunks right, so that damage gets beyond them.
fn mend(png: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = png.get(at..at + 4) {
        let length = u32::from_be_bytes(length.try_into().expect("four bytes")) as usize;
        let end = at.saturating_add(8).saturating_add(length);
        if png.len() < end.saturating_add(4) {
            return;
        }
        let sum = crc(&png[at + 4..end]);
        png[end..end + 4].copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

pub fn texture(seed: u64) -> Input {
    let mut random = random(seed);
    let picture = one(&mut random, &PICTURES).clone();
    let is_png = picture.starts_with(b"\x89PNG");
    let mut picture = mutate::bytes(&mut random, picture);
    if is_png && !once_in(&mut random, 4) {
        mend(&mut picture);
    }
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
    Input(vec![
        ("s.toml", format!("{AROUND}{MESH}").into_bytes()),
        ("m.obj", obj.as_bytes().to_vec()),
        ("m.mtl", b"newmtl a\nmap_Kd t.png\n".to_vec()),
        ("t.png", picture),
    ])
}

/// Pictures as the program writes them: with all layers, and with colour alone.
static FRAMES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let scene = catoptric_scene::open("sphere-square", &LoadOptions::default());
    let scene = scene.expect("a built-in scene");
    let tracer = Tracer::new(&scene).expect("it can be traced");
    let whole = tracer.render(&RenderOptions::new([16, 12], Truth::FirstBounce));
    let plain = Frame {
        primary: None,
        reflected: None,
        ..whole.clone()
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a.exr");
    let written = [whole, plain].map(|frame| {
        frame.write_exr(&file).expect("can be written");
        fs::read(&file).expect("can be read")
    });
    written.to_vec()
});

/// Most of the damage is done to the header: it says how much there is to read.
pub fn exr(seed: u64) -> Input {
    const HEADER: usize = 1200;
    let mut random = random(seed);
    let mut bytes = one(&mut random, &FRAMES).clone();
    let header = HEADER.min(bytes.len());
    let mut rest = bytes.split_off(header);
    match once_in(&mut random, 3) {
        true => rest = mutate::bytes(&mut random, rest),
        false => bytes = mutate::bytes(&mut random, bytes),
    }
    bytes.extend(rest);
    Input(vec![("a.exr", bytes)])
}

/// Names of techniques, put together from the words that are listed and from others.
pub fn name(seed: u64) -> Input {
    let mut random = random(seed);
    let known = catoptric_reflect::list();
    let technique = |random: &mut Random| {
        let info = &known[random.below(known.len())];
        let mut text = info.name.trim_start_matches('+').to_owned();
        let options: Vec<_> = info.options().collect();
        if once_in(random, 2) && !options.is_empty() {
            let option = *one(random, &options);
            let value = match once_in(random, 2) {
                true => option.default(),
                false => (*one(random, &NUMBERS)).to_owned(),
            };
            text += &format!("({}={value})", option.name);
        }
        text
    };
    let mut text = technique(&mut random);
    for _ in 0..random.below(3) {
        text += "+";
        text += &technique(&mut random);
    }
    let mut bytes = text.into_bytes();
    if once_in(&mut random, 2) {
        bytes = mutate::bytes(&mut random, bytes);
    }
    Input(vec![("name", bytes)])
}

/// Rows as `compare --format json` prints them.
pub fn rows() -> Vec<Value> {
    let row = |technique: &str, agreement: Value| {
        json!({ "schema_version": 1, "scene": "s", "technique": technique, "resolution": [16, 12],
                "status": "ok", "reason": null, "meta": {}, "object_agreement": agreement,
                "color": { "psnr": null, "equal": true, "mae": 0.0 },
                "time_ms": { "frame": { "median": 1.5, "median_low": 1.0, "median_high": 2.0 } } })
    };
    vec![row("linear", json!(0.5)), row("newton", Value::Null)]
}

pub fn record(seed: u64) -> Input {
    let mut random = random(seed);
    let text = serde_json::to_string_pretty(&rows()).expect("can be written");
    Input(vec![("a.json", mutate::text(&mut random, &text))])
}

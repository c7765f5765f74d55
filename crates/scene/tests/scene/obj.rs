//! What an OBJ file means: faces of many corners, normals, numbers, names, materials.

use std::path::Path;

use catoptric_scene::{LoadOptions, Mesh, Paint, Scene, SceneError, Shape, open};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

const HEAD: &str =
    "why = \"A test.\"\n[camera]\neye = [0, 0, 50]\ntarget = [0, 0, 0]\nfov_y = 30\n";
const OBJECT: &str = "[[object]]\nmesh = \"a.obj\"\n";
const MIRROR: &str = "[[mirror]]\nmesh = \"a.obj\"\n";
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A scene from files in a folder of their own, one of them `a.obj`.
fn load(files: &[(&str, &[u8])], body: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    load_in(folder.path(), body)
}

fn load_in(folder: &Path, body: &str) -> Result<Scene, SceneError> {
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("{HEAD}{body}")).unwrap();
    open(path.to_str().unwrap(), &LoadOptions::default())
}

fn object(obj: &str) -> Mesh {
    let files = [("a.obj", obj.as_bytes())];
    load(&files, OBJECT).unwrap().objects.remove(0).mesh
}

fn mirror(obj: &str) -> Mesh {
    let files = [("a.obj", obj.as_bytes())];
    match load(&files, MIRROR).unwrap().mirrors.remove(0).shape {
        Shape::Mesh(mesh) => mesh,
        _ => panic!("no mesh"),
    }
}

fn warnings(obj: &str) -> Vec<String> {
    load(&[("a.obj", obj.as_bytes())], OBJECT).unwrap().warnings
}

fn area(mesh: &Mesh) -> f64 {
    let triangle = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|index| mesh.positions[index as usize].as_dvec3());
        (b - a).cross(c - a).length() / 2.0
    };
    mesh.triangles.iter().map(triangle).sum()
}

/// The colours of the triangles, one after another.
fn colors(files: &[(&str, &[u8])], body: &str) -> Vec<Vec3> {
    let mesh = load(files, body).unwrap().objects.remove(0).mesh;
    let color = |index: &u32| match &mesh.materials[*index as usize].paint {
        Paint::Color(color) => *color,
        Paint::Texture { tint, image } => *tint * image.texel(0),
        _ => panic!("no colour of its own"),
    };
    mesh.material.iter().map(color).collect()
}

#[test]
fn a_hollow_face_covers_itself() {
    // A C, in the plane x = 2, from each of its corners.
    let outline = [
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [3.0, 2.0],
    ];
    let vertices: String = outline
        .iter()
        .map(|[y, z]| format!("v 2 {y} {z}\n"))
        .collect();
    for first in 0..8 {
        let face: String = (0..8)
            .map(|step| format!(" {}", 1 + (first + step) % 8))
            .collect();
        let mesh = object(&format!("{vertices}f{face}\n"));
        assert_eq!(
            (mesh.triangles.len(), area(&mesh)),
            (6, 7.0),
            "from {first}"
        );
        for [a, b, c] in &mesh.triangles {
            let [a, b, c] = [a, b, c].map(|index| mesh.positions[*index as usize]);
            assert!((b - a).cross(c - a).x > 0.0, "all face where the face does");
        }
    }
}

#[test]
fn corners_keep_their_attributes_when_faces_are_split() {
    let obj = format!(
        "{SQUARE}v 0.5 0.5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n\
         f 1/1 2/2 3/3 5/5 4/4\n"
    );
    let mesh = object(&obj);
    assert_eq!(mesh.triangles.len(), 3);
    for (triangle, uvs) in mesh.triangles.iter().zip(&mesh.uvs) {
        for (corner, uv) in triangle.iter().zip(uvs) {
            assert_eq!(mesh.positions[*corner as usize].truncate(), *uv);
        }
    }
}

#[test]
fn a_closed_mesh_stays_closed_where_sides_have_corners_between() {
    // A box whose top has a corner in the middle of a side, as its neighbour has.
    let obj = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nv 1 0 1\n\
        f 4 3 2 1\nf 5 9 6 7 8\nf 1 2 6 9 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let mesh = mirror(obj);
    assert_eq!(mesh.positions.len(), 9);
    assert!(Shape::Mesh(mesh).is_closed());
}

#[test]
fn a_face_that_crosses_itself_is_warned_of() {
    assert!(warnings(&format!("{SQUARE}f 1 2 3 4\n")).is_empty());
    let found = warnings(&format!("{SQUARE}f 1 2 3\nf 1 3 2 4\nf 1 3 2 4\n"));
    let [warning] = found.as_slice() else {
        panic!("{found:?}")
    };
    assert!(
        warning.contains("a.obj:6: the face crosses itself, as do 1 others"),
        "{warning}"
    );
}

#[test]
fn numbers_are_moved_before_they_are_rounded() {
    let far = "v 99999999.25 0 0\nv 100000001 0 0\nv 100000001 1.125 0\nf 1 2 3\n";
    let body = format!("{OBJECT}transform = {{ translate = [-1e8, 0, 0] }}\n");
    let mesh = load(&[("a.obj", far.as_bytes())], &body)
        .unwrap()
        .objects
        .remove(0)
        .mesh;
    let expected = [[-0.75, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.125, 0.0]].map(Vec3::from);
    assert_eq!(mesh.positions, expected);
    let uvs = "vt 16777217.5 0\nvt 16777218.5 0\nvt 16777217.5 1\n";
    let obj = format!("mtllib a.mtl\nusemtl t\n{SQUARE}{uvs}f 1/1 2/2 3/3\n");
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    image::RgbImage::new(1, 1).save(path("t.png")).unwrap();
    std::fs::write(path("a.mtl"), "newmtl t\nmap_Kd -o -16777217 0 t.png\n").unwrap();
    std::fs::write(path("a.obj"), obj).unwrap();
    let mesh = load_in(folder.path(), OBJECT)
        .unwrap()
        .objects
        .remove(0)
        .mesh;
    assert_eq!(mesh.uvs[0].map(|uv| uv.x), [0.5, 1.5, 0.5]);
}

/// Two squares that meet at a right angle along the y axis, facing −x + z and x + z.
const ROOF: &str = "v -1 0 0\nv 0 0 1\nv 0 1 1\nv -1 1 0\nv 1 0 0\nv 1 1 0\n";
const LEFT: Vec3 = Vec3::new(
    -std::f32::consts::FRAC_1_SQRT_2,
    0.0,
    std::f32::consts::FRAC_1_SQRT_2,
);
const RIGHT: Vec3 = Vec3::new(
    std::f32::consts::FRAC_1_SQRT_2,
    0.0,
    std::f32::consts::FRAC_1_SQRT_2,
);

/// Whether each normal of a mesh is that of its triangle.
fn is_flat(mesh: &Mesh) -> bool {
    mesh.triangles
        .iter()
        .zip(&mesh.normals)
        .all(|(corners, normals)| {
            let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
            let face = (b - a).cross(c - a).normalize();
            normals.iter().all(|normal| normal.distance(face) < 1e-6)
        })
}

/// Normals of the corners at the ridge, where x = 0.
fn at_the_ridge(mesh: &Mesh) -> Vec<Vec3> {
    let corners = mesh.triangles.as_flattened().iter();
    let all = corners.zip(mesh.normals.as_flattened());
    all.filter(|(corner, _)| mesh.positions[**corner as usize].x == 0.0)
        .map(|(_, normal)| *normal)
        .collect()
}

#[test]
fn a_face_without_normals_changes_no_other() {
    let given = "vn -0.6 0 0.8\nvn 0.6 0 0.8\nf 1//1 2//1 3//1 4//1\nf 2//2 5//2 6//2 3//2\n";
    let far = "v 50 50 -90\nv 51 50 -90\nv 51 51 -90\nf 7 8 9\n";
    for make in [object, mirror] {
        let without = make(&format!("{ROOF}{given}"));
        let with = make(&format!("{ROOF}{given}{far}"));
        assert_eq!(with.normals[..4], without.normals[..]);
        assert_eq!(with.normals[4], [Vec3::Z; 3]);
    }
}

#[test]
fn a_corner_without_a_normal_changes_no_other() {
    let obj = format!("{SQUARE}vn 0.6 0 0.8\nvn 0 0 0\ns off\nf 1//1 2 3//2\n");
    for make in [object, mirror] {
        let [given, none, zero] = make(&obj).normals[0];
        assert!(given.distance(Vec3::new(0.6, 0.0, 0.8)) < 1e-6, "{given}");
        assert_eq!([none, zero], [Vec3::Z; 2]);
    }
}

#[test]
fn smoothing_groups_say_where_normals_are_shared() {
    for (statements, flat) in [
        (["s off", ""], true),
        (["s 0", ""], true),
        (["s 1", "s 2"], true),
        (["s 1", "s off"], true),
        (["s 1", "s 1"], false),
        (["s 7", ""], false),
        (["s on", ""], false),
    ] {
        let [first, second] = statements;
        let obj = format!("{ROOF}{first}\nf 1 2 3 4\n{second}\nf 2 5 6 3\n");
        let mesh = mirror(&obj);
        assert_eq!(is_flat(&mesh), flat, "{statements:?}");
        if !flat {
            let ridge = at_the_ridge(&mesh);
            assert!(ridge.iter().all(|normal| normal.distance(Vec3::Z) < 1e-6));
            assert_eq!(object(&obj).normals, mesh.normals);
        } else {
            assert_eq!(ridge_sides(&mesh), [LEFT, RIGHT]);
        }
    }
    let nothing_said = format!("{ROOF}f 1 2 3 4\nf 2 5 6 3\n");
    assert!(!is_flat(&mirror(&nothing_said)), "a mirror is curved");
    assert!(object(&nothing_said).normals.is_empty(), "an object is not");
    assert!(object(&format!("s off\n{nothing_said}")).normals.is_empty());
}

/// The normals at the ridge from the left and from the right, rounded.
fn ridge_sides(mesh: &Mesh) -> [Vec3; 2] {
    let ridge = at_the_ridge(mesh);
    [LEFT, RIGHT].map(|side| {
        let near = |normal: &&Vec3| normal.distance(side) < 1e-6;
        ridge.iter().find(near).map_or(Vec3::ZERO, |_| side)
    })
}

#[test]
fn a_group_goes_on_after_other_faces() {
    let obj = format!("{ROOF}s 1\nf 1 2 3\ns off\nf 1 3 4\ns 1\nf 2 5 6\nf 2 6 3\n");
    let mesh = mirror(&obj);
    assert!(mesh.normals[0][1].distance(Vec3::new(0.0, 0.0, 1.0)) < 0.5);
    assert!(mesh.normals[0][1].distance(LEFT) > 0.1);
    assert!(
        mesh.normals[1]
            .iter()
            .all(|normal| normal.distance(LEFT) < 1e-6)
    );
}

const RED: Vec3 = Vec3::X;
const GREEN: Vec3 = Vec3::Y;
const GREY: Vec3 = Vec3::splat(0.8);

#[test]
fn names_that_differ_in_a_byte_are_different_names() {
    let mtl = b"newmtl M\xe9\nKd 1 0 0\nnewmtl M\xe8\nKd 0 1 0\n";
    let obj = [
        SQUARE.as_bytes(),
        b"mtllib \xe9.mtl\nusemtl M\xe8\nf 1 2 3\nusemtl M\xe9\nf 1 3 4\n",
    ]
    .concat();
    let files = [("a.obj", obj.as_slice()), ("é.mtl", mtl)];
    assert_eq!(colors(&files, OBJECT), [GREEN, RED]);
    let mesh = load(&files, OBJECT).unwrap().objects.remove(0).mesh;
    let names: Vec<&str> = mesh
        .materials
        .iter()
        .map(|material| material.name.as_str())
        .collect();
    assert_eq!(names, [r"M\xe8", r"M\xe9"]);
}

#[test]
fn indices_may_refer_to_what_follows() {
    let mtl = b"newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n";
    let obj = format!(
        "mtllib a.mtl\nusemtl a\nf 1/1/1 2/1/1 3/1/1\nusemtl b\nf 1/1/1 3/1/1 4/1/1\n\
         {SQUARE}vt 0 0\nvn 0 0 1\n"
    );
    let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_slice())];
    assert_eq!(colors(&files, OBJECT), [RED, GREEN]);
}

#[test]
fn a_material_without_a_name_is_none() {
    let obj = format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl\nf 1 3 4\n");
    for (mtl, second) in [
        ("newmtl a\nKd 1 0 0\n", GREY),
        ("newmtl a\nKd 1 0 0\nnewmtl\nKd 0 1 0\n", GREEN),
    ] {
        let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())];
        assert_eq!(colors(&files, OBJECT), [RED, second]);
    }
    let none = format!("usemtl\n{SQUARE}f 1 2 3\n");
    assert_eq!(colors(&[("a.obj", none.as_bytes())], OBJECT), [GREY]);
}

#[test]
fn what_nothing_uses_is_not_wrong() {
    let mtl = "newmtl a\nKd 1 0 0\nnewmtl b\nmap_Kd gone.png\nnewmtl c\nmap_Kd -clamp on t.tga\n\
        newmtl d\nKd x\n";
    let obj =
        format!("mtllib a.mtl\n{SQUARE}usemtl none\nusemtl b\nusemtl a\nf 1/1/1 2/2/2 3/3/3\n");
    let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())];
    assert_eq!(colors(&files, OBJECT), [RED]);
    let scene = load(&files, OBJECT).unwrap();
    let [coordinates, normals] = scene.warnings.as_slice() else {
        panic!("{:?}", scene.warnings)
    };
    assert!(coordinates.contains("a.obj:9: the texture coordinate index 1 counts for nothing"));
    assert!(normals.contains("a.obj:9: the normal index 1 counts for nothing"));
    let painted = format!("{OBJECT}color = [0, 1, 0]\n");
    assert_eq!(colors(&[("a.obj", obj.as_bytes())], &painted), [GREEN]);
    // Used, all of it is wrong.
    for name in ["b", "c", "d", "none"] {
        let obj = format!("{obj}usemtl {name}\nf 1 2 3\n");
        let files = [("a.obj", obj.as_bytes()), ("a.mtl", mtl.as_bytes())];
        assert!(load(&files, OBJECT).is_err(), "{name}");
    }
}

#[test]
fn one_number_is_a_grey_and_tints_a_texture_from_either_side() {
    let mut white = Vec::new();
    image::RgbImage::from_pixel(1, 1, image::Rgb([255; 3]))
        .write_to(
            &mut std::io::Cursor::new(&mut white),
            image::ImageFormat::Png,
        )
        .unwrap();
    let obj = format!("mtllib a.mtl\n{SQUARE}vt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
    for (mtl, expected) in [
        ("newmtl a\nKd 0.5\n", 0.5),
        ("newmtl a\nKd 0.8 0.8 0.8\nmap_Kd white.jpg\n", 0.8),
        ("newmtl a\nmap_Kd white.jpg\nKd 0.8 0.8 0.8\n", 0.8),
        ("newmtl a\nmap_Kd white.jpg\n", 1.0),
        ("newmtl a\n", 0.8),
    ] {
        // The picture is a PNG whatever it is called.
        let files = [
            ("a.obj", obj.as_bytes()),
            ("a.mtl", mtl.as_bytes()),
            ("white.jpg", white.as_slice()),
        ];
        assert_eq!(colors(&files, OBJECT), [Vec3::splat(expected)], "{mtl}");
    }
}

#[test]
fn names_of_files_may_have_escaped_spaces_and_marks_before_the_text() {
    let obj = format!("\u{feff}mtllib my\\ own.mtl\n{SQUARE}usemtl a\nf 1 2 3\n");
    let mtl = "\u{feff}newmtl a\nKd 1 0 0\n";
    let files = [("a.obj", obj.as_bytes()), ("my own.mtl", mtl.as_bytes())];
    assert_eq!(colors(&files, OBJECT), [RED]);
}

#[test]
fn each_file_is_read_once_and_all_texels_count() {
    let folder = tempfile::tempdir().unwrap();
    let write =
        |name: &str, content: &str| std::fs::write(folder.path().join(name), content).unwrap();
    // 36 Mi texels of one colour: a few kilobytes.
    let large = image::GrayImage::new(6144, 6144);
    large.save(folder.path().join("large.png")).unwrap();
    let picture = |name: &str| {
        std::fs::copy(folder.path().join("large.png"), folder.path().join(name)).unwrap()
    };
    write(
        "a.mtl",
        "newmtl a\nmap_Kd large.png\nnewmtl b\nmap_Kd ./large.png\n",
    );
    let used = "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n";
    let libraries = "mtllib a.mtl\n".repeat(1000);
    write("a.obj", &format!("{libraries}{SQUARE}vt 0 0\n{used}"));
    let scene = load_in(folder.path(), &OBJECT.repeat(2)).unwrap();
    assert_eq!(scene.objects.len(), 2);
    picture("second.png");
    write(
        "a.mtl",
        "newmtl a\nmap_Kd large.png\nnewmtl b\nmap_Kd second.png\n",
    );
    let message = load_in(folder.path(), OBJECT).unwrap_err().to_string();
    assert!(message.contains("a.mtl:4: `map_Kd`: "), "{message}");
    assert!(
        message.contains("37748736 texels (6144x6144), which makes 75497472 in all textures"),
        "{message}"
    );
    assert!(message.contains("the most is 67108864"), "{message}");
}

#[test]
fn what_a_scene_may_make_is_limited_and_said_before_it_is_made() {
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let thousand = "repeat = [{ count = 1000, translate = [1, 0, 0] }]\n";
    let sphere = "[[mirror]]\nshape = \"sphere\"\nradius = 1\n";
    for (body, place, parts) in [
        (
            "[[object]]\nshape = \"box\"\nn = 2048\n".to_owned(),
            7,
            ["`shape` makes 50331648 triangles,", "the most is 4000000"],
        ),
        (
            format!("[[object]]\nshape = \"grid\"\nn = 100\n{thousand}"),
            7,
            [
                "`shape` makes 20000000 triangles (in 1000 copies)",
                "the most is 4000000",
            ],
        ),
        (
            "[[mirror]]\nshape = \"cylinder\"\nn = 2048\nsegments = 4096\n".to_owned(),
            7,
            ["`shape` makes 50323456 triangles,", "the most is 4000000"],
        ),
        (
            "[[object]]\nshape = \"grid\"\nn = 1200\n".repeat(2),
            10,
            [
                "makes 2880000 triangles",
                "which makes 5760000 in the scene",
            ],
        ),
        (
            format!("{OBJECT}repeat = [{{ count = 10000 }}]\n").repeat(2000),
            7,
            [
                "a.obj: makes 20000 triangles (in 10000 copies)",
                "which makes 4020000 in the scene",
            ],
        ),
        (
            format!("{sphere}[[object]]\nshape = \"points\"\ncount = 20000\n{thousand}"),
            11,
            [
                "`count` makes 20000000 points (in 1000 copies)",
                "the most is 10000000",
            ],
        ),
    ] {
        let started = std::time::Instant::now();
        let two = format!("{triangle}f 1 2 3\n");
        let message = load(&[("a.obj", two.as_bytes())], &body)
            .unwrap_err()
            .to_string();
        for part in parts {
            assert!(message.contains(part), "{message}, without {part}");
        }
        if !message.contains("a.obj") {
            assert!(
                message.contains(&format!("scene.toml:{place}: ")),
                "{message}"
            );
        }
        assert!(started.elapsed().as_secs() < 120, "{message}");
    }
    let corners = " 1 2 3".repeat(4000);
    let obj = format!("{triangle}f{corners}\n");
    let message = load(&[("a.obj", obj.as_bytes())], OBJECT)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("a.obj:5: the face has 12000 corners: the most is 10000"),
        "{message}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Where `tobj` reads the same, it reads the same as we do.
    #[test]
    fn another_reader_agrees(
        positions in prop::collection::vec(prop::array::uniform3(-1000.0..1000.0f32), 3..40),
        normals in prop::collection::vec(prop::array::uniform3(0.1..1.0f32), 1..10),
        uvs in prop::collection::vec(prop::array::uniform2(-4.0..4.0f32), 1..10),
        faces in prop::collection::vec(prop::array::uniform3((0..40usize, 0..10usize, 0..10usize)), 1..40),
        relative: bool,
    ) {
        let mut obj = String::from("# made\n");
        for [x, y, z] in &positions {
            obj += &format!("v {x:?} {y:?} {z:?}\n");
        }
        for [x, y, z] in &normals {
            obj += &format!("vn {x} {y} {z}\n");
        }
        for [u, v] in &uvs {
            obj += &format!("vt {u} {v}\n");
        }
        for face in &faces {
            obj += "f";
            for (position, uv, normal) in face {
                let index = |index: &usize, count: usize| {
                    let index = (index % count) as i64;
                    if relative { index - count as i64 } else { index + 1 }
                };
                obj += &format!(
                    " {}/{}/{}",
                    index(position, positions.len()),
                    index(uv, uvs.len()),
                    index(normal, normals.len())
                );
            }
            obj += "\n";
        }
        let (models, _) = tobj::load_obj_buf(
            &mut obj.as_bytes(),
            &tobj::LoadOptions::default(),
            |_| Err(tobj::LoadError::OpenFileFailed),
        )
        .unwrap();
        let theirs = &models[0].mesh;
        let three = |values: &[f32], index: u32| Vec3::from_slice(&values[3 * index as usize..]);
        let mut expected = Vec::new();
        for corners in theirs.indices.as_chunks::<3>().0.iter().enumerate() {
            let (face, corners) = corners;
            let corners = [0, 1, 2].map(|corner| {
                let at = 3 * face + corner;
                let uv = theirs.texcoord_indices[at] as usize;
                (
                    three(&theirs.positions, corners[corner]),
                    three(&theirs.normals, theirs.normal_indices[at]).as_dvec3(),
                    [theirs.texcoords[2 * uv], theirs.texcoords[2 * uv + 1]],
                )
            });
            let [a, b, c] = corners.map(|(position, _, _)| position.as_dvec3());
            if (b - a).cross(c - a) != DVec3::ZERO {
                expected.push(corners);
            }
        }
        let files = [("a.obj", obj.as_bytes())];
        match load(&files, OBJECT) {
            Err(error) => {
                prop_assert!(expected.is_empty(), "{error}");
            }
            Ok(scene) => {
                let mesh = &scene.objects[0].mesh;
                prop_assert_eq!(mesh.triangles.len(), expected.len());
                for (index, corners) in expected.iter().enumerate() {
                    for (corner, (position, normal, uv)) in corners.iter().enumerate() {
                        let found = mesh.positions[mesh.triangles[index][corner] as usize];
                        prop_assert_eq!(found, *position);
                        prop_assert_eq!(mesh.uvs[index][corner].to_array(), *uv);
                        let found = mesh.normals[index][corner].as_dvec3();
                        prop_assert!(found.distance(normal.normalize()) < 1e-6);
                    }
                }
            }
        }
    }
}

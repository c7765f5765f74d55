//! OBJ files in all their variants, transforms, paints.

use std::path::Path;

use catoptric_scene::{LoadOptions, Paint, Scene, SceneError, Shape, open};
use glam::Vec3;

const HEAD: &str =
    "why = \"A test.\"\n[camera]\neye = [0, 0, 50]\ntarget = [0, 0, 0]\nfov_y = 30\n";

fn load(folder: &Path, body: &str) -> Result<Scene, SceneError> {
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("{HEAD}{body}")).unwrap();
    open(path.to_str().unwrap(), &LoadOptions::default())
}

fn with_obj(obj: &str, body: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    std::fs::write(
        folder.path().join("a.mtl"),
        "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n",
    )
    .unwrap();
    std::fs::write(
        folder.path().join("b.mtl"),
        "newmtl red\nKd 0 1 0\nnewmtl blue\nKd 0 1 1\n",
    )
    .unwrap();
    load(folder.path(), body)
}

const MESH: &str = "[[object]]\nmesh = \"a.obj\"\n";
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn polygons_become_triangles() {
    let scene = with_obj(&format!("{SQUARE}v -0.2 0.5 0\nf 1 2 3 4 5\n"), MESH).unwrap();
    let mesh = &scene.objects[0].mesh;
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (5, 3));
    assert!(mesh.normals.is_empty() && mesh.uvs.is_empty() && mesh.colors.is_empty());
    assert_eq!(scene.objects[0].name, "object 1");
    assert!(
        matches!(mesh.materials[mesh.material[0] as usize].paint, Paint::Color(c) if c == Vec3::splat(0.8))
    );
}

#[test]
fn relative_indices_normals_and_texture_coordinates() {
    let obj = format!("{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\nf -4/1/1 -3/2/1 -2/3/1\n");
    let mesh = &with_obj(&obj, MESH).unwrap().objects[0].mesh;
    assert_eq!(mesh.positions.len(), 3, "the unused vertex goes");
    assert_eq!(mesh.normals, [[Vec3::Z; 3]]);
    assert_eq!(mesh.uvs[0][2], glam::Vec2::ONE);
}

#[test]
fn equal_positions_are_one_and_minus_zero_is_zero() {
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -0 -0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nf 1 4 6\n";
    let mesh = &with_obj(obj, MESH).unwrap().objects[0].mesh;
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (4, 2));
}

#[test]
fn materials_are_the_files_or_replaced() {
    let obj = format!("mtllib a.mtl\n{SQUARE}usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n");
    let colors = |body: &str| -> Vec<Vec3> {
        let scene = with_obj(&obj, body).unwrap();
        let mesh = &scene.objects[0].mesh;
        mesh.material
            .iter()
            .map(|index| match mesh.materials[*index as usize].paint {
                Paint::Color(color) => color,
                _ => panic!("no plain colour"),
            })
            .collect()
    };
    assert_eq!(colors(MESH), [Vec3::X, Vec3::Z]);
    assert_eq!(
        colors(&format!("{MESH}mtl = \"b.mtl\"\n")),
        [Vec3::Y, Vec3::new(0.0, 1.0, 1.0)]
    );
    assert_eq!(
        colors(&format!("{MESH}color = [0.5, 0.5, 0.5]\n")),
        [Vec3::splat(0.5); 2]
    );
}

#[test]
fn vertex_colours() {
    let obj = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nf 1 2 3\n";
    let body = format!("{MESH}vertex_colors = true\n");
    let mesh = &with_obj(obj, &body).unwrap().objects[0].mesh;
    assert_eq!(mesh.colors, [[Vec3::X, Vec3::Y, Vec3::Z]]);
    assert!(
        with_obj(obj, MESH).unwrap().objects[0]
            .mesh
            .colors
            .is_empty()
    );
    let message = with_obj(&format!("{SQUARE}f 1 2 3\n"), &body)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("scene.toml:8") && message.contains("`vertex_colors`"),
        "{message}"
    );
}

/// Everything of a mesh that an OBJ's spelling must not change.
fn geometry(obj: &str) -> (Vec<Vec3>, Vec<[u32; 3]>, Vec<[glam::Vec2; 3]>) {
    let mesh = with_obj(obj, MESH).unwrap().objects.remove(0).mesh;
    (mesh.positions, mesh.triangles, mesh.uvs)
}

#[test]
fn every_valid_spelling_of_an_obj_gives_the_same_mesh() {
    let plain =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf 1/1 2/2 3/1\nf 1/1 3/2 4/2\n";
    let expected = geometry(plain);
    assert_eq!((expected.0.len(), expected.1.len()), (4, 2));
    for (what, spelt) in [
        ("byte order mark", format!("\u{feff}{plain}")),
        ("CRLF", plain.replace('\n', "\r\n")),
        ("CR", plain.replace('\n', "\r")),
        ("comments", plain.replace('\n', " # and why\n")),
        (
            "continuation",
            plain
                .replace(" 3/1", " \\\n3/1")
                .replace("v 1 1 0", "v 1 \\\n 1 0"),
        ),
        (
            "one coordinate",
            plain
                .replace("vt 0 0", "vt 0")
                .replace("vt 1 0", "vt 1 # u"),
        ),
        ("three coordinates", plain.replace("vt 1 0", "vt 1 0 0.5")),
        (
            "groups and lines",
            plain.replace("f 1/1 3", "g rest\ns off\nl 1 2\nf 1/1 3"),
        ),
    ] {
        assert_eq!(geometry(&spelt), expected, "{what}");
    }
}

#[test]
fn several_libraries_and_materials_with_comments() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "a.mtl",
        "\u{feff}newmtl red # warm\r\nKd 1 0 0 # R\r\nnewmtl Wood #5\r\nKd 0 1 0\r\n",
    );
    write(
        "b c.mtl",
        "newmtl Wood #6\rKd 1 1 0\rnewmtl blue\rKd 0 0 1\r",
    );
    write("d.mtl", "newmtl grey\nKd 0.5 0.5 \\\n0.5\n");
    let faces = ["red", "Wood #5", "Wood #6", "blue # cold", "grey"]
        .map(|name| format!("usemtl {name}\nf 1 2 3\n"))
        .concat();
    write(
        "a.obj",
        &format!("mtllib a.mtl d.mtl # two\nmtllib b c.mtl\n{SQUARE}{faces}"),
    );
    let mesh = load(folder.path(), MESH).unwrap().objects.remove(0).mesh;
    let colors: Vec<Vec3> = (mesh.material.iter())
        .map(|index| match mesh.materials[*index as usize].paint {
            Paint::Color(color) => color,
            _ => panic!("no plain colour"),
        })
        .collect();
    assert_eq!(
        colors,
        [
            Vec3::X,
            Vec3::Y,
            Vec3::new(1.0, 1.0, 0.0),
            Vec3::Z,
            Vec3::splat(0.5)
        ]
    );
}

/// A triangle in the colour of a picture, with this `map_Kd` line and this face.
fn textured(map: &str, face: &str) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    image::RgbImage::new(2, 2)
        .save(folder.path().join("t.png"))
        .unwrap();
    std::fs::write(
        folder.path().join("t.mtl"),
        format!("newmtl t\nmap_Kd {map}\n"),
    )
    .unwrap();
    let obj = format!("mtllib t.mtl\n{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nusemtl t\n{face}\n");
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    load(folder.path(), MESH)
}

#[test]
fn a_texture_is_scaled_and_moved_when_it_is_loaded() {
    let uvs = |map: &str| {
        textured(map, "f 1/1 2/2 3/3").unwrap().objects[0]
            .mesh
            .uvs
            .clone()
    };
    let uv = glam::Vec2::new;
    assert_eq!(uvs("t.png"), [[uv(0.0, 0.0), uv(1.0, 0.0), uv(1.0, 1.0)]]);
    assert_eq!(
        uvs("-s 4 2 1 t.png"),
        [[uv(0.0, 0.0), uv(4.0, 0.0), uv(4.0, 2.0)]]
    );
    assert_eq!(
        uvs("-s 4 2 -o 0.5 0.25 t.png # tiles"),
        [[uv(0.5, 0.25), uv(4.5, 0.25), uv(4.5, 2.25)]]
    );
}

#[test]
fn what_a_texture_needs() {
    for (map, face, wanted) in [
        (
            "t.png",
            "f 1 2 3",
            "a.obj:10: the face has no texture coordinates",
        ),
        (
            "t.png",
            "f 1/1 2/2 3/3\nf 1/1 3/3 4",
            "a.obj:11: the face has no",
        ),
        (
            "-clamp on t.png",
            "f 1/1 2/2 3/3",
            "t.mtl:2: `map_Kd` has the option `-clamp`",
        ),
        ("u.png", "f 1/1 2/2 3/3", "t.mtl:2: `map_Kd`: "),
    ] {
        let message = textured(map, face).unwrap_err().to_string();
        assert!(message.contains(wanted), "{message}, not {wanted}");
        assert!(message.contains("(the mesh of object 1, "), "{message}");
        assert!(message.contains("scene.toml:7)"), "{message}");
    }
}

#[test]
fn what_is_wrong_with_an_obj_is_told_with_its_line() {
    for (obj, wanted) in [
        ("v 0 0 nan\n", "a.obj:1: `v`"),
        ("v 0 0 0\nv 0 x 0\n", "a.obj:2: `v`"),
        ("v 0 0\n", "a.obj:1: `v` needs 3"),
        (
            "v 0 0 0\nv 1 0 0\nf 1 2 3\n",
            "a.obj:3: vertex index 3 is out of range: there are 2",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n",
            "a.obj:4: vertex index 0",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
            "a.obj:4: vertex index -4",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/2 3/1\n",
            "a.obj:5: texture coordinate index 2",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//2 3//1\nvn 0 0 1\n",
            "a.obj:4: normal index 2 is out of range: there are 1",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//-1 2//1 3//1\nvn 0 0 1\n",
            "a.obj:4: normal index -1",
        ),
        (
            "s some\n",
            "a.obj:1: `s` must be the number of a smoothing group or `off`",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n",
            "a.obj:4: a face needs",
        ),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 c\n", "a.obj:4: `c`"),
        ("v 0 0 0 1 1 1\nv 1 0 0\n", "a.obj:2: either all"),
        ("v 0 0 0 1 1\n", "a.obj:1: `v` has 5 numbers"),
        ("v 0 0 0 0\n", "a.obj:1: `v` has the weight 0"),
        ("v 0 0 0\nvt # u\n", "a.obj:2: `vt` needs a number"),
        ("v 0 0 0\nf 1 1 1/1/1/1\n", "a.obj:2: `1/1/1/1` is no face"),
        ("v 0 0 0\nf 1 1 1///1\n", "a.obj:2: `1///1` is no face"),
        ("v 0 0 0\n\0\n", "a.obj: is binary"),
        ("v 0 0 \\\nx\nv 0 0 0\n", "a.obj:1: `v` has a value"),
        (
            "mtllib a.mtl c.mtl\nv 0 0 0\nf 1 1 1\n",
            "a.obj:1: `mtllib`: no file `",
        ),
        ("v 0 0 0\n", "a.obj: the mesh is empty"),
        ("", "a.obj: the mesh is empty"),
        (
            "v 0 0 0\nv 1 0 0\nf 1 2 1\n",
            "scene.toml:6: object 1: the mesh is empty",
        ),
        (
            "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "a.obj:1: `mtllib`: no file `",
        ),
        (
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl green\nf 1 2 3\n",
            "a.obj:5: no material `green`",
        ),
    ] {
        let message = with_obj(obj, MESH).unwrap_err().to_string();
        assert!(message.contains(wanted), "{message}, not {wanted}");
    }
}

#[test]
fn scale_comes_before_rotation_before_translation() {
    let body = "[[object]]\nshape = \"quad\"\n\
        transform = { scale = [2, 1, 1], rotate_deg = [90, 0, 90], translate = [10, 0, 0] }\n";
    let folder = tempfile::tempdir().unwrap();
    let mesh = &load(folder.path(), body).unwrap().objects[0].mesh;
    // (1, 0, 1) → scaled (2, 0, 1) → about x (2, −1, 0) → about z (1, 2, 0) → moved (11, 2, 0).
    let corner = Vec3::new(11.0, 2.0, 0.0);
    assert!(
        mesh.positions.iter().any(|p| p.distance(corner) < 1e-6),
        "{:?}",
        mesh.positions
    );
    // Normal +y → about x +z → about z +z.
    assert!(
        mesh.normals
            .as_flattened()
            .iter()
            .all(|n| n.distance(Vec3::Z) < 1e-6)
    );
}

#[test]
fn normals_stay_perpendicular_and_outside_under_any_transform() {
    for scale in ["[3, 0.5, 1]", "[-3, 0.5, 1]", "-1"] {
        // The teapot has creases: only a fine one has normals near those of its triangles.
        for shape in ["sphere\"", "torus\"", "teapot\"\nn = 24", "box\"", "cone\""] {
            let body = format!(
                "[[object]]\nshape = \"{shape}\ntransform = {{ scale = {scale}, rotate_deg = [20, 30, 40] }}\n"
            );
            let folder = tempfile::tempdir().unwrap();
            let mesh = load(folder.path(), &body).unwrap().objects.remove(0).mesh;
            let mut volume = 0.0;
            for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
                let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
                let normal = (b - a).cross(c - a);
                volume += a.dot(normal);
                if normal.length() < 1e-6 {
                    continue; // Slivers at the teapot's poles.
                }
                assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
                let mean: Vec3 = normals.iter().sum();
                assert!(normal.dot(mean) > 0.0, "{shape} {scale}");
            }
            assert!(volume > 0.0, "{shape} {scale} is inside out");
        }
    }
}

#[test]
fn mesh_mirrors_have_shading_normals_and_matching_winding() {
    let cube = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
        f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
    let scene = with_obj(
        cube,
        "[[mirror]]\nmesh = \"a.obj\"\ntransform = { scale = 2 }\n",
    )
    .unwrap();
    let shape = &scene.mirrors[0].shape;
    let Shape::Mesh(mesh) = shape else {
        panic!("no mesh")
    };
    for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
        for (index, normal) in corners.iter().zip(normals) {
            let outward = mesh.positions[*index as usize].normalize();
            assert!(
                normal.distance(outward) < 1e-5,
                "angle weights make corners symmetric"
            );
        }
    }
    assert!(shape.is_closed() && !shape.is_analytic());
    assert!(shape.contains(glam::DVec3::splat(1.9)) && !shape.contains(glam::DVec3::splat(2.1)));

    let inward = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
    let scene = with_obj(inward, "[[mirror]]\nmesh = \"a.obj\"\n").unwrap();
    let Shape::Mesh(mesh) = &scene.mirrors[0].shape else {
        panic!("no mesh")
    };
    let [a, b, c] = mesh.triangles[0].map(|index| mesh.positions[index as usize]);
    assert!((b - a).cross(c - a).z < 0.0, "wound towards its normals");
}

#[test]
fn an_eye_inside_a_closed_mesh_mirror_is_rejected() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("a.obj"),
        "v -99 -99 -99\nv 999 -99 -99\nv -99 999 -99\nv -99 -99 999\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .unwrap();
    let message = load(folder.path(), "[[mirror]]\nmesh = \"a.obj\"\n")
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("scene.toml:3: camera: `eye` lies inside mirror 1"),
        "{message}"
    );
}

#[test]
fn models_are_found_in_a_folder_of_their_own() {
    let models = tempfile::tempdir().unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(models.path().join("a")).unwrap();
    std::fs::write(models.path().join("a/a.obj"), format!("{SQUARE}f 1 2 3\n")).unwrap();
    for file in ["a.obj", "a/a.obj"] {
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, format!("{HEAD}[[object]]\nmesh = \"{file}\"\n")).unwrap();
        let options = LoadOptions {
            models: Some(models.path().into()),
            resolution: None,
        };
        assert_eq!(
            open(path.to_str().unwrap(), &options)
                .unwrap()
                .triangle_count(),
            1
        );
        let error = open(path.to_str().unwrap(), &LoadOptions::default()).unwrap_err();
        assert!(
            matches!(error, SceneError::MissingModel { line: 7, .. }),
            "{error}"
        );
    }
}

/// A scene around one object or mirror.
fn with(body: &str) -> Scene {
    load(tempfile::tempdir().unwrap().path(), body).unwrap()
}

#[test]
fn copies_are_made_step_by_step() {
    let body = "[[object]]\nshape = \"triangles\"\n\
        positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2]]\n\
        transform = { translate = [1, 0, 0] }\n\
        repeat = [{ count = 3, translate = [1, 0, 0] }, { count = 2, rotate_deg = [0, 180, 0], about = [0, 0, 5] }]";
    let mesh = &with(body).objects[0].mesh;
    assert_eq!(mesh.triangles.len(), 6);
    // Neighbours of the first three copies share a corner; what is rotated does so up to rounding.
    assert!(
        (14..=16).contains(&mesh.positions.len()),
        "{}",
        mesh.positions.len()
    );
    let starts = [
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [-1.0, 0.0, 10.0],
        [-2.0, 0.0, 10.0],
        [-3.0, 0.0, 10.0],
    ];
    for (triangle, expected) in mesh.triangles.iter().zip(starts) {
        let first = mesh.positions[triangle[0] as usize];
        assert!(first.distance(expected.into()) < 1e-6, "{first}");
    }
}

#[test]
fn written_triangles_have_their_own_colours() {
    let body = "[[object]]\nshape = \"triangles\"\n\
        positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]\ntriangles = [[0, 1, 2], [1, 3, 2]]\n\
        colors = [[1, 0, 0], [0, 0, 1]]";
    let mesh = &with(body).objects[0].mesh;
    let color = |triangle: usize| match mesh.materials[mesh.material[triangle] as usize].paint {
        Paint::Color(color) => color,
        _ => panic!("no colour"),
    };
    assert_eq!((color(0), color(1)), (Vec3::X, Vec3::Z));
}

#[test]
fn a_lathe_may_turn_part_of_the_way() {
    let body =
        "[[object]]\nshape = \"lathe\"\nprofile = [[1, 0], [1, 1]]\nsegments = 6\nturn_deg = 90";
    let mesh = &with(body).objects[0].mesh;
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (14, 12));
    // From +z to +x.
    let (low, high) = mesh.bounds().unwrap();
    assert!(low.distance(Vec3::ZERO) < 1e-6 && high.distance(Vec3::ONE) < 1e-6);
}

#[test]
fn facets_have_the_normals_of_their_triangles() {
    let body = "[[mirror]]\nshape = \"lathe\"\nprofile = [[0, -1], [1, 0], [0, 1]]\nsegments = 5\nfacets = true";
    let scene = with(body);
    let Shape::Mesh(mesh) = &scene.mirrors[0].shape else {
        panic!("no mesh");
    };
    for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
        let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
        let face = (b - a).cross(c - a).normalize();
        assert!(normals.iter().all(|normal| normal.distance(face) < 1e-6));
        assert!(face.dot(a + b + c) > 0.0, "outside");
    }
}

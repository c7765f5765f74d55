//! Messages that a newcomer meets: each says what was found and what would be right.

use catoptric_scene::{LoadOptions, Scene};

const SCENE: &str = r#"why = "For tests."
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
fov_y = 40.0
[[object]]
name = "quad"
shape = "quad"
[[mirror]]
name = "ball"
shape = "sphere"
center = [0.0, 0.0, 0.0]
radius = 1.0
"#;

/// The message about a scene file with these bytes.
fn refused(bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, bytes).expect("a scene file");
    let scene = Scene::load(path.to_str().expect("UTF-8"), &LoadOptions::default());
    let message = scene.expect_err("refused").to_string();
    let name = format!("{}", path.display());
    assert!(
        message.starts_with(&name) && !message.contains('\n'),
        "{message}"
    );
    message[name.len()..].to_owned()
}

#[test]
fn a_fault_is_said_with_what_would_be_right() {
    for (part, fault, says) in [
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nup = [0, 0, 1]",
            ":6: camera: `up` is parallel to the viewing direction, from `eye` to `target`: give \
             another direction, such as [0.0, 1.0, 0.0]",
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 5.0, 0.0]",
            ":4: camera: `target` lies straight above or below `eye`, so that no direction is up: \
             add `up`, such as up = [0.0, 0.0, 1.0]",
        ),
        (
            "radius = 1.0",
            "radius = 1.0\ncubemaps = [1, 2, 3]",
            ":14: mirror \"ball\": `cubemaps` must be an array of arrays of 3 numbers each, such as \
             [[0.0, 1.0, 0.0]]; 1 is there in place of an array",
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0, 0, true]",
            ":3: camera: `eye` must be an array of 3 numbers; number 3 of them is true or false",
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = 5",
            ":3: camera: `eye` must be an array of 3 numbers, such as [0.0, 1.0, 0.0], not 5",
        ),
        (
            "shape = \"quad\"",
            "",
            ":6: object \"quad\": needs `shape = \"…\"` (one of quad, grid,",
        ),
        (
            "shape = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = 1.0",
            "",
            ":9: mirror \"ball\": needs `shape = \"…\"` (one of sphere,",
        ),
        (
            "shape = \"quad\"",
            "shape = \"points\"",
            ":6: object \"quad\": `shape = \"points\"` needs `positions = [[x, y, z], …]`, or `count = N`",
        ),
        (
            "[[mirror]]",
            "[[move]]\nname = \"ball\"\n[[mirror]]",
            "unknown key `move`: it is written as [[motion.move]], below [motion]",
        ),
        (
            "[[mirror]]",
            "[mirror]",
            "`mirror` must be written as [[mirror]], with two brackets and once for each of them",
        ),
    ] {
        let text = SCENE.replacen(part, fault, 1);
        assert_ne!(text, SCENE, "{part}");
        let message = refused(text.as_bytes());
        assert!(message.contains(says), "{message}");
    }
}

#[test]
fn text_in_another_encoding_is_named() {
    let wide: Vec<u8> = SCENE.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let marked = [&b"\xff\xfe"[..], &wide].concat();
    assert_eq!(refused(&marked), ": is UTF-16 text: save it as UTF-8");
    assert!(refused(&wide).contains("it has zero bytes"));
    assert!(refused(SCENE.replace("quad", "qu\0ad").as_bytes()).contains("it has zero bytes"));
    let latin = [b"why = \"".as_slice(), b"\xe4\"\n"].concat();
    assert!(refused(&latin).contains("is not UTF-8 text (byte 8"));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, format!("\u{feff}{SCENE}")).expect("a scene file");
    let scene = Scene::load(path.to_str().expect("UTF-8"), &LoadOptions::default());
    assert!(scene.is_ok(), "{scene:?}");
}

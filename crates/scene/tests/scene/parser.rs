//! Whatever is written into a scene file, the parser answers; and numbers arrive as written.

use catoptric_scene::shape::Sphere;
use catoptric_scene::{Fov, LoadOptions, Shape, builtin, open};
use proptest::prelude::*;

/// Words that mean something, and some that do not.
const WORDS: [&str; 24] = [
    "[[mirror]]",
    "[[object]]",
    "[camera]",
    "shape",
    "\"points\"",
    "\"box\"",
    "nan",
    "-inf",
    "1e400",
    "0",
    "-1",
    "[",
    "]",
    "{",
    "}",
    "=",
    "\"",
    "\n",
    "count = 3\n",
    "é",
    "\"plane\"",
    "radius = 0",
    "[[0]]",
    "99999999999999999999",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_edit_makes_it_panic(
        scene in 0usize..6,
        edits in prop::collection::vec((0.0..1.0f64, 0usize..12, 0..WORDS.len()), 1..6),
    ) {
        let name = ["sphere-square", "bowl", "ellipsoid", "planar", "sphere-table", "prototype-bowl"][scene];
        let mut text: Vec<char> = builtin::text(name).unwrap().chars().collect();
        for (place, cut, word) in edits {
            let start = (place * text.len() as f64) as usize;
            let end = (start + cut).min(text.len());
            text.splice(start..end, WORDS[word].chars());
        }
        let text: String = text.into_iter().collect();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("edited.toml");
        std::fs::write(&path, text).unwrap();
        let options = LoadOptions { resolution: Some([16, 12]), ..LoadOptions::default() };
        if let Err(error) = open(path.to_str().unwrap(), &options) {
            prop_assert!(error.to_string().contains("edited.toml"), "{error}");
        }
    }

    #[test]
    fn numbers_arrive_as_written(
        eye in prop::array::uniform3(10.0..1e6f64),
        radius in 1e-6..5.0f64,
        fov in 1e-3..179.0f64,
        size in prop::array::uniform2(1u32..5000),
    ) {
        let text = format!(
            "why = \"A test.\"\n[camera]\neye = {eye:?}\ntarget = [0, 0, 0]\nfov_x = {fov:?}\nresolution = {size:?}\n\
             [[mirror]]\nshape = \"sphere\"\nradius = {radius:?}\n"
        );
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("numbers.toml");
        std::fs::write(&path, text).unwrap();
        let scene = open(path.to_str().unwrap(), &LoadOptions::default()).unwrap();
        prop_assert_eq!(scene.camera.eye.to_array(), eye);
        prop_assert_eq!(scene.camera.fov, Fov::X(fov));
        prop_assert_eq!(scene.camera.resolution, size);
        let Shape::Sphere(Sphere { radius: found, .. }) = scene.mirrors[0].shape else { panic!("no sphere") };
        prop_assert_eq!(found, radius);
        prop_assert_eq!(scene.mirrors[0].tessellation, 128);
        prop_assert_eq!(&scene.mirrors[0].name, "mirror 1");
    }
}

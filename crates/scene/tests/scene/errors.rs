//! What is wrong with a scene file is said in one line, with file, line and key.

use std::path::Path;

use catoptric_scene::{LoadOptions, open};

/// A valid scene, to be spoilt.
const GOOD: &str = r#"why = "A test."
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
fov_y = 40.0
[background]
color = [0.1, 0.2, 0.3]
[[object]]
name = "floor"
shape = "grid"
n = 4
checker = { a = [1, 1, 1], b = [0, 0, 0], cells = 4 }
transform = { scale = 2.0, rotate_deg = [0, 10, 0], translate = [0.0, -1.0, 0.0] }
[[mirror]]
name = "ball"
shape = "sphere"
center = [0.0, 0.0, 0.0]
radius = 1.0
"#;

fn message(folder: &Path, text: &str) -> Option<String> {
    let path = folder.join("bad.toml");
    std::fs::write(&path, text).unwrap();
    open(path.to_str().unwrap(), &LoadOptions::default())
        .err()
        .map(|error| error.to_string())
}

#[test]
fn the_scene_to_be_spoilt_is_good() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(message(folder.path(), GOOD), None);
}

#[test]
fn messages_name_file_line_and_key() {
    let folder = tempfile::tempdir().unwrap();
    let sphere = "shape = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = 1.0";
    // (what is replaced, by what, the line named, parts of the message)
    let cases: &[(&str, &str, usize, &[&str])] = &[
        ("why = \"A test.\"", "", 1, &["`why`", "missing"]),
        ("why = \"A test.\"", "why = \"\"", 1, &["`why`"]),
        (
            "shape = \"sphere\"",
            "shape = \"sphere\"\ncubemaps = [[0.0, 1.0]]",
            17,
            &["`cubemaps`", "3 numbers"],
        ),
        (
            "why = \"A test.\"",
            "why = 3",
            1,
            &["`why`", "a string, not 3"],
        ),
        ("why", "whi", 1, &["unknown key `whi`", "`why`"]),
        (
            "[camera]",
            "[kamera]",
            2,
            &["unknown key `kamera`", "`camera`"],
        ),
        (
            "[[object]]",
            "[[objekt]]",
            8,
            &["unknown key `objekt`", "`object`"],
        ),
        ("[[object]]", "[object]", 8, &["`object`", "[[object]]"]),
        (
            "eye = ",
            "eyes = ",
            3,
            &["camera", "unknown key `eyes`", "`eye`"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "",
            2,
            &["camera", "`eye`", "missing"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 0.0]",
            3,
            &["`eye`", "3 numbers, not of 2"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 0.0, nan]",
            3,
            &["`eye`", "finite"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, inf, 5.0]",
            3,
            &["`eye`", "finite"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 1e300, 5.0]",
            3,
            &["`eye`", "range"],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 0.0, 0.5]",
            3,
            &["`eye`", "inside mirror \"ball\""],
        ),
        (
            "eye = [0.0, 0.0, 5.0]",
            "eye = [0.0, 0.0, 0.0]",
            4,
            &["`target`", "same point"],
        ),
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nup = [0, 0, 1]",
            6,
            &["`up`", "parallel"],
        ),
        (
            "fov_y = 40.0",
            "up = [0, 0, 0]",
            5,
            &["`up`", "zero vector"],
        ),
        ("fov_y = 40.0", "", 2, &["`fov_y`", "missing"]),
        ("fov_y = 40.0", "fov_y = 0.0", 5, &["`fov_y`", "180"]),
        ("fov_y = 40.0", "fov_x = 180", 5, &["`fov_x`", "180"]),
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nfov_x = 50",
            6,
            &["`fov_x`", "`fov_y`"],
        ),
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nresolution = [0, 10]",
            6,
            &["`resolution`", "from 1"],
        ),
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nresolution = [-1, 10]",
            6,
            &["`resolution`", "from 1"],
        ),
        (
            "fov_y = 40.0",
            "fov_y = 40.0\nresolution = [1.5, 10]",
            6,
            &["`resolution`", "whole"],
        ),
        (
            "color = [0.1, 0.2, 0.3]",
            "",
            6,
            &["background", "`gradient`"],
        ),
        (
            "color = [0.1, 0.2, 0.3]",
            "color = [-1, 0, 0]",
            7,
            &["`color`", "negative"],
        ),
        (
            "color = [0.1, 0.2, 0.3]",
            "gradient = { zenith = [0, 0, 0], horizon = [0, 0, 0] }",
            7,
            &["`nadir`"],
        ),
        (
            "color = [0.1, 0.2, 0.3]",
            "color = \"red\"",
            7,
            &["`color`", "not a string"],
        ),
        (
            "checker = {",
            "colour = {",
            12,
            &["object \"floor\": unknown key `colour`", "`color`"],
        ),
        (
            "checker = {",
            "color = [1, 1, 1]\nchecker = {",
            12,
            &["`color`", "`checker`"],
        ),
        (
            "cells = 4 }",
            "cells = 0 }",
            12,
            &["object \"floor\": checker: `cells`", "from 1"],
        ),
        ("b = [0, 0, 0], ", "", 12, &["checker", "`b`", "missing"]),
        (
            "shape = \"grid\"\nn = 4",
            "shape = \"gird\"",
            10,
            &["`gird`", "`grid`"],
        ),
        (
            "shape = \"grid\"",
            "shape = \"box\"\nmesh = \"a.obj\"",
            11,
            &["`mesh`", "`shape`"],
        ),
        (
            "shape = \"grid\"\nn = 4",
            "",
            8,
            &["object \"floor\"", "`mesh = \"FILE.obj\"`"],
        ),
        (
            "shape = \"grid\"",
            "shape = \"box\"\nradius = 2",
            11,
            &["unknown key `radius`"],
        ),
        (
            "shape = \"grid\"\nn = 4",
            "mesh = \"none.obj\"",
            10,
            &["none.obj", "models folder"],
        ),
        (
            "scale = 2.0",
            "scale = 0.0",
            13,
            &["object \"floor\": transform: `scale`", "zero"],
        ),
        (
            "scale = 2.0",
            "scale = [1, 0, 1]",
            13,
            &["transform: `scale`", "zero"],
        ),
        (
            "scale = 2.0",
            "scale = true",
            13,
            &["transform: `scale`", "not true or false"],
        ),
        (
            "rotate_deg",
            "rotate",
            13,
            &["unknown key `rotate`", "`rotate_deg`"],
        ),
        (
            "\"ball\"",
            "\"floor\"",
            15,
            &["`name`", "`floor` is used twice"],
        ),
        ("\"ball\"", "\"\"", 15, &["`name`", "empty"]),
        (
            "\"ball\"",
            r#""two\nlines""#,
            15,
            &["`name`", "control characters", r"`two\nlines`"],
        ),
        (
            "n = 4",
            "n = 4.5",
            11,
            &["`n` must be a whole number, not 4.5"],
        ),
        (
            "n = 4",
            "n = 123456789012345678901234567890",
            11,
            &["`n` must be from 1 to 2048, not 1.2346e29"],
        ),
        (
            "radius = 1.0",
            "radius = 1e-300",
            18,
            &["`radius` must be positive, not 1.0000e-300"],
        ),
        (
            "radius = 1.0",
            "radius = 0",
            18,
            &["mirror \"ball\": `radius`", "positive"],
        ),
        (
            "radius = 1.0",
            "radius = -1.0",
            18,
            &["mirror \"ball\": `radius`", "positive"],
        ),
        (
            "radius = 1.0",
            "",
            14,
            &["mirror \"ball\"", "`radius`", "missing"],
        ),
        (
            "radius = 1.0",
            "radius = 1.0\ntessellation = 2",
            19,
            &["`tessellation`", "from 4"],
        ),
        (
            "center = [0.0, 0.0, 0.0]",
            "centre = [0.0, 0.0, 0.0]",
            17,
            &["`centre`", "`center`"],
        ),
        (
            sphere,
            "shape = \"torus\"\nmajor = 1",
            14,
            &["`minor`", "missing"],
        ),
        (
            sphere,
            "shape = \"torus\"\nmajor = 1\nminor = 1",
            18,
            &["`minor`", "smaller than `major`"],
        ),
        (
            sphere,
            "shape = \"saddle\"\nnormal = [0, 0, 1]\nsize = [1, 1]\ncurvature = [1, 0.5]",
            19,
            &["`curvature`", "opposite signs"],
        ),
        (
            sphere,
            "shape = \"saddle\"\nnormal = [0, 1, 0]\nsize = [1, 1]\ncurvature = [1, -1]",
            14,
            &["`up`", "parallel"],
        ),
        ("\"sphere\"", "\"spere\"", 16, &["`spere`", "`sphere`"]),
        (
            sphere,
            "shape = \"ellipsoid\"\nradii = [1, 0, 1]",
            17,
            &["`radii`", "positive"],
        ),
        (
            sphere,
            "shape = \"ellipsoid\"\nradii = [9, 9, 9]",
            3,
            &["`eye`", "inside"],
        ),
        (
            sphere,
            "shape = \"plane\"\nnormal = [0, 0, 1]\nsize = [0, 1]",
            18,
            &["`size`", "area"],
        ),
        (
            sphere,
            "shape = \"plane\"\nnormal = [0, 1, 0]\nsize = [1, 1]\nup = [0, 2, 0]",
            19,
            &["`up`", "parallel"],
        ),
        (
            sphere,
            "shape = \"bowl\"\nradius = 1\naxis = [0, 0, 1]\nhalf_angle_deg = 180",
            19,
            &["`half_angle_deg`", "180"],
        ),
        (
            sphere,
            "shape = \"bowl\"\nradius = 1\naxis = [0, 0, 1]\nhalf_angle_deg = 0",
            19,
            &["`half_angle_deg`"],
        ),
        (sphere, "", 14, &["`mesh = \"FILE.obj\"`"]),
        (
            "[[mirror]]",
            "[motion]\norbit = 1\n[[mirror]]",
            15,
            &["motion: unknown key `orbit`"],
        ),
        ("[camera]", "[camera", 2, &[]),
        (
            "n = 4\nchecker",
            "n = 4\nn = 5\nchecker",
            12,
            &["duplicate"],
        ),
    ];
    for (old, new, line, parts) in cases {
        assert!(GOOD.contains(old), "{old}");
        let text = GOOD.replacen(old, new, 1);
        let message = message(folder.path(), &text).unwrap_or_else(|| panic!("accepted: {new}"));
        let place = format!("bad.toml:{line}: ");
        assert!(
            message.contains(&place),
            "{new}\n→ {message}, not line {line}"
        );
        for part in *parts {
            assert!(message.contains(part), "{new}\n→ {message}, without {part}");
        }
        assert!(!message.contains('\n'), "{message}");
    }
}

#[test]
fn points_need_what_they_are_made_from() {
    let folder = tempfile::tempdir().unwrap();
    let points = |keys: &str| {
        let text = format!("{GOOD}[[object]]\nname = \"dots\"\nshape = \"points\"\n{keys}\n");
        message(folder.path(), &text)
    };
    assert_eq!(points("positions = [[0, 0, 1], [1, 2, 3]]"), None);
    assert_eq!(
        points("count = 5\nseed = 3\nt = [0.1, 2.0]\nmirror = \"ball\""),
        None
    );
    for (keys, line, part) in [
        ("", 19, "`count = N`"),
        ("positions = []", 22, "`positions`"),
        ("positions = [[1, 2]]", 22, "`positions`"),
        ("positions = [[1, 2, 3]]\ncount = 2", 23, "`count`"),
        ("positions = [[1, 2, 3]]\nseed = 2", 22, "`positions`"),
        ("count = 2\nt = [0.0, 1.0]", 23, "`t`"),
        ("count = 2\nt = [2.0, 1.0]", 23, "`t`"),
        ("count = 2\nmirror = \"bal\"", 23, "did you mean `ball`"),
        ("count = 2\ncolour = [1, 1, 1]", 23, "`colour`"),
    ] {
        let message = points(keys).unwrap_or_else(|| panic!("accepted: {keys}"));
        assert!(
            message.contains(&format!("bad.toml:{line}: ")),
            "{keys}\n→ {message}"
        );
        assert!(message.contains(part), "{keys}\n→ {message}");
    }
}

#[test]
fn written_triangles_and_copies_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let with = |keys: &str| {
        let text = format!("{GOOD}[[object]]\nname = \"new\"\n{keys}\n");
        message(folder.path(), &text)
    };
    let triangle = |keys: &str| {
        format!("shape = \"triangles\"\npositions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n{keys}")
    };
    assert_eq!(with(&triangle("triangles = [[0, 1, 2]]")), None);
    let one = "triangles = [[0, 1, 2]]\n";
    let one = |keys: &str| triangle(&format!("{one}{keys}"));
    let boxed = |keys: &str| format!("shape = \"box\"\n{keys}");
    let flat = "shape = \"triangles\"\n\
                positions = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\ntriangles = [[0, 1, 2]]";
    for (keys, line, part) in [
        (triangle(""), 19, "`triangles` is missing"),
        (
            triangle("triangles = [[0, 1, 3]]"),
            23,
            "index 3, but there are 3",
        ),
        (triangle("triangles = [[0, 1]]"), 23, "3 whole numbers"),
        (triangle("triangles = [[0, 1, 1]]"), 19, "mesh is empty"),
        (flat.to_owned(), 19, "mesh is empty"),
        (
            one("colors = [[1, 1, 1], [0, 0, 0]]"),
            24,
            "`colors` must be one for each of 1",
        ),
        (one("colors = [[1, -1, 1]]"), 24, "`colors` must not be"),
        (
            one("colors = [[1, 1, 1]]\ncolor = [1, 1, 1]"),
            24,
            "`colors` and `color` exclude each other",
        ),
        (boxed("colors = [[1, 1, 1]]"), 22, "unknown key `colors`"),
        (
            boxed("repeat = [{ translate = [1, 0, 0] }]"),
            22,
            "repeat 1: key `count`",
        ),
        (
            boxed("repeat = { count = 2 }"),
            22,
            "an array of tables, not a table",
        ),
        (
            boxed("repeat = [{ count = 10000 }, { count = 2 }]"),
            22,
            "more than 10000 copies",
        ),
        (
            "shape = \"lathe\"\nprofile = [[1, 0], [1, 1]]\nturn_deg = 361".to_owned(),
            23,
            "`turn_deg` must be above 0 and at most 360",
        ),
    ] {
        let message = with(&keys).unwrap_or_else(|| panic!("accepted: {keys}"));
        let place = format!("bad.toml:{line}: object \"new\"");
        assert!(message.contains(&place), "{keys}\n→ {message}");
        assert!(message.contains(part), "{keys}\n→ {message}");
    }
}

#[test]
fn motion_knows_what_it_moves() {
    let folder = tempfile::tempdir().unwrap();
    let moving = |keys: &str| message(folder.path(), &format!("{GOOD}[motion]\n{keys}\n"));
    assert_eq!(moving("frames = 2\ncamera = { orbit_deg = 3 }"), None);
    let step = "[[motion.move]]\nname = \"floor\"\n";
    for (keys, line, part) in [
        ("camera = { orbit_deg = 3 }", 19, "`frames` is missing"),
        (
            "frames = 1\ncamera = { orbit_deg = 3 }",
            20,
            "`frames` must be from 2",
        ),
        ("frames = 4", 19, "needs `camera` or [[motion.move]]"),
        (
            "frames = 9\ngrowth = 0\ncamera = { orbit_deg = 1 }",
            21,
            "`growth` must be positive",
        ),
        (
            "frames = 9\ngrowth = 10\ncamera = { orbit_deg = 1 }",
            21,
            "`growth` makes the longest of 8 steps more than 1e6 times as long as the shortest",
        ),
        ("frames = 4\ncamera = {}", 21, "camera: needs `orbit_deg`"),
        (
            "frames = 4\ncamera = { eye = [1, 2, 3] }",
            21,
            "`eye` must be an array",
        ),
        (
            "frames = 4\ncamera = { orbit_deg = 1, target = [[1, 2, 3]] }",
            21,
            "`orbit_deg` and `target` exclude each other",
        ),
        (
            "frames = 5\ncamera = { eye = [[0.5, 0, -5]] }",
            21,
            "at frame 2 the eye lies inside mirror \"ball\"",
        ),
        (
            "frames = 3\ncamera = { eye = [[0, 0, -5]] }",
            21,
            "at frame 1 the eye is at the target",
        ),
        (
            "frames = 2\ncamera = { eye = [[0, 5, 0]] }",
            21,
            "at frame 1 the viewing direction is parallel",
        ),
        (
            "frames = 4\n[motion.move]",
            21,
            "written as [[motion.move]]",
        ),
        (
            "frames = 4\n[[motion.move]]",
            21,
            "motion: move 1: key `name`",
        ),
        (
            "frames = 4\n[[motion.move]]\nname = \"flor\"",
            22,
            "move \"flor\": `name` `flor` is no object and no mirror (did you mean `floor`?)",
        ),
        (&format!("frames = 4\n{step}"), 21, "needs `translate` or"),
        (
            &format!("frames = 4\n{step}translate = [1, 0, 0]\nabout = [1, 2, 3]"),
            24,
            "`about` needs `rotate_deg`",
        ),
        (
            &format!("frames = 4\n{step}translate = [1, 0, 0]\n{step}translate = [1, 0, 0]"),
            25,
            "`name` is moved twice",
        ),
        (
            "frames = 3\n[[motion.move]]\nname = \"ball\"\ntranslate = [0, 0, 10]",
            19,
            "at frame 1 the eye lies inside",
        ),
    ] {
        let message = moving(keys).unwrap_or_else(|| panic!("accepted: {keys}"));
        let place = format!("bad.toml:{line}: motion");
        assert!(message.contains(&place), "{keys}\n→ {message}");
        assert!(message.contains(part), "{keys}\n→ {message}");
    }
}

#[test]
fn names_that_are_no_scene() {
    let error = |name: &str| open(name, &LoadOptions::default()).unwrap_err().to_string();
    assert!(error("sphere-sqare").contains("did you mean `sphere-square`?"));
    assert!(error("no/such/file.toml").starts_with("no/such/file.toml: cannot be read"));
}

#[test]
fn the_command_lines_resolution_is_checked_too() {
    let options = LoadOptions {
        resolution: Some([0, 5]),
        ..LoadOptions::default()
    };
    let message = open("sphere-square", &options).unwrap_err().to_string();
    assert!(
        message.contains("`resolution`") && message.contains("0x5"),
        "{message}"
    );
}

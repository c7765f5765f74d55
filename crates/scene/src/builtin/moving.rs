//! `moving-MIRROR-WHAT`: one room before each kind of mirror, in which the camera, an object, the
//! mirror, or all of them move.
//!
//! Every sequence has the same pace: its steps grow from less than 0.05 pixels to more than 15 of
//! true motion of the reflections, so that what depends on the length of a step is seen in one
//! sequence. How far things go by the last frame is measured for each scene.

use std::fmt::Write;

const ROOM: &str = include_str!("../../../../scenes/template-moving.toml");

/// Frames of each sequence.
const FRAMES: u32 = 12;
/// How many times as long a step is as the one before: over ten of them, 470 times.
const GROWTH: f64 = 1.85;

/// A mirror of the family.
struct Moving {
    /// In the scene's name.
    name: &'static str,
    /// In its `why`.
    called: &'static str,
    /// The keys of its `[[mirror]]`.
    mirror: &'static str,
    /// How far what moves goes, in the order of [`WHAT`]: factors of the ways in [`motion`].
    reach: [f64; 4],
}

/// What moves: in the scene's name, and in its `why`.
const WHAT: [(&str, &str); 4] = [
    ("camera", "The camera"),
    ("object", "An object"),
    ("mirror", "The mirror"),
    ("all", "Everything"),
];

const MIRRORS: [Moving; 7] = [
    Moving {
        name: "ball",
        called: "before a mirror ball",
        mirror: "shape = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = 0.9",
        reach: [2.81, 2.74, 1.3, 0.87],
    },
    Moving {
        name: "ellipsoid",
        called: "before a strongly curved ellipsoid",
        mirror: "shape = \"ellipsoid\"\ncenter = [0.0, 0.0, 0.0]\nradii = [1.35, 0.6, 0.5]\nrotate_deg = [0.0, 22.0, 24.0]",
        reach: [3.0, 2.01, 1.05, 1.03],
    },
    Moving {
        name: "bowl",
        called: "before a concave mirror",
        mirror: "shape = \"bowl\"\ncenter = [0.0, 0.0, 0.3]\nradius = 1.5\naxis = [0.0, 0.0, -1.0]\nhalf_angle_deg = 55.0",
        reach: [5.84, 3.23, 1.06, 1.34],
    },
    Moving {
        name: "torus",
        called: "before a torus",
        mirror: "shape = \"torus\"\ncenter = [0.0, 0.0, 0.0]\naxis = [0.25, 0.3, 1.0]\nmajor = 0.78\nminor = 0.36",
        reach: [3.67, 3.1, 1.24, 1.06],
    },
    Moving {
        name: "saddle",
        called: "before a saddle",
        mirror: "shape = \"saddle\"\ncenter = [0.0, 0.0, 0.0]\nnormal = [0.1, 0.0, 1.0]\nsize = [2.4, 1.9]\ncurvature = [0.6, -0.6]",
        reach: [0.8, 0.48, 1.83, 1.35],
    },
    Moving {
        name: "plane",
        called: "before a flat mirror",
        mirror: "shape = \"plane\"\ncenter = [0.0, 0.0, -0.4]\nnormal = [0.1, 0.05, 1.0]\nsize = [2.8, 2.0]",
        reach: [0.89, 1.79, 0.67, 1.35],
    },
    Moving {
        name: "mesh",
        called: "before a ball of triangles",
        mirror: "shape = \"sphere\"\ncenter = [0.0, 0.0, 0.0]\nradius = 0.9\nexact = false\ntessellation = 256",
        reach: [2.81, 2.74, 1.3, 0.87],
    },
];

/// The names, mirrors outer.
pub(super) fn names() -> impl Iterator<Item = String> {
    MIRRORS.iter().flat_map(|moving| {
        let all = WHAT.iter();
        all.map(|(what, _)| format!("moving-{}-{what}", moving.name))
    })
}

/// The scene file of a member.
pub(super) fn text(name: &str) -> Option<String> {
    let (mirror, what) = name.strip_prefix("moving-")?.split_once('-')?;
    let moving = MIRRORS.iter().find(|moving| moving.name == mirror)?;
    let index = WHAT.iter().position(|(name, _)| *name == what)?;
    let room = ROOM.replacen("WHAT", WHAT[index].1, 1);
    let room = room.replacen("MIRROR", moving.called, 1);
    let keys = moving.mirror;
    let mirror = format!("\n[[mirror]]\nname = \"mirror\"\n{keys}\n");
    Some(room + &mirror + &motion(what, moving.reach[index]))
}

/// `[motion]` of one thing or of all, so many times as far as things go with 1.
fn motion(what: &str, reach: f64) -> String {
    let moves = |part: &str| what == part || what == "all";
    let mut text = format!("\n[motion]\nframes = {FRAMES}\ngrowth = {GROWTH:?}\n");
    if moves("camera") {
        let _ = writeln!(text, "camera = {{ orbit_deg = {:?} }}", -10.0 * reach);
    }
    for (part, name, turn) in [("object", "globe", 30.0), ("mirror", "mirror", -8.0)] {
        if moves(part) {
            let [along, up, turn] = [0.2, 0.05, turn].map(|way| way * reach);
            let _ = writeln!(
                text,
                "[[motion.move]]\nname = \"{name}\"\nrotate_deg = [0.0, {turn:?}, 0.0]\n\
                 translate = [{along:?}, {up:?}, {up:?}]"
            );
        }
    }
    text
}

//! `moving-MIRROR-WHAT`: one room in front of each kind of mirror, in which the camera, an object, the mirror,
//! or all of them move. An ending makes it a scene of a sweep: `-step-PX` is a single step of about PX pixels,
//! `-within-D` a step of about 4 pixels in a tube of radius D around the view instead of the room,
//! `-segments-N` a step of about 4 pixels in front of a mesh of N segments.
//!
//! All sequences have the same pace: the true motion of the reflections grows from less than 0.05 to more than
//! 15 pixels a step, so that one sequence shows what depends on the length of a step. How far things go by the
//! last frame was measured for each scene.

use std::fmt::Write;

const ROOM: &str = include_str!("../../../../scenes/template-moving.toml");

/// Frames of each sequence.
const FRAMES: i32 = 12;
/// How many times as long a step is as the one before: over ten of them, 470 times.
const GROWTH: f64 = 1.85;
/// The last step in pixels, about.
const LONGEST_PX: f64 = 16.0;

/// A mirror of the family.
struct Moving {
    /// In the scene's name.
    name: &'static str,
    /// In its `why`.
    called: &'static str,
    /// The keys of its `[[mirror]]`.
    mirror: &'static str,
    /// Factors of the motions in [`motion`], in the order of [`WHAT`].
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

/// What the names of single steps end with.
const ENDINGS: [(&str, &str, &[&str]); 9] = [
    ("", "all", &["-step-4"]),
    ("ball", "camera", &["-step-4"]),
    ("ball", "object", &["-step-4"]),
    ("ball", "mirror", &["-step-4"]),
    ("ball", "all", STEPS),
    ("bowl", "all", STEPS),
    (
        "ball",
        "camera",
        &["-within-1.2", "-within-2", "-within-4", "-within-8"],
    ),
    ("bowl", "camera", &["-within-2", "-within-4", "-within-8"]),
    (
        "mesh",
        "all",
        &[
            "-segments-16",
            "-segments-32",
            "-segments-64",
            "-segments-128",
            "-segments-512",
        ],
    ),
];
const STEPS: &[&str] = &["-step-0.1", "-step-0.3", "-step-1", "-step-10", "-step-30"];

/// The step of endings that give none, in pixels.
const USUAL: f64 = 4.0;

/// Whether a scene is one of the single steps of a sweep.
pub(super) fn is_single_step(name: &str) -> bool {
    name.starts_with("moving-") && name.split('-').count() > 3
}

/// The names, mirrors outer, then those of single steps.
pub(super) fn names() -> impl Iterator<Item = String> {
    let sequences = MIRRORS.iter().flat_map(|moving| {
        let all = WHAT.iter();
        all.map(|(what, _)| format!("moving-{}-{what}", moving.name))
    });
    let steps = ENDINGS.iter().flat_map(|(name, what, endings)| {
        let mirrors = MIRRORS.iter();
        let mirrors = mirrors.filter(move |moving| name.is_empty() || *name == moving.name);
        mirrors.flat_map(move |moving| {
            let endings = endings.iter();
            endings.map(move |ending| format!("moving-{}-{what}{ending}", moving.name))
        })
    });
    sequences.chain(steps)
}

/// What the ending of a name asks for.
#[derive(Clone, Copy)]
enum Ending<'n> {
    /// The whole sequence.
    None,
    /// A step of about so many pixels.
    Step(f64),
    Within(&'n str),
    Segments(&'n str),
}

impl<'n> Ending<'n> {
    fn of(text: &'n str) -> Option<Self> {
        let (kind, number) = text.split_once('-')?;
        let value: f64 = number.parse().ok()?;
        match kind {
            "step" => Some(Self::Step(value)),
            "within" => Some(Self::Within(number)),
            "segments" => Some(Self::Segments(number)),
            _ => None,
        }
    }

    /// Pixels of the only step; `None` for a sequence.
    fn step(self) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Step(pixels) => Some(pixels),
            Self::Within(_) | Self::Segments(_) => Some(USUAL),
        }
    }
}

/// The scene file of a member.
pub(super) fn text(name: &str) -> Option<String> {
    let (mirror, what) = name.strip_prefix("moving-")?.split_once('-')?;
    let (what, ending) = match what.split_once('-') {
        Some((what, ending)) => (what, Ending::of(ending)?),
        None => (what, Ending::None),
    };
    let moving = MIRRORS.iter().find(|moving| moving.name == mirror)?;
    let index = WHAT.iter().position(|(name, _)| *name == what)?;
    let mut room = ROOM.replacen("WHAT", WHAT[index].1, 1);
    room = room.replacen("MIRROR", moving.called, 1);
    if let Some(step) = ending.step() {
        let (before, _) = room.split_once(": each step")?;
        let (_, after) = room.split_once("at 640x480, ")?;
        room = format!("{before}: one step of about {step} pixels at 640x480, {after}");
    }
    if let Ending::Within(radius) = ending {
        let (before, _) = room.split_once("[[object]]")?;
        room = format!("{before}{}", TUBE.replace("RADIUS", radius));
    }
    let mut keys = moving.mirror.to_owned();
    if let Ending::Segments(segments) = ending {
        keys = keys.replace("tessellation = 256", &format!("tessellation = {segments}"));
    }
    let mirror = format!("\n[[mirror]]\nname = \"mirror\"\n{keys}\n");
    Some(room + &mirror + &motion(what, moving.reach[index], ending.step()))
}

/// What stands around the mirror in place of the room, open to the eye.
const TUBE: &str = r#"[[object]]
name = "tube"
shape = "lathe"
profile = [[RADIUS, -3.0], [RADIUS, 3.5]]
n = 24
segments = 64
checker = { a = [0.84, 0.80, 0.72], b = [0.18, 0.24, 0.32], cells = 16 }
transform = { rotate_deg = [90.0, 0.0, 0.0] }
"#;

/// `[motion]` of one thing or of all, with `reach` as the factor of all motions; or a single step of about
/// `step` pixels.
fn motion(what: &str, reach: f64, step: Option<f64>) -> String {
    let moves = |part: &str| what == part || what == "all";
    // The last step of a sequence is the longest.
    let longest = (1.0 - 1.0 / GROWTH) / (1.0 - GROWTH.powi(1 - FRAMES));
    let reach = match step {
        Some(pixels) => reach * longest * pixels / LONGEST_PX,
        None => reach,
    };
    let mut text = match step {
        Some(_) => "\n[motion]\nframes = 2\n".to_owned(),
        None => format!("\n[motion]\nframes = {FRAMES}\ngrowth = {GROWTH:?}\n"),
    };
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

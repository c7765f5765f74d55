//! The scenes that come with the program.

mod moving;

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../scenes/", $name, ".toml")))),*]
    };
}

/// Scenes with a file of their own.
const SCENES: [(&str, &str); 29] = scenes![
    "sphere-square",
    "sphere-square-hidden",
    "ellipsoid-square",
    "sphere-objects-1k",
    "sphere-objects-20k",
    "spheres",
    "planar",
    "facing",
    "parting",
    "bowl",
    "ellipsoid",
    "sphere-table",
    "sphere-touching",
    "crack",
    "faceted",
    "kitchen",
    "box",
    "distant",
    "box-teapot",
    "room",
    "atrium",
    "atrium-teapot",
    "torus",
    "saddle",
    "prototype-sphere",
    "prototype-ellipsoid",
    "prototype-bowl",
    "teapot-ball",
    "sponza-ball",
];

/// What a family changes in its template.
enum Change {
    /// Replaces the number of a key; the second string is the number that the key has in the template.
    Number(&'static str, &'static str),
    /// Keeps so many of the tables that begin with this line, which are the last of the template, and drops
    /// the others.
    Tables(&'static str),
    /// Keeps one object, by its name, and drops the other objects.
    Object,
}

impl Change {
    /// A template with the number of a scene.
    fn applied(&self, template: &str, number: &str) -> String {
        match self {
            Self::Number(key, own) => {
                let [own, new] = [*own, number].map(|number| format!("\n{key} = {number}"));
                template.replacen(&own, &new, 1)
            }
            Self::Tables(name) => {
                let kept: usize = number.parse().expect("a family counts its tables");
                let behind = template.match_indices(name).nth(kept);
                behind
                    .map_or(template, |(at, _)| &template[..at])
                    .to_owned()
            }
            Self::Object => {
                let named = format!("\nname = \"{number}\"\n");
                let mut kept = String::new();
                for (place, table) in template.split("\n[").enumerate() {
                    if table.starts_with("[object]]") && !table.contains(&named) {
                        continue;
                    }
                    if place > 0 {
                        kept += "\n[";
                    }
                    kept += table;
                }
                kept
            }
        }
    }
}

/// Scenes that differ in one number of a template.
struct Family {
    /// What their names begin with.
    prefix: &'static str,
    template: &'static str,
    change: Change,
    /// What their names end with, and their numbers.
    sizes: &'static [(&'static str, &'static str)],
}

/// Cells along each side of a grid of about so many vertices.
const GRID_SIZES: &[(&str, &str)] = &[
    ("100", "9"),
    ("300", "16"),
    ("1k", "31"),
    ("3k", "54"),
    ("10k", "99"),
    ("30k", "172"),
    ("100k", "315"),
];

/// Those, and one of a million triangles.
const FULL_SIZES: &[(&str, &str)] = &[
    ("100", "9"),
    ("300", "16"),
    ("1k", "31"),
    ("3k", "54"),
    ("10k", "99"),
    ("30k", "172"),
    ("100k", "315"),
    ("500k", "707"),
];

/// Sizes of scenes that are looked at beside a family.
const FEW_SIZES: &[(&str, &str)] = &[("1k", "31"), ("10k", "99")];

const FAMILIES: [Family; 11] = [
    Family {
        prefix: "sphere-grid-full-",
        template: include_str!("../../../scenes/template-sphere-grid-full.toml"),
        change: Change::Number("n", "8"),
        sizes: FULL_SIZES,
    },
    Family {
        prefix: "sphere-grid-",
        template: include_str!("../../../scenes/template-sphere-grid.toml"),
        change: Change::Number("n", "8"),
        sizes: GRID_SIZES,
    },
    Family {
        prefix: "sphere-grid-full-hidden-",
        template: include_str!("../../../scenes/template-sphere-grid-full-hidden.toml"),
        change: Change::Number("n", "8"),
        sizes: FEW_SIZES,
    },
    Family {
        prefix: "sphere-grid-hidden-",
        template: include_str!("../../../scenes/template-sphere-grid-hidden.toml"),
        change: Change::Number("n", "8"),
        sizes: FEW_SIZES,
    },
    Family {
        prefix: "sphere-drawn-",
        template: include_str!("../../../scenes/template-sphere-drawn.toml"),
        change: Change::Number("tessellation", "128"),
        sizes: &[
            ("8", "8"),
            ("16", "16"),
            ("32", "32"),
            ("64", "64"),
            ("128", "128"),
            ("256", "256"),
        ],
    },
    Family {
        prefix: "prototype-sphere-zoom-",
        template: include_str!("../../../scenes/prototype-sphere.toml"),
        change: Change::Number("fov_y", "34.0"),
        sizes: &[
            ("2", "17.382514"),
            ("4", "8.741543"),
            ("8", "4.377139"),
            ("16", "2.189368"),
            ("32", "1.094784"),
        ],
    },
    Family {
        prefix: "sphere-small-",
        template: include_str!("../../../scenes/sphere-objects-1k.toml"),
        change: Change::Number("fov_y", "36.0"),
        sizes: &[("2", "66.034796"), ("4", "104.84913"), ("8", "137.915489")],
    },
    Family {
        prefix: "sphere-near-",
        template: include_str!("../../../scenes/sphere-objects-1k.toml"),
        change: Change::Number("fov_y", "36.0"),
        sizes: &[("2", "18.4596"), ("4", "9.289")],
    },
    Family {
        prefix: "square-small-",
        template: include_str!("../../../scenes/sphere-square.toml"),
        change: Change::Number("fov_y", "36.0"),
        sizes: &[("4", "104.84913")],
    },
    Family {
        prefix: "sphere-table-only-",
        template: include_str!("../../../scenes/sphere-table.toml"),
        change: Change::Object,
        sizes: &[
            ("cloth", "cloth"),
            ("candlestick", "candlestick"),
            ("teapot", "teapot"),
            ("apple", "apple"),
        ],
    },
    Family {
        prefix: "mirrors-",
        template: include_str!("../../../scenes/template-mirrors.toml"),
        change: Change::Tables("[[mirror]]"),
        sizes: &[
            ("1", "1"),
            ("2", "2"),
            ("3", "3"),
            ("4", "4"),
            ("6", "6"),
            ("8", "8"),
        ],
    },
];

/// Whether the name is that of one of many scenes of a sweep that differ only in the length of a step, a
/// distance or a number of segments, so that it is not worth looking at by itself.
pub fn is_single_step(name: &str) -> bool {
    moving::is_single_step(name)
}

/// Names of all built-in scenes.
pub fn names() -> Vec<String> {
    let files = SCENES.iter().map(|(name, _)| (*name).to_owned());
    let families = FAMILIES.iter().flat_map(|family| {
        let sizes = family.sizes.iter();
        sizes.map(|(size, _)| format!("{}{size}", family.prefix))
    });
    files.chain(families).chain(moving::names()).collect()
}

/// The scene file of a built-in scene.
pub fn text(name: &str) -> Option<String> {
    if let Some((_, text)) = SCENES.iter().find(|(known, _)| *known == name) {
        return Some((*text).to_owned());
    }
    let sized = FAMILIES.iter().find_map(|family| {
        let size = name.strip_prefix(family.prefix)?;
        let (_, number) = family.sizes.iter().find(|(known, _)| *known == size)?;
        Some(family.change.applied(family.template, number))
    });
    sized.or_else(|| moving::text(name))
}

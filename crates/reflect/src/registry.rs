//! Every technique, in one table: adding one adds an entry here.

use std::fmt;

use catoptric_scene::Scene;

use crate::spec::Options;
use crate::{image_order, refine, search};

/// What a technique is called, takes, and is made by.
#[derive(Clone, Copy, Debug)]
pub struct TechniqueInfo {
    /// As written on the command line; refinements start with `+`.
    pub name: &'static str,
    /// A sentence.
    pub what: &'static str,
    /// How it goes together with others.
    pub family: Family,
    /// Where it was published.
    pub paper: &'static str,
    /// Groups of options, in display order.
    pub(crate) options: &'static [&'static [OptionInfo]],
    pub(crate) maker: Maker,
    /// Why it cannot draw a scene that has mirrors; `None` if it can.
    pub(crate) objection: fn(&Options, &Scene) -> Option<String>,
}

/// How a technique goes together with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Finds reflection points; goes with any refinement.
    Search,
    /// Chooses the points to search; goes with any search.
    Refinement,
    /// Finds what each mirror pixel's ray meets; stands alone.
    ImageOrder,
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Search => "search",
            Self::Refinement => "refinement",
            Self::ImageOrder => "image order",
        })
    }
}

/// One option of a technique.
#[derive(Clone, Copy, Debug)]
pub struct OptionInfo {
    /// Key.
    pub name: &'static str,
    /// What it may be; the default first.
    pub values: Values,
    /// A sentence.
    pub what: &'static str,
}

/// What an option may be.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// One of these, by default the first.
    Words(&'static [&'static str]),
    /// A whole number.
    Whole {
        /// Where it is not given.
        default: u32,
        /// Least and greatest.
        range: [u32; 2],
    },
    /// A number.
    Number {
        /// Where it is not given.
        default: f64,
        /// Least and greatest.
        range: [f64; 2],
    },
}

/// What makes a technique.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Maker {
    Search(search::Make),
    Refinement(refine::Make),
    ImageOrder(image_order::Make),
    /// It cannot be made, for this reason.
    Missing(&'static str),
}

impl TechniqueInfo {
    /// Why it cannot be used; `None` if it can.
    pub fn reason(&self) -> Option<&'static str> {
        match self.maker {
            Maker::Missing(reason) => Some(reason),
            _ => None,
        }
    }

    /// All options, in display order.
    pub fn options(&self) -> impl Iterator<Item = &'static OptionInfo> + Clone + use<> {
        self.options.iter().copied().flatten()
    }
}

impl OptionInfo {
    /// The value where none is given.
    pub fn default(&self) -> String {
        match self.values {
            Values::Words(words) => words[0].to_owned(),
            Values::Whole { default, .. } => default.to_string(),
            Values::Number { default, .. } => default.to_string(),
        }
    }

    /// What it may be, in words.
    pub fn allowed(&self) -> String {
        match self.values {
            Values::Words(words) => words.join(", "),
            Values::Whole { range, .. } => format!("a whole number, {} to {}", range[0], range[1]),
            Values::Number { range, .. } => format!("a number, {} to {}", range[0], range[1]),
        }
    }
}

const fn words(
    name: &'static str,
    values: &'static [&'static str],
    what: &'static str,
) -> OptionInfo {
    OptionInfo {
        name,
        values: Values::Words(values),
        what,
    }
}

/// Options of every technique.
const EVERY: &[OptionInfo] = &[
    words(
        "gbuffer",
        &["exact", "mesh"],
        "mirror points by analytic intersection, or of the drawn triangles",
    ),
    words(
        "under",
        &["background", "dark"],
        "what a mirror shows where no reflection is drawn",
    ),
];

/// Options of every search.
const SEARCH: &[OptionInfo] = &[
    words(
        "depth",
        &["thesis", "virtual"],
        "what the virtual triangles are depth-tested by; with +grid always virtual",
    ),
    words(
        "hidden",
        &["drop", "extend"],
        "triangles with a hidden vertex are dropped, or drawn with the vertex continued behind the tangent plane unless all three are hidden",
    ),
    words(
        "show",
        &["shaded", "wireframe", "levels"],
        "the reflected surfaces, those with the edges of the virtual triangles, or how often each was split",
    ),
];

const LINEAR: &[OptionInfo] = &[
    words(
        "start",
        &["center", "bounds", "previous"],
        "where the walk starts: the mirror's projected centre, its projected bounding box's, or the previous frame's answer",
    ),
    words(
        "neighbours",
        &["4", "8"],
        "texels compared with in each step",
    ),
    words(
        "residual",
        &["dot", "cross"],
        "the measure of a texel's fitness",
    ),
];

const NEWTON: &[OptionInfo] = &[words(
    "start",
    &["center", "bounds", "previous"],
    "where the iteration starts: the mirror's projected centre, its projected bounding box's, or the previous frame's answer",
)];

const RAY_HIERARCHY: &[OptionInfo] = &[
    words(
        "repair",
        &["none", "enlarge", "stop"],
        "what is done about holes between the cones: nothing, a second test with enlarged cones and spheres, or an answer from a level above the base",
    ),
    OptionInfo {
        name: "cone",
        values: Values::Number {
            default: 1.5,
            range: [1.0, 100.0],
        },
        what: "factor on the cones' half angles (repair=enlarge)",
    },
    OptionInfo {
        name: "sphere",
        values: Values::Number {
            default: 2.0,
            range: [1.0, 100.0],
        },
        what: "factor on the spheres' radii (repair=enlarge)",
    },
    OptionInfo {
        name: "stop",
        values: Values::Whole {
            default: 3,
            range: [1, 14],
        },
        what: "level whose sphere centre is the answer, the pixels being level 0 (repair=stop)",
    },
];

const REFLECTOR_CUBEMAP: &[OptionInfo] = &[
    OptionInfo {
        name: "iterations",
        values: Values::Whole {
            default: 9,
            range: [1, 256],
        },
        what: "most steps of a search",
    },
    OptionInfo {
        name: "size",
        values: Values::Whole {
            default: 256,
            range: [2, 2048],
        },
        what: "texels along an edge of the cube maps",
    },
    words(
        "start",
        &["bisector", "eye"],
        "the direction from the mirror's centre where a search starts: halfway between eye and vertex, or the eye's",
    ),
    OptionInfo {
        name: "step",
        values: Values::Number {
            default: 0.5,
            range: [0.05, 4.0],
        },
        what: "length of the first step, in units of the projected bisector",
    },
    OptionInfo {
        name: "shrink",
        values: Values::Number {
            default: 0.6,
            range: [0.1, 1.0],
        },
        what: "factor of the step length where the field changes much within a step",
    },
    OptionInfo {
        name: "grow",
        values: Values::Number {
            default: 1.25,
            range: [1.0, 4.0],
        },
        what: "factor of the step length where the field changes little within a step",
    },
];

const GRID: &[OptionInfo] = &[
    OptionInfo {
        name: "fraction",
        values: Values::Number {
            default: 0.1,
            range: [0.0, 1.0],
        },
        what: "grid vertices as a share of the mesh's; 1 searches every vertex of the mesh",
    },
    OptionInfo {
        name: "cell",
        values: Values::Number {
            default: 0.0,
            range: [0.0, 1e6],
        },
        what: "edge of the cells in world units, whatever their number; 0 goes by the fraction",
    },
];

const fn levels(default: u32, what: &'static str) -> OptionInfo {
    OptionInfo {
        name: "level",
        values: Values::Whole {
            default,
            range: [0, refine::tessellation::DEEPEST],
        },
        what,
    }
}

const FULL: &[OptionInfo] = &[levels(3, "how often every triangle is split")];

const ADAPTIVE: &[OptionInfo] = &[
    levels(5, "how often a triangle may be split"),
    OptionInfo {
        name: "threshold",
        values: Values::Number {
            default: 0.001,
            range: [0.0, 1.0],
        },
        what: "edge error from which a triangle is split: sin²(δ/2) of the angle δ by which the mirror's normal at the middle misses; 0 splits all, 1 none",
    },
];

const fn whole(
    name: &'static str,
    default: u32,
    range: [u32; 2],
    what: &'static str,
) -> OptionInfo {
    let values = Values::Whole { default, range };
    OptionInfo { name, values, what }
}

const fn number(
    name: &'static str,
    default: f64,
    range: [f64; 2],
    what: &'static str,
) -> OptionInfo {
    let values = Values::Number { default, range };
    OptionInfo { name, values, what }
}

/// Options of techniques that look into cube maps of the scene.
const CUBE_MAPS: &[OptionInfo] = &[
    words(
        "size",
        &["256", "32", "64", "128", "512", "1024"],
        "texels a side of a cube face",
    ),
    words(
        "update",
        &["static", "frame"],
        "whether the maps are drawn once or in every frame",
    ),
];

const RAY_TRACE: &[OptionInfo] = &[
    words(
        "traversal",
        &["shader", "hardware"],
        "what goes through the hierarchy: a shader (obvhs's), or ray queries in hardware where the adapter has them (the driver's)",
    ),
    words(
        "update",
        &["static", "frame"],
        "whether the hierarchy is built when something has moved or for every frame",
    ),
];

const ENVIRONMENT_MAP: &[OptionInfo] = &[words(
    "placement",
    &["center", "scene"],
    "where the map is taken from: the mirror's centre, or the first of its `cubemaps` in the scene file",
)];

const CUBEMAP_TRACE: &[OptionInfo] = &[
    whole("objects", 2, [1, 8], "cube maps of each mirror"),
    words(
        "placement",
        &["auto", "random", "scene"],
        "where the maps are taken from: of random candidates those that resolve the most pixels, or just as many as are needed, or the mirror's `cubemaps` in the scene file",
    ),
    words(
        "criterion",
        &["analytic", "distance", "both", "switch"],
        "what counts as a hit: a sign change of the distance to the map, a small one, a small one or else the first sign change, or either by how much the ray turns",
    ),
    words(
        "accept",
        &["continuous", "any"],
        "which sign changes count: those where the map is continuous (ours), or any, as published",
    ),
    words(
        "sampling",
        &["step", "angle", "texel"],
        "where a ray is looked at: at even steps, at even angles, or once in each texel",
    ),
    words(
        "pyramid",
        &["off", "published", "sound"],
        "skipping by least and greatest distances: none, by those at a cell's ends, or by the ray's nearest point",
    ),
    words(
        "stage",
        &["fragment", "compute"],
        "one fragment a ray, or 32 lanes a ray that test the cells of a level at once (and thereby each texel once)",
    ),
    words(
        "agree",
        &["ballot", "memory"],
        "how the lanes of a ray agree (stage=compute): by the ballots of subgroups, where the adapter has these, or lane by lane in workgroup memory",
    ),
    number(
        "length",
        2.0,
        [0.01, 100.0],
        "length of a ray, in diagonals of the scene",
    ),
    number(
        "step",
        0.001,
        [0.000_01, 0.5],
        "step, as a share of the ray's length (or of its angle)",
    ),
    number(
        "limit",
        1.5,
        [0.0, 1000.0],
        "largest distance that counts as a hit, in steps (criterion=distance)",
    ),
    whole(
        "from",
        2,
        [0, 10],
        "coarsest level of the pyramid; level k has 2^k cells a side",
    ),
    whole("to", 6, [0, 10], "finest level of the pyramid"),
    whole(
        "bounces",
        1,
        [1, 16],
        "rays followed from a pixel; more than one shows mirrors in mirrors",
    ),
    number(
        "bias",
        0.0,
        [0.0, 0.5],
        "share of a second ray's length at which it starts (bounces), 0: by the width of a texel, for all rays",
    ),
    words(
        "restart",
        &["bias", "clear"],
        "how a ray gets off the mirror (bounces): by the bias, or no hit counts before a sample that is clear of the surface",
    ),
    words(
        "unresolved",
        &[
            "mark",
            "environment",
            "background",
            "neighbours",
            "best",
            "trace",
        ],
        "what a pixel shows that no map resolves",
    ),
];

fn any_scene(_: &Options, _: &Scene) -> Option<String> {
    None
}

fn hidden_are_dropped(options: &Options, _: &Scene) -> Option<String> {
    let reason = "hidden=extend: a hidden vertex lies in no cone of the hierarchy, only a search that \
                  walks on the mirror can continue it";
    options.is("hidden", "extend").then(|| reason.to_owned())
}

const fn later(
    name: &'static str,
    what: &'static str,
    family: Family,
    paper: &'static str,
) -> TechniqueInfo {
    TechniqueInfo {
        name,
        what,
        family,
        paper,
        options: &[],
        maker: Maker::Missing("not built yet"),
        objection: any_scene,
    }
}

/// All techniques, those not built yet included.
pub const TECHNIQUES: &[TechniqueInfo] = &[
    TechniqueInfo {
        name: "linear",
        what: "linear screen-space search",
        family: Family::Search,
        paper: "Szabo 2013",
        options: &[LINEAR, SEARCH, EVERY],
        maker: Maker::Search(search::linear::make),
        objection: any_scene,
    },
    TechniqueInfo {
        name: "ray-hierarchy",
        what: "cone and sphere pyramid over the reflected rays",
        family: Family::Search,
        paper: "Szabo 2013",
        options: &[RAY_HIERARCHY, SEARCH, EVERY],
        maker: Maker::Search(search::ray_hierarchy::make),
        objection: hidden_are_dropped,
    },
    TechniqueInfo {
        name: "reflector-cubemap",
        what: "midpoint search in cube maps of the mirror",
        family: Family::Search,
        paper: "Estalella et al. 2005",
        options: &[REFLECTOR_CUBEMAP, SEARCH, EVERY],
        maker: Maker::Search(search::reflector_cubemap::make),
        objection: search::reflector_cubemap::objection,
    },
    TechniqueInfo {
        name: "newton",
        what: "Newton's method on the G-buffer, sub-pixel",
        family: Family::Search,
        paper: "this project",
        options: &[NEWTON, SEARCH, EVERY],
        maker: Maker::Search(search::newton::make),
        objection: any_scene,
    },
    later(
        "swept-boxes",
        "watertight pyramid, all solutions",
        Family::Search,
        "this project",
    ),
    TechniqueInfo {
        name: "+full",
        what: "splits every triangle",
        family: Family::Refinement,
        paper: "Szabo 2013",
        options: &[FULL],
        maker: Maker::Refinement(refine::full::make),
        objection: refine::tessellation::objection,
    },
    TechniqueInfo {
        name: "+adaptive",
        what: "splits where the edge error is large",
        family: Family::Refinement,
        paper: "Szabo 2013",
        options: &[ADAPTIVE],
        maker: Maker::Refinement(refine::adaptive::make),
        objection: refine::tessellation::objection,
    },
    TechniqueInfo {
        name: "+grid",
        what: "interpolates vertices between the virtual images of a grid around each mesh",
        family: Family::Refinement,
        paper: "Estalella et al. 2005",
        options: &[GRID],
        maker: Maker::Refinement(refine::grid::make),
        objection: any_scene,
    },
    later(
        "+pixel",
        "crack-free, error in pixels",
        Family::Refinement,
        "this project",
    ),
    later(
        "+exact",
        "ray-triangle test a fragment",
        Family::Refinement,
        "this project",
    ),
    TechniqueInfo {
        name: "environment-map",
        what: "one cube map from each mirror's centre, looked up in the reflected direction",
        family: Family::ImageOrder,
        paper: "baseline",
        options: &[ENVIRONMENT_MAP, CUBE_MAPS, EVERY],
        maker: Maker::ImageOrder(image_order::environment_map::make),
        objection: image_order::environment_map::objection,
    },
    TechniqueInfo {
        name: "planar",
        what: "the scene from the mirrored eye, flat mirrors only",
        family: Family::ImageOrder,
        paper: "baseline",
        options: &[EVERY],
        maker: Maker::ImageOrder(image_order::planar::make),
        objection: image_order::planar::objection,
    },
    TechniqueInfo {
        name: "cubemap-trace",
        what: "reflected rays marched through a few cube maps of distance",
        family: Family::ImageOrder,
        paper: "Číž 2017",
        options: &[CUBEMAP_TRACE, CUBE_MAPS, EVERY],
        maker: Maker::ImageOrder(image_order::cubemap_trace::make),
        objection: image_order::cubemap_trace::objection,
    },
    TechniqueInfo {
        name: "ray-trace",
        what: "the control: the reference's rays on the GPU",
        family: Family::ImageOrder,
        paper: "control",
        options: &[RAY_TRACE, EVERY],
        maker: Maker::ImageOrder(image_order::ray_trace::make),
        objection: any_scene,
    },
];

/// All techniques, for listing.
pub fn list() -> &'static [TechniqueInfo] {
    TECHNIQUES
}

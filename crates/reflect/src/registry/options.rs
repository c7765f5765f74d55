//! The options of every technique, with their defaults.

use super::{OptionInfo, Values};
use crate::refine;

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
pub(super) const EVERY: &[OptionInfo] = &[
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
pub(super) const SEARCH: &[OptionInfo] = &[
    words(
        "depth",
        &["thesis", "virtual"],
        "what the virtual triangles are depth-tested by; with a +grid that interpolates always virtual",
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

pub(super) const LINEAR: &[OptionInfo] = &[
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

pub(super) const NEWTON: &[OptionInfo] = &[words(
    "start",
    &["center", "bounds", "previous"],
    "where the iteration starts: the mirror's projected centre, its projected bounding box's, or the previous frame's answer",
)];

pub(super) const RAY_HIERARCHY: &[OptionInfo] = &[
    words(
        "repair",
        &["none", "enlarge", "stop"],
        "what is done about holes between the cones: nothing, a second test with enlarged cones and spheres, or an answer from a level above the base",
    ),
    number(
        "cone",
        1.5,
        [1.0, 100.0],
        "factor on the cones' half angles (repair=enlarge)",
    ),
    number(
        "sphere",
        2.0,
        [1.0, 100.0],
        "factor on the spheres' radii (repair=enlarge)",
    ),
    whole(
        "stop",
        3,
        [1, 14],
        "level whose sphere centre is the answer, the pixels being level 0 (repair=stop)",
    ),
];

pub(super) const REFLECTOR_CUBEMAP: &[OptionInfo] = &[
    whole("iterations", 9, [1, 256], "most steps of a search"),
    whole(
        "size",
        256,
        [2, 2048],
        "texels along an edge of the cube maps",
    ),
    words(
        "start",
        &["bisector", "eye"],
        "the direction from the mirror's centre where a search starts (in a concave mirror the one against it): halfway between eye and vertex, or the eye's",
    ),
    number(
        "step",
        0.5,
        [0.05, 4.0],
        "length of the first step, in units of the projected bisector",
    ),
    number(
        "shrink",
        0.6,
        [0.1, 1.0],
        "factor of the step length where the field changes much within a step",
    ),
    number(
        "grow",
        1.25,
        [1.0, 4.0],
        "factor of the step length where the field changes little within a step",
    ),
];

pub(super) const GRID: &[OptionInfo] = &[
    number(
        "fraction",
        0.1,
        [0.0, 1.0],
        "grid vertices as a share of the mesh's; 1 searches every vertex of the mesh",
    ),
    number(
        "cell",
        0.0,
        [0.0, 1e6],
        "edge of the cells in world units, whatever their number; 0 goes by the fraction",
    ),
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

pub(super) const FULL: &[OptionInfo] = &[levels(
    3,
    "how often every triangle is split that is not hidden",
)];

pub(super) const ADAPTIVE: &[OptionInfo] = &[
    levels(5, "how often a triangle may be split"),
    number(
        "threshold",
        0.001,
        [0.0, 1.0],
        "edge error from which a triangle is split: sin²(δ/2) of the angle δ by which the mirror's normal at the middle misses; 0 splits all, 1 none",
    ),
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
pub(super) const CUBE_MAPS: &[OptionInfo] = &[
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

pub(super) const RAY_TRACE: &[OptionInfo] = &[
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

pub(super) const ENVIRONMENT_MAP: &[OptionInfo] = &[words(
    "placement",
    &["center", "scene"],
    "where the map is taken from: the mirror's centre, or the first of its `cubemaps` in the scene file",
)];

pub(super) const CUBEMAP_TRACE: &[OptionInfo] = &[
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
        "which sign changes count: those where the map is continuous, of a map that hides nothing before them if there is one (ours), or any, as published",
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
        [0.000_02, 0.5],
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

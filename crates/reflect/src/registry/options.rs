//! Techniques whose options are still read by key.

use super::{Read, Technique, introduced};
use crate::image_order::cubemaps::MapOptions;
use crate::image_order::{Keyed, cubemap_trace};
use crate::options::{OptionInfo, Options, Settled, Values};
use crate::stage::options::StageOptions;
use crate::technique::{Family, Info, Properties, TechniqueInfo};

const fn keyed(
    name: &'static str,
    what: &'static str,
    paper: &'static str,
    options: &'static [&'static [OptionInfo]],
    keyed: Keyed,
    properties: fn(&mut Settled<'_>) -> Properties,
) -> Technique {
    Technique {
        info: TechniqueInfo {
            options: [options, StageOptions::TABLE],
            properties,
            ..introduced(Info { name, what, paper }, Family::ImageOrder)
        },
        read: Read::Keyed(keyed),
    }
}

pub(super) const CUBEMAP_TRACE: Technique = keyed(
    "cubemap-trace",
    "reflected rays marched through a few cube maps of distance",
    "Číž 2017",
    &[CUBEMAP_TRACE_OPTIONS, MapOptions::OWN],
    Keyed {
        make: cubemap_trace::make,
        objection: cubemap_trace::objection,
        properties: UNRESOLVED,
    },
    |_| UNRESOLVED,
);

const UNRESOLVED: Properties = Properties {
    may_be_unresolved: true,
    ..Properties::NONE
};

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

const CUBEMAP_TRACE_OPTIONS: &[OptionInfo] = &[
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

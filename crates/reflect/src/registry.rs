//! Every technique, in one table: adding one adds an entry here and its options to `options.rs`.

mod options;

use std::fmt;

use catoptric_scene::Scene;

use crate::spec::Options;
use crate::{image_order, refine, search};
use options::{
    ADAPTIVE, CUBE_MAPS, CUBEMAP_TRACE, ENVIRONMENT_MAP, EVERY, FULL, GRID, LINEAR, NEWTON,
    RAY_HIERARCHY, RAY_TRACE, REFLECTOR_CUBEMAP, SEARCH,
};

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

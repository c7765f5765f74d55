//! Every technique, in one table: adding one adds a line here.

/// What `catoptric list techniques` shows of a technique.
#[derive(Clone, Copy, Debug)]
pub struct TechniqueInfo {
    /// As written on the command line; refinements start with `+`.
    pub name: &'static str,
    /// A sentence.
    pub what: &'static str,
    /// `search`, `refinement` or `image order`.
    pub family: &'static str,
    /// Where it was published.
    pub paper: &'static str,
    /// Options, in display order.
    pub options: &'static [OptionInfo],
    /// Why it cannot be used yet; `None` if it can.
    pub reason: Option<&'static str>,
}

/// One option of a technique.
#[derive(Clone, Copy, Debug)]
pub struct OptionInfo {
    /// Key.
    pub name: &'static str,
    /// Values it takes, the default first.
    pub values: &'static [&'static str],
    /// A sentence.
    pub what: &'static str,
}

const fn option(
    name: &'static str,
    values: &'static [&'static str],
    what: &'static str,
) -> OptionInfo {
    OptionInfo { name, values, what }
}

const LINEAR: &[OptionInfo] = &[
    option(
        "start",
        &["center", "bounds", "previous"],
        "where the walk starts: the mirror's projected centre, its projected bounding box's, or the previous frame's answer",
    ),
    option(
        "neighbours",
        &["4", "8"],
        "texels compared with in each step",
    ),
    option(
        "residual",
        &["dot", "cross"],
        "the measure of a texel's fitness",
    ),
    option(
        "depth",
        &["thesis", "virtual"],
        "what the virtual triangles are depth-tested by",
    ),
    option(
        "hidden",
        &["drop"],
        "what becomes of triangles with a hidden vertex",
    ),
    option(
        "gbuffer",
        &["exact", "mesh"],
        "mirror points by analytic intersection, or of the drawn triangles",
    ),
    option(
        "under",
        &["background", "dark"],
        "what a mirror shows where no reflection is drawn",
    ),
];

const fn later(
    name: &'static str,
    what: &'static str,
    family: &'static str,
    paper: &'static str,
) -> TechniqueInfo {
    TechniqueInfo {
        name,
        what,
        family,
        paper,
        options: &[],
        reason: Some("not built yet"),
    }
}

/// All techniques, those not built yet included.
pub const TECHNIQUES: &[TechniqueInfo] = &[
    TechniqueInfo {
        name: "linear",
        what: "linear screen-space search",
        family: "search",
        paper: "Szabo 2013",
        options: LINEAR,
        reason: None,
    },
    later(
        "ray-hierarchy",
        "cone and sphere pyramid over the reflected rays",
        "search",
        "Szabo 2013",
    ),
    later(
        "reflector-cubemap",
        "midpoint search in cube maps of the mirror",
        "search",
        "Estalella et al. 2005",
    ),
    later(
        "newton",
        "Newton's method on the G-buffer, sub-pixel",
        "search",
        "this project",
    ),
    later(
        "swept-boxes",
        "watertight pyramid, all solutions",
        "search",
        "this project",
    ),
    later("+full", "splits every triangle", "refinement", "Szabo 2013"),
    later(
        "+adaptive",
        "splits where the edge error is large",
        "refinement",
        "Szabo 2013",
    ),
    later(
        "+grid",
        "interpolates most vertices from a grid",
        "refinement",
        "Estalella et al. 2005",
    ),
    later(
        "+pixel",
        "crack-free, error in pixels",
        "refinement",
        "this project",
    ),
    later(
        "+exact",
        "ray-triangle test a fragment",
        "refinement",
        "this project",
    ),
    later(
        "environment-map",
        "one cube map from the mirror's centre",
        "image order",
        "baseline",
    ),
    later(
        "planar",
        "mirrored viewpoint, flat mirrors",
        "image order",
        "baseline",
    ),
    later(
        "cubemap-trace",
        "rays marched through cube maps of distance",
        "image order",
        "Číž 2017",
    ),
    later(
        "ray-trace",
        "the reference's rays on the GPU",
        "image order",
        "control",
    ),
];

/// All techniques, for listing.
pub fn list() -> &'static [TechniqueInfo] {
    TECHNIQUES
}

//! What the paper of 2005 says, and what is asked of the constants that it leaves open.

use crate::suites::claims::make::{claim, difference, greatest_step, grows, ratio, value};
use crate::suites::claims::{
    Case, Claim, EVERY, Interval, Limit, Measure, Noise, Numbers, Paper, Place, Rule, Shown, Term,
    Which, at, each, last, of,
};
use crate::suites::paths::{
    AGREEMENT, EVALUATIONS, EXTRA, FLIP, FRAME_MS, JITTER_P99, JUMPS, MEAN_PX, MEDIAN_PX, MISSING,
    SEARCH_MS, SEARCHED, STEPS,
};

const V05: Paper = Paper::Estalella2005;

const RIGHT: Term = Term::Path(AGREEMENT);
const ROUNDING: Noise = Noise::Plus(0.001);
const HUNDREDTH: &str =
    "one mirror pixel in a hundred is what can be told; one in a thousand may round either way.";

/// Series of the pictures.
pub const PICTURES: &str = "pictures";
/// Of the path.
pub const PATH: &str = "path";

/// Fig. 6: every vertex, a grid, an environment map.
pub const METHODS: &[Claim] = &[
    claim(
        V05,
        "7, 8",
        "An environment map, even one made in every frame, is simply too inexact for what is near.",
        difference(
            at(PICTURES, 0.0),
            at(PICTURES, 2.0),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        "the share of right mirror pixels that the search has more: one in a hundred can be told.",
    ),
    claim(
        V05,
        "7, Fig. 6",
        "Interpolating from a grid of a tenth of the vertices removes errors of searching them all.",
        Rule {
            shown: Shown::In("FLIP"),
            ..difference(
                at(PICTURES, 0.0),
                at(PICTURES, 1.0),
                Term::Path(FLIP),
                Limit::Above(0.0),
                ROUNDING,
            )
        },
        "mean FLIP against the truth with all vertices less that with the grid: above 0 the grid is nearer.",
    ),
    claim(
        V05,
        "7",
        "The grid makes a much faster frame.",
        ratio(
            at(PICTURES, 1.0),
            at(PICTURES, 0.0),
            FRAME,
            Limit::Below(0.5),
            Noise::Clock,
        ),
        "the paper prints 0.13 of the time, where searches were nearly all of a frame; half is much faster.",
    ),
    claim(
        V05,
        "5",
        "The grid spares most of the search.",
        ratio(
            at(PICTURES, 1.0),
            at(PICTURES, 0.0),
            Term::Path(SEARCH_MS),
            Limit::Below(0.5),
            Noise::Clock,
        ),
        "the time of the search passes with the grid over that without.",
    ),
];

const FRAME: Term = Term::Path(FRAME_MS);

/// Fig. 7: densities of the grid.
pub const DENSITY: &[Claim] = &[
    claim(
        V05,
        "7, Fig. 7",
        "Above a tenth of the vertices the difference is not noticed: the same objects.",
        difference(
            of(Which::Ending(" steps"), Place::At(100.0)),
            of(Which::Ending(" steps"), Place::At(14.3)),
            RIGHT,
            Limit::Below(0.01),
            ROUNDING,
        ),
        "the share of right mirror pixels that all vertices have more than 14.3 % of them: one in a hundred \
         can be told.",
    ),
    claim(
        V05,
        "7, Fig. 7",
        "Above a tenth of the vertices the difference is not noticed: the same colours.",
        Rule {
            shown: Shown::In("FLIP"),
            ..difference(
                of(Which::Ending(" steps"), Place::At(14.3)),
                of(Which::Ending(" steps"), Place::At(100.0)),
                Term::Path(FLIP),
                Limit::Below(0.01),
                ROUNDING,
            )
        },
        "mean FLIP against the truth with 14.3 % less that with all: 0.01 is what can be told.",
    ),
    claim(
        V05,
        "7, Fig. 7",
        "A denser grid makes a slower frame.",
        ratio(
            of(Which::Ending(" steps"), Place::At(14.3)),
            of(Which::Ending(" steps"), Place::At(4.1)),
            FRAME,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "14.3 % over 4.1 %, where the paper prints 2.0 times.",
    ),
];

/// Fig. 8: numbers of steps.
pub const ITERATIONS: &[Claim] = &[
    claim(
        V05,
        "Fig. 8",
        "More than nine steps bring nothing to see.",
        difference(
            at("kitchen", 25.0),
            at("kitchen", 9.0),
            RIGHT,
            Limit::Below(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
    claim(
        V05,
        "Fig. 8",
        "Three steps are too few.",
        difference(
            at("kitchen", 9.0),
            at("kitchen", 3.0),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
    claim(
        V05,
        "4.2",
        "The search converges: more steps leave smaller errors.",
        greatest_step(
            EVERY,
            Term::Path(MEDIAN_PX),
            Limit::Below(1.0),
            Noise::Share(0.02),
        ),
        "the median offset from one number of steps to the next, at its worst.",
    ),
    claim(
        V05,
        "4.3",
        "A step takes two looks into the maps.",
        Rule {
            of: Measure::Own(looks, &[EVALUATIONS, STEPS]),
            is: Limit::Between(1.8, 2.2),
            noise: Noise::Exact,
            shown: Shown::In("looks"),
        },
        "evaluations that 25 steps take more than 9, over the steps that they take more, counted: what a search \
         looks at before its first step falls out.",
    ),
];

/// Looks for each further step.
fn looks(from: &dyn Numbers) -> Vec<Case> {
    let more = |path| Some(from.at("sphere", 25.0, path)? - from.at("sphere", 9.0, path)?);
    let steps = more(STEPS).filter(|steps| *steps > 0.0);
    let looks = more(EVALUATIONS).zip(steps);
    let case = |(looks, steps): (f64, f64)| Case {
        label: String::new(),
        number: Interval::exact(looks / steps),
    };
    looks.map(case).into_iter().collect()
}

/// Hidden vertices.
pub const SILHOUETTE: &[Claim] = &[
    claim(
        V05,
        "6.1",
        "Continuing hidden vertices fills what dropping their triangles leaves open.",
        difference(
            of(EVERY, Place::At(0.0)),
            of(EVERY, Place::At(1.0)),
            Term::Path(MISSING),
            Limit::Above(0.0),
            Noise::Plus(0.0005),
        ),
        "the share of mirror pixels that miss an object, dropped less continued.",
    ),
    claim(
        V05,
        "6.1",
        "Continuing hidden vertices does not draw too much.",
        difference(
            of(EVERY, Place::At(1.0)),
            of(EVERY, Place::At(0.0)),
            Term::Path(EXTRA),
            Limit::Below(0.01),
            Noise::Plus(0.0005),
        ),
        "the share of mirror pixels with an object too many, continued less dropped: one in a hundred.",
    ),
];

/// Places of the same number of steps, without and with a grid.
const PAIRS: [(&str, f64, f64); 3] = [
    ("5 steps", 1.0, 4.0),
    ("9 steps", 2.0, 5.0),
    ("25 steps", 3.0, 6.0),
];

/// Cells by the ratio of their edge to the distance, in meshes of more and more vertices.
pub const EDGES: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "The cells' edge against the distance counts, and not their share of the vertices.",
        ratio(
            each("300 vertices"),
            each("3k vertices"),
            Term::Path(MEAN_PX),
            Limit::Between(0.8, 1.25),
            Noise::Share(0.05),
        ),
        "the mean offset in the same cells with a tenth of the vertices, over that with all: a quarter more or \
         less counts as the same.",
    ),
    claim(
        Paper::Ours,
        "",
        "The offset grows with the square of the cells' edge.",
        grows(EVERY, Term::Path(MEAN_PX), Limit::Between(1.5, 2.5)),
        "the power of the edge: interpolation misses by the curvature times the square of the edge.",
    ),
];

/// Series of published grids.
pub const PUBLISHED: &str = "published grid";
/// Of trees of cells.
pub const TREE: &str = "octree";
/// Without a grid.
pub const ALL: &str = "all vertices";

/// Trees of cells beside published grids.
pub const TREES: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "At its best a tree shows more than any published grid here.",
        difference(
            of(Which::Named(TREE), Place::Most),
            of(Which::Named(PUBLISHED), Place::Most),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
    claim(
        Paper::Ours,
        "",
        "The finest tree takes less than half of the searches of all vertices.",
        ratio(
            of(Which::Named(TREE), Place::Most),
            of(Which::Named(ALL), Place::Most),
            Term::Path(SEARCHED),
            Limit::Below(0.5),
            Noise::Exact,
        ),
        "below a half interpolation pays wherever searching costs more than interpolating.",
    ),
];

/// Sweeps of the maps, by the number of segments or of texels.
pub const MAPS: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "The maps' error falls with the square of the number.",
        grows(
            Which::Ending(SETTLED),
            Term::Path(MEDIAN_PX),
            Limit::Between(-2.3, -1.7),
        ),
        "the power of the number by which the median error goes once the search has settled: linear \
         interpolation of a smooth surface gives -2.",
    ),
    claim(
        V05,
        "4.1",
        "Maps that are fine enough leave the error to the steps.",
        ratio(
            last("ellipsoid, settled"),
            last("ellipsoid, 9 steps"),
            Term::Path(MEDIAN_PX),
            Limit::Below(0.5),
            Noise::Share(0.05),
        ),
        "the error that the finest maps leave over that of nine steps with them: below a half the steps decide.",
    ),
];

/// Ending of the series of maps in which the search has settled.
pub const SETTLED: &str = ", settled";

/// The two projections of the bisector.
pub const PROJECTION: &[Claim] = &[claim(
    Paper::Ours,
    "",
    "The derivative of the projection does as well as the published difference on the cube's face.",
    ratio(
        of(Which::Ending(", ours"), Place::At(9.0)),
        of(Which::Ending(", published"), Place::At(9.0)),
        Term::Path(MEDIAN_PX),
        Limit::Below(1.1),
        Noise::Share(0.05),
    ),
    "the median error after nine steps, ours over published: one in ten more is a difference.",
)];

/// Flicker.
pub const STEADINESS: &[Claim] = &[
    claim(
        V05,
        "5",
        "A fixed number of steps flickers.",
        value(
            at(PATH, 1.0),
            Term::Path(JUMPS),
            Limit::Above(0.001),
            Noise::Plus(0.0002),
            Shown::Percent,
        ),
        "changes above 2 px from frame to frame with five steps: one vertex in a thousand is seen as flicker.",
    ),
    claim(
        V05,
        "5",
        "A grid of a tenth of the vertices removes the flicker.",
        Rule {
            of: Measure::Own(left, &[JITTER_P99]),
            is: Limit::Below(0.1),
            noise: Noise::Share(0.05),
            shown: Shown::Times,
        },
        "what one change in a hundred exceeds, with the grid over without: what is removed leaves less than \
         a tenth, not only less.",
    ),
    claim(
        V05,
        "5",
        "In the kitchen, too, the grid removes the flicker.",
        ratio(
            at("kitchen", 5.0),
            at("kitchen", 2.0),
            Term::Path(JITTER_P99),
            Limit::Below(0.1),
            Noise::Share(0.05),
        ),
        "the same for nine steps in the scene of the paper.",
    ),
];

/// What the grid leaves of the tail of the jitter.
fn left(from: &dyn Numbers) -> Vec<Case> {
    let cases = PAIRS.into_iter().filter_map(|(label, alone, grid)| {
        let read = |x| Term::Path(JITTER_P99).read(from, PATH, x, Noise::Share(0.05));
        Some(Case {
            label: label.to_owned(),
            number: read(grid)?.over(read(alone)?)?,
        })
    });
    cases.collect()
}

/// Cells of the grid.
pub const CELLS: &[Claim] = &[claim(
    Paper::Ours,
    "",
    "The error of interpolation grows as the square of a cell's edge.",
    grows(
        Which::Named("grid"),
        Term::Path(MEDIAN_PX),
        Limit::Between(1.7, 2.3),
    ),
    "interpolation that is exact to first order gives 2 where cells are small against the mirror and their \
     distance from it.",
)];

/// Constants of the step: places are those of the defaults.
pub const FIRST_STEP: &[Claim] = &[constant(0.5)];
pub const SHRINK: &[Claim] = &[constant(0.6)];
pub const GROW: &[Claim] = &[constant(1.25)];

const fn constant(chosen: f64) -> Claim {
    claim(
        Paper::Ours,
        "",
        "The value that is used here is about the best.",
        ratio(
            of(EVERY, Place::At(chosen)),
            of(EVERY, Place::Least),
            Term::Path(MEDIAN_PX),
            Limit::Below(1.5),
            Noise::Share(0.02),
        ),
        "its median offset over the least in the sweep: half again is about the best.",
    )
}

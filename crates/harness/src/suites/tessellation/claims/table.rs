//! A laid table: object by object, thresholds, numbers of triangles, facets.

use crate::suites::claims::make::{claim, difference, greatest_step, ratio, value};
use crate::suites::claims::{
    Claim, Limit, Noise, Paper, Place, Shown, Term, Which, at, first, last, of,
};
use crate::suites::paths::{CRACK_PIXELS, DRAWN};
use crate::suites::tessellation::data::{ADAPTIVE, FULL, NONE};
use crate::suites::tessellation::labels::{COARSE, FINE, FOUR, SEARCH};

use super::{
    C13, COUNTED, FASTER, FRAME, HALF, HUNDREDTH, OFF, RIGHT, ROUNDING, SEARCHES, T13, TRIANGLES,
    alike, edges_alike,
};

const GROWN: Term = Term::Quotient(DRAWN, "triangles.in");

/// CESCG Fig. 7.
pub const TABLE: &[Claim] = &[
    claim(
        C13,
        "5.1, Fig. 7",
        "Without tessellation the reflection of coarse models is visibly wrong.",
        difference(
            at(SEARCH, 2.0),
            at(SEARCH, 0.0),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
    claim(
        C13,
        "5.1, Fig. 7",
        "Adaptive tessellation looks as if all were fully tessellated: the same objects.",
        alike(at(SEARCH, 1.0), at(SEARCH, 2.0)),
        HUNDREDTH,
    ),
    claim(
        C13,
        "5.1, Fig. 7",
        "Adaptive tessellation looks as if all were fully tessellated: the same edges.",
        edges_alike(at(SEARCH, 1.0), at(SEARCH, 2.0)),
        HALF,
    ),
    claim(
        C13,
        "5.2, 6",
        "Adaptive tessellation makes a faster frame than full tessellation.",
        ratio(
            at(SEARCH, 1.0),
            at(SEARCH, 2.0),
            FRAME,
            Limit::Below(1.0),
            Noise::Clock,
        ),
        FASTER,
    ),
];

/// CESCG Fig. 7, object by object.
pub const OBJECTS: &[Claim] = &[
    claim(
        C13,
        "5.1, Fig. 7",
        "Objects that are modelled finely are left as they are.",
        value(
            of(Which::Named(FINE), Place::Each),
            GROWN,
            Limit::Below(1.1),
            Noise::Exact,
            Shown::Times,
        ),
        "triangles of each object after tessellation over those before: a tenth more is nearly none.",
    ),
    claim(
        C13,
        "5.1, Fig. 7",
        "Objects that are modelled coarsely are split.",
        value(
            of(Which::Named(COARSE), Place::Each),
            GROWN,
            Limit::Above(2.0),
            Noise::Exact,
            Shown::Times,
        ),
        "triangles of each object after tessellation over those before.",
    ),
];

/// CESCG Fig. 8; places are those of the thresholds.
pub const THRESHOLDS: &[Claim] = &[
    claim(
        C13,
        "5.2",
        "A threshold of 0.1 is too high.",
        difference(
            at(ADAPTIVE, 7.0),
            at(ADAPTIVE, 1.0),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        "the share of right mirror pixels that full tessellation has more: one in a hundred can be told.",
    ),
    claim(
        C13,
        "5.2",
        "A threshold of 0.01 is perfectly acceptable: the objects are right.",
        difference(
            at(ADAPTIVE, 7.0),
            at(ADAPTIVE, 3.0),
            RIGHT,
            Limit::Below(0.01),
            ROUNDING,
        ),
        "the share of right mirror pixels that full tessellation has more: one in a hundred can be told.",
    ),
    claim(
        C13,
        "5.2",
        "A threshold of 0.01 is perfectly acceptable: there are no gaps.",
        value(
            at(ADAPTIVE, 3.0),
            Term::Path(CRACK_PIXELS),
            Limit::Between(0.0, 0.0),
            Noise::Exact,
            Shown::In("pixels in cracks"),
        ),
        COUNTED,
    ),
    claim(
        C13,
        "5.1, 5.2",
        "The threshold trades time for exactness: the smallest takes longer than the largest.",
        ratio(
            last(ADAPTIVE),
            first(ADAPTIVE),
            FRAME,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "above 1 it takes longer.",
    ),
    claim(
        C13,
        "5.1",
        "The error that it limits is that in the picture: a smaller threshold leaves smaller errors at the edges.",
        greatest_step(
            Which::Named(ADAPTIVE),
            OFF,
            Limit::Below(1.05),
            Noise::Share(0.02),
        ),
        "the mean offset of edges from one threshold to the next smaller one, at its worst; a twentieth more \
         is scatter.",
    ),
    claim(
        C13,
        "5.2",
        "Near 0 the technique is no longer interactive.",
        ratio(
            last(ADAPTIVE),
            at(ADAPTIVE, 3.0),
            FRAME,
            Limit::Above(4.0),
            Noise::Clock,
        ),
        "a frame's time at 0 over that at 0.01: what ran at 40 frames a second then runs at 10.",
    ),
    claim(
        C13,
        "5.2",
        "A threshold of 1 is no tessellation.",
        value(
            first(ADAPTIVE),
            GROWN,
            Limit::Between(1.0, 1.0),
            Noise::Exact,
            Shown::Times,
        ),
        "triangles after over those before, counted.",
    ),
];

/// CESCG Fig. 9.
pub const COUNTS: &[Claim] = &[
    claim(
        C13,
        "5.2, Fig. 9",
        "Adaptive tessellation makes fewer vertices than full tessellation.",
        ratio(
            last(ADAPTIVE),
            last(FULL),
            TRIANGLES,
            Limit::Below(1.0),
            Noise::Exact,
        ),
        "triangles, of three vertices each, are counted.",
    ),
    claim(
        C13,
        "5.2, Fig. 9",
        "Adaptive tessellation needs fewer searches than full tessellation.",
        ratio(
            last(ADAPTIVE),
            last(FULL),
            SEARCHES,
            Limit::Below(1.0),
            Noise::Exact,
        ),
        "searches are counted.",
    ),
    claim(
        T13,
        "6.2, 7.2",
        "Adaptive tessellation makes pictures much better than none.",
        difference(
            last(ADAPTIVE),
            last(NONE),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        "the share of right mirror pixels that it adds to no tessellation: one in a hundred can be told.",
    ),
];

/// CESCG Fig. 10b.
pub const FACETS: &[Claim] = &[
    claim(
        C13,
        "5.3, Fig. 10b",
        "On a mirror of facets, where a vertex has several reflection points or none, the search fails.",
        value(
            at(FOUR, 0.0),
            RIGHT,
            Limit::Below(0.9),
            ROUNDING,
            Shown::Percent,
        ),
        "one mirror pixel in ten wrong is a failure.",
    ),
    claim(
        Paper::Ours,
        "",
        "On a mirror of facets splitting the triangles helps.",
        difference(
            at(FOUR, 1.0),
            at(FOUR, 0.0),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
];

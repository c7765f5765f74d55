//! One square: how far it is split, what shows, and where it cracks.

use crate::suites::claims::make::{claim, difference, pixels, ratio, value};
use crate::suites::claims::{
    Case, Claim, Limit, Measure, Noise, Numbers, Paper, Place, Rule, Shown, Term, Which, at, last,
    of,
};
use crate::suites::paths::{
    ANGLE, CRACK_PIXELS, FLIP, FLOOR, FRAME_MS, JUNCTIONS, MOVING_MS, REFINE_MS, SEARCHED,
    STILL_MS, UNFINISHED, WIDEST,
};
use crate::suites::tessellation::by_pixels;
use crate::suites::tessellation::data::{ADAPTIVE, FULL};
use crate::suites::tessellation::labels::{
    ELLIPSOID, HIDDEN, HIERARCHY_ADAPTIVE, HIERARCHY_FULL, LARGE_MIRROR, MOTION, SEARCH,
    SMALL_MIRROR, SPHERE, THOUSANDTH, TO_FIVE,
};

use super::{
    C13, COUNTED, EDGE_NOISE, FASTER, FRAME, HALF, HUNDREDTH, OFF, ROUNDING, SEARCHES, T13,
    TRIANGLES, alike, edges_alike,
};

/// Gaps of any width: wide ones count as holes.
const GAPS: Term = Term::Sum(&[CRACK_PIXELS, "coverage.holes"]);
const MOVING: Term = Term::Quotient(MOVING_MS, STILL_MS);

/// Thesis Fig. 1.5, CESCG Fig. 1.
pub const STRAIGHT: &[Claim] = &[
    claim(
        T13,
        "Fig. 1.5",
        "A square by the reflections of its corners has its edges in the wrong places.",
        value(
            at(SEARCH, 0.0),
            OFF,
            Limit::Above(1.0),
            EDGE_NOISE,
            Shown::In("px"),
        ),
        "a pixel of mean offset is seen by anyone.",
    ),
    claim(
        Paper::Estalella2005,
        "8",
        "Edges of large polygons are reflected wrongly, since only their ends are.",
        value(
            at(SEARCH, 0.0),
            OFF,
            Limit::Above(1.0),
            EDGE_NOISE,
            Shown::In("px"),
        ),
        "a pixel of mean offset is seen by anyone; the search of this paper has the same edges between its ends.",
    ),
    claim(
        C13,
        "Fig. 1",
        "A square that is split often enough has its edges in the right places.",
        value(
            at(SEARCH, 1.0),
            OFF,
            Limit::Below(1.0),
            EDGE_NOISE,
            Shown::In("px"),
        ),
        "less than a pixel of mean offset is as near as whole pixels allow.",
    ),
];

/// Thesis Fig. 6.3.
pub const LEVELS: &[Claim] = &[
    claim(
        T13,
        "6.2",
        "With a threshold of 0.001 no triangle is split more than twice, whatever the limit.",
        value(
            at(ADAPTIVE, 2.0),
            Term::Path(UNFINISHED),
            Limit::Between(0.0, 0.0),
            Noise::Exact,
            Shown::In("triangles"),
        ),
        "the triangles that at a limit of two would be split further, counted.",
    ),
    claim(
        Paper::Ours,
        "",
        "Where the mirror hides a part of the square the same threshold splits more than twice.",
        value(
            at(HIDDEN, 2.0),
            Term::Path(UNFINISHED),
            Limit::Above(0.5),
            Noise::Exact,
            Shown::In("triangles"),
        ),
        "the triangles that at a limit of two would be split further, counted.",
    ),
    claim(
        T13,
        "5.2, 6.2",
        "At three levels adaptive tessellation makes a faster frame than full tessellation.",
        ratio(
            at(ADAPTIVE, 3.0),
            at(FULL, 3.0),
            FRAME,
            Limit::Below(1.0),
            Noise::Clock,
        ),
        FASTER,
    ),
    claim(
        T13,
        "6.2",
        "At a high limit the cost of adaptive tessellation is much lower than that of full tessellation.",
        ratio(
            last(ADAPTIVE),
            last(FULL),
            FRAME,
            Limit::Below(0.5),
            Noise::Clock,
        ),
        "half is much lower.",
    ),
    claim(
        T13,
        "6.2",
        "A limit above two leads to no more searches.",
        ratio(
            last(ADAPTIVE),
            at(ADAPTIVE, 2.0),
            SEARCHES,
            Limit::Between(1.0, 1.05),
            Noise::Exact,
        ),
        "searches are counted; a twentieth more is not worth a word.",
    ),
    claim(
        T13,
        "6.2",
        "The picture is practically that of full tessellation: the same objects.",
        alike(last(ADAPTIVE), last(FULL)),
        HUNDREDTH,
    ),
    claim(
        T13,
        "6.2",
        "The picture is practically that of full tessellation: the same edges.",
        edges_alike(last(ADAPTIVE), last(FULL)),
        HALF,
    ),
    claim(
        T13,
        "5.2",
        "To compute the error costs next to nothing.",
        value(
            at(ADAPTIVE, 2.0),
            Term::Quotient(REFINE_MS, FRAME_MS),
            Limit::Below(0.05),
            Noise::Clock,
            Shown::Percent,
        ),
        "the share of a frame that goes into the pass that computes errors and splits: a twentieth.",
    ),
    claim(
        Paper::Ours,
        "",
        "Full tessellation comes as near to the truth as answers in whole pixels allow.",
        value(
            of(Which::Named(FULL), Place::Least),
            Term::Quotient(ANGLE, FLOOR),
            Limit::Below(1.1),
            Noise::Share(0.02),
            Shown::Times,
        ),
        "the median angular error over the median angle between a pixel's centre and the rest of it; a \
         tenth more is at that floor.",
    ),
];

/// Thesis Fig. 5.3 and 5.4.
pub const WIREFRAMES: &[Claim] = &[
    claim(
        T13,
        "5.2",
        "Full and adaptive tessellation are of like quality: the same objects.",
        alike(at(SEARCH, 2.0), at(SEARCH, 1.0)),
        HUNDREDTH,
    ),
    claim(
        T13,
        "5.2",
        "Full and adaptive tessellation are of like quality: the same edges.",
        edges_alike(at(SEARCH, 2.0), at(SEARCH, 1.0)),
        HALF,
    ),
    claim(
        T13,
        "5.2, 7.2",
        "A large number of triangles is spared.",
        ratio(
            at(SEARCH, 2.0),
            at(SEARCH, 1.0),
            TRIANGLES,
            Limit::Below(0.5),
            Noise::Exact,
        ),
        "triangles are counted: half is a large number.",
    ),
];

/// Thesis Fig. 6.4.
pub const VISIBLE: &[Claim] = &[
    claim(
        T13,
        "Fig. 6.4",
        "After level 3 there is almost nothing to see: the same objects.",
        alike(at(FULL, 3.0), at(FULL, 2.0)),
        HUNDREDTH,
    ),
    claim(
        T13,
        "Fig. 6.4",
        "After level 3 there is almost nothing to see: the same edges.",
        edges_alike(at(FULL, 3.0), at(FULL, 2.0)),
        HALF,
    ),
    claim(
        T13,
        "Fig. 6.4",
        "After level 3 there is almost nothing to see: the same colours.",
        Rule {
            shown: Shown::In("FLIP"),
            ..difference(
                at(FULL, 3.0),
                at(FULL, 2.0),
                Term::Path(FLIP),
                Limit::Between(-0.01, 0.01),
                ROUNDING,
            )
        },
        "mean FLIP against the truth of the one less that of the other: 0.01 is what can be told.",
    ),
];

/// Thesis Fig. 6.5, CESCG Fig. 10a.
pub const CRACK: &[Claim] = &[
    claim(
        T13,
        "6.2, Fig. 6.5",
        "Gaps open where a split triangle meets one that is not split.",
        value(
            at(TO_FIVE, 3.0),
            GAPS,
            Limit::Above(0.5),
            Noise::Exact,
            Shown::In("pixels"),
        ),
        "pixels in cracks, and gaps too wide to be cracks, counted at the threshold of the thesis.",
    ),
    claim(
        Paper::Ours,
        "",
        "Full tessellation, which splits all alike, leaves no T-junction.",
        value(
            at(TO_FIVE, 5.0),
            Term::Path(JUNCTIONS),
            Limit::Between(0.0, 0.0),
            Noise::Exact,
            Shown::In("T-junctions"),
        ),
        COUNTED,
    ),
    by_pixels::WHOLE,
    claim(
        C13,
        "5.3",
        "The threshold controls how wide the gaps are.",
        pixels(
            at(TO_FIVE, 4.0),
            of(Which::Named(TO_FIVE), Place::Most),
            Term::Path(WIDEST),
            Limit::Below(-0.5),
            Noise::Exact,
        ),
        "the widest crack at a threshold of 0.0001 less the widest at any: at least a pixel narrower.",
    ),
];

/// Both refinements under both searches.
pub const HIERARCHY: &[Claim] = &[
    claim(
        T13,
        "6.2",
        "Full and adaptive tessellation relate alike under both searches: by time.",
        Rule {
            of: Measure::Own(relation_by_time, &[FRAME_MS]),
            is: Limit::Between(0.8, 1.25),
            noise: Noise::Clock,
            shown: Shown::Times,
        },
        "full's frame over adaptive's under the hierarchy, over the same under the linear search, at the \
         highest limit; a quarter is about the same.",
    ),
    claim(
        T13,
        "6.2",
        "Full and adaptive tessellation relate alike under both searches: by searches.",
        Rule {
            of: Measure::Own(relation_by_searches, &[SEARCHED]),
            is: Limit::Between(0.8, 1.25),
            noise: Noise::Share(0.01),
            shown: Shown::Times,
        },
        "searches of full over those of adaptive under the hierarchy, over the same under the linear search.",
    ),
];

fn relation_by_time(from: &dyn Numbers) -> Vec<Case> {
    relation(from, FRAME, Noise::Clock)
}

fn relation_by_searches(from: &dyn Numbers) -> Vec<Case> {
    relation(from, SEARCHES, Noise::Share(0.01))
}

fn relation(from: &dyn Numbers, term: Term, noise: Noise) -> Vec<Case> {
    let number = || {
        let x = *from.places(HIERARCHY_FULL).last()?;
        let read = |series| term.read(from, series, x, noise);
        let hierarchy = read(HIERARCHY_FULL)?.over(read(HIERARCHY_ADAPTIVE)?)?;
        hierarchy.over(read(FULL)?.over(read(ADAPTIVE)?)?)
    };
    let case = |number| Case {
        label: String::new(),
        number,
    };
    number().map(case).into_iter().collect()
}

/// A sphere and an ellipsoid, threshold by threshold.
pub const REFLECTORS: &[Claim] = &[
    claim(
        T13,
        "5.1",
        "A strongly curved mirror has larger edge errors: at the same threshold more is split.",
        ratio(
            at(ELLIPSOID, THOUSANDTH),
            at(SPHERE, THOUSANDTH),
            TRIANGLES,
            Limit::Above(1.0),
            Noise::Exact,
        ),
        "triangles are counted, at a threshold of 0.001.",
    ),
    claim(
        T13,
        "6.2",
        "The right threshold depends on the mirror: the same one leaves other errors.",
        ratio(
            at(ELLIPSOID, THOUSANDTH),
            at(SPHERE, THOUSANDTH),
            OFF,
            Limit::Outside(0.5, 2.0),
            Noise::Share(0.1),
        ),
        "mean offset of edges at a threshold of 0.001, ellipsoid over sphere: up to twice is alike.",
    ),
];

/// A mirror near and far.
pub const SIZE: &[Claim] = &[
    by_pixels::SMALLER,
    claim(
        T13,
        "5.2, 6.2",
        "A mirror that is small in the picture is split as much as a large one, needlessly.",
        ratio(
            at(SMALL_MIRROR, 0.0),
            at(LARGE_MIRROR, 0.0),
            TRIANGLES,
            Limit::Between(0.8, 1.25),
            Noise::Exact,
        ),
        "triangles are counted: a quarter is about as many.",
    ),
];

/// A camera that moves.
pub const DYNAMIC: &[Claim] = &[
    by_pixels::UNBROKEN,
    by_pixels::WITHOUT_JUNCTIONS,
    claim(
        C13,
        "5.2",
        "Scenes that move cost adaptive tessellation nothing extra.",
        value(
            of(Which::Named(MOTION), Place::Each),
            MOVING,
            Limit::Below(1.25),
            Noise::Share(0.15),
            Shown::Times,
        ),
        "a moving frame's time over a still one's; less than a quarter is not told apart on a busy machine.",
    ),
];

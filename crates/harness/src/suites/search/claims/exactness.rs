//! How right and how steady the searches are, and the options of the hierarchy.

use crate::suites::claims::make::{
    claim, difference, greatest_step, least_step, pixels, ratio, value,
};
use crate::suites::claims::{
    Claim, EVERY, Limit, Measure, Noise, Paper, Place, Rule, Shown, Term, Which, at, each, first,
    last, of,
};
use crate::suites::paths::{
    AGREEMENT, ANGLE, FAILED, HOLES, JITTER_MEAN, JUMPS, MEAN_PX, MOVING_MS, MOVING_STEPS,
    NODE_TESTS, RECALL, REFLECTED, STILL_MS,
};
use crate::suites::search::data::{ENLARGED, LINEAR, RAW, STOPPED, WARM};
use crate::suites::search::labels::{
    ALL_REFLECTED, CONE, ENVIRONMENT, EXACT_LINEAR, EXACT_PLANAR, PARTLY_HIDDEN, SPHERE, STOP,
};

use super::T13;

const FAILS: Term = Term::Quotient(FAILED, REFLECTED);
const MEET_HOLES: Term = Term::Quotient(HOLES, REFLECTED);
const MOVING: Term = Term::Quotient(MOVING_MS, STILL_MS);

const RARE: &str = "one vertex in a hundred is a fault that a picture shows.";

/// Points with known reflection points.
pub const EXACTNESS: &[Claim] = &[
    claim(
        T13,
        "3.1",
        "The linear search ends in the pixel of the reflection point.",
        value(
            each(LINEAR),
            Term::Path(MEAN_PX),
            Limit::Below(0.5),
            Noise::Share(0.05),
            Shown::In("px"),
        ),
        "a pixel's centre is 0.38 px from a point in it in the mean, and 0.5 px allow for a neighbour now \
         and then.",
    ),
    claim(
        T13,
        "3.2",
        "On a concave mirror, where a vertex has several reflection points, the search misses some.",
        value(
            at(LINEAR, 2.0),
            Term::Path(RECALL),
            Limit::Below(0.95),
            Noise::Plus(0.01),
            Shown::Percent,
        ),
        "the share of true reflection points that are found: one in twenty missed is a hole in a picture.",
    ),
    claim(
        T13,
        "4.1, 4.2",
        "Vertices fall into holes between the cones.",
        value(
            each(RAW),
            MEET_HOLES,
            Limit::Above(0.01),
            Noise::Plus(0.002),
            Shown::Percent,
        ),
        RARE,
    ),
    claim(
        T13,
        "4.2",
        "Without a repair a search in a hole fails, and its answer is far off.",
        pixels(
            each(RAW),
            each(LINEAR),
            Term::Path(MEAN_PX),
            Limit::Above(1.0),
            Noise::Plus(0.1),
        ),
        "a pixel more of mean offset is what is seen as vertices that jump.",
    ),
    claim(
        T13,
        "4.2",
        "Enlargement does away with practically all failures.",
        value(
            each(ENLARGED),
            FAILS,
            Limit::Below(0.01),
            Noise::Plus(0.002),
            Shown::Percent,
        ),
        RARE,
    ),
    claim(
        T13,
        "4.2",
        "Enlargement brings errors of its own.",
        pixels(
            each(ENLARGED),
            each(LINEAR),
            Term::Path(MEAN_PX),
            Limit::Above(0.0),
            Noise::Plus(0.02),
        ),
        "its mean offset less that of the linear search; 0.02 px is the scatter of 3 000 points.",
    ),
    claim(
        T13,
        "4.2",
        "Stopping three levels early makes the reflection very erroneous.",
        value(
            each(STOPPED),
            Term::Path(MEAN_PX),
            Limit::Above(2.0),
            Noise::Share(0.05),
            Shown::In("px"),
        ),
        "two pixels are seen by anyone; a block of level 3 is eight pixels wide.",
    ),
];

/// Jitter, jumps, and the cost of a moving frame.
pub const MOTION: &[Claim] = &[
    claim(
        T13,
        "4.2",
        "Without a repair vertices of the hierarchy jump as the camera moves slowly.",
        difference(
            each(RAW),
            each(LINEAR),
            Term::Path(JUMPS),
            Limit::Above(0.001),
            Noise::Plus(0.0005),
        ),
        "changes above 2 px from frame to frame, beyond those of the linear search: one vertex in a \
         thousand is one a frame in a scene of a thousand.",
    ),
    claim(
        T13,
        "4.2",
        "Stopping early makes the reflection jitter.",
        ratio(
            each(STOPPED),
            each(LINEAR),
            Term::Path(JITTER_MEAN),
            Limit::Above(1.0),
            Noise::Share(0.1),
        ),
        "mean jitter against that of the linear search, whose answers are whole pixels; a tenth is scatter.",
    ),
    claim(
        T13,
        "2.3, 3.2",
        "A moving scene costs no more than a still one.",
        value(
            of(EVERY, Place::Each),
            MOVING,
            Limit::Below(1.25),
            Noise::Share(0.15),
            Shown::Times,
        ),
        "a moving frame's time over a still one's; less than a quarter is not told apart on a busy machine.",
    ),
    claim(
        T13,
        "6.1",
        "A small move of the camera leaves few steps to a walk from the previous frame's answer.",
        ratio(
            each(WARM),
            each(LINEAR),
            Term::Path(MOVING_STEPS),
            Limit::Below(0.25),
            Noise::Share(0.02),
        ),
        "steps against those of a cold walk: a quarter is few.",
    ),
];

/// Factors of the enlargement.
pub const FACTORS: &[Claim] = &[
    claim(
        T13,
        "4.2",
        "Larger factors make the search dearer.",
        Rule {
            of: Measure::Ratio(
                of(Which::Ending(FACTOR), Place::Last),
                of(Which::Ending(FACTOR), Place::First),
                Term::Path(NODE_TESTS),
            ),
            is: Limit::Above(1.0),
            noise: Noise::Share(0.01),
            shown: Shown::Times,
        },
        "node tests are counted, with the largest factor over the smallest.",
    ),
    claim(
        T13,
        "4.2",
        "With factors that are large enough practically no search fails.",
        value(
            of(Which::Ending(FACTOR), Place::Last),
            FAILS,
            Limit::Below(0.01),
            Noise::Plus(0.002),
            Shown::Percent,
        ),
        RARE,
    ),
    claim(
        T13,
        "4.2",
        "The factors 1.5 and 2 are good: practically no search fails with them.",
        value(
            at(SPHERE, 2.0),
            FAILS,
            Limit::Below(0.01),
            Noise::Plus(0.002),
            Shown::Percent,
        ),
        RARE,
    ),
    claim(
        T13,
        "4.2",
        "Larger factors bring more errors.",
        ratio(
            last(CONE),
            first(CONE),
            Term::Path(MEAN_PX),
            Limit::Above(1.0),
            Noise::Share(0.05),
        ),
        "mean offset with the largest cones over the smallest; a twentieth is the scatter of 3 000 points.",
    ),
];

/// What the series of both factors end with.
const FACTOR: &str = " factor";

/// Levels at which the descent stops.
pub const STOPS: &[Claim] = &[
    claim(
        T13,
        "4.3",
        "Each level that is left out displaces the reflection more.",
        least_step(
            Which::Named(STOP),
            Term::Path(MEAN_PX),
            Limit::Above(1.0),
            Noise::Share(0.02),
        ),
        "the least growth of the mean offset from level to level.",
    ),
    claim(
        T13,
        "4.3",
        "Each level that is left out makes the search cheaper.",
        greatest_step(
            Which::Named(STOP),
            Term::Path(NODE_TESTS),
            Limit::Below(1.0),
            Noise::Share(0.002),
        ),
        "node tests are counted, from level to level.",
    ),
    claim(
        T13,
        "4.2",
        "One level left out is not enough against holes.",
        value(
            at(STOP, 1.0),
            FAILS,
            Limit::Above(0.01),
            Noise::Plus(0.002),
            Shown::Percent,
        ),
        RARE,
    ),
];

/// Vertices hidden by the mirror.
pub const HIDDEN: &[Claim] = &[claim(
    T13,
    "6.1",
    "Hidden vertices cost the hierarchy unnecessary work: it cannot tell them from those in a hole.",
    ratio(
        each(PARTLY_HIDDEN),
        each(ALL_REFLECTED),
        Term::Path(NODE_TESTS),
        Limit::Above(1.0),
        Noise::Share(0.02),
    ),
    "node tests a search, with a part of the vertices hidden over none.",
)];

/// Fig. 1.1.
pub const NEAR: &[Claim] = &[
    claim(
        T13,
        "1.2, Fig. 1.1",
        "An environment map errs where objects are near the mirror or touch it; the search does not.",
        difference(
            each(EXACT_LINEAR),
            each(ENVIRONMENT),
            Term::Path(AGREEMENT),
            Limit::Above(0.01),
            Noise::Plus(0.002),
        ),
        "the search's share of mirror pixels with the right object less the map's: one in a hundred can be \
         told.",
    ),
    claim(
        Paper::SzaboCescg,
        "2, Fig. 2",
        "Where the map shows the right object it shows it in a wrong place.",
        ratio(
            each(ENVIRONMENT),
            each(EXACT_LINEAR),
            Term::Path(ANGLE),
            Limit::Above(2.0),
            Noise::Share(0.05),
        ),
        "the map's median angular error over the search's: twice is plain to see side by side.",
    ),
];

/// Fig. 3.2.
pub const EXAMPLES: &[Claim] = &[claim(
    T13,
    "3.2",
    "On a flat mirror the search is as good as the view from the mirrored eye.",
    difference(
        at(EXACT_LINEAR, 2.0),
        at(EXACT_PLANAR, 2.0),
        Term::Path(AGREEMENT),
        Limit::Between(-0.01, 0.01),
        Noise::Plus(0.001),
    ),
    "one mirror pixel in a hundred is what can be told.",
)];

//! Parameters one by one: Fig. 5.2 and 5.3, chapter 3.

use crate::suites::claims::make::{claim, difference, grows, ratio, value};
use crate::suites::claims::{
    Claim, EVERY, Limit, Measure, Noise, Paper, Place, Rule, Shown, Term, Which, each, of,
};
use crate::suites::cubemap::labels::{
    EIGHT, ENVIRONMENT, MAPPED, ONE, SWEPT, THREE, TRACED as TRACED_SCENES,
};
use crate::suites::paths::{FRAME_MS, MAPS_MS, PYRAMID_MS};

use super::{
    COUNTED, FRAME, LOOKED_UP, OPEN, RIGHT, RIGHT_IN_FULL, ROUNDING, SAMPLES_COUNTED, TRACING, Z17,
    every,
};

const HUNDREDTH: &str =
    "one mirror pixel in a hundred is what can be told; one in a thousand may round either way.";

/// Fig. 5.2 and 2.4.
pub const RESULTS: &[Claim] = &[
    claim(
        Z17,
        "5, Fig. 5.2",
        "Where rays meet no mirror again the results compare with ray tracing.",
        value(
            each(TRACED_SCENES),
            RIGHT,
            Limit::Above(0.95),
            ROUNDING,
            Shown::Percent,
        ),
        "95 of 100 mirror pixels are right, by the truth without mirrors in mirrors.",
    ),
    claim(
        Z17,
        "2.3.1, Fig. 2.4",
        "An environment map lacks parallax: it is less exact than tracing.",
        difference(
            each(TRACED_SCENES),
            each(MAPPED),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
];

/// Fig. 5.3: criteria. Places as in the list of criteria.
pub const CRITERIA: &[Claim] = &[
    claim(
        Z17,
        "3.4",
        "A threshold of distance misses hits that a change of sign finds.",
        difference(every(0), every(1), OPEN, Limit::Above(0.0), ROUNDING),
        "unresolved pixels by distance less those by sign.",
    ),
    claim(
        Z17,
        "3.4, 3.9",
        "Both criteria together resolve more than distance alone.",
        difference(every(0), every(2), OPEN, Limit::Above(0.0), ROUNDING),
        "unresolved pixels by distance less those by both.",
    ),
    claim(
        Z17,
        "3.4",
        "A change of sign finds hits where there are none.",
        difference(every(4), every(1), RIGHT, Limit::Above(0.002), ROUNDING),
        "right mirror pixels if changes count only where the map is continuous, less those if any counts.",
    ),
    claim(
        Z17,
        "5.1, Fig. 5.1",
        "The analytical criterion takes far fewer samples than the distance criterion.",
        ratio(every(1), every(0), LOOKED_UP, Limit::Below(0.5), COUNTED),
        SAMPLES_COUNTED,
    ),
];

/// Lengths of the step.
pub const STEPS: &[Claim] = &[
    claim(
        Z17,
        "5.1",
        "The analytical criterion tolerates a longer step.",
        difference(
            of(Which::Ending("analytic"), Place::At(0.01)),
            of(Which::Ending("analytic"), Place::At(0.001)),
            RIGHT,
            Limit::Above(-0.01),
            ROUNDING,
        ),
        "right mirror pixels with a step of a hundredth of the ray less those with a thousandth.",
    ),
    claim(
        Z17,
        "3.4",
        "How well the analytical criterion does depends on the step.",
        difference(
            of(Which::Ending("analytic"), Place::Most),
            of(Which::Ending("analytic"), Place::Least),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
];

/// Where a ray is sampled.
pub const SAMPLINGS: &[Claim] = &[
    claim(
        Z17,
        "3.5",
        "Even angles skip valid hits, so that distant objects are missing; even steps do better.",
        difference(every(0), every(1), RIGHT, Limit::Above(0.01), ROUNDING),
        HUNDREDTH,
    ),
    claim(
        Z17,
        "3.5",
        "Even steps take more samples than even angles.",
        ratio(every(0), every(1), LOOKED_UP, Limit::Above(1.0), COUNTED),
        SAMPLES_COUNTED,
    ),
    claim(
        Z17,
        "3.5",
        "Each texel once takes the fewest samples.",
        ratio(every(2), every(0), LOOKED_UP, Limit::Below(1.0), COUNTED),
        SAMPLES_COUNTED,
    ),
];

/// Skipping. Places as in the list of pyramids.
pub const PYRAMIDS: &[Claim] = &[
    claim(
        Z17,
        "3.6",
        "Skipping leaves the picture as it is.",
        difference(
            every(0),
            every(1),
            RIGHT,
            Limit::Between(-0.001, 0.001),
            Noise::Plus(0.0005),
        ),
        "right mirror pixels without skipping less those with the published test: one in a thousand.",
    ),
    claim(
        Paper::Ours,
        "",
        "Skipping by the sound test leaves the picture as it is.",
        difference(
            every(0),
            every(2),
            RIGHT,
            Limit::Between(-0.001, 0.001),
            Noise::Plus(0.0005),
        ),
        "right mirror pixels without skipping less those with the sound test: one in a thousand.",
    ),
    claim(
        Z17,
        "3.6",
        "Skipping reduces the number of samples.",
        ratio(every(1), every(0), LOOKED_UP, Limit::Below(1.0), COUNTED),
        SAMPLES_COUNTED,
    ),
];

/// What unresolved pixels show. Places as in the list of fillings.
pub const FILLINGS: &[Claim] = &[
    claim(
        Z17,
        "Fig. 3.10",
        "Filling with an environment map is noticed for its inexactness.",
        difference(every(5), every(1), RIGHT, Limit::Above(0.01), ROUNDING),
        "right mirror pixels with rays traced for the open ones less those with the map: one in a hundred.",
    ),
    claim(
        Z17,
        "3.9",
        "Filling with an environment map is nearer to the truth than marking.",
        difference(every(1), every(0), RIGHT, Limit::Above(0.0), ROUNDING),
        "right mirror pixels with the map less those with a mark.",
    ),
    claim(
        Z17,
        "3.9",
        "Filling with the sample that came nearest to a hit is nearer to the truth than marking.",
        difference(every(4), every(0), RIGHT, Limit::Above(0.0), ROUNDING),
        "right mirror pixels with the best candidate less those with a mark.",
    ),
];

/// Fragments and compute shaders.
pub const STAGES: &[Claim] = &[
    claim(
        Z17,
        "3.7, 7",
        "The compute version is faster than the fragments.",
        ratio(every(2), every(0), FRAME, Limit::Below(1.0), Noise::Clock),
        "a frame of the one over one of the other; on a software adapter lanes run one after another.",
    ),
    claim(
        Z17,
        "3.7",
        "The compute version takes fewer samples, since it looks at each texel once at most.",
        ratio(every(2), every(0), LOOKED_UP, Limit::Below(1.0), COUNTED),
        SAMPLES_COUNTED,
    ),
];

const CONTINUOUS: &str = SWEPT[0].0;

/// Face sizes.
pub const FACES: &[Claim] = &[
    claim(
        Z17,
        "5",
        "With maps that are fine enough the picture compares with ray tracing.",
        value(
            of(Which::Ending(CONTINUOUS), Place::Last),
            RIGHT,
            Limit::Above(0.99),
            ROUNDING,
            Shown::Percent,
        ),
        "99 of 100 mirror pixels right, by faces of 512².",
    ),
    claim(
        Z17,
        "2.3.1",
        "Cubemap tracing is more exact than an environment map of the same size.",
        difference(
            of(Which::Ending(CONTINUOUS), Place::Each),
            of(Which::Ending(ENVIRONMENT), Place::Each),
            RIGHT,
            Limit::Above(0.01),
            ROUNDING,
        ),
        HUNDREDTH,
    ),
    claim(
        Paper::Ours,
        "",
        "Finer maps are more exact.",
        difference(
            of(Which::Ending(CONTINUOUS), Place::Last),
            of(Which::Ending(CONTINUOUS), Place::First),
            RIGHT,
            Limit::Above(0.002),
            ROUNDING,
        ),
        "right mirror pixels by the finest maps less those by the coarsest.",
    ),
];

/// Numbers of maps.
pub const OBJECTS: &[Claim] = &[
    claim(
        Z17,
        "3.8",
        "The first two maps cover the most; further ones add little.",
        difference(
            of(Which::Ending(CONTINUOUS), Place::At(2.0)),
            of(Which::Ending(CONTINUOUS), Place::At(4.0)),
            OPEN,
            Limit::Below(0.01),
            ROUNDING,
        ),
        "unresolved pixels with two maps less those with four: one in a hundred.",
    ),
    claim(
        Z17,
        "3.8",
        "Each map adds to the time.",
        ratio(
            of(Which::Ending(CONTINUOUS), Place::At(4.0)),
            of(Which::Ending(CONTINUOUS), Place::At(1.0)),
            TRACING,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "the tracing pass with four maps over that with one.",
    ),
];

/// Maps drawn anew.
pub const REBUILD: &[Claim] = &[
    claim(
        Z17,
        "3.8, 5.1",
        "Drawing maps and pyramid anew is not very expensive.",
        Rule {
            of: Measure::Value(of(EVERY, Place::At(256.0)), REDRAWN),
            is: Limit::Below(0.5),
            noise: Noise::Clock,
            shown: Shown::Percent,
        },
        "their share of a frame with faces of 256²: less than half.",
    ),
    claim(
        Z17,
        "Table 5.2",
        "Drawing the maps grows as the number of their texels.",
        grows(EVERY, Term::Path(MAPS_MS), Limit::Between(1.7, 2.3)),
        "the power of the side: the printed times give 2.0.",
    ),
    claim(
        Z17,
        "Table 5.2",
        "Building the pyramid grows as the root of the side.",
        grows(EVERY, Term::Path(PYRAMID_MS), Limit::Between(0.2, 0.8)),
        "the power of the side: the printed times give 0.5.",
    ),
];

/// What is drawn anew, of a frame.
const REDRAWN: Term = Term::Share(&[MAPS_MS, PYRAMID_MS], FRAME_MS);

/// Mirrors in mirrors.
pub const BOUNCES: &[Claim] = &[
    claim(
        Z17,
        "3.3",
        "Three rays show more of mirrors in mirrors than one.",
        difference(
            every(THREE),
            every(ONE),
            RIGHT_IN_FULL,
            Limit::Above(0.002),
            ROUNDING,
        ),
        "pixels that are right by the truth with mirrors in mirrors.",
    ),
    claim(
        Paper::Ours,
        "",
        "Eight rays show more than three.",
        difference(
            every(EIGHT),
            every(THREE),
            RIGHT_IN_FULL,
            Limit::Above(0.002),
            ROUNDING,
        ),
        "pixels that are right by the truth with mirrors in mirrors.",
    ),
    claim(
        Z17,
        "3.3, 4",
        "One bias for all rays does not work.",
        difference(
            every(THREE),
            every(5),
            RIGHT_IN_FULL,
            Limit::Above(0.01),
            ROUNDING,
        ),
        "right pixels with a bias by texel and angle less those with a share of the ray: one in a hundred.",
    ),
    claim(
        Z17,
        "3.3",
        "Waiting for a sample that is clear of the mirror spares the bias.",
        difference(
            every(4),
            every(THREE),
            RIGHT_IN_FULL,
            Limit::Above(-0.01),
            ROUNDING,
        ),
        "right pixels so less those with a bias by texel and angle: no more than one in a hundred lost.",
    ),
];

//! What the thesis of 2017 says about tracing through cube maps.

use crate::suites::claims::make::{claim, difference, grows, ratio, value};
use crate::suites::claims::{
    Case, Claim, EVERY, Interval, Limit, Measure, Noise, Numbers, Paper, Pick, Place, Rule, Shown,
    Term, Which, each, first, last, of,
};
use crate::suites::paths::{
    AGREEMENT, FRAME_MS, FULL_AGREEMENT, MAPS_MS, PIXELS, PYRAMID_MS, SAMPLES, SEARCH_MS, TRACE_MS,
    UNRESOLVED,
};

use super::labels::{ACCELERATED, ANALYTIC, ANALYTIC_EFFICIENT, EFFICIENT, PLAIN, SELF_REFLECTING};
use super::labels::{DISTANT, GROWTH, NEAR, TOUCHING};
use super::labels::{EIGHT, ENVIRONMENT, ONE, SWEPT, THREE};
use super::labels::{MAPPED, TRACED as TRACED_SCENES};
use super::printed::{CELLS, OURS};

const Z17: Paper = Paper::Ciz2017;

const RIGHT: Term = Term::Path(AGREEMENT);
const RIGHT_IN_FULL: Term = Term::Path(FULL_AGREEMENT);
const OPEN: Term = Term::Path(UNRESOLVED);
const LOOKED_UP: Term = Term::Path(SAMPLES);
const TRACING: Term = Term::Path(TRACE_MS);
const FRAME: Term = Term::Path(FRAME_MS);

/// A pixel in a thousand may round either way.
const ROUNDING: Noise = Noise::Plus(0.001);
/// Samples are counted, but maps are placed by what a driver draws.
const COUNTED: Noise = Noise::Share(0.02);
const HUNDREDTH: &str =
    "one mirror pixel in a hundred is what can be told; one in a thousand may round either way.";
const SAMPLES_COUNTED: &str = "samples of a mirror pixel are counted.";
const FASTER: &str = "the time of the tracing pass; what its scatter leaves open is undecided.";

/// In every series, the point that stands there.
const fn every(place: usize) -> Pick {
    of(EVERY, Place::At(place as f64))
}

/// Table 5.2's flags.
pub const GRID: &[Claim] = &[
    claim(
        Z17,
        "4.3, 5.1",
        "Acceleration (A) cuts the number of samples greatly.",
        ratio(
            every(ACCELERATED),
            every(PLAIN),
            LOOKED_UP,
            Limit::Below(0.5),
            COUNTED,
        ),
        "samples with A over those without flags: half is great.",
    ),
    claim(
        Z17,
        "4.3",
        "Acceleration makes it faster.",
        ratio(
            every(ACCELERATED),
            every(PLAIN),
            TRACING,
            Limit::Below(1.0),
            Noise::Clock,
        ),
        FASTER,
    ),
    claim(
        Z17,
        "4.3",
        "Acceleration makes it faster by a small amount only.",
        ratio(
            every(ACCELERATED),
            every(PLAIN),
            TRACING,
            Limit::Above(0.5),
            Noise::Clock,
        ),
        "the tracing pass with A over that without flags: more than half is left.",
    ),
    claim(
        Z17,
        "Table 5.2",
        "Sampling each texel once (E) takes longer than even steps.",
        ratio(
            every(EFFICIENT),
            every(PLAIN),
            TRACING,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        FASTER,
    ),
    claim(
        Z17,
        "3.5",
        "Sampling each texel once takes fewer samples than even steps.",
        ratio(
            every(EFFICIENT),
            every(PLAIN),
            LOOKED_UP,
            Limit::Below(1.0),
            COUNTED,
        ),
        SAMPLES_COUNTED,
    ),
    claim(
        Z17,
        "5.1",
        "The analytical criterion (L) is much faster than the distance criterion.",
        ratio(
            every(ANALYTIC),
            every(PLAIN),
            TRACING,
            Limit::Below(0.5),
            Noise::Clock,
        ),
        "the tracing pass with L over that without flags: half is much faster.",
    ),
    claim(
        Z17,
        "5.1",
        "The analytical criterion leaves almost no pixel unresolved.",
        value(
            every(ANALYTIC),
            OPEN,
            Limit::Below(0.01),
            ROUNDING,
            Shown::Percent,
        ),
        "one mirror pixel in a hundred.",
    ),
    claim(
        Z17,
        "3.3",
        "Following rays from mirror to mirror (S) shows what mirrors see in mirrors.",
        difference(
            every(SELF_REFLECTING),
            every(ANALYTIC_EFFICIENT),
            RIGHT_IN_FULL,
            Limit::Above(0.002),
            ROUNDING,
        ),
        "the share of pixels that are right by the truth with mirrors in mirrors, with S less without.",
    ),
    claim(
        Z17,
        "5",
        "What a mirror pixel costs does not depend on the scene: by time.",
        Rule {
            of: Measure::Own(spread_of_time, &[TRACE_MS, PIXELS]),
            is: Limit::Below(1.25),
            noise: Noise::Clock,
            shown: Shown::Times,
        },
        "nanoseconds a mirror pixel with L in the dearest scene over the cheapest: a quarter is about the same.",
    ),
    claim(
        Z17,
        "5",
        "What a mirror pixel costs does not depend on the scene: by samples.",
        Rule {
            of: Measure::Own(spread_of_samples, &[SAMPLES]),
            is: Limit::Below(1.25),
            noise: COUNTED,
            shown: Shown::Times,
        },
        "samples a mirror pixel with L in the dearest scene over the cheapest: a quarter is about the same.",
    ),
];

fn spread_of_time(from: &dyn Numbers) -> Vec<Case> {
    spread(from, Term::Quotient(TRACE_MS, PIXELS), Noise::Clock)
}

fn spread_of_samples(from: &dyn Numbers) -> Vec<Case> {
    spread(from, LOOKED_UP, COUNTED)
}

/// The greatest of all series over the least, with the analytical criterion.
fn spread(from: &dyn Numbers, term: Term, noise: Noise) -> Vec<Case> {
    let read = |label: &String| term.read(from, label, ANALYTIC as f64, noise);
    let mut numbers: Vec<_> = from.labels().iter().filter_map(read).collect();
    numbers.sort_by(|a, b| a.value.total_cmp(&b.value));
    let spread = match numbers.as_slice() {
        [least, .., most] => most.over(*least),
        _ => None,
    };
    let case = |number| Case {
        label: String::new(),
        number,
    };
    spread.map(case).into_iter().collect()
}

/// Table 5.2, cell by cell.
pub const TABLE: &[Claim] = &[claim(
    Z17,
    "Table 5.2",
    "The cells relate as printed.",
    Rule {
        of: Measure::Own(printed, &[TRACE_MS, PIXELS]),
        is: Limit::Between(0.5, 2.0),
        noise: Noise::Clock,
        shown: Shown::Times,
    },
    "time a mirror pixel of each cell over that of the cell without flags in the same window, ours over \
     theirs (GT 540M): within twice is alike on other hardware.",
)];

/// Our ratio of each cell to its base, over the printed one.
fn printed(from: &dyn Numbers) -> Vec<Case> {
    const COST: Term = Term::Quotient(TRACE_MS, PIXELS);
    let read = |place: usize| COST.read(from, OURS, place as f64, Noise::Clock);
    let cases = CELLS.iter().enumerate().filter_map(|(place, cell)| {
        let theirs = cell.micros / CELLS[cell.base].micros;
        let ours = read(place)
            .filter(|_| cell.base != place)?
            .over(read(cell.base)?)?;
        let scaled = |value: f64| value / theirs;
        Some(Case {
            label: format!("{} ({:.2} there)", cell.label(), theirs),
            number: Interval {
                value: scaled(ours.value),
                low: scaled(ours.low),
                high: scaled(ours.high),
            },
        })
    });
    cases.collect()
}

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

const SUPPORTED: &str = "what is supported shows the right object on 95 of 100 mirror pixels.";

/// Whether a technique, by its place, supports what a series asks for.
const fn supports(series: &'static str, technique: f64) -> Rule {
    value(
        of(Which::Named(series), Place::At(technique)),
        RIGHT,
        Limit::Above(0.95),
        ROUNDING,
        Shown::Percent,
    )
}

const fn fails(series: &'static str, technique: f64) -> Rule {
    Rule {
        is: Limit::Below(0.95),
        ..supports(series, technique)
    }
}

/// Table 5.1. Places as in the list of techniques.
pub const CAPABILITIES: &[Claim] = &[
    claim(
        Z17,
        "Table 5.1",
        "Environment maps do not support near objects.",
        fails(NEAR, 3.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Environment maps do not support touching objects.",
        fails(TOUCHING, 3.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "2.3.1",
        "Environment maps are right for what is distant.",
        supports(DISTANT, 3.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Virtual objects support near objects.",
        supports(NEAR, 5.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Virtual objects support touching objects.",
        supports(TOUCHING, 5.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Virtual objects support distant objects.",
        supports(DISTANT, 5.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Cubemap tracing supports near objects.",
        supports(NEAR, 8.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Cubemap tracing supports touching objects.",
        supports(TOUCHING, 8.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Cubemap tracing supports distant objects.",
        supports(DISTANT, 8.0),
        SUPPORTED,
    ),
    claim(
        Z17,
        "Table 5.1",
        "Maps drawn for every frame make cubemap tracing dearer than an environment map so drawn.",
        ratio(
            of(Which::Named(NEAR), Place::At(9.0)),
            of(Which::Named(NEAR), Place::At(4.0)),
            FRAME,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "the thesis calls the one moderate and the other low.",
    ),
];

const TRACED: &str = GROWTH[0].0;

/// Cost against the size of the scene.
pub const GROWS: &[Claim] = &[
    claim(
        Z17,
        "5",
        "The cost of tracing does not depend on the number of triangles: by samples.",
        grows(Which::Named(TRACED), LOOKED_UP, Limit::Between(-0.05, 0.05)),
        "the power of the vertices by which samples grow: within 0.05 of none.",
    ),
    claim(
        Z17,
        "5",
        "The cost of tracing does not depend on the number of triangles: by time.",
        grows(Which::Named(TRACED), TRACING, Limit::Between(-0.05, 0.05)),
        "the power of the vertices by which the pass grows: within 0.05 of none, and surer than that.",
    ),
    claim(
        Z17,
        "Table 5.1",
        "Virtual objects cost much for a vertex.",
        ratio(
            last("linear"),
            first("linear"),
            FRAME,
            Limit::Above(2.0),
            Noise::Clock,
        ),
        "a frame with the most vertices over one with the fewest.",
    ),
    claim(
        Z17,
        "Table 5.1",
        "Cubemap tracing costs more for a pixel than virtual objects.",
        ratio(
            first(TRACED),
            first("linear"),
            FRAME,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "a frame of the one over one of the other where there are fewest vertices.",
    ),
    claim(
        Paper::Estalella2005,
        "5",
        "Searching every vertex costs as the number of vertices.",
        ratio(
            last(GROWTH[4].0),
            of(Which::Named(GROWTH[4].0), Place::At(10_000.0)),
            Term::Path(SEARCH_MS),
            Limit::Between(8.0, 12.5),
            Noise::Clock,
        ),
        "the search pass with ten times the vertices: eight to twelve and a half times is as many.",
    ),
    claim(
        Z17,
        "2.3.1, Table 5.1",
        "An environment map costs less than cubemap tracing.",
        ratio(
            each("environment map"),
            each(TRACED),
            FRAME,
            Limit::Below(1.0),
            Noise::Clock,
        ),
        "a frame of the one over one of the other.",
    ),
];

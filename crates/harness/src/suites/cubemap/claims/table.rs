//! Table 5.1 and 5.2, and what a larger scene costs.

use crate::suites::claims::make::{claim, difference, grows, ratio, value};
use crate::suites::claims::{
    Case, Claim, Interval, Limit, Measure, Noise, Numbers, Paper, Place, Rule, Shown, Term, Which,
    each, first, last, of,
};
use crate::suites::cubemap::labels::{
    ACCELERATED, ANALYTIC, ANALYTIC_EFFICIENT, DISTANT, EFFICIENT, GROWTH, NEAR, PLAIN,
    SELF_REFLECTING, TOUCHING,
};
use crate::suites::cubemap::printed::{CELLS, OURS};
use crate::suites::paths::{PIXELS, SAMPLES, SEARCH_MS, TRACE_MS};

use super::{
    COUNTED, FRAME, LOOKED_UP, OPEN, RIGHT, RIGHT_IN_FULL, ROUNDING, SAMPLES_COUNTED, TRACING, Z17,
    every,
};

const FASTER: &str = "the time of the tracing pass; what its scatter leaves open is undecided.";

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

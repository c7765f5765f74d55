//! What the searches cost: vertices, mirrors.

use crate::suites::claims::make::{claim, difference, least_step, ratio, value};
use crate::suites::claims::{
    Case, Claim, EVERY, Interval, Limit, Measure, Noise, Numbers, Paper, Rule, Shown, Term, each,
    first, last,
};
use crate::suites::paths::{
    AGREEMENT, AT_RIM, FRAME_MS, HEIGHT, NODE_TESTS, OFF_RIM, SEARCH_MS, STEPS, WIDTH, WORK,
};
use crate::suites::search::data::{ENLARGED, LINEAR, RAW, STOPPED, SWEPT, SWEPT_WARM, WARM};
use crate::suites::search::labels::REFLECTOR;

use super::T13;

const FRAME: Term = Term::Path(FRAME_MS);
/// All that depends on the search: start or pyramid, search, and the drawing of its answers. On some
/// adapters a compute pass ends in the time of the raster pass after it, so that the search alone
/// would be too little.
const OWN: Term = Term::Sum(&[
    SEARCH_MS,
    "time_ms.passes.start",
    "time_ms.passes.hierarchy",
    "time_ms.passes.virtual",
]);
/// The same without the looking for a start, which the thesis takes as given.
const WITHOUT_START: Term = Term::Sum(&[
    SEARCH_MS,
    "time_ms.passes.hierarchy",
    "time_ms.passes.virtual",
]);
const RIM: Term = Term::Quotient(AT_RIM, OFF_RIM);
const TIME_OF_STEP: Term = Term::Quotient(SEARCH_MS, STEPS);

const SLOWER: &str = "above 1 it is slower; what the medians' intervals leave open is undecided.";
const LOOKS: &str = "looks at texels are counted: above 1 it looks at more.";
const QUARTER: &str = "a quarter more or less is not told apart in the thesis' plots.";

/// That the repaired hierarchy takes longer than the walk, at each place.
const fn slower(time: Term) -> Rule {
    ratio(
        each(ENLARGED),
        each(LINEAR),
        time,
        Limit::Above(1.0),
        Noise::Clock,
    )
}

const MORE_WORK: Rule = ratio(
    each(ENLARGED),
    each(LINEAR),
    Term::Path(WORK),
    Limit::Above(1.0),
    Noise::Share(0.01),
);
const ONE_STEP: Claim = claim(
    T13,
    "6.1",
    "With a still camera a walk from the previous frame's answer takes a single step.",
    value(
        each(WARM),
        Term::Path(STEPS),
        Limit::Between(0.0, 1.0),
        Noise::Exact,
        Shown::In("steps"),
    ),
    "steps are counted: the claim is one.",
);
const STEP_COSTS: Claim = claim(
    T13,
    "4.3, 6.1",
    "A step of the hierarchy, a test of cones and spheres, takes longer than one of the walk.",
    ratio(
        each(RAW),
        each(LINEAR),
        TIME_OF_STEP,
        Limit::Above(1.0),
        Noise::Clock,
    ),
    "the time of the search pass over the steps of a vertex: above 1 a step takes longer.",
);
const MORE_STEPS: Claim = claim(
    T13,
    "6.1",
    "The hierarchy does not need fewer steps than the walk.",
    ratio(
        each(RAW),
        each(LINEAR),
        Term::Path(STEPS),
        Limit::Above(1.0),
        Noise::Share(0.01),
    ),
    "steps are counted: above 1 it needs more.",
);

/// Fig. 4.3.
pub const OBJECTS: &[Claim] = &[
    claim(
        T13,
        "4.3",
        "The hierarchy, with enlargement, makes a slower frame than the linear search.",
        slower(FRAME),
        SLOWER,
    ),
    claim(
        T13,
        "4.3",
        "The hierarchy's own passes take longer than those of the linear search.",
        slower(OWN),
        SLOWER,
    ),
    claim(
        T13,
        "4.3",
        "The hierarchy's own passes take longer even if the search for a start is charged to neither.",
        slower(WITHOUT_START),
        "the thesis takes the mirror's centre as known; above 1 it is slower.",
    ),
    claim(
        T13,
        "4.3",
        "The hierarchy has more to look at than the linear search.",
        MORE_WORK,
        LOOKS,
    ),
    claim(
        T13,
        "Fig. 4.3c",
        "Enlarging cones and spheres costs time.",
        ratio(
            each(ENLARGED),
            each(RAW),
            FRAME,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        SLOWER,
    ),
    claim(
        T13,
        "Fig. 4.3d",
        "Stopping early saves time.",
        ratio(
            each(STOPPED),
            each(ENLARGED),
            FRAME,
            Limit::Below(1.0),
            Noise::Clock,
        ),
        "below 1 it is faster; what the medians' intervals leave open is undecided.",
    ),
    STEP_COSTS,
    MORE_STEPS,
    claim(
        T13,
        "6.1",
        "The hierarchy takes at least as many steps as its pyramid has levels.",
        Rule {
            of: Measure::Own(steps_by_level, &[STEPS, WIDTH, HEIGHT]),
            is: Limit::Above(1.0),
            noise: Noise::Exact,
            shown: Shown::Times,
        },
        "the mean number of steps over the number of levels above the pixels.",
    ),
    claim(
        T13,
        "4.3, 6.1",
        "With enlargement the hierarchy gives the linear search's picture.",
        difference(
            each(ENLARGED),
            each(LINEAR),
            Term::Path(AGREEMENT),
            Limit::Between(-0.01, 0.01),
            Noise::Plus(0.001),
        ),
        "one mirror pixel in a hundred is what can be told; a pixel in a thousand may round either way.",
    ),
    claim(
        T13,
        "4.2",
        "What enlargement gets wrong is worst at grazing angles.",
        ratio(
            each(ENLARGED),
            each(LINEAR),
            RIM,
            Limit::Above(1.0),
            Noise::Share(0.1),
        ),
        "the median angular error at the rim over that off the rim, against the linear search's, which \
         grows at the rim as well; a tenth is the scatter of a median of so few pixels.",
    ),
    claim(
        T13,
        "4.2",
        "What stopping early gets wrong is worst at grazing angles.",
        ratio(
            each(STOPPED),
            each(LINEAR),
            RIM,
            Limit::Above(1.0),
            Noise::Share(0.1),
        ),
        "the median angular error at the rim over that off the rim, against the linear search's; a tenth is scatter.",
    ),
    ONE_STEP,
    WARM_SAVES,
];

const WARM_SAVES: Claim = claim(
    T13,
    "2.3",
    "Starting at the previous frame's answer saves time.",
    ratio(
        each(WARM),
        each(LINEAR),
        OWN,
        Limit::Below(1.0),
        Noise::Clock,
    ),
    "below 1 its own passes are faster; a still camera is the best case.",
);

/// A scene of the user's.
pub const SCENE: &[Claim] = OBJECTS;

/// Steps over the levels of the pyramid above the pixels.
fn steps_by_level(from: &dyn Numbers) -> Vec<Case> {
    let places = from.places(RAW).into_iter();
    let cases = places.filter_map(|x| {
        let side = from.at(RAW, x, WIDTH)?.max(from.at(RAW, x, HEIGHT)?);
        let levels = side.log2().ceil();
        Some(Case {
            label: from.place_name(x),
            number: Interval::exact(from.at(RAW, x, STEPS)? / levels),
        })
    });
    cases.collect()
}

const NO_HIDDEN: Claim = claim(
    T13,
    "6.1",
    "In the measured scene every vertex is reflected, none hidden.",
    value(
        each(LINEAR),
        Term::Path("vertices.hidden"),
        Limit::Between(0.0, 0.0),
        Noise::Exact,
        Shown::In("vertices hidden"),
    ),
    "counted by exact reflection points.",
);

const SWEPT_FASTER: Claim = claim(
    Paper::Ours,
    "",
    "A hierarchy over cells that share their corners is faster than the linear search, its building included.",
    ratio(
        each(SWEPT.0),
        each(LINEAR),
        OWN,
        Limit::Below(1.0),
        Noise::Clock,
    ),
    "own passes over own passes: below 1 it is faster; what the medians' intervals leave open is undecided.",
);
const SWEPT_WARM_HALF: Claim = claim(
    Paper::Ours,
    "",
    "From the previous frame's answers of a still camera it tests at most half of the nodes.",
    ratio(
        each(SWEPT_WARM.0),
        each(SWEPT.0),
        Term::Path(NODE_TESTS),
        Limit::Below(0.5),
        Noise::Share(0.01),
    ),
    "node tests of a vertex are counted.",
);

/// Fig. 6.1.
pub const GENERAL_VIEW: &[Claim] = &[
    SWEPT_FASTER,
    SWEPT_WARM_HALF,
    claim(
        T13,
        "Fig. 6.1",
        "The hierarchy generally needs a longer frame than the linear search.",
        slower(FRAME),
        SLOWER,
    ),
    claim(
        T13,
        "Fig. 6.1",
        "The hierarchy's own passes generally take longer than those of the linear search.",
        slower(OWN),
        SLOWER,
    ),
    claim(
        T13,
        "6.1",
        "The hierarchy has more to look at than the linear search.",
        MORE_WORK,
        LOOKS,
    ),
    STEP_COSTS,
    MORE_STEPS,
    NO_HIDDEN,
    ONE_STEP,
    WARM_SAVES,
];

/// Fig. 6.2.
pub const FULL_VIEW: &[Claim] = &[
    SWEPT_FASTER,
    claim(
        Paper::Ours,
        "",
        "Where the reflection fills the view, it takes at most a fifth of the linear search's time.",
        ratio(
            each(SWEPT.0),
            each(LINEAR),
            OWN,
            Limit::Below(0.2),
            Noise::Clock,
        ),
        "own passes over own passes; the building weighs less the more vertices there are.",
    ),
    SWEPT_WARM_HALF,
    claim(
        T13,
        "Fig. 6.2",
        "Where the reflection fills the view, frames of both searches take about as long.",
        ratio(
            each(ENLARGED),
            each(LINEAR),
            FRAME,
            Limit::Between(0.8, 1.25),
            Noise::Clock,
        ),
        QUARTER,
    ),
    claim(
        T13,
        "Fig. 6.2",
        "Where the reflection fills the view, own passes of both searches take about as long.",
        ratio(
            each(ENLARGED),
            each(LINEAR),
            OWN,
            Limit::Between(0.67, 1.5),
            Noise::Clock,
        ),
        "by half more or a third less is about as long, where medians of passes repeat to a tenth.",
    ),
    claim(
        T13,
        "6.1",
        "Where the reflection fills the view the walk has most steps to take: the hierarchy looks at no more than it.",
        ratio(
            each(ENLARGED),
            each(LINEAR),
            Term::Path(WORK),
            Limit::Below(1.0),
            Noise::Share(0.01),
        ),
        "looks at texels are counted.",
    ),
    NO_HIDDEN,
    ONE_STEP,
    WARM_SAVES,
];

/// Mirrors of several sizes in the picture.
pub const SMALL: &[Claim] = &[
    claim(
        T13,
        "6.1",
        "In a large picture of a small mirror the walk takes fewer steps than the hierarchy.",
        ratio(
            last(LINEAR),
            last(RAW),
            Term::Path(STEPS),
            Limit::Below(1.0),
            Noise::Share(0.02),
        ),
        "steps are counted, at the smallest mirror.",
    ),
    claim(
        T13,
        "6.1",
        "The smaller the mirror, the better for the linear search.",
        Rule {
            of: Measure::Own(favoured, &[FRAME_MS]),
            is: Limit::Above(1.0),
            noise: Noise::Clock,
            shown: Shown::Times,
        },
        "how often the hierarchy's frame is the linear search's, at the smallest mirror over that at the \
         largest.",
    ),
    claim(
        Paper::Estalella2005,
        "5",
        "The search in maps of the mirror costs the same however small the reflection is in the picture.",
        ratio(
            last(REFLECTOR),
            first(REFLECTOR),
            Term::Path(WORK),
            Limit::Between(0.8, 1.25),
            Noise::Share(0.02),
        ),
        "looks into the maps a vertex, at the smallest mirror over the largest: a quarter is about the same.",
    ),
];

/// Hierarchy over linear search at the smallest mirror, over the same at the largest.
fn favoured(from: &dyn Numbers) -> Vec<Case> {
    let places = from.places(LINEAR);
    let ratio = |x: f64| {
        let time = |series| FRAME.read(from, series, x, Noise::Clock);
        time(ENLARGED)?.over(time(LINEAR)?)
    };
    let ends = places.first().zip(places.last());
    let number = ends.and_then(|(large, small)| ratio(*small)?.over(ratio(*large)?));
    let case = |number| Case {
        label: String::new(),
        number,
    };
    number.map(case).into_iter().collect()
}

/// One to eight mirrors.
pub const MIRRORS: &[Claim] = &[
    claim(
        T13,
        "2.3, 3.1",
        "Each added mirror costs.",
        least_step(EVERY, OWN, Limit::Above(1.0), Noise::Share(0.05)),
        "the least growth from one number of mirrors to the next: above 1 each costs. Medians of passes on one \
         machine repeat to about a twentieth.",
    ),
    claim(
        Paper::Estalella2005,
        "8",
        "Every vertex is searched for every mirror.",
        ratio(
            last(LINEAR),
            first(LINEAR),
            Term::Path("vertices.searched"),
            Limit::Between(7.9, 8.1),
            Noise::Exact,
        ),
        "searches are counted, with eight mirrors over one.",
    ),
];

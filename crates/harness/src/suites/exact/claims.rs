//! What the suite decides.

use super::crossover;
use super::labels::{BEAMS, MAPS, REBUILT, REFIT, SEARCHED, STATIC};
use crate::suites::claims::make::{claim, grows, ratio, value};
use crate::suites::claims::{
    Case, Claim, EVERY, Interval, Limit, Measure, Noise, Numbers, Paper, Place, Rule, Shown, Term,
    Which, at, each, last, of,
};
use crate::suites::paths::{
    AGREEMENT, ANGLE, BUILD_CPU, FULL_AGREEMENT, MOVED_NODES, OWN_MS, REFIT_MS,
};

const OWN: Term = Term::Path(OWN_MS);

/// The time of two techniques, the second with the hierarchy built for each frame.
const fn cheaper(one: &'static str, other: &'static str) -> Rule {
    ratio(each(one), each(other), OWN, Limit::Below(1.0), Noise::Clock)
}

pub(super) const CHOICE: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "Where nothing moves, trace rays through a hierarchy that was built once: nothing exact costs less.",
        cheaper(STATIC, BEAMS),
        "the time of the rays over that of beams, scene by scene: less is below 1.",
    ),
    claim(
        Paper::Ours,
        "",
        "Where things move and neighbours stay neighbours, refit the hierarchy: that costs less than beams.",
        cheaper(REFIT, BEAMS),
        "the time of refitting and tracing over that of beams: less is below 1.",
    ),
    claim(
        Paper::Ours,
        "",
        "Where triangles come and go, so that a hierarchy would be built for every frame, take beams.",
        cheaper(BEAMS, REBUILT),
        "the time of beams over that of building on the CPU and tracing: less is below 1.",
    ),
    claim(
        Paper::Ours,
        "",
        "Beams show the right object on every mirror pixel, whatever the mirror.",
        value(
            each(BEAMS),
            Term::Path(AGREEMENT),
            Limit::Above(0.9998),
            Noise::Exact,
            Shown::Percent,
        ),
        "of some thousand pixels one at an edge may round otherwise.",
    ),
    claim(
        Paper::Ours,
        "",
        "A refitted hierarchy changes no pixel either.",
        value(
            each(REFIT),
            Term::Path(AGREEMENT),
            Limit::Above(0.9998),
            Noise::Exact,
            Shown::Percent,
        ),
        "of some thousand pixels one at an edge may round otherwise.",
    ),
    claim(
        Paper::Ours,
        "",
        "Traced cube maps that show what moves cost more than exact beams.",
        ratio(
            each(MAPS),
            each(BEAMS),
            OWN,
            Limit::Above(1.0),
            Noise::Clock,
        ),
        "the time of drawing the maps and tracing them over that of beams: more is above 1.",
    ),
    claim(
        Paper::Ours,
        "",
        "Traced cube maps show another object on more than a hundredth of the mirror pixels.",
        value(
            each(MAPS),
            Term::Path(AGREEMENT),
            Limit::Below(0.99),
            Noise::Share(0.001),
            Shown::Percent,
        ),
        "the share with the right object: a hundredth is plain to see along every edge.",
    ),
    claim(
        Paper::Ours,
        "",
        "Searched vertices err a hundred times as much as beams.",
        ratio(
            each(SEARCHED),
            each(BEAMS),
            Term::Path(ANGLE),
            Limit::Above(100.0),
            Noise::Share(0.05),
        ),
        "the median angular error: what lies between exact vertices is interpolated.",
    ),
];

pub(super) const TRIANGLES: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "From fewer than ten thousand triangles on, beams cost less than a hierarchy built for every frame.",
        Rule {
            of: Measure::Own(from_triangles, &[OWN_MS]),
            is: Limit::Below(10_000.0),
            noise: Noise::Clock,
            shown: Shown::In("triangles"),
        },
        "where the two curves cross for the last time, between places as powers: real scenes have more.",
    ),
    claim(
        Paper::Ours,
        "",
        "The cost of beams grows more slowly than the number of triangles.",
        grows(Which::Named(BEAMS), OWN, Limit::Below(0.9)),
        "the power of the number of triangles: 1 is in step with it.",
    ),
    claim(
        Paper::Ours,
        "",
        "The cost of building a hierarchy grows in step with the number of triangles or faster.",
        grows(
            Which::Named(REBUILT),
            Term::Path(BUILD_CPU),
            Limit::Above(0.9),
        ),
        "the power of the number of triangles: 1 is in step with it.",
    ),
    claim(
        Paper::Ours,
        "",
        "What a ray costs in a hierarchy built once grows far more slowly than the number of triangles.",
        grows(Which::Named(STATIC), OWN, Limit::Below(0.5)),
        "the power of the number of triangles: the root of it is far more slowly.",
    ),
    claim(
        Paper::Ours,
        "",
        "With a million triangles beams take at most half of the time of building a hierarchy and tracing.",
        ratio(
            at(BEAMS, 999_698.0),
            at(REBUILT, 999_698.0),
            OWN,
            Limit::Below(0.5),
            Noise::Clock,
        ),
        "the time of beams over that of building on the CPU and tracing.",
    ),
    claim(
        Paper::Ours,
        "",
        "With a million triangles beams take more than twice the time of refitting and tracing.",
        ratio(
            at(BEAMS, 999_698.0),
            at(REFIT, 999_698.0),
            OWN,
            Limit::Above(2.0),
            Noise::Clock,
        ),
        "the time of beams over that of fitting boxes and tracing.",
    ),
    claim(
        Paper::Ours,
        "",
        "A refitted hierarchy costs more by its rays than by its boxes, up to a million triangles.",
        value(
            each(REFIT),
            Term::Quotient(REFIT_MS, OWN_MS),
            Limit::Below(0.5),
            Noise::Clock,
            Shown::Percent,
        ),
        "the share of the pass that fits boxes in what a refitted hierarchy costs: the rest is tracing.",
    ),
];

fn from_triangles(from: &dyn Numbers) -> Vec<Case> {
    crossover::case(from, [BEAMS, REBUILT], OWN)
}

pub(super) const PIXELS_GROW: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "The cost of beams grows more slowly than the mirror's pixels.",
        grows(Which::Named(BEAMS), OWN, Limit::Below(0.9)),
        "the power of the share of the picture: what does not depend on pixels is paid for a small mirror, too.",
    ),
    claim(
        Paper::Ours,
        "",
        "Beams lose their lead over a hierarchy built for every frame in no view.",
        cheaper(BEAMS, REBUILT),
        "the time of beams over that of building on the CPU and tracing, view by view.",
    ),
];

pub(super) const MIRRORS_GROW: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "The cost of beams grows no faster than the number of mirrors.",
        grows(Which::Named(BEAMS), OWN, Limit::Below(1.0)),
        "the power of the number of mirrors: like mirrors have that many times the pixels.",
    ),
    claim(
        Paper::Ours,
        "",
        "With eight mirrors cube maps cost more than three times what beams do.",
        ratio(
            last(MAPS),
            last(BEAMS),
            OWN,
            Limit::Above(3.0),
            Noise::Clock,
        ),
        "each mirror has maps of its own, which are drawn for each frame.",
    ),
];

pub(super) const MOTION: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "Where neighbours part, a refitted hierarchy makes each ray visit more than half as many nodes again.",
        ratio(
            at(REFIT, 3.0),
            at(REBUILT, 3.0),
            Term::Path(MOVED_NODES),
            Limit::Above(1.5),
            Noise::Share(0.01),
        ),
        "node tests in the last frame, over those of a hierarchy built for it.",
    ),
    claim(
        Paper::Ours,
        "",
        "Where things move as one or not at all, a refitted hierarchy is as good as a new one.",
        Rule {
            of: Measure::Own(moved_as_one, &[MOVED_NODES]),
            is: Limit::Below(1.1),
            noise: Noise::Share(0.01),
            shown: Shown::Times,
        },
        "node tests in the last frame, over those of a hierarchy built for it: a tenth more is as good.",
    ),
    claim(
        Paper::Ours,
        "",
        "Nothing that moves costs a pixel: in each frame beams are as exact.",
        value(
            of(Which::Named(BEAMS), Place::Each),
            Term::Path("temporal.object_agreement_min"),
            Limit::Above(0.999),
            Noise::Exact,
            Shown::Percent,
        ),
        "the worst frame: of some thousand pixels a few at edges may round otherwise.",
    ),
];

/// All places but the last, whose objects part.
fn moved_as_one(from: &dyn Numbers) -> Vec<Case> {
    let term = Term::Path(MOVED_NODES);
    let cases = [0.0, 1.0, 2.0].into_iter().filter_map(|x| {
        let [refit, built] =
            [REFIT, REBUILT].map(|series| term.read(from, series, x, Noise::Share(0.01)));
        let number: Interval = refit?.over(built?)?;
        Some(Case {
            label: from.place_name(x),
            number,
        })
    });
    cases.collect()
}

pub(super) const BOUNCES: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "With as many reflections as the truth follows, beams show what it shows.",
        value(
            of(EVERY, Place::Last),
            Term::Path(FULL_AGREEMENT),
            Limit::Above(0.9995),
            Noise::Exact,
            Shown::Percent,
        ),
        "of some thousand pixels two at edges may round otherwise.",
    ),
    claim(
        Paper::Ours,
        "",
        "Each further reflection costs less than the one before: eight take less than eight times the time of one.",
        ratio(
            of(EVERY, Place::Last),
            of(EVERY, Place::First),
            OWN,
            Limit::Below(8.0),
            Noise::Clock,
        ),
        "the time with eight reflections over that with one: fewer pixels are left at each.",
    ),
];

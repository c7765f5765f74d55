//! What the figures of the motion of reflections decide.

use crate::suites::claims::make::{claim, grows, ratio, value};
use crate::suites::claims::{
    Claim, Limit, Noise, Paper, Pick, Place, Shown, Term, Which, at, each, of,
};
use crate::suites::paths::{MOTION_EXCESS, MOTION_MISSING, MOTION_P50, MOTION_P95, MOTION_P99};

use super::labels::{FLAT, LENS, NEWTON, NEWTON_ANALYTIC, NEWTON_MESH, PLANE, SURFACE};

/// Two runs on one machine differ by nothing, on two adapters by rounding.
const ROUNDING: Noise = Noise::Share(0.05);

/// Each mirror but the flat one, on which the thin lens is exact.
const fn curved(series: &'static str) -> Pick {
    of(Which::Named(series), Place::RightOf(PLANE))
}

pub const MIRRORS: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "On a flat mirror the flat mirror's formula is exact.",
        value(
            at(FLAT.0, PLANE),
            Term::Path(MOTION_P99),
            Limit::Below(0.001),
            ROUNDING,
            Shown::In("px"),
        ),
        "the 99th percentile of the error: float32 leaves some 1e-4 px.",
    ),
    claim(
        Paper::Ours,
        "",
        "On a flat mirror the thin lens is exact.",
        value(
            at(LENS.0, PLANE),
            Term::Path(MOTION_P99),
            Limit::Below(0.001),
            ROUNDING,
            Shown::In("px"),
        ),
        "without curvature it is the flat mirror's formula.",
    ),
    claim(
        Paper::Ours,
        "",
        "On curved mirrors the thin lens that denoisers publish is off by a tenth of a pixel in the median.",
        value(
            curved(LENS.0),
            Term::Path(MOTION_P50),
            Limit::Above(0.1),
            ROUNDING,
            Shown::In("px"),
        ),
        "of a true motion of 4 pixels; a tenth of a pixel a frame blurs what is accumulated over ten frames \
         by a whole one.",
    ),
    claim(
        Paper::Ours,
        "",
        "On curved mirrors the surface's motion is farther off than the thin lens.",
        ratio(
            curved(SURFACE.0),
            curved(LENS.0),
            Term::Path(MOTION_P50),
            Limit::Above(1.0),
            ROUNDING,
        ),
        "the medians over each other.",
    ),
    claim(
        Paper::Ours,
        "",
        "Newton's method on the last frame's G-buffer is off by less than a twentieth of a pixel at 95 % of \
         the pixels.",
        value(
            each(NEWTON.0),
            Term::Path(MOTION_P95),
            Limit::Below(0.05),
            ROUNDING,
            Shown::In("px"),
        ),
        "three steps at 640×480; what is left is what the texels of a G-buffer resolve.",
    ),
    claim(
        Paper::Ours,
        "",
        "It leaves at most one pixel in a hundred without an answer.",
        value(
            each(NEWTON.0),
            Term::Path(MOTION_MISSING),
            Limit::Below(0.01),
            ROUNDING,
            Shown::Percent,
        ),
        "of the pixels whose true motion is known.",
    ),
    claim(
        Paper::Ours,
        "",
        "What a viewer sees of its errors is on curved mirrors at most a tenth of what he sees of the thin lens's.",
        ratio(
            curved(NEWTON.0),
            curved(LENS.0),
            Term::Path(MOTION_EXCESS),
            Limit::Below(0.1),
            ROUNDING,
        ),
        "FLIP of the reprojected picture beyond that of the true vectors, over each other.",
    ),
];

pub const STEPS: &[Claim] = &[
    claim(
        Paper::Ours,
        "",
        "The thin lens's error is a share of the motion: half the step, half the error.",
        grows(
            Which::Named(LENS.0),
            Term::Path(MOTION_P50),
            Limit::Between(0.8, 1.2),
        ),
        "the power by which the median error grows with the true motion: 1.",
    ),
    claim(
        Paper::Ours,
        "",
        "Newton's error stays below a twentieth of a pixel however long the step.",
        value(
            each(NEWTON.0),
            Term::Path(MOTION_P95),
            Limit::Below(0.05),
            ROUNDING,
            Shown::In("px"),
        ),
        "the 95th percentile, from a tenth of a pixel to thirty.",
    ),
];

pub const MESHES: &[Claim] = &[claim(
    Paper::Ours,
    "",
    "What Newton's method is off by on a mesh falls with the number of segments.",
    ratio(
        of(Which::Named(NEWTON_MESH), Place::First),
        of(Which::Named(NEWTON_MESH), Place::Last),
        Term::Path(MOTION_P95),
        Limit::Above(2.0),
        ROUNDING,
    ),
    "the 95th percentile with the fewest segments over that with the most: twice is plain.",
)];

pub const DERIVATIVES: &[Claim] = &[claim(
    Paper::Ours,
    "",
    "With the exact surface Newton's method is off by less than with the G-buffer.",
    ratio(
        each(NEWTON_ANALYTIC.0),
        each(NEWTON.0),
        Term::Path(MOTION_P95),
        Limit::Below(1.0),
        ROUNDING,
    ),
    "the 95th percentiles over each other.",
)];

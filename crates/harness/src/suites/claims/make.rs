//! Claims in one line each: what most rules have in common.

use super::numbers::{Noise, Pick, Term, Which};
use super::rule::{Limit, Measure, Rule, Shown};
use super::{Claim, Paper};

/// A claim.
pub const fn claim(
    paper: Paper,
    section: &'static str,
    says: &'static str,
    rule: Rule,
    why: &'static str,
) -> Claim {
    Claim {
        paper,
        section,
        says,
        rule,
        why,
    }
}

/// One number over another.
pub const fn ratio(one: Pick, other: Pick, term: Term, is: Limit, noise: Noise) -> Rule {
    Rule {
        of: Measure::Ratio(one, other, term),
        is,
        noise,
        shown: Shown::Times,
    }
}

/// One share less another.
pub const fn difference(one: Pick, other: Pick, term: Term, is: Limit, noise: Noise) -> Rule {
    Rule {
        of: Measure::Difference(one, other, term),
        is,
        noise,
        shown: Shown::Percent,
    }
}

/// A number by itself.
pub const fn value(pick: Pick, term: Term, is: Limit, noise: Noise, shown: Shown) -> Rule {
    Rule {
        of: Measure::Value(pick, term),
        is,
        noise,
        shown,
    }
}

/// The power by which series grow.
pub const fn grows(which: Which, term: Term, is: Limit) -> Rule {
    Rule {
        of: Measure::Power(which, term),
        is,
        noise: Noise::Exact,
        shown: Shown::Power,
    }
}

/// The least ratio from place to place.
pub const fn least_step(which: Which, term: Term, is: Limit, noise: Noise) -> Rule {
    Rule {
        of: Measure::LeastStep(which, term),
        is,
        noise,
        shown: Shown::Times,
    }
}

/// The greatest ratio from place to place.
pub const fn greatest_step(which: Which, term: Term, is: Limit, noise: Noise) -> Rule {
    Rule {
        of: Measure::GreatestStep(which, term),
        is,
        noise,
        shown: Shown::Times,
    }
}

/// The same difference, in pixels.
pub const fn pixels(one: Pick, other: Pick, term: Term, is: Limit, noise: Noise) -> Rule {
    Rule {
        shown: Shown::In("px"),
        ..difference(one, other, term, is, noise)
    }
}

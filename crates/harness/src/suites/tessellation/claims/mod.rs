//! What both papers say about splitting the reflected triangles.

use crate::suites::claims::make::{difference, pixels};
use crate::suites::claims::{Limit, Noise, Paper, Pick, Rule, Term};
use crate::suites::paths::{AGREEMENT, DRAWN, EDGES, FRAME_MS, SEARCHED};

mod square;
mod table;

pub use square::{
    CRACK, DYNAMIC, HIERARCHY, LEVELS, REFLECTORS, SIZE, STRAIGHT, VISIBLE, WIREFRAMES,
};
pub use table::{COUNTS, FACETS, OBJECTS, TABLE, THRESHOLDS};

const T13: Paper = Paper::Szabo2013;
const C13: Paper = Paper::SzaboCescg;

const RIGHT: Term = Term::Path(AGREEMENT);
const OFF: Term = Term::Path(EDGES);
const FRAME: Term = Term::Path(FRAME_MS);
const TRIANGLES: Term = Term::Path(DRAWN);
const SEARCHES: Term = Term::Path(SEARCHED);

/// A pixel in a thousand may round either way.
const ROUNDING: Noise = Noise::Plus(0.001);
const EDGE_NOISE: Noise = Noise::Plus(0.05);
const HUNDREDTH: &str =
    "one mirror pixel in a hundred is what can be told; one in a thousand may round either way.";
const HALF: &str = "half a pixel at the edges is what can be told.";
const FASTER: &str = "below 1 it is faster; what the medians' intervals leave open is undecided.";
const COUNTED: &str = "counted exactly.";

/// Techniques that are alike show equally many right pixels: the first share less the second.
const fn alike(one: Pick, other: Pick) -> Rule {
    difference(one, other, RIGHT, Limit::Between(-0.01, 0.01), ROUNDING)
}

/// What is alike has its edges in the same places.
const fn edges_alike(one: Pick, other: Pick) -> Rule {
    pixels(one, other, OFF, Limit::Between(-0.5, 0.5), EDGE_NOISE)
}

//! What the thesis of 2017 says about tracing through cube maps.

use crate::suites::claims::{EVERY, Noise, Paper, Pick, Place, Term, of};
use crate::suites::paths::{AGREEMENT, FRAME_MS, FULL_AGREEMENT, SAMPLES, TRACE_MS, UNRESOLVED};

mod parameters;
mod table;

pub use parameters::{
    BOUNCES, CRITERIA, FACES, FILLINGS, OBJECTS, PYRAMIDS, REBUILD, RESULTS, SAMPLINGS, STAGES,
    STEPS,
};
pub use table::{CAPABILITIES, GRID, GROWS, TABLE};

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
const SAMPLES_COUNTED: &str = "samples of a mirror pixel are counted.";

/// In every series, the point that stands there.
const fn every(place: usize) -> Pick {
    of(EVERY, Place::At(place as f64))
}

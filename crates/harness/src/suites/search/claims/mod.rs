//! What the thesis of 2013 says about its two searches.

use crate::suites::claims::Paper;

mod cost;
mod exactness;

pub use cost::{FULL_VIEW, GENERAL_VIEW, MIRRORS, OBJECTS, SCENE, SMALL};
pub use exactness::{EXACTNESS, EXAMPLES, FACTORS, HIDDEN, MOTION, NEAR, STOPS};

const T13: Paper = Paper::Szabo2013;

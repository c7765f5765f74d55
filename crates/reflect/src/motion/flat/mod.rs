//! `motion-flat`: the motion of the virtual image behind the tangent plane: a flat mirror's.

use super::Recipe;
use crate::options::options;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct Flat {}
}

impl Named for Flat {
    const INFO: Info = Info {
        name: "motion-flat",
        what: "motion of the virtual image behind the tangent plane",
        paper: "baseline",
    };
}

impl Recipe for Flat {
    fn program(&self) -> &'static str {
        "motion/flat"
    }
}

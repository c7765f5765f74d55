//! `motion-surface`: the motion of the mirror's surface: the reflection as if painted on it.

use super::Recipe;
use crate::options::options;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct Surface {}
}

impl Named for Surface {
    const INFO: Info = Info {
        name: "motion-surface",
        what: "motion of the mirror's surface, as if painted on it",
        paper: "baseline",
    };
}

impl Recipe for Surface {
    fn program(&self) -> &'static str {
        "motion/surface"
    }
}

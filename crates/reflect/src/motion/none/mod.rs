//! `motion-none`: no motion at all: the reflection is taken to stay where it is in the image.

use super::Recipe;
use crate::options::options;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct None {}
}

impl Named for None {
    const INFO: Info = Info {
        name: "motion-none",
        what: "no motion: the reflection stays where it is",
        paper: "baseline",
    };
}

impl Recipe for None {
    fn program(&self) -> &'static str {
        "motion/none"
    }
}

//! Full tessellation: every triangle is split `level` times (Szabo 2013, chapter 5), but for those
//! that are hidden by all their corners.

use catoptric_scene::Scene;

use super::tessellation::{DEEPEST, Rule, Tessellation};
use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::options::options;
use crate::technique::{Info, Named, Properties};

options! {
    /// The refinement, as its options describe it.
    pub(crate) struct Full {
        /// how often every triangle is split that is not hidden
        level: u32 = 3 in 0..=DEEPEST,
    }
}

impl Named for Full {
    const INFO: Info = Info {
        name: "+full",
        what: "splits every triangle",
        paper: "Szabo 2013",
    };
}

impl Full {
    pub(crate) fn rule(self) -> Rule {
        Rule {
            level: self.level,
            threshold: None,
        }
    }
}

impl Recipe for Full {
    fn objection(&self, scene: &Scene) -> Option<String> {
        self.rule().objection(scene)
    }

    fn properties(&self) -> Properties {
        Rule::PROPERTIES
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
        Ok(Box::new(Tessellation::new(context, self.rule())?))
    }
}

//! Adaptive tessellation: a triangle is split while the error of one of its edges reaches
//! `threshold`, at most `level` times (Szabo 2013, chapter 5; Szabo CESCG, section 4.2).

use catoptric_scene::Scene;

use super::tessellation::{DEEPEST, Rule, Tessellation};
use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::options::options;
use crate::technique::{Info, Named, Properties};

options! {
    /// The refinement, as its options describe it.
    pub(crate) struct Adaptive {
        /// how often a triangle may be split
        level: u32 = 5 in 0..=DEEPEST,
        /// edge error from which a triangle is split: sin²(δ/2) of the angle δ by which the
        /// mirror's normal at the middle misses; 0 splits all, 1 none
        threshold: f64 = 0.001 in 0.0..=1.0,
    }
}

impl Named for Adaptive {
    const INFO: Info = Info {
        name: "+adaptive",
        what: "splits where the edge error is large",
        paper: "Szabo 2013",
    };
}

impl Adaptive {
    pub(crate) fn rule(self) -> Rule {
        Rule {
            level: self.level,
            threshold: Some(self.threshold as f32),
        }
    }
}

impl Recipe for Adaptive {
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

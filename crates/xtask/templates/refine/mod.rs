//! A refinement to begin with: every triangle is split into four, once or more often.

use catoptric_scene::Scene;

use super::tessellation::{Rule, Tessellation};
use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::options::options;
use crate::technique::{Info, Named, Properties};

options! {
    pub(crate) struct TemplateName {
        /// how often every triangle is split
        times: u32 = 1 in 1..=4,
    }
}

impl Named for TemplateName {
    const INFO: Info = Info {
        name: "+template-name",
        what: "splits every triangle into four",
        paper: "this project",
    };
}

impl TemplateName {
    fn rule(&self) -> Rule {
        Rule {
            level: self.times,
            threshold: None,
        }
    }
}

impl Recipe for TemplateName {
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

#[cfg(test)]
mod tests {
    use crate::parse;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn splitting_again_draws_more_triangles() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-square");
        let [once, twice] = [1, 2].map(|times| {
            let spec = format!("linear+template-name(times={times})");
            let spec = parse(&spec).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
            let output = prepared.render().expect("renders");
            output.triangles.expect("triangles that are drawn").drawn
        });
        assert!(0 < once && once < twice, "{once}, then {twice}");
    }
}

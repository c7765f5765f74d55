//! A search to begin with: of the mirror's texels on a lattice it takes the one whose normal fits
//! best. Exact to about half the lattice's spacing, and slow.

use super::start::{FromStart, Start};
use super::{Context, Recipe, Search};
use crate::error::ReflectError;
use crate::options::{options, words};
use crate::technique::{Info, Named};

words! {
    /// How far the texels that are looked at lie apart.
    pub(crate) enum Spacing {
        Eight = "8",
        Four = "4",
    }
}

options! {
    pub(crate) struct TemplateName {
        /// texels from one that is looked at to the next, along each axis
        spacing: Spacing,
    }
}

impl Named for TemplateName {
    const INFO: Info = Info {
        name: "template-name",
        what: "the best texel of a lattice",
        paper: "this project",
    };
}

impl Recipe for TemplateName {
    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        let features = [
            (self.spacing == Spacing::Four, "four"),
            (context.extends, "extend"),
        ];
        let features = features
            .into_iter()
            .filter_map(|(on, name)| on.then_some(name));
        let features: Vec<_> = features.collect();
        let search = FromStart::new(context, Start::Center, "template_name", &features)?;
        Ok(Box::new(search))
    }
}

#[cfg(test)]
mod tests {
    use crate::parse;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn half_the_spacing_takes_four_times_the_evaluations() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        let [coarse, fine] = ["8", "4"].map(|spacing| {
            let spec = parse(&format!("template-name(spacing={spacing})")).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
            let work = prepared.render().expect("renders").work;
            work.evaluations.expect("a search that evaluates")
        });
        assert!((3.0..5.0).contains(&(fine / coarse)), "{fine} to {coarse}");
    }
}

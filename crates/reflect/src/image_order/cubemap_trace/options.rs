//! The options, and which of them go together.

use std::fmt::Display;

use crate::image_order::cubemaps::{MapOptions, MirrorsIn};
use crate::options::{Words, options, words};

words! {
    /// Where a mirror's maps are taken from.
    pub(crate) enum Placement {
        /// Of random candidates those that resolve the most pixels.
        Auto = "auto",
        /// Random candidates, no more than are needed.
        Random = "random",
        /// Its places in the scene file.
        Scene = "scene",
    }
}

words! {
    /// Maps of each mirror.
    pub(crate) enum Objects {
        Two = "2",
        One = "1",
        Three = "3",
        Four = "4",
        Five = "5",
        Six = "6",
        Seven = "7",
        Eight = "8",
        /// As many as are worth it, up to eight.
        Auto = "auto",
    }
}

impl Objects {
    /// How many; `None` for as many as are worth it.
    pub(crate) fn number(self) -> Option<usize> {
        match self {
            Self::One => Some(1),
            Self::Two => Some(2),
            Self::Three => Some(3),
            Self::Four => Some(4),
            Self::Five => Some(5),
            Self::Six => Some(6),
            Self::Seven => Some(7),
            Self::Eight => Some(8),
            Self::Auto => None,
        }
    }
}

words! {
    /// What counts as a hit. Δ is a sample's distance from the map's centre less the distance that
    /// the map holds in its direction.
    pub(crate) enum Criterion {
        /// A sign change of Δ.
        Analytic = "analytic",
        /// A small Δ.
        Distance = "distance",
        /// A small Δ, or else the first sign change.
        Both = "both",
        /// Either, by how much the ray turns as seen from the centre.
        Switch = "switch",
    }
}

words! {
    /// Which sign changes of Δ count.
    pub(crate) enum Accept {
        /// Where the map is continuous, of a map that hides nothing before them if there is one.
        Continuous = "continuous",
        Any = "any",
    }
}

words! {
    /// Where a ray is looked at.
    pub(crate) enum Sampling {
        /// At even steps.
        Step = "step",
        /// At even angles, seen from the map's centre.
        Angle = "angle",
        /// Once in each texel, for all of the ray's way through it.
        Texel = "texel",
        /// Once in each texel, where the ray enters it.
        Entry = "texel-entry",
    }
}

words! {
    /// How cells of the pyramid are skipped.
    pub(crate) enum Skipping {
        Off = "off",
        /// By the ray's distances at the cell's ends.
        Published = "published",
        /// By the distances of the ray's nearest and farthest point in the cell.
        Sound = "sound",
    }
}

words! {
    /// What follows the rays.
    pub(crate) enum ShaderStage {
        /// A fragment a ray.
        Fragment = "fragment",
        /// 32 lanes a ray.
        Compute = "compute",
    }
}

words! {
    /// How the lanes of a ray agree.
    pub(crate) enum Agreement {
        /// By ballots of subgroups, where the adapter has these.
        Ballot = "ballot",
        /// Lane by lane in workgroup memory.
        Memory = "memory",
    }
}

words! {
    /// How a ray gets off the mirror that it starts on.
    pub(crate) enum Restart {
        /// By the bias.
        Bias = "bias",
        /// No hit counts before a sample that is clear of the surface.
        Clear = "clear",
    }
}

words! {
    /// What colour a ray takes from the map where it meets something.
    pub(crate) enum Filter {
        /// The texel's.
        Nearest = "nearest",
        /// Blended between the four nearest texels.
        Linear = "linear",
    }
}

words! {
    /// What a pixel shows that no map resolves.
    pub(crate) enum Unresolved {
        /// That it is unresolved.
        Mark = "mark",
        /// What a map from the mirror's centre holds in the reflected direction.
        Environment = "environment",
        Background = "background",
        /// What its resolved neighbours show.
        Neighbours = "neighbours",
        /// The sample with the smallest Δ.
        Best = "best",
        /// What the ray tracer finds.
        Trace = "trace",
    }
}

options! {
    pub(crate) struct CubemapTrace {
        /// cube maps of each mirror; auto (ours): with another one, up to eight, as long as it resolves 0.2 % of the mirror's pixels more, placed anew when the view has moved
        objects: Objects,
        /// where the maps are taken from: of random candidates those that resolve the most pixels, or just as many as are needed, or the mirror's `cubemaps` in the scene file
        placement: Placement,
        /// what counts as a hit: a sign change of the distance to the map, a small one, a small one or else the first sign change, or either by how much the ray turns
        criterion: Criterion,
        /// which sign changes count: those where the map is continuous, of a map that hides nothing before them if there is one (ours), or any, as published
        accept: Accept,
        /// where a ray is looked at: at even steps, at even angles, or once in each texel: for all of its way through it (ours), or where it enters, as published
        sampling: Sampling,
        /// skipping by least and greatest distances: none, by those at a cell's ends, or by the ray's nearest point
        pyramid: Skipping,
        /// one fragment a ray, or 32 lanes a ray that test the cells of a level at once (and thereby each texel once)
        stage: ShaderStage,
        /// how the lanes of a ray agree (stage=compute): by the ballots of subgroups, where the adapter has these, or lane by lane in workgroup memory
        agree: Agreement,
        /// length of a ray, in diagonals of the scene
        length: f64 = 2.0 in 0.01..=100.0,
        /// step, as a share of the ray's length (or of its angle)
        step: f64 = 0.001 in 0.000_02..=0.5,
        /// largest distance that counts as a hit, in steps (criterion=distance)
        limit: f64 = 1.5 in 0.0..=1000.0,
        /// cosine of the angle, seen from the map's centre, from which on a ray counts as turning: the distance decides (criterion=switch)
        turn: f64 = 0.7 in -1.0..=1.0,
        /// coarsest level of the pyramid; level k has 2^k cells a side
        from: u32 = 2 in 0..=10,
        /// finest level of the pyramid
        to: u32 = 6 in 0..=10,
        /// rays followed from a pixel; more than one shows mirrors in mirrors
        bounces: u32 = 1 in 1..=16,
        /// where maps show the mirrors (bounces): among the objects, which hides what is behind them; or apart in maps of their own (ours), the nearer of both hits counting, where backs of mirrors are not met
        mirrors: MirrorsIn,
        /// share of a second ray's length at which it starts (bounces), 0: by the width of a texel, for all rays
        bias: f64 = 0.0 in 0.0..=0.5,
        /// how a ray gets off the mirror (bounces): by the bias, or no hit counts before a sample that is clear of the surface
        restart: Restart,
        /// what colour is taken from a map: that of the texel, or blended between the four nearest
        filter: Filter,
        /// what a pixel shows that no map resolves
        unresolved: Unresolved,
        ..maps: MapOptions,
    }
}

impl CubemapTrace {
    /// Rays are followed from mirror to mirror: where the maps show the mirrors.
    pub(crate) fn mirrors_in(&self) -> Option<MirrorsIn> {
        (self.bounces > 1).then_some(self.mirrors)
    }

    /// The same if it is among the objects.
    pub(crate) fn among(&self) -> Option<MirrorsIn> {
        self.mirrors_in().filter(|shown| *shown == MirrorsIn::Among)
    }

    /// Why compute shaders cannot follow rays so.
    pub(crate) fn objection(&self) -> Option<String> {
        use {Criterion as C, Sampling as S, Skipping as P, Unresolved as U};
        if self.stage == ShaderStage::Fragment {
            return None;
        }
        unless("criterion", self.criterion, &[C::Analytic, C::Distance])
            .or_else(|| unless("sampling", self.sampling, &[S::Step, S::Texel]))
            .or_else(|| unless("pyramid", self.pyramid, &[P::Off, P::Sound]))
            .or_else(|| (self.bounces > 1).then(|| lacks("bounces", self.bounces, 1)))
            .or_else(|| unless("filter", self.filter, &[Filter::Nearest]))
            .or_else(|| unless("unresolved", self.unresolved, &[U::Mark, U::Background]))
    }
}

/// That compute shaders lack the value of an option, unless it is one that they have.
fn unless<T: Words + PartialEq>(option: &str, value: T, have: &[T]) -> Option<String> {
    let only: Vec<_> = have.iter().map(|value| value.word()).collect();
    let lacks = || lacks(option, value.word(), only.join(", "));
    (!have.contains(&value)).then(lacks)
}

fn lacks(option: &str, value: impl Display, only: impl Display) -> String {
    format!("stage=compute has no {option}={value}, only {only}")
}

#[cfg(test)]
mod tests {
    use super::Objects;
    use crate::options::Words;
    use crate::testing::scene;
    use crate::{Support, parse, supports};

    #[test]
    fn a_number_of_maps_is_what_it_is_written_as() {
        for (objects, word) in Objects::ALL.iter().zip(Objects::WORDS) {
            let number = objects.number().map(|number| number.to_string());
            assert_eq!(number.as_deref().unwrap_or("auto"), *word);
        }
    }

    #[test]
    fn compute_shaders_name_what_they_lack() {
        let scene = scene("sphere-table");
        let objection = |options: &str| {
            let spec = parse(&format!("cubemap-trace({options})")).expect("a technique");
            match supports(&spec, &scene) {
                Support::Yes => String::new(),
                Support::No(reason) => reason,
            }
        };
        for (option, only) in [
            ("criterion=both", "analytic, distance"),
            ("criterion=switch", "analytic, distance"),
            ("sampling=angle", "step, texel"),
            ("sampling=texel-entry", "step, texel"),
            ("filter=linear", "nearest"),
            ("pyramid=published", "off, sound"),
            ("bounces=3", "1"),
            ("unresolved=environment", "mark, background"),
        ] {
            assert_eq!(objection(option), "");
            assert_eq!(
                objection(&format!("stage=compute,{option}")),
                format!("stage=compute has no {option}, only {only}")
            );
        }
        let others = "criterion=distance,sampling=texel,pyramid=sound,unresolved=background";
        assert_eq!(objection(&format!("stage=compute,{others}")), "");
    }
}

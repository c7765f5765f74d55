//! Linear screen-space search (Szabo 2013, Alg. 3.2 and 3.3; Szabo CESCG, Alg. 2).

#[cfg(test)]
mod twin;

use super::start::{FromStart, Start};
use super::{Context, Recipe, Search};
use crate::error::ReflectError;
use crate::options::{options, words};
use crate::technique::{Info, Named, Properties};

words! {
    /// How many texels are compared with in each step.
    pub(crate) enum Neighbours {
        Four = "4",
        Eight = "8",
    }
}

words! {
    /// How well a texel fits, between its normal and the bisector.
    pub(crate) enum Residual {
        /// By their scalar product.
        Dot = "dot",
        /// By the length of their cross product.
        Cross = "cross",
    }
}

options! {
    /// The search, as its options describe it.
    pub(crate) struct Linear {
        /// where the walk starts: the mirror's projected centre, its projected bounding box's, or
        /// the previous frame's answer
        start: Start,
        /// texels compared with in each step
        neighbours: Neighbours,
        /// the measure of a texel's fitness
        residual: Residual,
    }
}

impl Named for Linear {
    const INFO: Info = Info {
        name: "linear",
        what: "linear screen-space search",
        paper: "Szabo 2013",
    };
}

impl Recipe for Linear {
    fn properties(&self) -> Properties {
        Properties {
            walks: true,
            carries_over: self.start == Start::Previous,
            ..Properties::default()
        }
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
        let features = [
            (self.residual == Residual::Cross, "cross"),
            (self.neighbours == Neighbours::Eight, "eight"),
            (context.extends, "extend"),
        ];
        let features = features
            .into_iter()
            .filter_map(|(on, name)| on.then_some(name));
        let features: Vec<_> = features.collect();
        let search = FromStart::new(context, self.start, "linear", &features)?;
        Ok(Box::new(search))
    }
}

#[cfg(test)]
mod tests {
    use crate::parse;
    use crate::testing::{gpu_or_skip, scene};

    #[test]
    fn a_still_camera_needs_one_step_from_the_second_frame_on() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        for technique in [
            "linear(start=previous)",
            "linear(start=previous,neighbours=8)",
        ] {
            let spec = parse(technique).expect("a technique");
            let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
            let [first, second, third] = [(); 3].map(|()| prepared.render().expect("renders"));
            assert!(
                first.work.steps > Some(5.0),
                "{technique}: {:?}",
                first.work
            );
            for later in [second, third] {
                assert_eq!(later.work.steps, Some(1.0), "{technique}");
                assert!(
                    later.work.evaluations.is_some_and(|count| count <= 9.0),
                    "{technique}: {:?}",
                    later.work
                );
                let places = |output: &crate::Output| {
                    let vertices = output.vertices.iter().flatten();
                    vertices
                        .map(|vertex| (vertex.at, vertex.state))
                        .collect::<Vec<_>>()
                };
                assert_eq!(places(&later), places(&first), "{technique}");
            }
        }
    }

    #[test]
    fn a_slow_camera_needs_few_steps() {
        let Some(gpu) = gpu_or_skip() else { return };
        let scene = scene("sphere-objects-1k");
        let spec = parse("linear(start=previous)").expect("a technique");
        let mut prepared = crate::prepare(&gpu, &spec, &scene, [160, 120]).expect("fits");
        let first = prepared
            .render()
            .expect("renders")
            .work
            .steps
            .expect("a search that steps");
        for frame in 1..4 {
            prepared
                .update(&scene.at(frame))
                .expect("the same scene, moved");
            let steps = prepared
                .render()
                .expect("renders")
                .work
                .steps
                .expect("a search that steps");
            assert!(
                (1.0..0.1 * first).contains(&steps),
                "frame {frame}: {steps} of {first}"
            );
        }
    }
}

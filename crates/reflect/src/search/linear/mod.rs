//! Linear screen-space search (Szabo 2013, Alg. 3.2 and 3.3; Szabo CESCG, Alg. 2).

#[cfg(test)]
mod twin;

use super::start::FromStart;
use super::{Context, Search};
use crate::error::ReflectError;

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    let options = context.options;
    let mut features = Vec::new();
    if options.is("residual", "cross") {
        features.push("cross");
    }
    if options.is("neighbours", "8") {
        features.push("eight");
    }
    if options.is("hidden", "extend") {
        features.push("extend");
    }
    Ok(Box::new(FromStart::new(context, "linear", &features)?))
}

#[cfg(test)]
mod tests {
    use crate::spec::parse;
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

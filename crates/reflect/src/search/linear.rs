//! Linear screen-space search (Szabo 2013, Alg. 3.2 and 3.3; Szabo CESCG, Alg. 2).

use super::start::Starts;
use super::{Context, Pipelines, Search};
use crate::ReflectError;
use crate::gpu::Gpu;
use crate::points::Points;
use crate::recorder::Recorder;
use crate::stage::Stage;
use crate::technique::Variant;

struct Linear {
    from_previous: bool,
    starts: Starts,
    pipelines: Pipelines,
}

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
    let starts = Starts::new(context)?;
    Ok(Box::new(Linear {
        from_previous: options.is("start", "previous"),
        pipelines: Pipelines::new(context, "linear", &features, &starts.layout)?,
        starts,
    }))
}

impl Search for Linear {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        self.starts.update(gpu, stage);
    }

    fn begin_frame(&mut self, gpu: &Gpu) {
        self.starts.begin_frame(gpu);
    }

    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        self.starts.record(frame, stage);
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        mirror: usize,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.starts.groups[mirror];
        (self.pipelines).record(frame, (stage, mirror), points, own, variant);
    }

    fn uses_previous(&self) -> bool {
        self.from_previous
    }
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

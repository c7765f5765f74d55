//! Newton's method on the G-buffer, between pixels: the field of tangential parts of the bisector
//! is 0 at a reflection point, and its derivatives follow from those of position and normal.
//! Sub-pixel answers from the same buffers that the published searches read.

use super::start::Starts;
use super::{Context, Pipelines, Search};
use crate::ReflectError;
use crate::gpu::Gpu;
use crate::points::Points;
use crate::recorder::Recorder;
use crate::stage::Stage;
use crate::technique::Variant;

struct Newton {
    from_previous: bool,
    starts: Starts,
    pipelines: Pipelines,
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Search>, ReflectError> {
    let options = context.options;
    let starts = Starts::new(context)?;
    let mut features = Vec::new();
    if options.is("hidden", "extend") {
        features.push("extend");
    }
    Ok(Box::new(Newton {
        from_previous: options.is("start", "previous"),
        pipelines: Pipelines::new(context, "newton", &features, &starts.layout)?,
        starts,
    }))
}

impl Search for Newton {
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

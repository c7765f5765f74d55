//! GPU time of passes, measured from END stamp to END stamp.
//!
//! Stamps at a pass's beginning are not trusted (a software driver gets them wrong once a render pass
//! has run). The first pass lasts from a lone stamp before it. That stamp is submitted with the frame,
//! after everything submitted before has run: neither uploads nor the recording of the frame count. If
//! passes that do not depend on each other overlap, the time of both counts for the one that ends
//! first.

use super::device::Gpu;
use super::recorder::Recorder;
use super::stamps::Stamps;

/// Times of one frame.
#[derive(Clone, Debug)]
pub struct FrameTime {
    /// Sum of the passes, milliseconds; `None` where the adapter cannot tell.
    pub gpu_ms: Option<f64>,
    /// Name and milliseconds of each pass, in order, passes of one name added up; `None` with a
    /// reason.
    pub passes: Option<Vec<(String, f64)>>,
    /// Why `passes` is `None`.
    pub passes_reason: Option<String>,
    /// From before the submission until the queue is empty, milliseconds.
    pub wall_ms: f64,
    /// On the CPU before that, to build what the frame traces, milliseconds; `None` where nothing
    /// is built for each frame.
    pub build_ms: Option<f64>,
}

/// Share of the wall time by which the sum of the passes may differ from it, apart from the time of an
/// empty submission.
const PASSES_MISS_WALL: f64 = 0.1;

/// Empty submissions that are timed for the median.
const EMPTY: usize = 5;

/// Times frames.
#[derive(Debug)]
pub(crate) struct Timer {
    stamps: Stamps,
    /// For the lone stamp: some drivers stamp no pass that does nothing.
    idle: Option<wgpu::ComputePipeline>,
    /// Wall time of a submission with nothing but the lone stamp, milliseconds.
    latency_ms: f64,
    /// The last stamp of the frame before; 0 before the first.
    last: u64,
}

impl Timer {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let set = gpu.info().timestamps.then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("end stamps"),
                ty: wgpu::QueryType::Timestamp,
                count: Stamps::CAPACITY,
            })
        });
        let mut timer = Self {
            idle: set.is_some().then(|| idle(gpu)),
            stamps: Stamps::new(set),
            latency_ms: 0.0,
            last: 0,
        };
        let mut empty = [(); EMPTY].map(|()| {
            let commands = timer.lone_stamp(gpu);
            gpu.wait();
            let begin = std::time::Instant::now();
            gpu.queue.submit([commands]);
            gpu.wait();
            begin.elapsed().as_secs_f64() * 1e3
        });
        empty.sort_by(f64::total_cmp);
        timer.latency_ms = empty[EMPTY / 2];
        timer
    }

    /// Commands that end with stamp 0 and do nothing else.
    fn lone_stamp(&self, gpu: &Gpu) -> wgpu::CommandBuffer {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        if let (Some(stamps), Some(idle)) = (self.stamps.set(), &self.idle) {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("lone stamp"),
                timestamp_writes: Some(wgpu::ComputePassTimestampWrites {
                    query_set: stamps,
                    beginning_of_pass_write_index: None,
                    end_of_pass_write_index: Some(0),
                }),
            });
            pass.set_pipeline(idle);
            pass.dispatch_workgroups(1, 1, 1);
        }
        encoder.finish()
    }

    /// Times a frame whose passes `record` records.
    pub(crate) fn time(&mut self, gpu: &Gpu, record: impl FnOnce(&mut Recorder<'_>)) -> FrameTime {
        self.stamps.clear();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        record(&mut Recorder::new(&mut encoder, &mut self.stamps));
        let commands = [self.lone_stamp(gpu), encoder.finish()];
        // Uploads that wait for a submission have one of their own.
        gpu.queue.submit([]);
        gpu.wait();
        let begin = std::time::Instant::now();
        gpu.queue.submit(commands);
        gpu.wait();
        let wall_ms = begin.elapsed().as_secs_f64() * 1e3;
        let without = |reason: String| FrameTime {
            gpu_ms: None,
            passes: None,
            passes_reason: Some(reason),
            wall_ms,
            build_ms: None,
        };
        let Some(stamps) = self.stamps.set() else {
            return without("the adapter has no timestamps".to_owned());
        };
        let count = self.stamps.names().len() as u32 + 1;
        if count > Stamps::CAPACITY {
            return without(format!(
                "{count} passes are more than the {} that can be timed",
                Stamps::CAPACITY
            ));
        }
        let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("stamps"),
            size: u64::from(count) * 8,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.resolve_query_set(stamps, 0..count, &resolved, 0);
        gpu.queue.submit([encoder.finish()]);
        let ticks: Vec<u64> = gpu
            .read_buffer(&resolved)
            .chunks_exact(8)
            .map(bytemuck::pod_read_unaligned)
            .collect();
        let period = f64::from(gpu.queue.get_timestamp_period()) * 1e-6;
        let before = std::mem::replace(&mut self.last, ticks.last().copied().unwrap_or_default());
        if let Err(reason) = judge(&ticks, self.stamps.names(), before, period) {
            return without(reason);
        }
        let mut passes: Vec<(String, f64)> = Vec::new();
        for (name, pair) in self.stamps.names().iter().zip(ticks.windows(2)) {
            let time = (pair[1] - pair[0]) as f64 * period;
            match passes.iter_mut().find(|(known, _)| known == name) {
                Some((_, sum)) => *sum += time,
                None => passes.push((name.clone(), time)),
            }
        }
        let sum: f64 = passes.iter().map(|(_, ms)| ms).sum();
        if (sum - wall_ms).abs() > PASSES_MISS_WALL * wall_ms + self.latency_ms {
            return FrameTime {
                gpu_ms: Some(sum),
                ..without(format!(
                    "the passes add up to {sum:.2} ms, the wall clock says {wall_ms:.2}"
                ))
            };
        }
        FrameTime {
            gpu_ms: Some(sum),
            passes: Some(passes),
            passes_reason: None,
            wall_ms,
            build_ms: None,
        }
    }
}

/// Ticks that are finer than this, in milliseconds, tell any two passes apart.
const FINE_TICK_MS: f64 = 1e-3;

/// Whether the stamps of a frame can be believed: stamp 0 is the lone one, stamp `i + 1` ends pass `i`.
/// `before` is the last stamp of the frame before, which had been waited for.
///
/// # Errors
/// Why they cannot.
fn judge(ticks: &[u64], names: &[String], before: u64, period_ms: f64) -> Result<(), String> {
    let what = |index: usize| match index.checked_sub(1).and_then(|pass| names.get(pass)) {
        Some(name) => format!("the end of pass `{name}`"),
        None => "the start".to_owned(),
    };
    if ticks.iter().all(|tick| *tick == 0) {
        return Err("all stamps are zero: the driver writes none".to_owned());
    }
    if let Some(index) = ticks.iter().position(|tick| *tick == 0) {
        return Err(format!("the stamp of {} is zero", what(index)));
    }
    if let Some(index) = ticks.iter().position(|tick| *tick <= before) {
        return Err(format!(
            "the stamp of {} is of an earlier frame",
            what(index)
        ));
    }
    if let Some(index) = ticks.windows(2).position(|pair| pair[1] < pair[0]) {
        return Err(format!(
            "the stamp of {} is earlier than that of {}",
            what(index + 1),
            what(index)
        ));
    }
    if ticks.len() > 1 && ticks.first() == ticks.last() {
        return Err("all stamps are the same: the passes share a start".to_owned());
    }
    let shared = ticks.windows(2).position(|pair| pair[0] == pair[1]);
    match shared.filter(|_| period_ms < FINE_TICK_MS) {
        Some(index) => Err(format!(
            "the stamps of {} and of {} are the same: the passes share a start",
            what(index),
            what(index + 1)
        )),
        None => Ok(()),
    }
}

/// A pipeline that does nothing.
fn idle(gpu: &Gpu) -> wgpu::ComputePipeline {
    let source = "@compute @workgroup_size(1) fn idle() {}";
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("idle"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("idle"),
            layout: None,
            module: &module,
            entry_point: Some("idle"),
            compilation_options: Default::default(),
            cache: None,
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1e-6;

    fn judged(ticks: &[u64], before: u64) -> Result<(), String> {
        let names = ["gbuffer", "search", "draw"].map(str::to_owned);
        judge(ticks, &names, before, PERIOD)
    }

    #[test]
    fn stamps_that_follow_each_other_are_believed() {
        assert_eq!(judged(&[10, 20, 35, 36], 9), Ok(()));
        assert_eq!(judged(&[10], 0), Ok(()));
    }

    #[test]
    fn stamps_that_lie_are_told_apart() {
        for (ticks, before, said) in [
            ([0, 0, 0, 0], 0, "all stamps are zero"),
            ([10, 20, 0, 30], 9, "the end of pass `search` is zero"),
            ([0, 20, 25, 30], 9, "the start is zero"),
            ([10, 20, 30, 40], 40, "the start is of an earlier frame"),
            (
                [50, 60, 30, 80],
                40,
                "the end of pass `search` is of an earlier frame",
            ),
            (
                [50, 60, 55, 80],
                40,
                "`search` is earlier than that of the end of pass `gbuffer`",
            ),
            (
                [50, 50, 50, 50],
                40,
                "all stamps are the same: the passes share a start",
            ),
            (
                [50, 60, 60, 80],
                40,
                "`gbuffer` and of the end of pass `search` are the same",
            ),
        ] {
            let error = judged(&ticks, before).expect_err(said);
            assert!(error.contains(said), "{error}");
        }
    }

    #[test]
    fn a_coarse_clock_may_count_two_short_passes_as_one() {
        let names = ["a".to_owned(), "b".to_owned()];
        assert_eq!(judge(&[5, 6, 6], &names, 4, 0.01), Ok(()));
        assert!(judge(&[5, 6, 6], &names, 4, 1e-6).is_err());
    }
}

//! GPU time of passes, measured from END stamp to END stamp.
//!
//! Stamps at a pass's beginning are not trusted (a software driver gets them wrong once a render
//! pass has run). The first pass lasts from a lone stamp before it, submitted with the frame once all
//! that was submitted before has run: neither uploads nor the recording of the frame count.
//! Passes that do not depend on each other may overlap; then the time of both counts for the one
//! that ends first.

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

/// Share of the wall time by which the passes may miss it, beside what an empty submission takes.
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
        if ticks.contains(&0) || !ticks.is_sorted() {
            return without("a stamp is missing or earlier than the one before".to_owned());
        }
        let period = f64::from(gpu.queue.get_timestamp_period()) * 1e-6;
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

//! GPU time of passes, measured from END stamp to END stamp.
//!
//! Stamps at a pass's beginning are not trusted (a software driver gets them wrong once a render
//! pass has run). The first pass lasts from a lone stamp before it, submitted with the frame once all
//! that was submitted before has run: neither uploads nor the recording of the frame count.
//! Passes that do not depend on each other may overlap; then the time of both counts for the one
//! that ends first.

use crate::gpu::Gpu;
use crate::recorder::{Begin, Recorder};

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

/// Hands out END stamps, one a pass.
#[derive(Debug)]
pub(crate) struct Timer {
    stamps: Option<wgpu::QuerySet>,
    names: Vec<String>,
    /// For the lone stamp: some drivers stamp no pass that does nothing.
    idle: Option<wgpu::ComputePipeline>,
    /// Wall time of a submission with nothing but the lone stamp, milliseconds.
    latency_ms: f64,
}

impl Timer {
    /// Stamps of a query set, as many as every adapter has.
    const CAPACITY: u32 = wgpu::QUERY_SET_MAX_QUERIES;

    pub(crate) fn new(gpu: &Gpu) -> Self {
        let stamps = gpu.info().timestamps.then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("end stamps"),
                ty: wgpu::QueryType::Timestamp,
                count: Self::CAPACITY,
            })
        });
        let idle = stamps.is_some().then(|| idle(gpu));
        let mut timer = Self {
            stamps,
            idle,
            ..Self::none()
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

    /// A timer that stamps nothing.
    pub(crate) fn none() -> Self {
        Self {
            stamps: None,
            names: Vec::new(),
            idle: None,
            latency_ms: 0.0,
        }
    }

    /// Commands that end with stamp 0 and do nothing else.
    fn lone_stamp(&self, gpu: &Gpu) -> wgpu::CommandBuffer {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        if let (Some(stamps), Some(idle)) = (&self.stamps, &self.idle) {
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

    /// The query set and the index of the next pass's END stamp.
    pub(crate) fn next(&mut self, name: &str) -> Option<(&wgpu::QuerySet, u32)> {
        self.names.push(name.to_owned());
        let index = self.names.len() as u32;
        self.stamps
            .as_ref()
            .filter(|_| index < Self::CAPACITY)
            .map(|stamps| (stamps, index))
    }

    /// Times a frame whose passes `record` records.
    pub(crate) fn time(&mut self, gpu: &Gpu, record: impl FnOnce(&mut Recorder<'_>)) -> FrameTime {
        self.names.clear();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        record(&mut Recorder::new(&mut encoder, self));
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
        let Some(stamps) = &self.stamps else {
            return without("the adapter has no timestamps".to_owned());
        };
        let count = self.names.len() as u32 + 1;
        if count > Self::CAPACITY {
            return without(format!(
                "{count} passes are more than the {} that can be timed",
                Self::CAPACITY
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
        for (name, pair) in self.names.iter().zip(ticks.windows(2)) {
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

/// What the timestamp self-test saw.
#[derive(Clone, Debug, serde::Serialize)]
pub struct SelfTest {
    /// A known load after another pass was seen where it ran, or the adapter has no timestamps.
    pub passed: bool,
    /// In words.
    pub message: String,
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

/// Share of the frame that the known load must account for.
const LOAD_SHARE: f64 = 0.5;
/// The load grows until a frame takes as long, in milliseconds, so that nothing else counts.
const LOAD_MS: f64 = 50.0;
/// It does not grow beyond so many dispatches.
const MOST_LOAD: u32 = 1 << 14;

/// A heavy compute pass after a render pass that it reads from, as every frame has it: its time
/// must be seen as its own.
pub(crate) fn self_test(gpu: &Gpu) -> SelfTest {
    if !gpu.info().timestamps {
        return SelfTest {
            passed: true,
            message: "the adapter has no timestamps; wall time only".to_owned(),
        };
    }
    const LOAD: &str = "@group(0) @binding(0) var<storage, read_write> sink: array<f32>;
@group(0) @binding(1) var rendered: texture_2d<f32>;
@compute @workgroup_size(64) fn load(@builtin(global_invocation_id) id: vec3u) {
    var x = f32(id.x) * 1e-3 + textureLoad(rendered, vec2u(), 0).x;
    for (var i = 0; i < 20000; i++) { x = fract(x * 1.7 + 0.3); }
    sink[id.x] = x;
}";
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("load"),
            source: wgpu::ShaderSource::Wgsl(LOAD.into()),
        });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("load"),
            layout: None,
            module: &module,
            entry_point: Some("load"),
            compilation_options: Default::default(),
            cache: None,
        });
    let sink = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("sink"),
        size: 4096 * 4,
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: false,
    });
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("target"),
        size: wgpu::Extent3d {
            width: 64,
            height: 64,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let view = target.create_view(&Default::default());
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: sink.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::TextureView(&view),
            },
        ],
    });
    let mut timer = Timer::new(gpu);
    let mut timed = |dispatches: u32| {
        timer.time(gpu, |frame| {
            frame.render("render", &[&view], Begin::Clear, None, |_| {});
            frame.compute("load", |pass| {
                pass.set_pipeline(&pipeline);
                pass.set_bind_group(0, &group, &[]);
                for _ in 0..dispatches {
                    pass.dispatch_workgroups(64, 1, 1);
                }
            });
        })
    };
    let mut dispatches = 1;
    let mut time = timed(dispatches);
    while time.wall_ms < LOAD_MS && dispatches < MOST_LOAD {
        dispatches *= 2;
        time = timed(dispatches);
    }
    match &time.passes {
        None => SelfTest {
            passed: false,
            message: time.passes_reason.unwrap_or_default(),
        },
        Some(passes) => {
            let load = passes[1].1;
            SelfTest {
                passed: load >= LOAD_SHARE * time.wall_ms,
                message: format!(
                    "a compute load after a render pass: {load:.2} ms of {:.2} ms wall",
                    time.wall_ms
                ),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::gpu_or_skip;

    #[test]
    fn a_load_after_a_render_pass_is_seen_where_it_ran() {
        let Some(gpu) = gpu_or_skip() else { return };
        let test = super::self_test(&gpu);
        assert!(test.passed, "{}", test.message);
    }
}

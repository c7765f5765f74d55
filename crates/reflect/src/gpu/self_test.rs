//! The clock's self-test: times are believed only where a known load is seen where it ran.

use super::clock::Timer;
use super::device::Gpu;
use super::recorder::Begin;

/// What the timestamp self-test saw.
#[derive(Clone, Debug, serde::Serialize)]
pub struct SelfTest {
    /// A known load after another pass was seen where it ran, or the adapter has no timestamps.
    pub passed: bool,
    /// In words.
    pub message: String,
}

/// Share of the frame that the known load must account for.
const LOAD_SHARE: f64 = 0.5;
/// The load is increased until a frame takes this long, in milliseconds, so that all else is
/// negligible.
const LOAD_MS: f64 = 50.0;
/// Most dispatches of the load.
const MOST_LOAD: u32 = 1 << 14;

impl Gpu {
    /// Puts a known compute load after a render pass and checks that its time is seen where it ran.
    pub fn timestamp_self_test(&self) -> SelfTest {
        self_test(self)
    }
}

/// A heavy compute pass after a render pass that it reads from, as every frame has it: its time
/// must be seen as its own.
fn self_test(gpu: &Gpu) -> SelfTest {
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

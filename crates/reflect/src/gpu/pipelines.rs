//! Pipelines: linked shaders with their entry points, layouts and targets.

use std::collections::BTreeMap;
use std::ops::Deref;

use super::device::Gpu;
use super::error::BuildError;
use super::shaders;
use super::textures::{DEPTH, FLOAT4};

/// Most workgroups in one dimension on every adapter.
const MAX_GROUPS: u32 = 65535;

/// A program of `shaders/`, linked and compiled.
pub(crate) struct Module {
    module: wgpu::ShaderModule,
    /// Of its compute entry points.
    workgroups: BTreeMap<String, [u32; 3]>,
}

impl Deref for Module {
    type Target = wgpu::ShaderModule;

    fn deref(&self) -> &Self::Target {
        &self.module
    }
}

/// Links and compiles a program of `shaders/` with the given features on.
pub(crate) fn module(gpu: &Gpu, program: &str, features: &[&str]) -> Result<Module, BuildError> {
    let text = shaders::link(program, features).map_err(BuildError::Shader)?;
    let invalid = |error| BuildError::Shader(format!("{program}.wesl: {error}"));
    let workgroups = shaders::workgroup_sizes(&text).map_err(invalid)?;
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(program),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
    Ok(Module { module, workgroups })
}

fn pipeline_layout(gpu: &Gpu, layouts: &[Option<&wgpu::BindGroupLayout>]) -> wgpu::PipelineLayout {
    gpu.device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: layouts,
            immediate_size: 0,
        })
}

/// A compute pipeline, and the size of its workgroups as its shader states it.
pub(crate) struct Kernel {
    pipeline: wgpu::ComputePipeline,
    workgroup: [u32; 3],
}

impl Deref for Kernel {
    type Target = wgpu::ComputePipeline;

    fn deref(&self) -> &Self::Target {
        &self.pipeline
    }
}

impl Kernel {
    /// Workgroups that give at least `count` threads, one after the other: x of a workgroup's size.
    pub(crate) fn groups(&self, count: u32) -> u32 {
        count.div_ceil(self.workgroup[0])
    }

    /// Workgroups in x and y that give at least a thread for each texel of an image.
    pub(crate) fn groups_over(&self, [width, height]: [u32; 2]) -> [u32; 2] {
        let [x, y, _] = self.workgroup;
        [width.div_ceil(x), height.div_ceil(y)]
    }
}

/// A compute pipeline; `layouts` are those of groups 0, 1, …, `None` for a group not used.
///
/// # Panics
/// Where the module has no such entry point: a bug.
pub(crate) fn compute(
    gpu: &Gpu,
    module: &Module,
    entry: &str,
    layouts: &[Option<&wgpu::BindGroupLayout>],
) -> Kernel {
    kernel(gpu, module, entry, layouts, true)
}

/// As [`compute`], for a shader that sets all memory of its workgroups that it reads: none of it is
/// cleared before, which costs much where there is much.
pub(crate) fn compute_unset(
    gpu: &Gpu,
    module: &Module,
    entry: &str,
    layouts: &[Option<&wgpu::BindGroupLayout>],
) -> Kernel {
    kernel(gpu, module, entry, layouts, false)
}

fn kernel(
    gpu: &Gpu,
    module: &Module,
    entry: &str,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    zeroed: bool,
) -> Kernel {
    let workgroup = module.workgroups.get(entry);
    let workgroup = *workgroup.unwrap_or_else(|| panic!("no compute entry point `{entry}`"));
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&pipeline_layout(gpu, layouts)),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions {
                zero_initialize_workgroup_memory: zeroed,
                ..Default::default()
            },
            cache: None,
        });
    Kernel {
        pipeline,
        workgroup,
    }
}

/// What a raster pipeline draws to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RasterTargets {
    /// Number of [`FLOAT4`] colour targets.
    pub colors: usize,
    /// Depth test (greater wins) and write.
    pub depth: bool,
}

/// A raster pipeline of triangle lists, drawn from both sides, with the vertex entry `vertex`.
pub(crate) fn raster(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    fragment: &str,
    targets: RasterTargets,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> wgpu::RenderPipeline {
    let entries = RasterEntries {
        module,
        vertex: "vertex",
        fragment,
    };
    let formats = vec![FLOAT4; targets.colors];
    raster_to(gpu, entries, &formats, targets.depth, layouts, buffers)
}

/// The two ends of a raster pipeline.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RasterEntries<'a> {
    pub module: &'a wgpu::ShaderModule,
    pub vertex: &'a str,
    pub fragment: &'a str,
}

/// A raster pipeline to colour targets of any formats; `depth` as in [`RasterTargets`].
pub(crate) fn raster_to(
    gpu: &Gpu,
    RasterEntries {
        module,
        vertex,
        fragment,
    }: RasterEntries<'_>,
    formats: &[wgpu::TextureFormat],
    depth: bool,
    layouts: &[Option<&wgpu::BindGroupLayout>],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
) -> wgpu::RenderPipeline {
    let color = |format: &wgpu::TextureFormat| {
        Some(wgpu::ColorTargetState {
            format: *format,
            blend: None,
            write_mask: wgpu::ColorWrites::ALL,
        })
    };
    let colors: Vec<_> = formats.iter().map(color).collect();
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&pipeline_layout(gpu, layouts)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: depth.then(|| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &colors,
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Workgroups in x and y that give at least `count` groups; a shader finds its group's index as
/// `x + y · num_workgroups.x`.
pub(crate) fn dispatch_size(count: u32) -> [u32; 2] {
    [count.min(MAX_GROUPS), count.div_ceil(MAX_GROUPS)]
}

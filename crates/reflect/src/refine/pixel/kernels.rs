//! The kernels of `pixel/kernels.wesl`, with the layouts of what they are bound to.

use crate::error::ReflectError;
use crate::gpu::{Gpu, Kernel, Slot, compute, group, layout, module};
use crate::refine::Context;
use crate::stage::options::{Depth, Fragments, Hidden};

/// A kernel and the layout of its group 3.
pub(super) struct Step {
    pub kernel: Kernel,
    own_layout: wgpu::BindGroupLayout,
}

impl Step {
    /// Its group 3.
    pub(super) fn group(
        &self,
        gpu: &Gpu,
        buffers: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        group(gpu, &self.own_layout, buffers)
    }
}

/// In the order in which they run.
pub(super) struct Kernels {
    pub adopt: Step,
    pub begin: Step,
    /// At the scene's own edges.
    pub first_count: Step,
    pub first_scan: Step,
    pub first_write: Step,
    /// At each level.
    pub judge: Step,
    pub count: Step,
    /// The same, and it counts finished triangles.
    pub telling_count: Step,
    pub scan: Step,
    pub write_edges: Step,
    pub write_triangles: Step,
    pub tally: Step,
    /// Of group 2: positions and answers of all points, and edges.
    pub geometry: wgpu::BindGroupLayout,
}

impl Kernels {
    pub(super) fn new(context: &Context<'_>) -> Result<Self, ReflectError> {
        use Slot::{Read, Uniform, Write};
        let Context {
            gpu, stage, drawn, ..
        } = context;
        let of_options = [
            (drawn.hidden == Hidden::Extend, "extend"),
            (drawn.depth == Depth::Virtual, "virtual_depth"),
            (drawn.fragments == Fragments::Exact, "exact"),
        ];
        let of_options = of_options
            .iter()
            .filter_map(|(on, name)| on.then_some(*name));
        let of_options: Vec<_> = of_options.collect();
        let program =
            |feature: &[&str]| module(gpu, "pixel/kernels", &[&of_options, feature].concat());
        let geometry = layout(gpu, "refined", &[Write; 3]);
        let kernel = |module, entry, slots: &[Slot]| {
            let own_layout = layout(gpu, entry, slots);
            let layouts = [
                Some(&stage.world.view_layout),
                Some(&stage.gbuffer.mirror_layout),
                Some(&geometry),
                Some(&own_layout),
            ];
            Step {
                kernel: compute(gpu, module, entry, &layouts),
                own_layout,
            }
        };
        // It looks at neither view nor geometry, and binds as many buffers as there may be.
        let alone = |module, slots: &[Slot]| {
            let own_layout = layout(gpu, "scan", slots);
            Step {
                kernel: compute(gpu, module, "scan", &[None, None, None, Some(&own_layout)]),
                own_layout,
            }
        };
        let [plain, first, telling] = [&[][..], &["first"], &["tally"]].map(program);
        let (plain, first, telling) = (plain?, first?, telling?);
        let count = [Uniform, Read, Read, Write, Write];
        let scan = [Uniform, Write, Write, Write, Write, Write, Write];
        let edges = [Uniform, Read, Read, Write];
        let triangles = [Uniform, Read, Read, Write, Write, Write];
        let tally = layout(gpu, "tally", &[Read, Read, Write]);
        Ok(Self {
            adopt: kernel(&plain, "adopt", &[Uniform, Read, Read]),
            begin: kernel(&plain, "begin", &[Uniform, Read, Write]),
            first_count: kernel(&first, "count", &count),
            first_scan: alone(&first, &scan),
            first_write: kernel(&first, "write_edges", &edges),
            judge: kernel(&plain, "judge", &[Uniform, Read]),
            count: kernel(&plain, "count", &count),
            telling_count: kernel(&telling, "count", &count),
            scan: alone(&plain, &scan),
            write_edges: kernel(&plain, "write_edges", &edges),
            write_triangles: kernel(&plain, "write_triangles", &triangles),
            tally: Step {
                kernel: compute(
                    gpu,
                    &module(gpu, "tessellation/tally", &[])?,
                    "tally",
                    &[None, None, None, Some(&tally)],
                ),
                own_layout: tally,
            },
            geometry,
        })
    }
}

//! The kernels of `pixel/kernels.wesl`, with the layouts of what they are bound to.

use crate::error::ReflectError;
use crate::gpu::{Slot, layout, module};
use crate::refine::Context;
use crate::refine::step::Step;
use crate::stage::options::{Depth, Fragments, Hidden};

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
        let drawing = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&geometry),
        ];
        let kernel = |module, entry, slots: &[Slot]| Step::new(gpu, module, entry, slots, drawing);
        // They look at neither view nor geometry, and the scan binds as many buffers as there may be.
        let alone = |module, entry, slots: &[Slot]| Step::new(gpu, module, entry, slots, [None; 3]);
        let [plain, first, telling] = [&[][..], &["first"], &["tally"]].map(program);
        let (plain, first, telling) = (plain?, first?, telling?);
        let count = [Uniform, Read, Read, Write, Write];
        let scan = [Uniform, Write, Write, Write, Write, Write, Write];
        let edges = [Uniform, Read, Read, Write];
        let triangles = [Uniform, Read, Read, Write, Write, Write];
        let tally = module(gpu, "tessellation/tally", &[])?;
        Ok(Self {
            adopt: kernel(&plain, "adopt", &[Uniform, Read, Read]),
            begin: kernel(&plain, "begin", &[Uniform, Read, Write]),
            first_count: kernel(&first, "count", &count),
            first_scan: alone(&first, "scan", &scan),
            first_write: kernel(&first, "write_edges", &edges),
            judge: kernel(&plain, "judge", &[Uniform, Read]),
            count: kernel(&plain, "count", &count),
            telling_count: kernel(&telling, "count", &count),
            scan: alone(&plain, "scan", &scan),
            write_edges: kernel(&plain, "write_edges", &edges),
            write_triangles: kernel(&plain, "write_triangles", &triangles),
            tally: alone(&tally, "tally", &[Read, Read, Write]),
            geometry,
        })
    }
}

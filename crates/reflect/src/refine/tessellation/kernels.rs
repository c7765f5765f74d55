//! Kernels of the tessellation loop, with the layouts of what they are bound to.

use super::rule::Rule;
use crate::error::ReflectError;
use crate::gpu::{Kernel, Slot, compute, layout, module};
use crate::refine::Context;
use crate::refine::step::Step;
use crate::stage::options::Fragments;

/// The entry points of `tessellation/kernels.wesl` in the order in which they run, and of `tessellation/tally.wesl`.
pub(super) struct Kernels {
    pub begin: Step,
    pub classify: Step,
    pub scan: Step,
    pub split: Step,
    /// The same for the last level.
    pub split_last: Kernel,
    pub judge: Step,
    pub tally: Step,
    /// Of group 2 of `classify` and `judge`.
    pub answers_layout: wgpu::BindGroupLayout,
    /// Of group 2 of `split`.
    pub vertices_layout: wgpu::BindGroupLayout,
}

impl Kernels {
    pub(super) fn new(context: &Context<'_>, rule: Rule) -> Result<Self, ReflectError> {
        use Slot::{Read, Uniform, Write};
        let Context { gpu, stage, .. } = context;
        let exact = (context.drawn.fragments == Fragments::Exact).then_some("exact");
        let program = |features: &[&str]| {
            let features: Vec<_> = features.iter().copied().chain(exact).collect();
            module(gpu, "tessellation/kernels", &features)
        };
        let plain = program(&[])?;
        let judging = match rule.threshold {
            None => &program(&["full"])?,
            Some(_) => &plain,
        };
        let kernel =
            |module, entry, slots: &[Slot], others| Step::new(gpu, module, entry, slots, others);
        let alone = [None; 3];
        let answers_layout = layout(gpu, "answers", &[Read; 4]);
        let answered = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&answers_layout),
        ];
        let vertices_layout = layout(gpu, "vertices", &[Read, Write]);
        let of_surface = [None, None, Some(&stage.world.surface_layout)];
        let of_vertices = [None, None, Some(&vertices_layout)];
        let begin_slots = [Uniform, Write, Write, Uniform, Write];
        let classify_slots = [Uniform, Read, Read, Write, Write];
        let scan_slots = [Uniform, Write, Write, Write, Write, Write, Write];
        let split_slots = [Read, Write, Write, Read, Read, Read];
        let judge_slots = [Uniform, Read, Read, Write];
        let split = kernel(&plain, "split", &split_slots, of_vertices);
        let [view, mirror, shared] = of_vertices;
        let layouts = [view, mirror, shared, Some(&split.own_layout)];
        Ok(Self {
            begin: kernel(&plain, "begin", &begin_slots, of_surface),
            classify: kernel(judging, "classify", &classify_slots, answered),
            scan: kernel(&plain, "scan", &scan_slots, alone),
            split_last: compute(gpu, &program(&["last"])?, "split", &layouts),
            split,
            judge: kernel(judging, "judge", &judge_slots, answered),
            tally: kernel(
                &module(gpu, "tessellation/tally", &[])?,
                "tally",
                &[Read, Read, Write],
                alone,
            ),
            answers_layout,
            vertices_layout,
        })
    }
}

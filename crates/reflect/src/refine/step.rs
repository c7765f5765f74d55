//! A kernel that runs among others, each with a group of its own.

use crate::gpu::{Gpu, Kernel, Module, Slot, compute, group, layout};

/// A kernel and the layout of its group 3.
pub(super) struct Step {
    pub kernel: Kernel,
    pub own_layout: wgpu::BindGroupLayout,
}

impl Step {
    /// The kernel `entry`, with groups 0 to 2 as it wants them and then its own.
    pub(super) fn new(
        gpu: &Gpu,
        module: &Module,
        entry: &'static str,
        slots: &[Slot],
        others: [Option<&wgpu::BindGroupLayout>; 3],
    ) -> Self {
        let own_layout = layout(gpu, entry, slots);
        let [first, second, third] = others;
        let layouts = [first, second, third, Some(&own_layout)];
        Self {
            kernel: compute(gpu, module, entry, &layouts),
            own_layout,
        }
    }

    /// Its group 3.
    pub(super) fn group(
        &self,
        gpu: &Gpu,
        resources: &[wgpu::BindingResource<'_>],
    ) -> wgpu::BindGroup {
        group(gpu, &self.own_layout, resources)
    }
}

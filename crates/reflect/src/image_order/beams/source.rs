//! Where the rays come from that the hierarchy is built over: the mirrors' G-buffer, or two images
//! (`beams/field.wesl`).

use crate::stage::Stage;

/// What kernels read the rays from.
pub(super) struct Source {
    /// Width and height of the image in pixels.
    pub(super) size: [u32; 2],
    /// Shader feature of the kernels that read the rays from there.
    pub(super) feature: Option<&'static str>,
    /// Group 0, where they read it.
    pub(super) view: Option<(wgpu::BindGroupLayout, wgpu::BindGroup)>,
    /// Group 1.
    pub(super) rays_layout: wgpu::BindGroupLayout,
    /// By reflection: of the first ray of each path, of the second, of the third as of the first, …
    pub(super) rays: Vec<wgpu::BindGroup>,
}

impl Source {
    /// The rays that the G-buffer reflects.
    pub(super) fn of_gbuffer(stage: &Stage) -> Self {
        Self {
            size: stage.world.size,
            feature: None,
            view: Some((
                stage.world.view_layout.clone(),
                stage.world.view_group.clone(),
            )),
            rays_layout: stage.gbuffer.mirror_layout.clone(),
            rays: stage
                .gbuffer
                .mirror_groups
                .iter()
                .take(1)
                .cloned()
                .collect(),
        }
    }

    /// Layouts of groups 0 and 1.
    pub(super) fn layouts(&self) -> [Option<&wgpu::BindGroupLayout>; 2] {
        let view = self.view.as_ref().map(|(layout, _)| layout);
        [view, Some(&self.rays_layout)]
    }

    /// Sets groups 0 and 1 for the rays after so many reflections of each path.
    pub(super) fn set(&self, pass: &mut wgpu::ComputePass<'_>, reflections: usize) {
        if let Some((_, view)) = &self.view {
            pass.set_bind_group(0, view, &[]);
        }
        pass.set_bind_group(1, &self.rays[reflections % self.rays.len()], &[]);
    }
}

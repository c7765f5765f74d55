//! The hierarchy over the reflected rays (`beams/pyramid.wesl`), built for each frame.

use super::source::Source;
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, image_with_levels, layout, level_view, module,
    view,
};

/// Pixels along the side of a leaf, and of a node of the highest level.
const LEAF: u32 = 2;
pub(super) const TOP: u32 = LEAF << (LEVELS - 1);

/// Levels: leaves of 2 pixels, then 4, 8, … 128 along each side.
const LEVELS: u32 = 7;

/// Three images with all levels, and the pass that fills them.
pub(super) struct Pyramid {
    /// As `beams/node.wesl` says what they hold.
    images: [wgpu::Texture; 3],
    leaves: Kernel,
    join: Kernel,
    /// By level, to be written.
    written: Vec<wgpu::BindGroup>,
    /// By level, to be read for the one above.
    below: Vec<wgpu::BindGroup>,
}

impl Pyramid {
    /// # Errors
    /// Shaders that do not link: a bug. What the device cannot hold it notes itself.
    pub(super) fn new(gpu: &Gpu, source: &Source) -> Result<Self, ReflectError> {
        let size = source.size.map(|side| side.next_multiple_of(TOP) / LEAF);
        let images = ["rays, low", "rays, high", "rays, least"]
            .map(|label| image_with_levels(gpu, label, size, LEVELS));
        gpu.check()?;
        let written_layout = layout(gpu, "level", &[Slot::Image; 3]);
        let below_layout = layout(gpu, "level below", &[Slot::Texture; 3]);
        let groups = |layout| {
            let of_level = |level| {
                let views = images.each_ref().map(|image| level_view(image, level));
                let resources = views.each_ref().map(wgpu::BindingResource::TextureView);
                group(gpu, layout, &resources)
            };
            (0..LEVELS).map(of_level).collect()
        };
        let features: Vec<_> = source.feature.into_iter().collect();
        let module = module(gpu, "beams/pyramid", &features)?;
        let [view, rays] = source.layouts();
        let written = Some(&written_layout);
        Ok(Self {
            leaves: compute(gpu, &module, "leaves", &[view, rays, written]),
            join: compute(
                gpu,
                &module,
                "join",
                &[None, None, written, Some(&below_layout)],
            ),
            written: groups(&written_layout),
            below: groups(&below_layout),
            images,
        })
    }

    /// Nodes in x and y of a level, 0 being the leaves.
    pub(super) fn nodes(&self, level: u32) -> [u32; 2] {
        [
            self.images[0].width() >> level,
            self.images[0].height() >> level,
        ]
    }

    /// The images, all levels, as `beams/node.wesl` reads them.
    pub(super) fn views(&self) -> [wgpu::TextureView; 3] {
        self.images.each_ref().map(view)
    }

    /// Records the pass `hierarchy`, over the rays after so many reflections of each path.
    pub(super) fn record(&self, frame: &mut Recorder<'_>, source: &Source, reflections: usize) {
        frame.compute("hierarchy", |pass| {
            pass.set_pipeline(&self.leaves);
            source.set(pass, reflections);
            pass.set_bind_group(2, &self.written[0], &[]);
            let [x, y] = self.leaves.groups_over(self.nodes(0));
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.join);
            for level in 1..LEVELS {
                pass.set_bind_group(2, &self.written[level as usize], &[]);
                pass.set_bind_group(3, &self.below[level as usize - 1], &[]);
                let [x, y] = self.join.groups_over(self.nodes(level));
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}

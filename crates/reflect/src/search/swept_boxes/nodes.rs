//! The hierarchy over the cells between reflected rays (`swept_boxes/rays.wesl`, `swept_boxes/build.wesl`),
//! built for each mirror and frame.

use encase::ShaderType;
use glam::UVec2;

use crate::error::ReflectError;
use crate::gpu::{
    FLOAT4, Gpu, Kernel, Recorder, Slot, compute, group, image_with_levels, layout, level_view,
    module, storage_zeros, target, uniform, view,
};
use crate::stage::Stage;

/// Most slices. Twin of `MOST` in `swept_boxes/node.wesl`.
const MOST: u32 = 8;

/// Texels of a node without slices, and in a row. Twins of those in `swept_boxes/node.wesl`.
const BASE: u32 = 3;
const ROW: u32 = 4;

/// A warm search begins this many levels above a previous answer, so a hierarchy has at least as many. Twin
/// of `NEARBY` in `swept_boxes/search.wesl`.
const NEARBY: u32 = 3;

/// Twin of `Layout` in `swept_boxes/build.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(super) struct Layout {
    /// Texels of a node.
    pub block: UVec2,
    /// Slices that they have room for.
    pub room: u32,
}

/// Rays, boxes and slices, and the pass that makes them.
pub(super) struct Nodes {
    /// Points and directions.
    rays: [wgpu::Texture; 2],
    /// All levels.
    boxes: wgpu::Texture,
    slices: wgpu::Buffer,
    layout: Layout,
    make_rays: Kernel,
    made: wgpu::BindGroup,
    focus: Option<Kernel>,
    cells: Kernel,
    join: Kernel,
    /// Group 1 of `build`.
    built_from: wgpu::BindGroup,
    /// By level, to be written.
    written: Vec<wgpu::BindGroup>,
    /// By level, to be read for the one above.
    below: Vec<wgpu::BindGroup>,
}

/// The highest level of the hierarchy over an image: it has nine nodes at most, but for small images.
pub(super) fn top_level([width, height]: [u32; 2]) -> u32 {
    (width.max(height) + 1)
        .ilog2()
        .saturating_sub(1)
        .max(NEARBY)
}

/// Nodes along both sides of the lowest level, the cells.
pub(super) fn cells(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| (side + 1).next_multiple_of(1 << top_level(size)))
}

impl Nodes {
    /// With room for so many slices; it `extends` to where the mirror's surface is not seen.
    ///
    /// # Errors
    /// What the device cannot hold.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &Stage,
        room: u32,
        extends: bool,
    ) -> Result<Self, ReflectError> {
        let size = stage.world.size;
        let texels = BASE + 2 * room;
        let block = [texels.min(ROW), texels.div_ceil(ROW)];
        let layout_of = Layout {
            block: UVec2::from_array(block),
            room,
        };
        let levels = top_level(size) + 1;
        let cells = cells(size);
        let [width, height] = [0, 1].map(|side| cells[side] * block[side]);
        let rays = ["ray points", "ray directions"]
            .map(|label| target(gpu, label, size.map(|side| side + 2), FLOAT4));
        let boxes = image_with_levels(gpu, "swept boxes", [width, height], levels);
        gpu.check()?;
        let slices = storage_zeros(gpu, 4 + 4 * u64::from(MOST));
        let made_layout = layout(gpu, "rays made", &[Slot::Image; 2]);
        let from_slots = [Slot::Write, Slot::Texture, Slot::Texture, Slot::Uniform];
        let from_layout = layout(gpu, "rays", &from_slots);
        let written_layout = layout(gpu, "level", &[Slot::Image]);
        let below_layout = layout(gpu, "level below", &[Slot::Texture]);
        let views = rays.each_ref().map(view);
        let [points, directions] = views.each_ref().map(wgpu::BindingResource::TextureView);
        let uniform = uniform(gpu, &layout_of);
        let from = [
            slices.as_entire_binding(),
            points.clone(),
            directions.clone(),
            uniform.as_entire_binding(),
        ];
        let groups = |layout| {
            let of_level = |level| {
                let view = level_view(&boxes, level);
                group(gpu, layout, &[wgpu::BindingResource::TextureView(&view)])
            };
            (0..levels).map(of_level).collect()
        };
        let rays_module = module(
            gpu,
            "swept_boxes/rays",
            if extends { &["extend"] } else { &[] },
        )?;
        let build = module(gpu, "swept_boxes/build", &[])?;
        let view_of = Some(&stage.world.view_layout);
        let mirror = Some(&stage.gbuffer.mirror_layout);
        let (from_of, written) = (Some(&from_layout), Some(&written_layout));
        let kernel = |entry, layouts: &[Option<&wgpu::BindGroupLayout>]| {
            compute(gpu, &build, entry, layouts)
        };
        Ok(Self {
            make_rays: compute(
                gpu,
                &rays_module,
                "rays",
                &[view_of, mirror, Some(&made_layout)],
            ),
            made: group(gpu, &made_layout, &[points, directions]),
            focus: (room > 0).then(|| kernel("focus", &[view_of, from_of])),
            cells: kernel("cells", &[view_of, from_of, written]),
            join: kernel("join", &[view_of, from_of, written, Some(&below_layout)]),
            built_from: group(gpu, &from_layout, &from),
            written: groups(&written_layout),
            below: groups(&below_layout),
            rays,
            boxes,
            slices,
            layout: layout_of,
        })
    }

    pub(super) fn rays(&self) -> &[wgpu::Texture; 2] {
        &self.rays
    }

    pub(super) fn boxes(&self) -> &wgpu::Texture {
        &self.boxes
    }

    pub(super) fn slices(&self) -> &wgpu::Buffer {
        &self.slices
    }

    /// Texels of a node.
    pub(super) fn block(&self) -> [u32; 2] {
        self.layout.block.to_array()
    }

    /// The highest level, and its nodes.
    pub(super) fn top(&self) -> (u32, [u32; 2]) {
        let top = self.boxes.mip_level_count() - 1;
        (top, self.nodes(top))
    }

    fn nodes(&self, level: u32) -> [u32; 2] {
        let [x, y] = self.block();
        [
            (self.boxes.width() / x) >> level,
            (self.boxes.height() / y) >> level,
        ]
    }

    /// Records the pass `hierarchy`.
    pub(super) fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        frame.compute("hierarchy", |pass| {
            pass.set_pipeline(&self.make_rays);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &self.made, &[]);
            let size = [self.rays[0].width(), self.rays[0].height()];
            let [x, y] = self.make_rays.groups_over(size);
            pass.dispatch_workgroups(x, y, 1);
            pass.set_bind_group(1, &self.built_from, &[]);
            if let Some(focus) = &self.focus {
                pass.set_pipeline(focus);
                pass.dispatch_workgroups(1, 1, 1);
            }
            pass.set_pipeline(&self.cells);
            pass.set_bind_group(2, &self.written[0], &[]);
            let [x, y] = self.cells.groups_over(self.nodes(0));
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.join);
            for level in 1..self.written.len() {
                pass.set_bind_group(2, &self.written[level], &[]);
                pass.set_bind_group(3, &self.below[level - 1], &[]);
                let [x, y] = self.join.groups_over(self.nodes(level as u32));
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}

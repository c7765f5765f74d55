//! The pyramid of spheres and cones over the reflected rays of one mirror (Szabo 2013, Alg. 4.1).

use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, level_view, module, pyramid,
};
use crate::stage::Stage;

/// Two square textures with all levels, and the pass that fills them.
pub(crate) struct Pyramid {
    /// Centre (world space) and radius; radius −1 where there is no mirror below.
    pub spheres: wgpu::Texture,
    /// Unit direction and half angle in radians; −1 likewise.
    pub cones: wgpu::Texture,
    base: Kernel,
    bound: Kernel,
    /// By level, to be written.
    written: Vec<wgpu::BindGroup>,
    /// By level, to be read for the one above.
    read: Vec<wgpu::BindGroup>,
}

/// A texel is packed into as many bits a coordinate (`ray_hierarchy/search.wesl`).
const WIDEST: u32 = 1 << 14;

/// Side of the base textures: the power of two next to the image's longer side. At least 2, so
/// that there is a level above the base.
fn base_side(size: [u32; 2]) -> u32 {
    size[0].max(size[1]).next_power_of_two().max(2)
}

impl Pyramid {
    /// # Errors
    /// An image so large that its base textures are beyond the device.
    pub(crate) fn new(gpu: &Gpu, stage: &Stage) -> Result<Self, ReflectError> {
        let size = stage.world.size;
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let (side, limit) = (base_side(size), limit.min(WIDEST));
        if side > limit {
            let limit = 1 << limit.ilog2();
            return Err(ReflectError::Size { size, limit });
        }
        let [spheres, cones] = ["spheres", "cones"].map(|label| pyramid(gpu, label, side));
        let written_layout = layout(gpu, "level", &[Slot::Image; 2]);
        let read_layout = layout(gpu, "level below", &[Slot::Texture; 2]);
        let groups = |layout| {
            let levels = 0..spheres.mip_level_count();
            let of_level = |level| {
                let views = [&spheres, &cones].map(|texture| level_view(texture, level));
                group(
                    gpu,
                    layout,
                    &views.each_ref().map(wgpu::BindingResource::TextureView),
                )
            };
            levels.map(of_level).collect()
        };
        let module = module(gpu, "ray_hierarchy/build", &[])?;
        let view = Some(&stage.world.view_layout);
        let mirror = Some(&stage.gbuffer.mirror_layout);
        let written = Some(&written_layout);
        let below = Some(&read_layout);
        Ok(Self {
            base: compute(gpu, &module, "base", &[view, mirror, written]),
            bound: compute(gpu, &module, "bound", &[None, None, written, below]),
            written: groups(&written_layout),
            read: groups(&read_layout),
            spheres,
            cones,
        })
    }

    /// Records the pass `hierarchy`: the reflected rays of `mirror` (an index), then level by level.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        let groups =
            |kernel: &Kernel, level: usize| kernel.groups_over([self.spheres.width() >> level; 2]);
        frame.compute("hierarchy", |pass| {
            pass.set_pipeline(&self.base);
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &self.written[0], &[]);
            let [x, y] = groups(&self.base, 0);
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.bound);
            for level in 1..self.written.len() {
                pass.set_bind_group(2, &self.written[level], &[]);
                pass.set_bind_group(3, &self.read[level - 1], &[]);
                let [x, y] = groups(&self.bound, level);
                pass.dispatch_workgroups(x, y, 1);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::base_side;

    #[test]
    fn the_base_is_the_next_power_of_two_of_the_longer_side() {
        let sides = [[640, 480], [512, 512], [300, 513], [1, 1]].map(base_side);
        assert_eq!(sides, [1024, 512, 1024, 2]);
    }
}

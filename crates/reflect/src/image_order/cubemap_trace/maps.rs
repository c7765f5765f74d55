//! The cube maps of a mirror as the shaders that trace read them.

use catoptric_scene::Scene;
use encase::ShaderType;

use super::options::CubemapTrace;
use super::pyramid::Pyramid;
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, group, set_uniform, uniform};
use crate::image_order::cubemaps::{CubeMaps, Wanted, array_view};
use crate::stage::Stage;
use crate::stage::extent::diagonal;

/// Slots of group 3 behind those of the maps: `Trace`, pyramid, normals.
pub(crate) const MORE: &[Slot] = &[Slot::Uniform, Slot::Textures, Slot::Textures];

/// Twin of `Trace` in `cubemap_trace/rays.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct TraceUniform {
    /// Length of a ray, world units.
    pub length: f32,
    /// Length of a step, as a share of a ray, or of the angle that it turns by.
    pub step: f32,
    /// Largest |Δ| that is a hit, world units (criterion `distance`).
    pub limit: f32,
    /// Share of a ray at which it starts off a mirror; 0: by the texels' width.
    pub bias: f32,
    /// First level of the pyramid that is looked at.
    pub coarsest: u32,
    /// Last level of the pyramid that is looked at.
    pub finest: u32,
    /// Rays that are followed from a pixel.
    pub bounces: u32,
    /// Cosine below which a ray turns much (criterion `switch`).
    pub turn: f32,
}

impl TraceUniform {
    /// In a scene of this extent.
    pub(crate) fn new(options: &CubemapTrace, scene: &Scene) -> Self {
        let length = options.length as f32 * diagonal(scene);
        let step = options.step as f32;
        let levels = options.maps.size.texels().ilog2();
        let finest = options.to.min(levels - 1);
        Self {
            length,
            step,
            limit: options.limit as f32 * step * length,
            bias: options.bias as f32,
            coarsest: options.from.min(finest),
            finest,
            bounces: options.bounces,
            turn: options.turn as f32,
        }
    }
}

/// The maps of one mirror and what reads them.
pub(crate) struct MirrorMaps {
    pub maps: CubeMaps,
    pub pyramid: Option<Pyramid>,
    /// A [`TraceUniform`].
    trace: wgpu::Buffer,
    /// Group 3 of the passes that trace.
    pub group: wgpu::BindGroup,
}

impl MirrorMaps {
    pub(crate) fn new(
        gpu: &Gpu,
        pyramid: bool,
        trace: &TraceUniform,
        stage: &Stage,
        wanted: Wanted,
        own_layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, ReflectError> {
        let maps = CubeMaps::new(gpu, stage, wanted)?;
        let pyramid = pyramid.then(|| Pyramid::new(gpu, &maps));
        let pyramid = pyramid.transpose()?;
        let [colors, distances] = maps.views();
        // Where there is no pyramid or normal the shader does not look; some texture must be bound.
        let range = pyramid.as_ref().map_or(&maps.distances, |it| &it.texture);
        let range = array_view(range);
        let normals = array_view(maps.normals.as_ref().unwrap_or(&maps.distances));
        let trace = uniform(gpu, trace);
        let mut resources = maps.resources([&colors, &distances]).to_vec();
        resources.extend([
            trace.as_entire_binding(),
            wgpu::BindingResource::TextureView(&range),
            wgpu::BindingResource::TextureView(&normals),
        ]);
        let group = group(gpu, own_layout, &resources);
        Ok(Self {
            maps,
            pyramid,
            trace,
            group,
        })
    }

    /// Makes maps that are drawn in every frame, and rays, fit what has moved.
    pub(crate) fn refresh(&mut self, gpu: &Gpu, trace: &TraceUniform, stage: &Stage) {
        self.maps.refresh(gpu, stage);
        set_uniform(gpu, &self.trace, trace);
    }

    /// Draws the maps and builds the pyramid over them.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        self.maps.record(frame, stage);
        if let Some(pyramid) = &self.pyramid {
            pyramid.record(frame);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn the_settings_of_rays_lie_as_shaders_read_them() {
        for program in ["cubemap_trace/march", "cubemap_trace/lanes"] {
            assert_layout!(
                TraceUniform {
                    length,
                    step,
                    limit,
                    bias,
                    coarsest,
                    finest,
                    bounces,
                    turn
                },
                program,
                &[],
                "Trace"
            );
        }
    }
}

//! The acceleration pyramid: least and greatest world distance of 2 × 2 cells, level by level
//! (Číž 2017, section 3.6).

use crate::diagnostics::DistanceLevel;
use crate::error::ReflectError;
use crate::gpu::{Gpu, Kernel, Recorder, Slot, compute, group, layout, module, texture_array};
use crate::image_order::cubemaps::{CubeMaps, FACES};

/// Levels above the single texels of all faces of a set of maps.
pub(crate) struct Pyramid {
    /// (least, greatest) a cell; mip level 0 has half the texels of a face a side.
    pub texture: wgpu::Texture,
    from_texels: Kernel,
    from_cells: Kernel,
    groups: Vec<wgpu::BindGroup>,
}

impl Pyramid {
    pub(crate) fn new(gpu: &Gpu, maps: &CubeMaps) -> Result<Self, ReflectError> {
        let levels = maps.size().ilog2();
        let layers = maps.distances.depth_or_array_layers();
        let texture = texture_array(
            gpu,
            "distance pyramid",
            [maps.size() / 2, layers],
            levels,
            wgpu::TextureFormat::Rg32Float,
            wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_SRC,
        );
        let level_view = |texture: &wgpu::Texture, level| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        let slots = [Slot::Textures, Slot::WriteArray, Slot::Uniform];
        let layout = layout(gpu, "distance pyramid", &slots);
        let groups = (0..levels).map(|level| {
            let finer = match level {
                0 => level_view(&maps.distances, 0),
                level => level_view(&texture, level - 1),
            };
            let coarser = level_view(&texture, level);
            let resources = [
                wgpu::BindingResource::TextureView(&finer),
                wgpu::BindingResource::TextureView(&coarser),
                maps.uniform(),
            ];
            group(gpu, &layout, &resources)
        });
        let groups = groups.collect();
        let pipeline = |features: &[&str]| -> Result<_, ReflectError> {
            let module = module(gpu, "cubemap_trace/pyramid", features)?;
            Ok(compute(gpu, &module, "reduce", &[Some(&layout)]))
        };
        Ok(Self {
            from_texels: pipeline(&["texels"])?,
            from_cells: pipeline(&[])?,
            groups,
            texture,
        })
    }

    /// Reads back all levels, those of the single texels first; `maps` are those it was made for,
    /// `far` is where they take the background to be.
    pub(crate) fn levels(&self, gpu: &Gpu, maps: &CubeMaps, far: f32) -> Vec<DistanceLevel> {
        let texel = |distance: f32| [if distance == 0.0 { far } else { distance }; 2];
        let texels = gpu.read_layers(&maps.distances, 0);
        let finest = DistanceLevel {
            side: maps.size(),
            ranges: texels.into_iter().map(texel).collect(),
        };
        let coarser = (0..self.texture.mip_level_count()).map(|level| DistanceLevel {
            side: self.texture.width() >> level,
            ranges: gpu
                .read_layers(&self.texture, level)
                .chunks_exact(2)
                .map(|cell| [cell[0], cell[1]])
                .collect(),
        });
        std::iter::once(finest).chain(coarser).collect()
    }

    /// Builds all levels, as the pass `pyramid`.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>) {
        let layers = self.texture.depth_or_array_layers();
        debug_assert_eq!(layers % FACES, 0);
        for (group, level) in self.groups.iter().zip(0..) {
            let kernel = match level {
                0 => &self.from_texels,
                _ => &self.from_cells,
            };
            let [x, y] = kernel.groups_over([self.texture.width() >> level; 2]);
            frame.compute("pyramid", |pass| {
                pass.set_pipeline(kernel);
                pass.set_bind_group(0, group, &[]);
                pass.dispatch_workgroups(x, y, layers);
            });
        }
    }
}

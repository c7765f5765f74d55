//! Starts spread over the mirror (`tile_starts.wesl`): of each tile of its projected bounding box the place
//! nearest to the tile's middle.

use crate::error::ReflectError;
use crate::gpu::{Kernel, Recorder, Slot, compute, group, layout, module, storage_zeros};
use crate::search::{Context, Pipelines, Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::Points;
use crate::stage::variant::Variant;

/// Tiles of a mirror. Twin of `TILES` in `shared/tile_starts.wesl`.
const TILES: u32 = 9;

/// Cells that a thread of `bound` looks at. Twin of `BLOCK` in `tile_starts.wesl`.
const BLOCK: u32 = 16;

/// A search that chooses among the starts of all tiles.
pub(super) struct FromTiles {
    clear: Kernel,
    bound: Kernel,
    choose: Kernel,
    pipelines: Pipelines,
    mirrors: Vec<Starts>,
}

/// Of one mirror, found anew in each frame.
struct Starts {
    find: wgpu::BindGroup,
    /// Group 3 of the search.
    read: wgpu::BindGroup,
    /// Image coordinates; x is −1 for a tile without a full cell.
    #[cfg(test)]
    starts: wgpu::Buffer,
}

impl FromTiles {
    /// Of a program with an entry point `search`.
    pub(super) fn new(
        context: &Context<'_>,
        program: &str,
        features: &[&str],
    ) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let find = layout(gpu, "tile starts found", &[Slot::Write; 2]);
        let read = layout(gpu, "tile starts", &[Slot::Read]);
        let module = module(gpu, "tile_starts", &[])?;
        let layouts = [
            Some(&stage.world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&find),
        ];
        let mirrors = stage.world.mirrors.iter().map(|_| {
            let (bounds, starts) = (
                storage_zeros(gpu, 16),
                storage_zeros(gpu, 8 * u64::from(TILES)),
            );
            let found = [bounds.as_entire_binding(), starts.as_entire_binding()];
            Starts {
                find: group(gpu, &find, &found),
                read: group(gpu, &read, &[starts.as_entire_binding()]),
                #[cfg(test)]
                starts,
            }
        });
        let [clear, bound, choose] =
            ["clear", "bound", "choose"].map(|entry| compute(gpu, &module, entry, &layouts));
        Ok(Self {
            clear,
            bound,
            choose,
            mirrors: mirrors.collect(),
            pipelines: Pipelines::new(context, program, features, &read)?,
        })
    }
}

impl Search for FromTiles {
    fn record_build(&self, frame: &mut Recorder<'_>, stage: &Stage, mirror: usize) {
        let [width, height] = stage.world.size;
        frame.compute("start", |pass| {
            pass.set_bind_group(0, &stage.world.view_group, &[]);
            pass.set_bind_group(1, &stage.maps().mirror_groups[mirror], &[]);
            pass.set_bind_group(2, &self.mirrors[mirror].find, &[]);
            pass.set_pipeline(&self.clear);
            pass.dispatch_workgroups(1, 1, 1);
            pass.set_pipeline(&self.bound);
            let [x, y] = self.bound.groups_over([width.div_ceil(BLOCK), height]);
            pass.dispatch_workgroups(x, y, 1);
            pass.set_pipeline(&self.choose);
            pass.dispatch_workgroups(TILES, 1, 1);
        });
    }

    fn record_search(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        sheet: Sheet,
        points: &Points,
        variant: Variant,
    ) {
        let own = &self.mirrors[sheet.mirror].read;
        (self.pipelines).record(frame, (stage, sheet.mirror), points, own, variant);
    }
}

#[cfg(test)]
mod tests {
    use glam::{IVec2, Vec2};

    use super::*;
    use crate::gpu::Gpu;
    use crate::search::Instrumentation;
    use crate::stage::points::points_layout;
    use crate::stage::twin::GBuffer;
    use crate::stage::variant::Variant;
    use crate::testing::{gpu_or_skip, scene, stage};

    /// Tiles along each side.
    const SIDE: i32 = 3;

    /// The starts of a scene's first mirror, and its G-buffer.
    fn starts(gpu: &Gpu, name: &str, size: [u32; 2]) -> (Vec<Vec2>, GBuffer) {
        let stage = stage(gpu, &scene(name), size);
        let context = Context {
            gpu,
            stage: &stage,
            extends: false,
            points_layout: &points_layout(gpu),
            instrumentation: Instrumentation::Efforts,
        };
        let search = FromTiles::new(&context, "newton", &["tiles"]).expect("fits the device");
        gpu.run(|frame| {
            stage.begin(frame, Variant::AllLayers);
            search.record_build(frame, &stage, 0);
        });
        let bytes = gpu.read_buffer(&search.mirrors[0].starts);
        let starts = bytes.chunks(8).take(TILES as usize);
        let starts = starts.map(|pair| Vec2::from_array(bytemuck::pod_read_unaligned(pair)));
        (starts.collect(), GBuffer::read(gpu, &stage, 0))
    }

    /// `tile_starts.wesl`: of a tile of the full cells' box.
    fn twin(gbuffer: &GBuffer, cells: &[IVec2], tile: i32) -> Vec2 {
        let low = cells.iter().copied().reduce(IVec2::min).expect("a cell");
        let high = cells.iter().copied().reduce(IVec2::max).expect("a cell");
        let size = high + 1 - low;
        let place = IVec2::new(tile % SIDE, tile / SIDE);
        let [first, last] = [place, place + 1].map(|place| low + place * size / SIDE);
        let middle = (first + last) / 2;
        let inside = |cell: &&IVec2| cell.cmpge(first).all() && cell.cmplt(last).all();
        let nearest = cells.iter().filter(inside).min_by_key(|cell| {
            let square = (**cell - middle).length_squared();
            (square, cell.y * gbuffer.size.x + cell.x)
        });
        nearest.map_or(Vec2::splat(-1.0), |cell| cell.as_vec2() + 1.0)
    }

    #[test]
    fn each_tile_starts_at_its_full_cell_nearest_to_the_middle() {
        let Some(gpu) = gpu_or_skip() else { return };
        for (name, size) in [
            ("ellipsoid", [160, 120]),
            ("bowl", [97, 64]),
            ("torus", [160, 120]),
            ("sphere-objects-1k", [64, 48]),
        ] {
            let (starts, gbuffer) = starts(&gpu, name, size);
            let texels = (0..gbuffer.size.x * gbuffer.size.y)
                .map(|index| IVec2::new(index % gbuffer.size.x, index / gbuffer.size.x));
            let is_full = |cell: &IVec2| {
                let corners = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];
                corners
                    .iter()
                    .all(|corner| gbuffer.on_mirror(cell + corner))
            };
            let cells: Vec<IVec2> = texels.filter(is_full).collect();
            for (tile, start) in (0..).zip(&starts) {
                assert_eq!(*start, twin(&gbuffer, &cells, tile), "{name}, tile {tile}");
            }
        }
    }
}

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

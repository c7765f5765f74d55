//! What refinements that split triangles answer for a frame, all in the same way.

use catoptric_frame::Triangles;
use glam::Vec3;

use super::Surface;
use super::scene_vertices::SceneVertices;
use super::tessellation::junctions;
use crate::gpu::Gpu;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::points::Efforts;

/// Triangles at most among which T-junctions are looked for: they are made and read once more.
const MOST_COUNTED: u64 = 1 << 18;

/// What the GPU counted in a frame, over all sheets.
pub(super) struct Counts {
    /// Finished triangles by how often they were split.
    pub by_level: [u32; 12],
    /// New points searched.
    pub points: u32,
    /// Triangles that the level limit kept from being split.
    pub unfinished: u32,
    /// Steps, evaluations and node tests of the new points.
    pub efforts: [u64; 3],
}

/// Three sums of 64 bits, as `tessellation/tally.wesl` leaves them.
pub(super) fn sums(gpu: &Gpu, buffer: &wgpu::Buffer) -> [u64; 3] {
    let bytes = gpu.read_buffer_part(buffer, 24);
    let word = |index: usize| -> u64 { bytemuck::pod_read_unaligned(&bytes[index * 8..][..8]) };
    [word(0), word(1), word(2)]
}

/// Sets buffers to zero before a frame is recorded.
pub(super) fn clear(gpu: &Gpu, buffers: [&wgpu::Buffer; 2]) {
    for buffer in buffers {
        let zeros = vec![0; buffer.size() as usize];
        gpu.queue.write_buffer(buffer, 0, &zeros);
    }
}

/// A drawn triangle.
pub(super) struct Drawn {
    /// The scene's triangle.
    pub source: u32,
    /// How often that was split.
    pub level: u32,
    /// World-space corners.
    pub corners: [Vec3; 3],
}

/// A refinement that splits triangles.
pub(super) trait Splits {
    /// How often a triangle may be split.
    fn level(&self) -> u32;

    fn scene_vertices(&self) -> &SceneVertices;

    /// Of the last frame.
    fn counts(&self, gpu: &Gpu) -> Counts;

    /// Visits the drawn triangles of a sheet in the last frame.
    fn visit_drawn(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        visit: &mut dyn FnMut(Drawn),
    );

    /// `Refine::efforts`.
    fn efforts_of_all(&self, gpu: &Gpu, stage: &Stage) -> Efforts {
        let mut efforts = self.scene_vertices().efforts(gpu, stage);
        let Counts {
            points,
            efforts: [steps, evaluations, node_tests],
            ..
        } = self.counts(gpu);
        efforts.add(Efforts {
            searched: points.into(),
            steps,
            evaluations,
            node_tests,
        });
        efforts
    }

    /// `Refine::triangles`.
    fn triangles_of_all(&self, gpu: &Gpu, stage: &Stage) -> Triangles {
        let counts = self.counts(gpu);
        let by_level = counts.by_level[..=self.level() as usize].iter();
        let by_level: Vec<_> = by_level.map(|count| u64::from(*count)).collect();
        let of_scene = u64::from(stage.world.corners / 3);
        Triangles {
            input: of_scene * stage.world.mirrors.len() as u64,
            drawn: by_level.iter().sum(),
            by_level,
            unfinished: counts.unfinished.into(),
        }
    }

    /// `Refine::surface`; `None` where there are too many triangles to look at.
    fn surface_of_all(&self, gpu: &Gpu, stage: &Stage, search: &dyn Search) -> Option<Surface> {
        if self.triangles_of_all(gpu, stage).drawn > MOST_COUNTED {
            return None;
        }
        let objects = junctions::objects(&stage.world.scene);
        let mut surface = Surface {
            t_junctions: 0,
            levels: Vec::new(),
        };
        for sheet in &self.scene_vertices().sheets {
            let mut edges = junctions::Edges::default();
            let mut levels = vec![0; objects.len()];
            self.visit_drawn(gpu, stage, search, *sheet, &mut |drawn| {
                let source = drawn.source as usize;
                edges.add(objects[source], drawn.corners);
                levels[source] = levels[source].max(drawn.level as u8 + 1);
            });
            surface.t_junctions += edges.t_junctions(self.level());
            surface.levels.append(&mut levels);
        }
        Some(surface)
    }
}

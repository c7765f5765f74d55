//! Grid interpolation (Estalella et al. 2005, §5): only the vertices of each mesh's bounding grid
//! are searched for; the mesh's own are interpolated between their virtual images.
//!
//! The grid belongs to a mesh and moves with it. A grid vertex inside a mirror lies in the hidden
//! region and has an image like any other there (§6.1). By `fraction`, a mesh that would have no
//! fewer grid vertices than vertices is searched directly.
//!
//! Ours: `mixed=search` searches the vertices of cells whose corners' states are mixed;
//! `cells=octree` has a tree of cells around each mesh, which every frame goes down, for each mirror,
//! as far as the images of the cells' centres ask for it; `polish=1` takes a Newton step from
//! the interpolated reflection point.

mod cells;
mod forest;
mod pose;
mod settling;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod twin;

use catoptric_frame::{Triangles, VertexResult};
use catoptric_scene::Scene;
use glam::{DAffine3, Vec3};

use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, storage, storage_bytes,
};
use crate::options::{options, words};
use crate::refine::scene_vertices::in_a_row;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::Depth;
use crate::stage::points::{Efforts, Points};
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};
use cells::Cells as Lattice;
use forest::Forest;
use pose::Pose;
use settling::{Settled, Settling};

words! {
    /// What cells there are around a mesh.
    pub(crate) enum Cells {
        /// An even grid.
        Grid = "grid",
        /// A tree, divided in each frame where the images ask for it.
        Octree = "octree",
    }
}

words! {
    /// What becomes of a vertex in a cell of which some corners are hidden and some are not.
    pub(crate) enum Mixed {
        /// It is interpolated.
        Interpolate = "interpolate",
        /// It is searched itself.
        Search = "search",
    }
}

options! {
    /// The refinement, as its options describe it.
    pub(crate) struct Grid {
        /// grid vertices as a share of the mesh's; 1 searches every vertex of the mesh (cells=grid)
        fraction: f64 = 0.1 in 0.0..=1.0,
        /// edge of the cells in world units, whatever their number; 0 goes by the fraction (cells=grid)
        cell: f64 = 0.0 in 0.0..=1e6,
        /// an even grid around each mesh, or a tree of cells that is divided, in each frame and for each
        /// mirror, where corners' states are mixed or the image of a cell's centre misses the mean of its
        /// corners' images; of what holds no more than 8 vertices these are searched
        cells: Cells,
        /// vertices of a cell with both hidden and reflected corners are interpolated, or searched
        /// themselves (cells=grid; in a tree the latter)
        mixed: Mixed,
        /// 1: a Newton step on the G-buffer from each interpolated reflection point
        polish: u32 = 0 in 0..=1,
        /// largest miss of a centre's image, in pixels, in a cell that is not divided (cells=octree)
        error: f64 = 0.25 in 0.0..=1e6,
    }
}

impl Named for Grid {
    const INFO: Info = Info {
        name: "+grid",
        what: "interpolates between the virtual images of a coarse grid",
        paper: "Estalella et al. 2005",
    };
}

impl Grid {
    /// Whether every mesh is searched directly: with as many grid vertices as vertices, nothing is
    /// interpolated.
    fn is_bypassed(&self) -> bool {
        self.cells == Cells::Grid && self.cell <= 0.0 && self.fraction >= 1.0
    }

    /// Whether each frame settles what it searches.
    fn settles(&self) -> bool {
        !self.is_bypassed() && (self.cells == Cells::Octree || self.mixed == Mixed::Search)
    }

    fn polishes(&self) -> bool {
        !self.is_bypassed() && self.polish == 1
    }

    /// The cells around the meshes.
    fn forest(&self, meshes: &[&[Vec3]]) -> Forest {
        if self.cells == Cells::Octree {
            return Forest::of_trees(meshes);
        }
        let grid = |positions: &&[Vec3]| {
            if self.cell > 0.0 {
                (!positions.is_empty()).then(|| Lattice::by_edge(positions, self.cell))
            } else {
                Lattice::by_fraction(positions, self.fraction)
            }
        };
        let grids: Vec<_> = meshes.iter().map(grid).collect();
        if self.settles() {
            Forest::of_grids_with_leaves(meshes, &grids)
        } else {
            Forest::of_grids(meshes, &grids)
        }
    }
}

impl Recipe for Grid {
    /// A reflected vertex also needs those corners of its cell that are not reflected. Where there is no
    /// cell, the search is used as asked for.
    fn wants_continued(&self) -> bool {
        !self.is_bypassed()
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
        Ok(Box::new(Interpolation::new(self, context)?))
    }
}

/// The refinement, ready for a scene.
struct Interpolation {
    raster: Raster,
    interpolate: Kernel,
    layout: wgpu::BindGroupLayout,
    points_layout: wgpu::BindGroupLayout,
    forest: Forest,
    /// One an object; `None` for an empty mesh.
    poses: Vec<Option<Pose>>,
    /// `None`: every record is searched.
    settling: Option<Settling>,
    polishes: bool,
    /// A [`forest::Place`] a vertex of the scene.
    places: wgpu::Buffer,
    /// Of [`forest::Cell`].
    cells: wgpu::Buffer,
    sheets: Vec<Sheet>,
    /// One a sheet.
    on_sheets: Vec<OnSheet>,
    /// What the mirrors' searches were made for.
    scene: Scene,
    /// The searches are new: there are no answers of a previous frame.
    fresh: bool,
}

/// Searched and interpolated points on one sheet of a mirror.
struct OnSheet {
    searched: Points,
    settled: Option<Settled>,
    /// All vertices of the scene; its answers are written by the interpolation.
    interpolated: Points,
    interpolate: wgpu::BindGroup,
    draw: wgpu::BindGroup,
}

/// World-space positions of each object.
fn meshes(scene: &Scene) -> Vec<&[Vec3]> {
    let objects = scene.objects.iter();
    objects
        .map(|object| object.mesh.positions.as_slice())
        .collect()
}

impl Interpolation {
    fn new(options: &Grid, context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let scene = stage.world.scene.clone();
        let forest = options.forest(&meshes(&scene));
        let poses = meshes(&scene).into_iter().map(Pose::new).collect();
        let mut drawn = context.drawn;
        if !options.is_bypassed() {
            // Between images in space there are only images in space.
            drawn.depth = Depth::Virtual;
        }
        let raster = Raster::new(gpu, drawn, stage, "stage/virtual", &[], &[Slot::Read])?;
        let settling = match options.settles() {
            true => Some(Settling::new(context, &forest, options.error as f32)?),
            false => None,
        };
        let features = [
            (context.continued, "continued"),
            (context.continued, "extend"),
            (options.settles(), "settled"),
            (options.polishes(), "polish"),
        ];
        let features = features.into_iter().filter(|(on, _)| *on);
        let features: Vec<_> = features.map(|(_, name)| name).collect();
        let (read, write) = (Slot::Read, Slot::Write);
        let slots = [read, read, read, read, read, write, read];
        let slots = &slots[..6 + usize::from(options.settles())];
        let layout = layout(gpu, "grid/interpolate", slots);
        let module = module(gpu, "grid/interpolate", &features)?;
        let mirror = options.polishes().then_some(&stage.gbuffer.mirror_layout);
        let layouts = [Some(&stage.world.view_layout), mirror, Some(&layout)];
        let mut made = Self {
            interpolate: compute(gpu, &module, "interpolate", &layouts),
            raster,
            layout,
            points_layout: context.points_layout.clone(),
            places: storage(gpu, &forest.places),
            cells: forest.cells_on(gpu),
            forest,
            poses,
            settling,
            polishes: options.polishes(),
            sheets: context.sheets.to_vec(),
            on_sheets: Vec::new(),
            scene,
            fresh: true,
        };
        made.on_sheets = made.searches(gpu, stage);
        Ok(made)
    }

    /// World-space positions of the records, for objects as they stand.
    fn positions(&self) -> Vec<[f32; 4]> {
        let meshes = meshes(&self.scene);
        let all: Vec<_> = meshes.iter().copied().flatten().copied().collect();
        let vertices = self
            .forest
            .vertices
            .iter()
            .map(|vertex| all[*vertex as usize]);
        let moves = self.poses.iter().zip(&meshes).map(|(pose, positions)| {
            let pose = pose.as_ref();
            pose.map_or(DAffine3::IDENTITY, |pose| pose.moved(positions))
        });
        let moves: Vec<_> = moves.collect();
        let points = self.forest.points.iter();
        let points = points.map(|point| moves[point.object].transform_point3(point.rest).as_vec3());
        let positions = vertices.chain(points);
        positions.map(|p| p.extend(1.0).to_array()).collect()
    }

    /// Makes what is searched on each mirror, for objects as they stand.
    fn searches(&self, gpu: &Gpu, stage: &Stage) -> Vec<OnSheet> {
        let positions = storage_bytes(gpu, bytemuck::cast_slice(&self.positions()));
        let sheets = self.sheets.iter();
        sheets
            .map(|_| self.on_sheet(gpu, stage, &positions))
            .collect()
    }

    fn on_sheet(&self, gpu: &Gpu, stage: &Stage, positions: &wgpu::Buffer) -> OnSheet {
        let world = &stage.world;
        let layout = &self.points_layout;
        let (searched, settled) = match &self.settling {
            Some(settling) => {
                let (points, settled) = settling.on_sheet(gpu, layout, positions, &self.cells);
                (points, Some(settled))
            }
            None => {
                let records = self.forest.records();
                (Points::new(gpu, layout, positions, records), None)
            }
        };
        let interpolated = Points::new(gpu, layout, &world.positions, world.vertices());
        let mut buffers = vec![
            &self.places,
            &self.cells,
            positions,
            &searched.found,
            &world.positions,
            &interpolated.found,
        ];
        buffers.extend(settled.as_ref().map(|settled| &settled.states));
        let resources = buffers.iter().map(|buffer| buffer.as_entire_binding());
        let resources: Vec<_> = resources.collect();
        let found = interpolated.found.as_entire_binding();
        OnSheet {
            interpolate: group(gpu, &self.layout, &resources),
            draw: group(gpu, &self.raster.own_layout, &[found]),
            searched,
            settled,
            interpolated,
        }
    }
}

impl Refine for Interpolation {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        let now = &stage.world.scene;
        let mut objects = now.objects.iter().zip(&self.scene.objects);
        let mut mirrors = now.mirrors.iter().zip(&self.scene.mirrors);
        let still = objects.all(|(a, b)| a.mesh.positions == b.mesh.positions)
            && mirrors.all(|(a, b)| a.shape == b.shape);
        if !still {
            self.scene = now.clone();
            self.on_sheets = self.searches(gpu, stage);
            self.fresh = true;
        }
    }

    fn reads_maps(&self) -> bool {
        self.polishes
    }

    fn begin_frame(&mut self, gpu: &Gpu, _stage: &Stage, warm: bool) {
        let fresh = std::mem::take(&mut self.fresh);
        let warm = warm && !fresh;
        for OnSheet {
            searched, settled, ..
        } in &self.on_sheets
        {
            match settled {
                Some(_) => searched.set_list_warm(gpu, warm),
                None => searched.set_warm(gpu, self.forest.records(), warm),
            }
        }
    }

    fn record(
        &self,
        frame: &mut Recorder<'_>,
        stage: &Stage,
        search: &dyn Search,
        sheet: Sheet,
        variant: Variant,
    ) {
        let world = &stage.world;
        let on_sheet = &self.on_sheets[sheet.index];
        let searched = &on_sheet.searched;
        match (&self.settling, &on_sheet.settled) {
            (Some(settling), Some(settled)) => {
                settling.record(frame, stage, search, (sheet, searched, settled), variant);
            }
            _ => search.record_search(frame, stage, sheet, searched, variant),
        }
        frame.compute("interpolate", |pass| {
            pass.set_pipeline(&self.interpolate);
            pass.set_bind_group(0, &world.view_group, &[]);
            if self.polishes {
                pass.set_bind_group(1, &stage.maps().mirror_groups[sheet.mirror], &[]);
            }
            pass.set_bind_group(2, &on_sheet.interpolate, &[]);
            on_sheet.interpolated.run(pass, &self.interpolate);
        });
        let found = &on_sheet.draw;
        self.raster
            .record(frame, stage, sheet.mirror, found, variant, |pass| {
                pass.draw(self.raster.vertices(world.corners / 3), 0..1);
            });
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        let batches: Vec<_> = self.on_sheets.iter().map(|on| &on.interpolated).collect();
        in_a_row(gpu, stage, &self.sheets, &batches, false)
    }

    fn efforts(&self, gpu: &Gpu, _stage: &Stage) -> Efforts {
        let records = self.forest.records();
        let mut total = Efforts::default();
        for (sheet, on_sheet) in self.sheets.iter().zip(&self.on_sheets) {
            let mut efforts = match &on_sheet.settled {
                Some(settled) => settled.efforts(gpu, &on_sheet.searched, records),
                None => on_sheet.searched.total(gpu, records),
            };
            efforts.searched *= u64::from(sheet.number == 0);
            total.add(efforts);
        }
        total
    }

    fn triangles(&self, _gpu: &Gpu, stage: &Stage) -> Triangles {
        let triangles = u64::from(stage.world.corners / 3);
        let drawn = triangles * self.on_sheets.len() as u64;
        Triangles {
            input: triangles * stage.world.mirrors.len() as u64,
            drawn,
            by_level: vec![drawn],
            unfinished: 0,
        }
    }
}

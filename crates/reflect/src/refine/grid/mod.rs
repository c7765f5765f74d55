//! Grid interpolation (Estalella et al. 2005, §5): only the vertices of each mesh's bounding grid
//! are searched for; the mesh's own are interpolated between their virtual images.
//!
//! The grid belongs to a mesh and moves with it. A grid vertex inside a mirror has no reflection
//! there and is left out of the cells around it. By `fraction`, a mesh that would have no fewer grid
//! vertices than vertices is searched directly.

mod cells;
#[cfg(test)]
mod tests;

use catoptric_frame::{Triangles, VertexResult};
use catoptric_scene::{MirrorShape, Scene};
use encase::ShaderType;
use glam::{DVec3, Vec3};

use super::{Context, Recipe, Refine};
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, group, layout, module, storage, storage_bytes,
};
use crate::options::options;
use crate::refine::scene_vertices::in_a_row;
use crate::search::{Search, Sheet};
use crate::stage::Stage;
use crate::stage::options::Depth;
use crate::stage::points::{Efforts, Points};
use crate::stage::raster::Raster;
use crate::stage::variant::Variant;
use crate::technique::{Info, Named};
use cells::{Cells, Pose};

options! {
    /// The refinement, as its options describe it.
    pub(crate) struct Grid {
        /// grid vertices as a share of the mesh's; 1 searches every vertex of the mesh
        fraction: f64 = 0.1 in 0.0..=1.0,
        /// edge of the cells in world units, whatever their number; 0 goes by the fraction
        cell: f64 = 0.0 in 0.0..=1e6,
    }
}

impl Named for Grid {
    const INFO: Info = Info {
        name: "+grid",
        what: "interpolates vertices between the virtual images of a grid around each mesh",
        paper: "Estalella et al. 2005",
    };
}

impl Grid {
    /// Whether every mesh is searched directly: with as many grid vertices as vertices, nothing is
    /// interpolated.
    fn is_bypassed(&self) -> bool {
        self.cell <= 0.0 && self.fraction >= 1.0
    }
}

impl Recipe for Grid {
    /// A vertex that is reflected needs those of its cell's corners too that are not. Where there is
    /// no cell, it is the search as asked for.
    fn wants_continued(&self) -> bool {
        !self.is_bypassed()
    }

    fn make(&self, context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
        Ok(Box::new(Interpolation::new(self, context)?))
    }
}

/// Twin of `Place` in `grid.wesl`: where a vertex of the scene lies among what is searched.
#[derive(Clone, Copy, Debug, ShaderType)]
struct Place {
    /// Coordinates in the cell, 0 to 1.
    local: Vec3,
    /// A cell, or [`Place::DIRECT`] + a searched point.
    cell: u32,
}

impl Place {
    /// `cell`: the vertex is searched itself.
    const DIRECT: u32 = 1 << 31;
}

/// A mesh with its grid.
struct Mesh {
    /// `None`: searched directly.
    grid: Option<(Cells, Pose)>,
}

/// The refinement, ready for a scene.
struct Interpolation {
    raster: Raster,
    interpolate: Kernel,
    layout: wgpu::BindGroupLayout,
    points_layout: wgpu::BindGroupLayout,
    /// One an object.
    meshes: Vec<Mesh>,
    /// A [`Place`] a vertex of the scene.
    places: wgpu::Buffer,
    sheets: Vec<Sheet>,
    /// One a sheet.
    mirrors: Vec<OnMirror>,
    /// What the mirrors' searches were made for.
    scene: Scene,
    /// The searches are new: there are no answers of a previous frame.
    fresh: bool,
}

/// Searched and interpolated points on one sheet of a mirror.
struct OnMirror {
    searched: Points,
    count: u32,
    /// Grid vertices inside the mirror.
    dropped: u32,
    /// All vertices of the scene; its answers are written by the interpolation.
    interpolated: Points,
    interpolate: wgpu::BindGroup,
    draw: wgpu::BindGroup,
}

/// Corner of a cell that is inside the mirror; `DROPPED` in `grid.wesl`.
const DROPPED: u32 = u32::MAX;

impl Mesh {
    fn new(positions: &[Vec3], options: &Grid) -> Self {
        let edge = options.cell;
        let cells = if edge > 0.0 {
            (!positions.is_empty()).then(|| Cells::by_edge(positions, edge))
        } else {
            Cells::by_fraction(positions, options.fraction)
        };
        Self {
            grid: cells.zip(Pose::new(positions)),
        }
    }
}

/// Where each vertex of the scene is found. Searched points are numbered object by object: first
/// all that are vertices themselves, then those of the grids.
fn places(meshes: &[Mesh], scene: &Scene) -> Vec<Place> {
    let mut places = Vec::new();
    let (mut first_cell, mut direct) = (0, 0);
    for (mesh, object) in meshes.iter().zip(&scene.objects) {
        match &mesh.grid {
            Some((cells, _)) => {
                let place = |(cell, local): &(u32, Vec3)| Place {
                    local: *local,
                    cell: first_cell + cell,
                };
                places.extend(cells.places.iter().map(place));
                first_cell += cells.cells.len() as u32;
            }
            None => {
                for _ in &object.mesh.positions {
                    places.push(Place {
                        local: Vec3::ZERO,
                        cell: Place::DIRECT | direct,
                    });
                    direct += 1;
                }
            }
        }
    }
    places
}

/// The inside of a mirror.
struct Solid<'a> {
    shape: &'a dyn MirrorShape,
    low: DVec3,
    high: DVec3,
}

impl<'a> Solid<'a> {
    /// `None` for a mirror that encloses nothing.
    fn new(shape: &'a dyn MirrorShape) -> Option<Self> {
        let (low, high) = shape.bounds();
        shape.is_closed().then_some(Self { shape, low, high })
    }

    fn contains(&self, point: DVec3) -> bool {
        let in_box = point.cmpge(self.low).all() && point.cmple(self.high).all();
        in_box && self.shape.encloses(point)
    }
}

impl Interpolation {
    fn new(options: &Grid, context: &Context<'_>) -> Result<Self, ReflectError> {
        let Context { gpu, stage, .. } = context;
        let scene = stage.world.scene.clone();
        let meshes: Vec<_> = (scene.objects.iter())
            .map(|object| Mesh::new(&object.mesh.positions, options))
            .collect();
        let mut drawn = context.drawn;
        if !options.is_bypassed() {
            // Between images in space there are only images in space.
            drawn.depth = Depth::Virtual;
        }
        let raster = Raster::new(gpu, drawn, stage, "stage/virtual", &[], &[Slot::Read])?;
        let read = Slot::Read;
        let layout = layout(gpu, "grid", &[read, read, read, read, read, Slot::Write]);
        let continued = context.continued.then_some("continued");
        let module = module(gpu, "grid", continued.as_slice())?;
        let layouts = [Some(&stage.world.view_layout), Some(&layout)];
        let mut made = Self {
            interpolate: compute(gpu, &module, "interpolate", &layouts),
            raster,
            layout,
            points_layout: context.points_layout.clone(),
            places: storage(gpu, &places(&meshes, &scene)),
            meshes,
            sheets: context.sheets.to_vec(),
            mirrors: Vec::new(),
            scene,
            fresh: true,
        };
        made.mirrors = made.searches(gpu, stage);
        Ok(made)
    }

    /// Makes what is searched on each mirror, for objects and mirrors as they stand.
    fn searches(&self, gpu: &Gpu, stage: &Stage) -> Vec<OnMirror> {
        let shapes = self.sheets.iter();
        let shapes = shapes.map(|sheet| &self.scene.mirrors[sheet.mirror].shape);
        shapes
            .map(|shape| self.on_mirror(gpu, stage, &**shape))
            .collect()
    }

    fn on_mirror(&self, gpu: &Gpu, stage: &Stage, shape: &dyn MirrorShape) -> OnMirror {
        let solid = Solid::new(shape);
        let mut positions: Vec<[f32; 4]> = Vec::new();
        let four = |p: Vec3| [p.x, p.y, p.z, 1.0];
        let objects = || self.meshes.iter().zip(&self.scene.objects);
        for (mesh, object) in objects() {
            if mesh.grid.is_none() {
                positions.extend(object.mesh.positions.iter().copied().map(four));
            }
        }
        let mut corners = Vec::new();
        let mut dropped = 0;
        for (mesh, object) in objects() {
            let Some((cells, pose)) = &mesh.grid else {
                continue;
            };
            let moved = pose.moved(&object.mesh.positions);
            let vertices = cells.vertices.iter().map(|vertex| {
                let vertex = moved.transform_point3(*vertex);
                if solid.as_ref().is_some_and(|solid| solid.contains(vertex)) {
                    dropped += 1;
                    return DROPPED;
                }
                positions.push(four(vertex.as_vec3()));
                positions.len() as u32 - 1
            });
            let slots: Vec<_> = vertices.collect();
            let cells = cells.cells.iter().flatten();
            corners.extend(cells.map(|corner| slots[*corner as usize]));
        }
        let count = positions.len() as u32;
        let positions = storage_bytes(gpu, bytemuck::cast_slice(&positions));
        let searched = Points::new(gpu, &self.points_layout, &positions, count);
        let world = &stage.world;
        let vertices = world.vertices();
        let interpolated = Points::new(gpu, &self.points_layout, &world.positions, vertices);
        let corners = storage_bytes(gpu, bytemuck::cast_slice(&corners));
        let resources = [
            &self.places,
            &corners,
            &positions,
            &searched.found,
            &world.positions,
            &interpolated.found,
        ];
        let resources = resources.map(wgpu::Buffer::as_entire_binding);
        let found = interpolated.found.as_entire_binding();
        OnMirror {
            interpolate: group(gpu, &self.layout, &resources),
            draw: group(gpu, &self.raster.own_layout, &[found]),
            searched,
            count,
            dropped,
            interpolated,
        }
    }
}

impl Refine for Interpolation {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) {
        let now = &stage.world.scene;
        let objects = now.objects.iter().zip(&self.scene.objects);
        let mirrors = now.mirrors.iter().zip(&self.scene.mirrors);
        let still = objects
            .into_iter()
            .all(|(a, b)| a.mesh.positions == b.mesh.positions)
            && mirrors.into_iter().all(|(a, b)| a.shape == b.shape);
        if !still {
            self.scene = now.clone();
            self.mirrors = self.searches(gpu, stage);
            self.fresh = true;
        }
    }

    fn begin_frame(&mut self, gpu: &Gpu, _stage: &Stage, warm: bool) {
        let warm = warm && !std::mem::take(&mut self.fresh);
        for mirror in &self.mirrors {
            mirror.searched.set_warm(gpu, mirror.count, warm);
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
        let on_mirror = &self.mirrors[sheet.index];
        search.record_search(frame, stage, sheet, &on_mirror.searched, variant);
        frame.compute("interpolate", |pass| {
            pass.set_pipeline(&self.interpolate);
            pass.set_bind_group(0, &world.view_group, &[]);
            pass.set_bind_group(1, &on_mirror.interpolate, &[]);
            on_mirror.interpolated.run(pass, &self.interpolate);
        });
        let found = &on_mirror.draw;
        self.raster
            .record(frame, stage, sheet.mirror, found, variant, |pass| {
                pass.draw(0..world.corners, 0..1);
            });
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage) -> Vec<VertexResult> {
        let batches: Vec<_> = self.mirrors.iter().map(|on| &on.interpolated).collect();
        in_a_row(gpu, stage, &self.sheets, &batches, false)
    }

    fn efforts(&self, gpu: &Gpu, _stage: &Stage) -> Efforts {
        let mut total = Efforts::default();
        for (sheet, on_mirror) in self.sheets.iter().zip(&self.mirrors) {
            let mut efforts = on_mirror.searched.total(gpu, on_mirror.count);
            efforts.searched *= u64::from(sheet.number == 0);
            total.add(efforts);
        }
        total
    }

    fn notes(&self) -> Vec<String> {
        let inside = self.mirrors.iter().zip(&self.sheets);
        inside
            .filter(|(on, sheet)| on.dropped > 0 && sheet.number == 0)
            .map(|(on, sheet)| {
                let all = on.count + on.dropped;
                let name = &self.scene.mirrors[sheet.mirror].name;
                format!(
                    "{} of {all} grid vertices lie inside mirror `{name}` and are left out",
                    on.dropped
                )
            })
            .collect()
    }

    fn triangles(&self, _gpu: &Gpu, stage: &Stage) -> Triangles {
        let triangles = u64::from(stage.world.corners / 3);
        let drawn = triangles * self.mirrors.len() as u64;
        Triangles {
            input: triangles * stage.world.mirrors.len() as u64,
            drawn,
            by_level: vec![drawn],
            unfinished: 0,
        }
    }
}

//! Grid interpolation (Estalella et al. 2005, §5): only the vertices of each mesh's bounding grid
//! are searched for; the mesh's own are interpolated between their virtual images.
//!
//! The grid belongs to a mesh and moves with it. A grid vertex inside a mirror has no reflection
//! there and is left out of the cells around it. By `fraction`, a mesh that would have no fewer grid
//! vertices than vertices is searched directly.

mod cells;

use catoptric_frame::{Triangles, VertexResult};
use catoptric_scene::{Scene, Shape};
use glam::{DVec3, Vec3};

use super::{Context, Refine};
use crate::error::ReflectError;
use crate::gpu::{Gpu, Recorder, Slot, compute, group, layout, module, storage, storage_bytes};
use crate::search::Search;
use crate::spec::Options;
use crate::stage::Stage;
use crate::stage::data::GridPlace;
use crate::stage::points::{Efforts, Points};
use crate::stage::raster::Raster;
use crate::technique::Variant;
use cells::{Cells, Pose};

/// A mesh with its grid.
struct Mesh {
    /// `None`: searched directly.
    grid: Option<(Cells, Pose)>,
}

struct Grid {
    raster: Raster,
    interpolate: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    points_layout: wgpu::BindGroupLayout,
    /// One an object.
    meshes: Vec<Mesh>,
    /// A [`GridPlace`] a vertex of the scene.
    places: wgpu::Buffer,
    mirrors: Vec<OnMirror>,
    /// What the mirrors' searches were made for.
    scene: Scene,
    /// The searches are new: there are no answers of a previous frame.
    fresh: bool,
}

/// Searched and interpolated points on one mirror.
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

/// Whether every mesh is searched directly: with as many grid vertices as vertices, nothing is
/// interpolated.
pub(super) fn is_bypassed(options: &Options) -> bool {
    options.number("cell") <= 0.0 && options.number("fraction") >= 1.0
}

pub(crate) fn make(context: &Context<'_>) -> Result<Box<dyn Refine>, ReflectError> {
    let Context { gpu, stage, .. } = context;
    let options = context.options.expect("a refinement has options");
    let scene = stage.world.scene.clone();
    let meshes: Vec<_> = (scene.objects.iter())
        .map(|object| Mesh::new(&object.mesh.positions, options))
        .collect();
    // Between images in space there are only images in space.
    let drawn = match is_bypassed(options) {
        true => context.search_options.clone(),
        false => context.search_options.with("depth", "virtual"),
    };
    let raster = Raster::new(gpu, &drawn, stage, "virtual", &[], &[Slot::Read])?;
    let read = Slot::Read;
    let layout = layout(gpu, "grid", &[read, read, read, read, read, Slot::Write]);
    let continued = context.searched_options.is("hidden", "extend");
    let continued = continued.then_some("continued");
    let module = module(gpu, "grid", continued.as_slice())?;
    let layouts = [Some(&stage.world.view_layout), Some(&layout)];
    let mut grid = Grid {
        interpolate: compute(gpu, &module, "interpolate", &layouts),
        raster,
        layout,
        points_layout: context.points_layout.clone(),
        places: storage(gpu, &places(&meshes, &scene)),
        meshes,
        mirrors: Vec::new(),
        scene,
        fresh: true,
    };
    grid.mirrors = grid.searches(gpu, stage);
    Ok(Box::new(grid))
}

impl Mesh {
    fn new(positions: &[Vec3], options: &Options) -> Self {
        let edge = options.number("cell");
        let cells = if edge > 0.0 {
            (!positions.is_empty()).then(|| Cells::by_edge(positions, edge))
        } else {
            Cells::by_fraction(positions, options.number("fraction"))
        };
        Self {
            grid: cells.zip(Pose::new(positions)),
        }
    }
}

/// Where each vertex of the scene is found. Searched points are numbered object by object: first
/// all that are vertices themselves, then those of the grids.
fn places(meshes: &[Mesh], scene: &Scene) -> Vec<GridPlace> {
    let mut places = Vec::new();
    let (mut first_cell, mut direct) = (0, 0);
    for (mesh, object) in meshes.iter().zip(&scene.objects) {
        match &mesh.grid {
            Some((cells, _)) => {
                let place = |(cell, local): &(u32, Vec3)| GridPlace {
                    local: *local,
                    cell: first_cell + cell,
                };
                places.extend(cells.places.iter().map(place));
                first_cell += cells.cells.len() as u32;
            }
            None => {
                for _ in &object.mesh.positions {
                    places.push(GridPlace {
                        local: Vec3::ZERO,
                        cell: GridPlace::DIRECT | direct,
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
    shape: &'a Shape,
    low: DVec3,
    high: DVec3,
}

impl<'a> Solid<'a> {
    /// `None` for a mirror that encloses nothing.
    fn new(shape: &'a Shape) -> Option<Self> {
        let (low, high) = shape.bounds();
        shape.is_closed().then_some(Self { shape, low, high })
    }

    fn contains(&self, point: DVec3) -> bool {
        let in_box = point.cmpge(self.low).all() && point.cmple(self.high).all();
        in_box
            && match self.shape {
                Shape::Mesh(mesh) => mesh.winding_number(point).abs() > 0.5,
                shape => shape.contains(point),
            }
    }
}

impl Grid {
    /// Makes what is searched on each mirror, for objects and mirrors as they stand.
    fn searches(&self, gpu: &Gpu, stage: &Stage) -> Vec<OnMirror> {
        let shapes = self.scene.mirrors.iter().map(|mirror| &mirror.shape);
        shapes
            .map(|shape| self.on_mirror(gpu, stage, shape))
            .collect()
    }

    fn on_mirror(&self, gpu: &Gpu, stage: &Stage, shape: &Shape) -> OnMirror {
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

impl Refine for Grid {
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
        mirror: usize,
        variant: Variant,
    ) {
        let world = &stage.world;
        let on_mirror = &self.mirrors[mirror];
        search.record_search(frame, stage, mirror, &on_mirror.searched, variant);
        frame.compute("interpolate", |pass| {
            pass.set_pipeline(&self.interpolate);
            pass.set_bind_group(0, &world.view_group, &[]);
            pass.set_bind_group(1, &on_mirror.interpolate, &[]);
            on_mirror.interpolated.run(pass);
        });
        let found = &on_mirror.draw;
        self.raster
            .record(frame, stage, mirror, found, variant, |pass| {
                pass.draw(0..world.corners, 0..1);
            });
    }

    fn vertices(&self, gpu: &Gpu, stage: &Stage, _search: &dyn Search) -> Vec<VertexResult> {
        let places: Vec<_> = stage.world.places().collect();
        let mirrors = stage.world.mirrors.iter().zip(&self.mirrors);
        mirrors
            .flat_map(|(mirror, on)| on.interpolated.results(gpu, mirror.id, &places, false))
            .collect()
    }

    fn efforts(&self, gpu: &Gpu, _stage: &Stage) -> Efforts {
        let mut total = Efforts::default();
        for mirror in &self.mirrors {
            total.add(mirror.searched.total(gpu, mirror.count));
        }
        total
    }

    fn notes(&self) -> Vec<String> {
        let inside = self.mirrors.iter().zip(&self.scene.mirrors);
        inside
            .filter(|(on, _)| on.dropped > 0)
            .map(|(on, mirror)| {
                let all = on.count + on.dropped;
                let name = &mirror.name;
                format!(
                    "{} of {all} grid vertices lie inside mirror `{name}` and are left out",
                    on.dropped
                )
            })
            .collect()
    }

    fn triangles(&self, _gpu: &Gpu, stage: &Stage) -> Triangles {
        let drawn = u64::from(stage.world.corners / 3) * self.mirrors.len() as u64;
        Triangles {
            input: drawn,
            drawn,
            by_level: vec![drawn],
            unfinished: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_frame::VertexState;
    use glam::Vec2;

    use super::*;
    use crate::spec::parse;
    use crate::technique::Prepared;
    use crate::testing::{gpu_or_skip, scene};
    use crate::{Output, prepare};

    /// All but exact.
    const SEARCH: &str = "reflector-cubemap(iterations=60,size=128,hidden=extend,depth=virtual)";
    /// Of the pictures, which do not matter: reflection points are found without them.
    const SIZE: [u32; 2] = [32, 32];

    fn ready<'g>(gpu: &'g Gpu, scene: &Scene, technique: &str) -> Prepared<'g> {
        let spec = parse(technique).expect("a technique");
        prepare(gpu, &spec, scene, SIZE).expect("fits the device")
    }

    fn render(gpu: &Gpu, scene: &Scene, refinement: &str) -> Output {
        let technique = format!("{SEARCH}{refinement}");
        ready(gpu, scene, &technique).render().expect("renders")
    }

    /// State and image coordinates of every vertex.
    fn answers(output: &Output) -> Vec<(VertexState, Vec2)> {
        let vertices = output.vertices.iter().flatten();
        vertices.map(|vertex| (vertex.state, vertex.at)).collect()
    }

    #[test]
    fn fraction_one_bypasses_the_grid_and_a_tenth_searches_a_tenth() {
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene("sphere-objects-1k");
        let plain = render(&gpu, &scene, "");
        let bypassed = render(&gpu, &scene, "+grid(fraction=1)");
        assert_eq!(answers(&plain), answers(&bypassed));
        assert_eq!(
            (plain.searched, plain.work),
            (bypassed.searched, bypassed.work)
        );
        // Whatever the search was asked for.
        for search in ["linear", "newton"] {
            let spec = |refinement| parse(&format!("{search}{refinement}")).expect("a technique");
            let [alone, bypassed] = ["", "+grid(fraction=1)"].map(|refinement| {
                let prepared = prepare(&gpu, &spec(refinement), &scene, [80, 60]);
                prepared
                    .expect("fits the device")
                    .render()
                    .expect("renders")
            });
            assert_eq!(alone.frame.color, bypassed.frame.color, "{search}");
        }
        let tenth = render(&gpu, &scene, "+grid(fraction=0.1)");
        let share = tenth.searched as f64 / plain.searched as f64;
        // Objects of a few dozen vertices cannot come down to a tenth.
        assert!((0.05..0.3).contains(&share), "{share}");
    }

    #[test]
    fn interpolation_is_as_exact_as_the_cells_are_small() {
        // Mean offsets of a prototype in pixels of a 512 × 512 picture, by the edge of the cells in
        // radii. It had vertices around the sphere, not those that nearly touch it, where cells
        // reach into the mirror: hence those from a radius away.
        const MEANS: [(f64, f32); 4] = [(0.1, 0.04), (0.25, 0.2), (0.5, 0.72), (1.0, 2.2)];
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene("prototype-sphere");
        let exact = answers(&render(&gpu, &scene, ""));
        let far: Vec<_> = (scene.objects[0].mesh.positions.iter())
            .map(|position| position.length() > 2.2)
            .collect();
        for (edge, mean) in MEANS {
            let found = render(&gpu, &scene, &format!("+grid(cell={edge})"));
            let pairs = exact.iter().zip(answers(&found)).zip(&far);
            let gaps = pairs.filter(|(_, far)| **far);
            let gaps: Vec<_> = gaps.map(|((a, b), _)| a.1.distance(b.1) * 16.0).collect();
            let found = gaps.iter().sum::<f32>() / gaps.len() as f32;
            assert!(gaps.len() > 500, "{} vertices", gaps.len());
            assert!(found < mean, "{found} px in cells of {edge}");
        }
    }

    #[test]
    fn drawing_is_in_space_whatever_the_depth_option() {
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene("sphere-objects-1k");
        let draw = |technique: &str| {
            let output = ready(&gpu, &scene, technique).render().expect("renders");
            let reflected = output.frame.reflected.expect("all layers");
            (reflected.id, reflected.position)
        };
        let thesis = draw("linear(depth=thesis)+grid");
        assert_eq!(thesis, draw("linear(depth=virtual)+grid"));
        // What it would have been.
        assert_ne!(draw("linear(depth=thesis)"), draw("linear(depth=virtual)"));
    }

    #[test]
    fn hidden_corners_are_continued_though_hidden_triangles_are_dropped() {
        // Interpolation does not depend on what is drawn; only which vertices count as hidden does.
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene("sphere-touching");
        let with = |hidden: &str| {
            let technique =
                format!("reflector-cubemap(iterations=60,size=128,hidden={hidden})+grid");
            let output = ready(&gpu, &scene, &technique).render().expect("renders");
            answers(&output)
        };
        assert_eq!(with("drop"), with("extend"));
        // The hierarchy cannot continue them: all that a hidden corner touches is dropped.
        let hidden = |answers: Vec<(VertexState, Vec2)>| {
            let states = answers.into_iter().map(|(state, _)| state);
            states.filter(|state| *state == VertexState::Hidden).count()
        };
        let hierarchy = ready(&gpu, &scene, "ray-hierarchy(repair=enlarge)+grid").render();
        let hierarchy = hidden(answers(&hierarchy.expect("renders")));
        assert!(hierarchy > hidden(with("drop")), "{hierarchy}");
    }

    #[test]
    fn corners_inside_the_mirror_are_left_out_and_counted() {
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let scene = scene("sphere-touching");
        let touching = render(&gpu, &scene, "+grid");
        assert_eq!(touching.notes.len(), 1, "{:?}", touching.notes);
        assert!(touching.notes[0].contains("inside mirror `ball`"));
        // A vertex that has lost all corners is hidden inside, and none is lost.
        let positions = scene
            .objects
            .iter()
            .flat_map(|object| &object.mesh.positions);
        let mut hidden_inside = 0;
        for ((state, _), position) in answers(&touching).iter().zip(positions) {
            assert_ne!(*state, VertexState::Failed, "{position}");
            let inside = scene.mirrors[0].shape.contains(position.as_dvec3());
            hidden_inside += u32::from(inside && *state == VertexState::Hidden);
        }
        assert!(hidden_inside > 0);
    }

    #[test]
    fn the_grid_moves_with_its_mesh() {
        // Where the mesh went, the same grid gives what a grid made there gives: the move is along
        // the axes, so that both divide the mesh alike. Rounding of the moved positions, in pixels
        // of this small picture.
        const ROUNDING: f32 = 1e-3;
        let Some(gpu) = gpu_or_skip() else {
            return;
        };
        let mut scene = scene("sphere-objects-1k");
        let technique = format!("{SEARCH}+grid");
        let mut moving = ready(&gpu, &scene, &technique);
        moving.render().expect("renders");
        for object in &mut scene.objects {
            for position in &mut object.mesh.positions {
                *position += Vec3::new(0.25, 0.0, 0.5);
            }
        }
        moving.update(&scene).expect("the same scene");
        let moved = moving.render().expect("renders");
        let fresh = render(&gpu, &scene, "+grid");
        let pairs = answers(&moved).into_iter().zip(answers(&fresh));
        let worst = pairs.map(|(a, b)| a.1.distance(b.1)).fold(0.0, f32::max);
        assert!(worst < ROUNDING, "{worst}");
    }
}

//! What is searched for a scene's meshes, and the cells between: grids, or trees of cells.
//!
//! A tree's cells depend on where vertices are, not on mirror or view: its memory is bounded by the mesh.
//! Each cell with corners holds at least nine vertices, so that a level has at most one corner or centre a
//! vertex. Each takes 72 bytes a mirror and 16 once; twelve levels of them are at most 1.1 kB a vertex with one
//! mirror. Meshes that are surfaces have a third of a corner or centre a vertex.
//!
//! The records that a search answers for are scene vertices first, then corners and centres of
//! cells. They depend on the meshes alone; which of them a frame asks for is settled on the GPU,
//! unless all of them are (`mixed=interpolate`).

use std::collections::HashMap;
use std::ops::Range;

use encase::{ShaderSize, ShaderType};
use glam::{DVec3, Vec3};

use super::cells::Cells;
use crate::gpu::{Gpu, storage, storage_zeros};

/// Twin of `Place` in `grid/cells.wesl`: where a vertex of the scene lies among what is searched.
#[derive(Clone, Copy, Debug, PartialEq, ShaderType)]
pub(super) struct Place {
    /// Coordinates in the cell, 0 to 1.
    pub local: Vec3,
    /// The innermost cell around it, or [`Place::DIRECT`] + its own record.
    pub cell: u32,
}

impl Place {
    /// `cell`: the vertex is searched itself, in every frame.
    pub const DIRECT: u32 = 1 << 31;
}

/// Twin of `Cell` in `grid/cells.wesl`.
#[derive(Clone, Copy, Debug, PartialEq, ShaderType)]
pub(super) struct Cell {
    /// Coordinates, in the parent, of the corner of this cell that has 0 here.
    pub offset: Vec3,
    /// The cell that it is a part of, or [`NONE`].
    pub parent: u32,
    /// Extent, that of the parent being 1.
    pub scale: Vec3,
    /// Record of its centre; [`NONE`] where none is looked at.
    pub center: u32,
    /// Records of its corners; corner `x + 2y + 4z` at local coordinates `(x, y, z)`.
    pub corners: [u32; 8],
    /// Its first part: a cell, or in a leaf a place in [`Forest::order`].
    pub first: u32,
    /// Number of its parts.
    pub count: u32,
    /// 1: it has no corners. Its parts are vertices, which are searched themselves.
    pub leaf: u32,
}

/// No cell, or no record.
pub(super) const NONE: u32 = u32::MAX;

/// A cell that holds no more vertices than this has no corners: eight corners and a centre would be nine points
/// to search.
const FEW: usize = 8;

/// Most levels of cells: at the last one, each holds a 4096th of its mesh along an axis.
const MOST_LEVELS: usize = 13;

/// Shares of the longest extent below which a cell is not halved along an axis, so that its parts
/// come near to cubes.
const SHORT: f64 = 0.7;

/// A corner or a centre of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Index of the object that it moves with.
    pub object: usize,
    /// World space, when the cells were made.
    pub rest: DVec3,
}

/// Cells around the meshes of a scene, and what is to be searched.
#[derive(Clone, Debug, Default)]
pub(super) struct Forest {
    /// Scene vertices that have a record, in order.
    pub vertices: Vec<u32>,
    /// What else has one, after them.
    pub points: Vec<Point>,
    /// Level by level; a level's cells are parts of the one before.
    pub cells: Vec<Cell>,
    /// Each level's cells; none where every record is searched, so that a frame has nothing to settle.
    pub levels: Vec<Range<u32>>,
    /// Scene vertices in the order of the leaves that they lie in.
    pub order: Vec<u32>,
    /// One a scene vertex.
    pub places: Vec<Place>,
}

/// A cell that is still to be made.
struct Pending {
    object: usize,
    low: DVec3,
    high: DVec3,
    /// Indices in the scene.
    vertices: Vec<u32>,
    offset: Vec3,
    scale: Vec3,
    parent: u32,
}

/// Vertices of the scene before each object's.
fn firsts(meshes: &[&[Vec3]]) -> Vec<u32> {
    let counts = meshes.iter().map(|positions| positions.len() as u32);
    counts
        .scan(0, |next, count| {
            let first = *next;
            *next += count;
            Some(first)
        })
        .collect()
}

impl Forest {
    /// Grids, one a mesh; `None` for a mesh that is searched directly. Every record is searched.
    pub(super) fn of_grids(meshes: &[&[Vec3]], grids: &[Option<Cells>]) -> Self {
        let mut made = Self::default();
        for ((positions, grid), first) in meshes.iter().zip(grids).zip(firsts(meshes)) {
            if grid.is_none() {
                made.vertices.extend(first..first + positions.len() as u32);
            }
        }
        let mut direct = 0;
        for (object, (positions, grid)) in meshes.iter().zip(grids).enumerate() {
            let Some(grid) = grid else {
                made.places.extend(positions.iter().map(|_| {
                    direct += 1;
                    Place {
                        local: Vec3::ZERO,
                        cell: Place::DIRECT | (direct - 1),
                    }
                }));
                continue;
            };
            let cells = made.cells.len() as u32;
            made.add_roots(object, grid);
            made.places
                .extend(grid.places.iter().map(|(cell, local)| Place {
                    local: *local,
                    cell: cells + cell,
                }));
        }
        made
    }

    /// The same, where a frame settles which vertices it searches beside the grids: each cell of a
    /// grid has one part, a leaf with the vertices in it.
    pub(super) fn of_grids_with_leaves(meshes: &[&[Vec3]], grids: &[Option<Cells>]) -> Self {
        let vertices: usize = meshes.iter().map(|positions| positions.len()).sum();
        let mut made = Self::for_all(vertices);
        // What is searched in any case, in leaves of the first level.
        for ((positions, grid), first) in meshes.iter().zip(grids).zip(firsts(meshes)) {
            let all: Vec<_> = (first..first + positions.len() as u32).collect();
            if grid.is_none() {
                for few in all.chunks(FEW) {
                    made.add_leaf(NONE, few, |_| Vec3::ZERO);
                }
            }
        }
        let leaves = made.cells.len() as u32;
        for (object, grid) in grids.iter().enumerate() {
            if let Some(grid) = grid {
                made.add_roots(object, grid);
            }
        }
        let roots = made.cells.len() as u32;
        let mut root = leaves;
        for (grid, first) in grids.iter().zip(firsts(meshes)) {
            let Some(grid) = grid else { continue };
            let mut held = vec![Vec::new(); grid.cells.len()];
            for (vertex, (cell, _)) in (first..).zip(&grid.places) {
                held[*cell as usize].push(vertex);
            }
            for vertices in held {
                let cell = &mut made.cells[root as usize];
                (cell.first, cell.count) = (roots + root - leaves, 1);
                let local = |vertex: u32| grid.places[(vertex - first) as usize].1;
                made.add_leaf(root, &vertices, local);
                root += 1;
            }
        }
        made.levels = vec![0..roots, roots..made.cells.len() as u32];
        made
    }

    /// A tree of cells around each mesh, which a frame goes down as far as it must.
    pub(super) fn of_trees(meshes: &[&[Vec3]]) -> Self {
        let all: Vec<_> = meshes.iter().copied().flatten().copied().collect();
        let mut made = Self::for_all(all.len());
        let mut records = HashMap::new();
        let roots = meshes.iter().zip(firsts(meshes)).enumerate();
        let roots = roots.map(|(object, (positions, first))| {
            let vertices = (first..first + positions.len() as u32).collect();
            let everywhere = (DVec3::NEG_INFINITY, DVec3::INFINITY);
            Pending::new(object, everywhere, vertices, NONE, &all)
        });
        let mut level: Vec<_> = roots.filter(|root| !root.vertices.is_empty()).collect();
        while !level.is_empty() {
            let first = made.cells.len() as u32;
            let next = first + level.len() as u32;
            let deepest = made.levels.len() + 1 == MOST_LEVELS;
            let mut parts = Vec::new();
            for pending in level {
                let local = |vertex: u32| pending.local(all[vertex as usize]);
                let flat = pending.low == pending.high;
                if pending.vertices.len() <= FEW || deepest || flat {
                    made.add_leaf(pending.parent, &pending.vertices, local);
                    let leaf = made.cells.last_mut().expect("added above");
                    (leaf.offset, leaf.scale) = (pending.offset, pending.scale);
                    continue;
                }
                let index = made.cells.len() as u32;
                let before = parts.len();
                parts.extend(pending.parts(index, &all));
                let mut record = |place: DVec3| {
                    let bits = place.to_array().map(f64::to_bits);
                    *records.entry((pending.object, bits)).or_insert_with(|| {
                        made.points.push(Point {
                            object: pending.object,
                            rest: place,
                        });
                        (made.vertices.len() + made.points.len() - 1) as u32
                    })
                };
                let corners = std::array::from_fn(|corner| record(pending.corner(corner)));
                made.cells.push(Cell {
                    offset: pending.offset,
                    parent: pending.parent,
                    scale: pending.scale,
                    center: record(pending.middle()),
                    corners,
                    first: next + before as u32,
                    count: (parts.len() - before) as u32,
                    leaf: 0,
                });
            }
            made.levels.push(first..next);
            level = parts;
        }
        made
    }

    /// All vertices of a scene have a record, that of their index.
    fn for_all(vertices: usize) -> Self {
        let nowhere = Place {
            local: Vec3::ZERO,
            cell: NONE,
        };
        Self {
            vertices: (0..vertices as u32).collect(),
            places: vec![nowhere; vertices],
            ..Self::default()
        }
    }

    /// Records of all kinds.
    pub(super) fn records(&self) -> u32 {
        (self.vertices.len() + self.points.len()) as u32
    }

    /// Its cells, as shaders read them. There is room for one where there is none.
    pub(super) fn cells_on(&self, gpu: &Gpu) -> wgpu::Buffer {
        match self.cells.is_empty() {
            true => storage_zeros(gpu, Cell::SHADER_SIZE.get()),
            false => storage(gpu, &self.cells),
        }
    }

    /// The cells of a grid, without parts.
    fn add_roots(&mut self, object: usize, grid: &Cells) {
        let first = self.records();
        let points = grid.vertices.iter();
        self.points.extend(points.map(|rest| Point {
            object,
            rest: *rest,
        }));
        self.cells.extend(grid.cells.iter().map(|corners| Cell {
            offset: Vec3::ZERO,
            parent: NONE,
            scale: Vec3::ONE,
            center: NONE,
            corners: corners.map(|corner| first + corner),
            first: 0,
            count: 0,
            leaf: 0,
        }));
    }

    /// A cell whose parts are these vertices; `local` gives their coordinates in it.
    fn add_leaf(&mut self, parent: u32, vertices: &[u32], local: impl Fn(u32) -> Vec3) {
        let cell = self.cells.len() as u32;
        for vertex in vertices {
            let local = local(*vertex);
            self.places[*vertex as usize] = Place { local, cell };
        }
        self.cells.push(Cell {
            offset: Vec3::ZERO,
            parent,
            scale: Vec3::ONE,
            center: NONE,
            corners: [NONE; 8],
            first: self.order.len() as u32,
            count: vertices.len() as u32,
            leaf: 1,
        });
        self.order.extend(vertices);
    }
}

impl Pending {
    /// What a box holds; along an axis in which the vertices have no extent it has none either.
    fn new(
        object: usize,
        (low, high): (DVec3, DVec3),
        vertices: Vec<u32>,
        parent: u32,
        all: &[Vec3],
    ) -> Self {
        let held = vertices.iter().map(|vertex| all[*vertex as usize]);
        let around = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (least, most) = held.fold(around, |(low, high), p| (low.min(p), high.max(p)));
        let (least, most) = (least.as_dvec3(), most.as_dvec3());
        let whole = parent == NONE;
        let tight = |axis: usize| whole || least[axis] == most[axis];
        let low = |axis| if tight(axis) { least[axis] } else { low[axis] };
        let high = |axis| if tight(axis) { most[axis] } else { high[axis] };
        Self {
            object,
            low: DVec3::new(low(0), low(1), low(2)),
            high: DVec3::new(high(0), high(1), high(2)),
            vertices,
            offset: Vec3::ZERO,
            scale: Vec3::ONE,
            parent,
        }
    }

    fn middle(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    fn corner(&self, corner: usize) -> DVec3 {
        let along = |axis: usize| match corner >> axis & 1 {
            0 => self.low[axis],
            _ => self.high[axis],
        };
        DVec3::new(along(0), along(1), along(2))
    }

    /// Coordinates in the box, 0 along an axis in which it has no extent.
    fn share(&self, place: DVec3) -> DVec3 {
        let extent = self.high - self.low;
        let along = |axis: usize| match extent[axis] > 0.0 {
            true => (place[axis] - self.low[axis]) / extent[axis],
            false => 0.0,
        };
        DVec3::new(along(0), along(1), along(2))
    }

    fn local(&self, position: Vec3) -> Vec3 {
        let share = self.share(position.as_dvec3());
        share.clamp(DVec3::ZERO, DVec3::ONE).as_vec3()
    }

    /// The halves along its long axes that hold vertices, as parts of the cell that it becomes.
    fn parts(&self, cell: u32, all: &[Vec3]) -> Vec<Self> {
        let (middle, extent) = (self.middle(), self.high - self.low);
        let halved = extent.cmpge(DVec3::splat(SHORT * extent.max_element()));
        let mut held: [Vec<u32>; 8] = Default::default();
        for vertex in &self.vertices {
            let upper = all[*vertex as usize].as_dvec3().cmpge(middle) & halved;
            held[upper.bitmask() as usize].push(*vertex);
        }
        let parts = held.into_iter().enumerate();
        let parts = parts.filter(|(_, vertices)| !vertices.is_empty());
        parts
            .map(|(upper, vertices)| {
                let upper = glam::BVec3::new(upper & 1 != 0, upper & 2 != 0, upper & 4 != 0);
                let low = DVec3::select(upper, middle, self.low);
                let high = DVec3::select(halved & !upper, middle, self.high);
                let mut part = Self::new(self.object, (low, high), vertices, cell, all);
                let [offset, end] = [part.low, part.high].map(|end| self.share(end));
                part.offset = offset.as_vec3();
                part.scale = (end - offset).as_vec3();
                part
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::scene;

    /// World-space position of what has these coordinates in a cell of a tree.
    fn place_of(forest: &Forest, mut cell: usize, mut local: Vec3) -> DVec3 {
        let cells = &forest.cells;
        // A leaf has no corners to count from.
        while cells[cell].leaf == 1 && cells[cell].parent != NONE {
            local = cells[cell].offset + cells[cell].scale * local;
            cell = cells[cell].parent as usize;
        }
        let corner = |index: usize| {
            let record = cells[cell].corners[index] as usize;
            forest.points[record - forest.vertices.len()].rest
        };
        let ways = [1, 2, 4].map(|index| corner(index) - corner(0));
        let local = local.as_dvec3();
        corner(0) + local.x * ways[0] + local.y * ways[1] + local.z * ways[2]
    }

    #[test]
    fn every_cell_of_a_tree_around_a_vertex_gives_it_back() {
        let scene = scene("kitchen");
        let meshes: Vec<_> = (scene.objects.iter())
            .map(|object| object.mesh.positions.as_slice())
            .collect();
        let forest = Forest::of_trees(&meshes);
        let all: Vec<_> = meshes.iter().copied().flatten().collect();
        for (position, place) in all.iter().zip(&forest.places) {
            let (mut cell, mut local) = (place.cell as usize, place.local);
            assert_eq!(forest.cells[cell].leaf, 1);
            while forest.cells[cell].parent != NONE {
                let part = &forest.cells[cell];
                (local, cell) = (part.offset + part.scale * local, part.parent as usize);
                let gap = place_of(&forest, cell, local).distance(position.as_dvec3());
                assert!(gap < 1e-5, "{gap}");
            }
        }
        let mut order = forest.order.clone();
        order.sort_unstable();
        assert_eq!(order, forest.vertices, "each vertex in one leaf");
    }

    #[test]
    fn trees_take_half_a_record_a_vertex_more_than_the_vertices() {
        for name in ["kitchen", "sphere-objects-20k"] {
            let scene = scene(name);
            let meshes: Vec<_> = (scene.objects.iter())
                .map(|object| object.mesh.positions.as_slice())
                .collect();
            let forest = Forest::of_trees(&meshes);
            let vertices = forest.vertices.len() as f64;
            assert!(f64::from(forest.records()) < 1.5 * vertices, "{name}");
            assert!((forest.cells.len() as f64) < 0.5 * vertices, "{name}");
        }
    }

    #[test]
    fn what_cannot_be_divided_is_a_leaf() {
        let one_place = vec![Vec3::new(0.1, -2.0, 3.0); 50];
        let forest = Forest::of_trees(&[&one_place, &[], &[Vec3::X]]);
        assert_eq!(forest.cells.len(), 2);
        assert!(forest.cells.iter().all(|cell| cell.leaf == 1));
        // Two clusters, nearer to one another than the smallest cell is large beside a third vertex.
        let mut near = one_place;
        near.extend([Vec3::new(0.1, -2.0, 3.000_01); 50]);
        near.push(Vec3::splat(1e3));
        let forest = Forest::of_trees(&[&near]);
        assert!(forest.levels.len() <= MOST_LEVELS);
        assert!(forest.points.len() <= 9 * MOST_LEVELS);
    }
}

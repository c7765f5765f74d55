//! The bounding grid of a mesh: which cells it has, and where in them the vertices lie
//! (Estalella et al. 2005, §5). World space.

use glam::{DVec3, UVec3, Vec3};

/// The occupied cells of an axis-aligned grid around a mesh, as it stood when the grid was made.
///
/// Along an axis in which the mesh has no extent, the grid is a single layer of vertices.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cells {
    /// World-space corners of all occupied cells, each once; without those that no vertex of the
    /// mesh is interpolated from.
    pub vertices: Vec<DVec3>,
    /// Indices into `vertices` of a cell's corners: corner `x + 2y + 4z` at local coordinates `(x, y, z)`;
    /// in a flat grid both ends of an axis are the same vertex. A corner that no vertex of this cell needs
    /// is replaced by one that is needed.
    pub cells: Vec<[u32; 8]>,
    /// For each vertex of the mesh, its cell and its local coordinates in [0, 1]³.
    pub places: Vec<(u32, Vec3)>,
    /// Corners that no vertex of the mesh is interpolated from.
    pub unneeded: usize,
}

/// A box divided evenly.
#[derive(Clone, Copy, Debug)]
struct Lattice {
    low: DVec3,
    extent: DVec3,
    /// Cells along each axis; 0 where the box is flat.
    counts: UVec3,
}

/// An extent below this share of the longest is none.
const FLAT: f64 = 1e-6;

/// A corner's share in a vertex below this is none: rounding, where the vertex lies on the cell's side.
const NEGLIGIBLE: f32 = 1e-6;

/// Most cells along an axis, so that the three indices of a grid vertex fit into one word.
const MOST_CELLS: u32 = 1 << 20;

impl Lattice {
    /// Cells as near to cubes of this edge as the box allows; `round` settles how many of them
    /// are along the axis of an index (0, 1, 2).
    fn new(low: DVec3, extent: DVec3, edge: f64, round: impl Fn(usize, f64) -> f64) -> Self {
        let flat = FLAT * extent.max_element();
        let count = |axis: usize| {
            if extent[axis] <= flat {
                return 0;
            }
            let cells = round(axis, extent[axis] / edge);
            cells.clamp(1.0, f64::from(MOST_CELLS)) as u32
        };
        Self {
            low,
            extent,
            counts: UVec3::new(count(0), count(1), count(2)),
        }
    }

    /// Cell of a point in the box, and the point's local coordinates there.
    fn locate(&self, point: DVec3) -> (UVec3, Vec3) {
        let counts = self.counts.as_dvec3();
        let place = (point - self.low) / self.extent.max(DVec3::splat(f64::MIN_POSITIVE)) * counts;
        let place = place.clamp(DVec3::ZERO, counts);
        let cell = place
            .floor()
            .as_uvec3()
            .min(self.counts.saturating_sub(UVec3::ONE));
        (cell, (place - cell.as_dvec3()).as_vec3())
    }

    /// A grid vertex.
    fn vertex(&self, node: UVec3) -> DVec3 {
        let share = node.as_dvec3() / self.counts.max(UVec3::ONE).as_dvec3();
        self.low + share * self.extent
    }

    /// Grid vertices around a cell; repeated where the grid is flat.
    fn corners(&self, cell: UVec3) -> [UVec3; 8] {
        std::array::from_fn(|corner| {
            let corner = corner as u32;
            let step = UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            cell + step.min(self.counts)
        })
    }

    /// Cells that hold a position, each once, in order.
    fn occupied(&self, positions: &[Vec3]) -> Vec<Occupied> {
        let held = positions.iter().map(|position| {
            let (cell, local) = self.locate(position.as_dvec3());
            let needed = (0..8).filter(|corner| share(*corner, local) > NEGLIGIBLE);
            Occupied {
                cell: key(cell),
                corners: needed.fold(0, |corners, corner| corners | 1 << corner),
            }
        });
        let mut held: Vec<_> = held.collect();
        held.sort_unstable_by_key(|held| held.cell);
        held.dedup_by(|next, kept| {
            let same = next.cell == kept.cell;
            if same {
                kept.corners |= next.corners;
            }
            same
        });
        held
    }

    /// Vertices of occupied cells, each once, in order.
    fn nodes(&self, occupied: &[Occupied]) -> Vec<u64> {
        let corners = |held: &Occupied| self.corners(unkey(held.cell)).map(key);
        distinct(occupied.iter().flat_map(corners).collect())
    }

    /// Those of them that a position needs.
    fn needed(&self, occupied: &[Occupied]) -> Vec<u64> {
        let nodes = occupied.iter().flat_map(|held| {
            let corners = self.corners(unkey(held.cell)).into_iter().enumerate();
            let needed = corners.filter(|(corner, _)| held.needs(*corner));
            needed.map(|(_, node)| key(node))
        });
        distinct(nodes.collect())
    }
}

/// A cell that holds positions.
#[derive(Clone, Copy, Debug)]
struct Occupied {
    /// Its [`key`].
    cell: u64,
    /// A bit a corner: whether a position is interpolated from it.
    corners: u8,
}

impl Occupied {
    fn needs(&self, corner: usize) -> bool {
        self.corners >> corner & 1 == 1
    }
}

/// The share of a corner at local coordinates.
fn share(corner: usize, local: Vec3) -> f32 {
    let along = |axis: usize| match corner >> axis & 1 {
        0 => 1.0 - local[axis],
        _ => local[axis],
    };
    along(0) * along(1) * along(2)
}

/// Three indices in one word, in the order of the words.
fn key(index: UVec3) -> u64 {
    (u64::from(index.z) << 42) | (u64::from(index.y) << 21) | u64::from(index.x)
}

fn unkey(key: u64) -> UVec3 {
    let part = |shift: u32| (key >> shift & 0x1f_ffff) as u32;
    UVec3::new(part(0), part(21), part(42))
}

fn distinct(mut keys: Vec<u64>) -> Vec<u64> {
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// Least corner and extent of the box around positions.
fn bounds(positions: &[Vec3]) -> (DVec3, DVec3) {
    let around = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = positions.iter().fold(around, |(low, high), p| {
        (low.min(p.as_dvec3()), high.max(p.as_dvec3()))
    });
    (low, high - low)
}

impl Cells {
    /// The grid whose vertices, needed or not, number as nearly as possible `fraction` of the mesh's.
    /// `None` if it would have no fewer than the mesh itself.
    pub(crate) fn by_fraction(positions: &[Vec3], fraction: f64) -> Option<Self> {
        if fraction >= 1.0 || positions.len() < 2 {
            return None;
        }
        let (low, extent) = bounds(positions);
        let longest = extent.max_element();
        let wanted = fraction * positions.len() as f64;
        let nearest = |_, cells: f64| cells.round();
        let vertices = |lattice: &Lattice| lattice.nodes(&lattice.occupied(positions)).len();
        // Finer cells have more vertices, on the whole: bisection finds the edge where the number
        // wanted is passed, …
        let (mut fine, mut coarse) = (f64::from(MOST_CELLS / 16).recip().ln(), 0.0);
        for _ in 0..16 {
            let middle = f64::midpoint(fine, coarse);
            let lattice = Lattice::new(low, extent, longest * middle.exp(), nearest);
            if vertices(&lattice) as f64 > wanted {
                fine = middle;
            } else {
                coarse = middle;
            }
        }
        // … and of the lattices around it, with the number of cells along each axis rounded up or
        // down, the one that comes nearest is taken.
        let steps = (-3..=3).map(|step| longest * (coarse + 0.02 * f64::from(step)).exp());
        let around = steps.flat_map(|edge| {
            (0..8).map(move |ups: u8| {
                Lattice::new(low, extent, edge, |axis, cells| {
                    cells.floor() + f64::from(ups >> axis & 1)
                })
            })
        });
        let mut around: Vec<_> = around.collect();
        around.sort_by_key(|lattice| lattice.counts.to_array());
        around.dedup_by_key(|lattice| lattice.counts);
        let miss = |lattice: &Lattice| (vertices(lattice) as f64 - wanted).abs();
        let around = around.iter().map(|lattice| (miss(lattice), lattice));
        let (_, lattice) = around.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let cells = Self::in_lattice(positions, lattice);
        (cells.vertices.len() + cells.unneeded < positions.len()).then_some(cells)
    }

    /// The grid with cells of about this edge in world units.
    pub(crate) fn by_edge(positions: &[Vec3], edge: f64) -> Self {
        let (low, extent) = bounds(positions);
        let lattice = Lattice::new(low, extent, edge, |_, cells| cells.round());
        Self::in_lattice(positions, &lattice)
    }

    fn in_lattice(positions: &[Vec3], lattice: &Lattice) -> Self {
        let occupied = lattice.occupied(positions);
        let nodes = lattice.needed(&occupied);
        let index = |nodes: &[u64], at: UVec3| {
            let found = nodes.binary_search(&key(at));
            found.expect("listed above") as u32
        };
        let corners = |held: &Occupied| {
            let around = lattice.corners(unkey(held.cell));
            let needed = || (0..8).filter(|corner| held.needs(*corner));
            let stand_in = needed()
                .next()
                .expect("the shares of a position add up to 1");
            around.map(|node| {
                let is_needed = needed().any(|corner| around[corner] == node);
                index(&nodes, if is_needed { node } else { around[stand_in] })
            })
        };
        let place = |position: &Vec3| {
            let (cell, local) = lattice.locate(position.as_dvec3());
            let found = occupied.binary_search_by_key(&key(cell), |held| held.cell);
            (found.expect("it holds this position") as u32, local)
        };
        Self {
            vertices: nodes
                .iter()
                .map(|node| lattice.vertex(unkey(*node)))
                .collect(),
            cells: occupied.iter().map(corners).collect(),
            places: positions.iter().map(place).collect(),
            unneeded: lattice.nodes(&occupied).len() - nodes.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::MirrorShape;
    use catoptric_scene::shape::Sphere;

    use super::*;

    fn sphere() -> Vec<Vec3> {
        let shape = Sphere {
            center: DVec3::new(2.0, 0.5, -1.0),
            radius: 0.7,
        };
        shape.tessellate(96).positions
    }

    /// A flat square of 41 × 41 vertices, turned out of the axes or not.
    fn square(turned: bool) -> Vec<Vec3> {
        let vertex = |i: u32| Vec3::new((i % 41) as f32, 3.0, (i / 41) as f32) / 10.0;
        let turn = glam::Mat3::from_rotation_x(if turned { 0.5 } else { 0.0 });
        (0..41 * 41).map(|i| turn * vertex(i)).collect()
    }

    #[test]
    fn interpolated_corners_give_back_every_vertex() {
        for positions in [sphere(), square(false), square(true)] {
            let cells = Cells::by_fraction(&positions, 0.1).expect("coarser than the mesh");
            for (position, (cell, local)) in positions.iter().zip(&cells.places) {
                let corners = cells.cells[*cell as usize];
                let weight = |corner: usize, axis: usize| {
                    let share = f64::from(local[axis]);
                    if corner >> axis & 1 == 1 {
                        share
                    } else {
                        1.0 - share
                    }
                };
                let sum: DVec3 = (0..8)
                    .map(|i| {
                        let weight = weight(i, 0) * weight(i, 1) * weight(i, 2);
                        cells.vertices[corners[i] as usize] * weight
                    })
                    .sum();
                assert!(sum.distance(position.as_dvec3()) < 1e-6, "{position} {sum}");
            }
        }
    }

    #[test]
    fn grid_vertices_number_the_fraction_asked_for() {
        // The paper's densities. A grid of five cells along an axis of a sphere's box cannot come
        // nearer: one cell more or fewer along one axis changes its vertices by a seventh.
        const SHARE: f64 = 0.08;
        for positions in [sphere(), square(false), square(true)] {
            for fraction in [0.041, 0.055, 0.096, 0.143] {
                let cells = Cells::by_fraction(&positions, fraction).expect("coarser");
                let got = (cells.vertices.len() + cells.unneeded) as f64 / positions.len() as f64;
                assert!((got / fraction - 1.0).abs() < SHARE, "{got} for {fraction}");
            }
        }
    }

    #[test]
    fn cells_are_nearly_cubes_and_flat_meshes_have_one_layer() {
        let cells = Cells::by_fraction(&sphere(), 0.1).expect("coarser");
        let mut whole = 0;
        for corners in &cells.cells {
            if (1..8).any(|corner| corners[..corner].contains(&corners[corner])) {
                // One stands for another that is not needed.
                continue;
            }
            whole += 1;
            let [a, x, y, z] = [0, 1, 2, 4].map(|i| cells.vertices[corners[i] as usize]);
            let edges = [x - a, y - a, z - a].map(DVec3::length);
            let (least, greatest) = (
                edges[0].min(edges[1]).min(edges[2]),
                edges[0].max(edges[1]).max(edges[2]),
            );
            // One cell more along one of the axes, of which there are at least four.
            assert!(greatest / least < 1.3, "{edges:?}");
        }
        assert!(2 * whole > cells.cells.len(), "{whole}");
        let cells = Cells::by_fraction(&square(false), 0.1).expect("coarser");
        assert!(
            cells
                .cells
                .iter()
                .all(|corners| corners[..2] == corners[2..4])
        );
        assert!(
            cells
                .vertices
                .iter()
                .all(|vertex| (vertex.y - 0.3).abs() < 1e-6)
        );
    }

    #[test]
    fn corners_that_no_vertex_is_interpolated_from_are_left_out() {
        // Two walls that face each other: between them lie layers of corners that no vertex needs, even in
        // cells that hold a wall.
        let wall = |x: f32| {
            square(false)
                .into_iter()
                .map(move |p| Vec3::new(x, p.x, p.z))
        };
        let walls: Vec<_> = wall(-1.0).chain(wall(1.0)).collect();
        let (low, extent) = bounds(&walls);
        let lattice = Lattice::new(low, extent, 0.4, |_, cells| cells.round());
        let all = lattice.nodes(&lattice.occupied(&walls)).len();
        let cells = Cells::by_edge(&walls, 0.4);
        assert_eq!([2 * cells.vertices.len(), 2 * cells.unneeded], [all; 2]);
        assert!(cells.vertices.iter().all(|vertex| vertex.x.abs() == 1.0));
    }

    #[test]
    fn small_meshes_and_fraction_one_have_no_grid() {
        assert_eq!(Cells::by_fraction(&square(false), 1.0), None);
        let quad = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::X + Vec3::Z];
        assert_eq!(Cells::by_fraction(&quad, 0.1), None);
        assert_eq!(Cells::by_fraction(&[], 0.1), None);
    }
}

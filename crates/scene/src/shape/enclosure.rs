//! Whether points lie inside a closed mesh, for many points: on a grid, so that few triangles of a
//! large mesh are tested for each point.

use glam::{DVec2, DVec3};

use crate::mesh::Mesh;

/// Most cells along a side of the grid.
const MOST_CELLS: f64 = 1024.0;

/// Most cells that a triangle lies in, on average.
const PLACES: f64 = 8.0;

/// The triangles of a closed mesh, by where they lie in y and z.
pub(crate) struct Enclosure<'a> {
    mesh: &'a Mesh,
    low: DVec3,
    high: DVec3,
    /// Cells a side.
    side: usize,
    /// Where the triangles of each cell begin; the last entry is where those of the last cell end.
    begins: Vec<u32>,
    triangles: Vec<u32>,
}

impl<'a> Enclosure<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let (low, high) = mesh.bounds().unwrap_or_default();
        let mut enclosure = Self {
            mesh,
            low: low.as_dvec3(),
            high: high.as_dvec3(),
            side: (mesh.triangles.len() as f64).sqrt().clamp(1.0, MOST_CELLS) as usize,
            begins: Vec::new(),
            triangles: Vec::new(),
        };
        let all = 0..mesh.triangles.len();
        let places = |enclosure: &Self| -> f64 {
            let cells = all.clone().map(|triangle| {
                let [low, high] = enclosure.cells(triangle);
                ((high[0] - low[0] + 1) * (high[1] - low[1] + 1)) as f64
            });
            cells.sum()
        };
        // Where triangles are large, or long and thin, in fewer cells.
        while enclosure.side > 1 && places(&enclosure) > PLACES * mesh.triangles.len() as f64 {
            enclosure.side /= 2;
        }
        let mut counts = vec![0_u32; enclosure.side * enclosure.side + 1];
        for triangle in all.clone() {
            enclosure.each_cell(triangle, |cell| counts[cell + 1] += 1);
        }
        for cell in 1..counts.len() {
            counts[cell] += counts[cell - 1];
        }
        let mut next = counts.clone();
        let mut triangles = vec![0; counts[counts.len() - 1] as usize];
        for triangle in all {
            enclosure.each_cell(triangle, |cell| {
                triangles[next[cell] as usize] = triangle as u32;
                next[cell] += 1;
            });
        }
        (enclosure.begins, enclosure.triangles) = (counts, triangles);
        enclosure
    }

    /// Whether a point lies inside.
    pub(crate) fn holds(&self, point: DVec3) -> bool {
        if point.cmplt(self.low).any() || point.cmpgt(self.high).any() {
            return false;
        }
        let [y, z] = self.cell(point);
        let cell = y * self.side + z;
        let range = self.begins[cell] as usize..self.begins[cell + 1] as usize;
        let crossings = self.triangles[range].iter();
        crossings
            .map(|index| self.crossing(*index as usize, point))
            .sum::<i32>()
            != 0
    }

    /// The cell over a point, along y and z.
    fn cell(&self, point: DVec3) -> [usize; 2] {
        let size = (self.high - self.low).max(DVec3::splat(f64::MIN_POSITIVE));
        let place = (point - self.low) / size * self.side as f64;
        // A negative number becomes 0.
        [place.y, place.z].map(|place| (place as usize).min(self.side - 1))
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.mesh.triangles[triangle].map(|index| self.mesh.positions[index as usize].as_dvec3())
    }

    /// The first and the last cell over a triangle.
    fn cells(&self, triangle: usize) -> [[usize; 2]; 2] {
        let [a, b, c] = self.corners(triangle);
        [a.min(b).min(c), a.max(b).max(c)].map(|corner| self.cell(corner))
    }

    fn each_cell(&self, triangle: usize, mut each: impl FnMut(usize)) {
        let [low, high] = self.cells(triangle);
        for y in low[0]..=high[0] {
            for z in low[1]..=high[1] {
                each(y * self.side + z);
            }
        }
    }

    /// How a ray from `point` along +x crosses a triangle: 1 or −1 by the side, 0 if it does not. A
    /// ray through an edge crosses one of its two triangles.
    fn crossing(&self, triangle: usize, point: DVec3) -> i32 {
        let corners = self.corners(triangle);
        let flat = corners.map(|corner| DVec2::new(corner.y, corner.z));
        let at = DVec2::new(point.y, point.z);
        let edge = |from: DVec2, to: DVec2| {
            let upwards = from.y <= at.y && at.y < to.y;
            let downwards = to.y <= at.y && at.y < from.y;
            // Always from the lower end, so that both triangles of an edge agree.
            let (low, high) = if upwards { (from, to) } else { (to, from) };
            let left = (high - low).perp_dot(at - low) > 0.0;
            match (upwards, downwards) {
                (true, _) if left => 1,
                (_, true) if left => -1,
                _ => 0,
            }
        };
        let [a, b, c] = flat;
        let winding = edge(a, b) + edge(b, c) + edge(c, a);
        if winding == 0 {
            return 0;
        }
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let offset = point - a;
        let x = a.x - (normal.y * offset.y + normal.z * offset.z) / normal.x;
        if x > point.x { winding } else { 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Random;

    /// A box around the origin, each face of `n` by `n` squares.
    fn cube(n: u32) -> Mesh {
        let mut mesh = Mesh::default();
        for face in 0..6 {
            let (axis, sign) = (face / 2, if face % 2 == 0 { 1.0 } else { -1.0 });
            let first = mesh.positions.len() as u32;
            for i in 0..=n {
                for j in 0..=n {
                    let [u, v] = [i, j].map(|k| 2.0 * k as f32 / n as f32 - 1.0);
                    let mut corner = [0.0; 3];
                    corner[axis] = sign;
                    corner[(axis + 1) % 3] = sign * u;
                    corner[(axis + 2) % 3] = v;
                    mesh.positions.push(corner.into());
                }
            }
            for i in 0..n {
                for j in 0..n {
                    let at = |i, j| first + i * (n + 1) + j;
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    mesh.triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        mesh
    }

    #[test]
    fn points_are_inside_where_the_surface_winds_around_them() {
        for n in [1, 2, 7] {
            let mut mesh = cube(n);
            // Bent, so that it is not convex, and triangles lie at all angles.
            for position in &mut mesh.positions {
                let bend = position.x * position.x + 0.3 * position.y;
                position.z += bend;
            }
            let enclosure = Enclosure::new(&mesh);
            let mut random = Random::new(7);
            let mut inside = 0;
            for _ in 0..2000 {
                let point = DVec3::from_array([(); 3].map(|()| random.between(-2.5, 2.5)));
                let expected = mesh.winding_number(point).abs() > 0.5;
                assert_eq!(enclosure.holds(point), expected, "{n}: {point}");
                inside += u32::from(expected);
            }
            assert!((50..1000).contains(&inside), "{inside} points");
        }
    }

    #[test]
    fn rays_through_edges_and_corners_count_once() {
        let mesh = cube(4);
        let enclosure = Enclosure::new(&mesh);
        let values = [-1.5, -1.0 + 1e-9, -0.5, 0.0, 0.25, 0.5, 1.0 - 1e-9, 1.5];
        for x in values {
            for y in values {
                for z in values {
                    let point = DVec3::new(x, y, z);
                    let expected = point.abs().max_element() < 1.0;
                    assert_eq!(enclosure.holds(point), expected, "{point}");
                }
            }
        }
    }
}

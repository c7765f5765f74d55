//! Faces of more than three corners, in triangles.
//!
//! The corners are projected along the axis of space that is nearest to the face's normal (by
//! Newell's sum, which also holds for faces that are not quite flat). Dropping a coordinate keeps
//! straight lines exactly straight, which a rotation into the plane would not. A convex face is a
//! fan around its first corner, as other renderers split it; from other faces `earcut` cuts ears.
//! At times `earcut` leaves out corners on a straight side. These are put back, so that a neighbour
//! that has them too still shares all edges.

use earcut::{Earcut, deviation};
use glam::{DVec2, DVec3};

/// Triangulates faces one after another, with the same memory.
pub(crate) struct Triangulator {
    earcut: Earcut<f64>,
    points: Vec<DVec2>,
    triangles: Vec<u32>,
}

impl Triangulator {
    pub(crate) fn new() -> Self {
        Self {
            earcut: Earcut::new(),
            points: Vec::new(),
            triangles: Vec::new(),
        }
    }

    /// Triangles of corner numbers, which run around as the face does. None where all corners lie
    /// on a line.
    pub(crate) fn triangulate(&mut self, corners: &[DVec3]) -> &[[u32; 3]] {
        self.triangles.clear();
        self.points.clear();
        if corners.len() <= 3 {
            self.triangles.extend([0, 1, 2]);
            return self.triangles.as_chunks().0;
        }
        project(corners, &mut self.points);
        if is_convex(&self.points) {
            for corner in 1..corners.len() as u32 - 1 {
                self.triangles.extend([0, corner, corner + 1]);
            }
            return self.triangles.as_chunks().0;
        }
        let points = self.points.iter().map(DVec2::to_array);
        self.earcut.earcut(points, &[], &mut self.triangles);
        for triangle in self.triangles.as_chunks_mut::<3>().0 {
            let [a, b, c] = triangle.map(|corner| self.points[corner as usize]);
            if area(a, b, c) < 0.0 {
                triangle.swap(1, 2);
            }
        }
        self.put_back_straight_corners();
        self.triangles.as_chunks().0
    }

    /// Splits triangles at corners that lie on one of their sides and are in no triangle.
    fn put_back_straight_corners(&mut self) {
        let count = self.points.len();
        let mut used = vec![false; count];
        for corner in &self.triangles {
            used[*corner as usize] = true;
        }
        let Some(start) = used.iter().position(|used| *used) else {
            return;
        };
        let mut from = start;
        let mut left_out = Vec::new();
        for step in 1..=count {
            let corner = (start + step) % count;
            if !used[corner] {
                left_out.push(corner as u32);
                continue;
            }
            if !left_out.is_empty() {
                self.split(from as u32, corner as u32, &left_out);
                left_out.clear();
            }
            from = corner;
        }
    }

    /// Makes a fan of the triangle with the side from `a` to `b` if all of `between` lie on that
    /// side, one behind the other.
    fn split(&mut self, a: u32, b: u32, between: &[u32]) {
        let point = |corner: u32| self.points[corner as usize];
        let along = point(b) - point(a);
        let places = between
            .iter()
            .map(|corner| (point(*corner) - point(a)).dot(along) / along.length_squared());
        let in_order = std::iter::once(0.0)
            .chain(places)
            .chain([1.0])
            .is_sorted_by(|before, after| before <= after);
        if !in_order {
            return;
        }
        let (all, _) = self.triangles.as_chunks_mut::<3>();
        let found = all.iter_mut().find_map(|triangle| {
            let side = (0..3).find(|side| triangle[*side] == a && triangle[(side + 1) % 3] == b)?;
            Some((triangle[(side + 2) % 3], triangle))
        });
        let Some((apex, triangle)) = found else {
            return;
        };
        *triangle = [a, between[0], apex];
        let next = between[1..].iter().copied().chain([b]);
        for (from, to) in between.iter().zip(next) {
            self.triangles.extend([*from, to, apex]);
        }
    }

    /// Whether sides of the face that was triangulated last cross each other, or its triangles do
    /// not cover what its sides enclose. Sides that touch, or lie on each other as those to a hole
    /// do, are no fault.
    pub(super) fn is_crossed(&self) -> bool {
        let count = self.points.len();
        if count <= 3 {
            return false;
        }
        let points = self.points.iter().map(DVec2::to_array);
        deviation(points, &[], &self.triangles) > 1e-6
            || crossing(&self.points)
            || repeats_a_side(&self.points)
    }
}

/// The corners without the coordinate in which the face is thinnest, relative to the first,
/// turned so that the face runs counter-clockwise.
fn project(corners: &[DVec3], points: &mut Vec<DVec2>) {
    let relative = |index: usize| corners[index] - corners[0];
    let count = corners.len();
    let newell: DVec3 = (0..count)
        .map(|index| relative(index).cross(relative((index + 1) % count)))
        .sum();
    let extent = (0..count).fold(0.0f64, |most, index| {
        most.max(relative(index).abs().max_element())
    });
    // The sum is zero where the two halves of a crossed face cancel out.
    let normal = if newell.length() > 1e-12 * extent * extent {
        newell
    } else {
        (1..count - 1)
            .map(|index| relative(index).cross(relative(index + 1)))
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
            .unwrap_or(DVec3::Z)
    };
    let size = normal.abs();
    let (u, v, along) = if size.x >= size.y && size.x >= size.z {
        (1, 2, normal.x)
    } else if size.y >= size.z {
        (2, 0, normal.y)
    } else {
        (0, 1, normal.z)
    };
    let (u, v) = if along < 0.0 { (v, u) } else { (u, v) };
    points.extend((0..count).map(|index| {
        let at = relative(index);
        DVec2::new(at[u], at[v])
    }));
}

/// Twice the area, positive where the corners run counter-clockwise.
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Whether a face turns left at every corner, and is seen whole from its first: then it is convex
/// and goes around once.
fn is_convex(points: &[DVec2]) -> bool {
    let count = points.len();
    let turns = |corner: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| points[(corner + step) % count]);
        area(a, b, c) > 0.0
    };
    let seen = |corner: usize| area(points[0], points[corner], points[corner + 1]) > 0.0;
    (0..count).all(turns) && (1..count - 1).all(seen)
}

/// Whether two sides cross at a point inside both.
fn crossing(points: &[DVec2]) -> bool {
    let side = |index: usize| (points[index], points[(index + 1) % points.len()]);
    let reach = |index: usize| {
        let (from, to) = side(index);
        (from.x.min(to.x), from.x.max(to.x))
    };
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| reach(*a).0.total_cmp(&reach(*b).0));
    order.iter().enumerate().any(|(place, first)| {
        let (a, b) = side(*first);
        let end = reach(*first).1;
        order[place + 1..]
            .iter()
            .take_while(|second| reach(**second).0 <= end)
            .any(|second| {
                let (c, d) = side(*second);
                let apart = |p: f64, q: f64| (p < 0.0 && q > 0.0) || (p > 0.0 && q < 0.0);
                apart(area(a, b, c), area(a, b, d)) && apart(area(c, d, a), area(c, d, b))
            })
    })
}

/// Whether a face runs along the same side twice in the same direction, as one does that goes
/// around more than once.
fn repeats_a_side(points: &[DVec2]) -> bool {
    let next = |index: usize| points[(index + 1) % points.len()];
    let sides = (0..points.len()).map(|index| (points[index], next(index)));
    let sides = sides.filter(|(from, to)| from != to);
    let mut sides: Vec<[f64; 4]> = sides
        .map(|(from, to)| [from.x, from.y, to.x, to.y].map(|c| c + 0.0))
        .collect();
    sides.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    sides.windows(2).any(|pair| pair[0] == pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;
    use proptest::prelude::*;

    /// The triangles of a flat face in the xy plane, the area they cover, and whether the face is
    /// said to cross itself.
    fn flat(points: &[[f64; 2]]) -> (Vec<[u32; 3]>, f64, bool) {
        let corners: Vec<_> = points
            .iter()
            .map(|[x, y]| DVec3::new(*x, *y, 0.0))
            .collect();
        in_space(&corners)
    }

    fn in_space(corners: &[DVec3]) -> (Vec<[u32; 3]>, f64, bool) {
        let mut triangulator = Triangulator::new();
        let triangles = triangulator.triangulate(corners).to_vec();
        let covered = |[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|corner| corners[*corner as usize]);
            (b - a).cross(c - a).length() / 2.0
        };
        let area = triangles.iter().map(covered).sum();
        (triangles, area, triangulator.is_crossed())
    }

    /// How often each directed edge occurs that no triangle runs along the other way.
    fn rim(triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
        let edges: Vec<_> = triangles
            .iter()
            .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
            .collect();
        let mut rim: Vec<_> = edges
            .iter()
            .copied()
            .filter(|(a, b)| !edges.contains(&(*b, *a)))
            .collect();
        rim.sort_unstable();
        rim
    }

    fn sides(count: u32) -> Vec<(u32, u32)> {
        let mut sides: Vec<_> = (0..count).map(|i| (i, (i + 1) % count)).collect();
        sides.sort_unstable();
        sides
    }

    const U: [[f64; 2]; 8] = [
        [-3.0, -2.0],
        [3.0, -2.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, -1.0],
        [-2.0, -1.0],
        [-2.0, 2.0],
        [-3.0, 2.0],
    ];

    #[test]
    fn a_hollow_face_is_itself_whichever_corner_comes_first_and_however_it_lies() {
        let shapes: [(&[[f64; 2]], f64); 3] = [
            (&U, 6.0 + 2.0 * 3.0),
            (&[[-1.0, -1.0], [0.0, -0.2], [1.0, -1.0], [0.0, 1.0]], 1.2),
            (
                &[
                    [2.0, 0.0],
                    [2.0, 1.0],
                    [1.0, 1.0],
                    [1.0, 3.0],
                    [0.0, 3.0],
                    [0.0, 0.0],
                ],
                4.0,
            ),
        ];
        let turns = [
            DMat3::IDENTITY,
            DMat3::from_rotation_x(0.5) * DMat3::from_rotation_y(1.1),
            DMat3::from_rotation_y(2.5) * DMat3::from_rotation_z(0.3),
            DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)),
        ];
        for (points, expected) in shapes {
            for turn in turns {
                for first in 0..points.len() {
                    let mut corners: Vec<_> = points
                        .iter()
                        .map(|[x, y]| turn * DVec3::new(*x, *y, 0.0) + 7.0)
                        .collect();
                    corners.rotate_left(first);
                    let (triangles, area, crossed) = in_space(&corners);
                    assert_eq!(triangles.len(), points.len() - 2);
                    assert!((area - expected).abs() < 1e-12, "{area}, not {expected}");
                    assert!(!crossed);
                    assert_eq!(rim(&triangles), sides(points.len() as u32));
                }
            }
        }
    }

    #[test]
    fn a_hole_stays_a_hole() {
        // From the outer square along a bridge around the inner one, and back.
        let outer = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0]];
        let inner = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0]];
        let points = [outer, inner].concat();
        for first in 0..points.len() {
            let mut points = points.clone();
            points.rotate_left(first);
            let (_, area, crossed) = flat(&points);
            assert!((area - 12.0).abs() < 1e-12, "{area}");
            assert!(!crossed);
        }
    }

    #[test]
    fn corners_on_a_straight_side_are_kept() {
        let points = [
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [3.0, 0.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [0.0, 3.0],
            [0.0, 2.0],
        ];
        for first in 0..points.len() {
            let mut points = points;
            points.rotate_left(first);
            let (triangles, area, crossed) = flat(&points);
            assert_eq!((area, crossed), (9.0, false));
            assert_eq!(rim(&triangles), sides(8));
            let mut line = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [0.0, 1.0]];
            line.rotate_left(first % 5);
            let (triangles, area, _) = flat(&line);
            assert_eq!((triangles.len(), area), (3, 1.5));
        }
    }

    #[test]
    fn a_face_that_crosses_itself_is_said() {
        let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
        let star: Vec<_> = (0..5)
            .map(|i| (f64::from(i) * 0.8 * std::f64::consts::PI).sin_cos())
            .map(|(sin, cos)| [sin, cos])
            .collect();
        let twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].repeat(2);
        for points in [bow.as_slice(), &star, &twice] {
            assert!(flat(points).2, "{points:?}");
        }
    }

    #[test]
    fn faces_without_area_have_no_triangles_with_area() {
        for points in [
            [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]],
            [[1.0, 1.0]; 4],
        ] {
            let (_, area, crossed) = flat(&points);
            assert_eq!((area, crossed), (0.0, false));
        }
    }

    #[test]
    fn a_face_far_from_the_origin_is_as_exact_as_one_near() {
        let corners: Vec<_> = U
            .iter()
            .map(|[x, y]| DVec3::new(5e6 + x / 8.0, -3e6 + y / 8.0, 1e6))
            .collect();
        let (_, area, crossed) = in_space(&corners);
        assert_eq!((area, crossed), (12.0 / 64.0, false));
    }

    proptest! {
        /// Around a point, at any distances: simple, however jagged.
        #[test]
        fn a_star_shaped_face_is_covered_once(
            distances in prop::collection::vec(0.1..10.0f64, 4..40),
            normal in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let normal = DVec3::from(normal);
            prop_assume!(normal.length() > 0.1);
            let (u, v) = normal.normalize().any_orthonormal_pair();
            let count = distances.len();
            let corners: Vec<DVec3> = distances
                .iter()
                .enumerate()
                .map(|(index, distance)| {
                    let angle = std::f64::consts::TAU * index as f64 / count as f64;
                    distance * (angle.cos() * u + angle.sin() * v)
                })
                .collect();
            let expected: f64 = (0..count)
                .map(|index| corners[index].cross(corners[(index + 1) % count]).length() / 2.0)
                .sum();
            let (triangles, area, crossed) = in_space(&corners);
            prop_assert!((area - expected).abs() < 1e-9 * expected, "{area}, not {expected}");
            prop_assert!(!crossed);
            prop_assert_eq!(triangles.len(), count - 2);
            prop_assert_eq!(rim(&triangles), sides(count as u32));
            for [a, b, c] in triangles {
                let [a, b, c] = [a, b, c].map(|corner| corners[corner as usize]);
                prop_assert!((b - a).cross(c - a).dot(normal) > 0.0);
            }
        }

        /// Whatever the corners, the answer is triangles of them.
        #[test]
        fn any_corners_are_answered(
            points in prop::collection::vec(prop::array::uniform3(-3i8..3), 3..30),
        ) {
            let corners: Vec<_> =
                points.iter().map(|point| DVec3::from(point.map(f64::from))).collect();
            let (triangles, _, _) = in_space(&corners);
            prop_assert!(triangles.as_flattened().iter().all(|i| (*i as usize) < corners.len()));
            prop_assert!(triangles.len() <= 2 * corners.len());
        }
    }
}

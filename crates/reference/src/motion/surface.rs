//! A mirror's surface at rest, with coordinates around every place of it.
//!
//! On a shape that is known exactly the coordinates are lengths along two tangents. On a mesh they are
//! the weights of the second and third corner of a triangle, and a step that leaves a triangle goes on
//! in its neighbour.

use std::collections::HashMap;

use catoptric_scene::{Mesh, Pose, Shape};
use glam::{DMat2, DVec2, DVec3, Vec3};

/// Differences of normals are taken over this share of a shape's extent: small enough for the
/// derivative, large enough for f64.
const DIFFERENCE: f64 = 1e-5;

/// Height above the surface, as a share of the extent, at which the ray starts that puts a point onto
/// it.
const ABOVE: f64 = 1e-3;

/// The longest step on a smooth surface, as a share of its extent.
const LONGEST: f64 = 0.25;

/// Triangles that one step may cross.
const MOST_TRIANGLES: usize = 256;

/// A place on a mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// A point of the mirror at rest.
    Point(DVec3),
    /// On a mesh.
    OnTriangle {
        /// Index into the mesh's triangles.
        triangle: usize,
        /// Weights of the triangle's corners.
        weights: DVec3,
    },
}

/// The surface around a place, at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub point: DVec3,
    /// Unit, on the reflecting side; of a mesh the shading normal.
    pub normal: DVec3,
    /// How the point changes along both coordinates.
    pub points: [DVec3; 2],
    /// How the normal does.
    pub normals: [DVec3; 2],
}

/// A mirror's surface.
pub(super) enum Surface {
    Smooth {
        shape: Shape,
        extent: f64,
    },
    Mesh {
        rest: Mesh,
        neighbours: Vec<[Option<u32>; 3]>,
    },
}

/// A mesh mirror at a frame itself, whose corners are rounded there.
pub(super) type Posed<'m> = Option<(&'m Mesh, Pose)>;

impl Surface {
    pub(super) fn new(shape: &Shape) -> Self {
        if let Some(mesh) = shape.as_mesh() {
            return Self::Mesh {
                neighbours: neighbours(mesh),
                rest: mesh.clone(),
            };
        }
        let (low, high) = shape.bounds();
        Self::Smooth {
            shape: shape.clone(),
            extent: (high - low).length(),
        }
    }

    pub(super) fn is_mesh(&self) -> bool {
        matches!(self, Self::Mesh { .. })
    }

    /// The surface around a place; `None` where it has none.
    pub(super) fn at(&self, posed: Posed<'_>, place: &Place) -> Option<Local> {
        match (self, place) {
            (Self::Smooth { shape, extent }, Place::Point(point)) => {
                let normal = shape.normal_at(*point)?;
                let (first, second) = normal.any_orthonormal_pair();
                let step = DIFFERENCE * extent;
                let change = |along: DVec3| {
                    let [after, before] =
                        [1.0, -1.0].map(|side| shape.normal_at(*point + side * step * along));
                    Some((after? - before?) / (2.0 * step))
                };
                Some(Local {
                    point: *point,
                    normal,
                    points: [first, second],
                    normals: [change(first)?, change(second)?],
                })
            }
            (Self::Mesh { rest, .. }, Place::OnTriangle { triangle, weights }) => {
                let (corners, normals) = triangle_of(rest, posed, *triangle);
                let mix = |[a, b, c]: [DVec3; 3]| weights.x * a + weights.y * b + weights.z * c;
                let shading = mix(normals);
                let length = shading.length();
                let normal = shading / length;
                let [a, b, c] = normals;
                let turned = |change: DVec3| (change - normal.dot(change) * normal) / length;
                let [p, q, r] = corners;
                let local = Local {
                    point: mix(corners),
                    normal,
                    points: [q - p, r - p],
                    normals: [turned(b - a), turned(c - a)],
                };
                local.normal.is_finite().then_some(local)
            }
            _ => None,
        }
    }

    /// The place that a step in coordinates leads to; `None` where it leaves the surface.
    pub(super) fn moved(
        &self,
        posed: Posed<'_>,
        place: &Place,
        here: &Local,
        step: DVec2,
    ) -> Option<Place> {
        if !step.is_finite() {
            return None;
        }
        let way = step.x * here.points[0] + step.y * here.points[1];
        match (self, place) {
            (Self::Smooth { shape, extent }, Place::Point(point)) => {
                if way.length() > LONGEST * extent {
                    return None;
                }
                let above = (ABOVE * extent).max(way.length());
                let start = *point + way + above * here.normal;
                let hit = shape.intersect(start, -here.normal, 0.0)?;
                (hit.t < 3.0 * above).then_some(Place::Point(hit.position))
            }
            (Self::Mesh { rest, neighbours }, Place::OnTriangle { triangle, weights }) => {
                let mut walk = Walk {
                    triangle: *triangle,
                    weights: *weights,
                    way,
                };
                let mut from = None;
                for _ in 0..MOST_TRIANGLES {
                    let corners = |triangle| triangle_of(rest, posed, triangle).0;
                    match walk.on(&corners(walk.triangle), from) {
                        Ok(weights) => {
                            return Some(Place::OnTriangle {
                                triangle: walk.triangle,
                                weights,
                            });
                        }
                        Err((edge, at)) => {
                            let next = neighbours[walk.triangle][edge]? as usize;
                            from = Some(walk.triangle);
                            walk.enter(rest, next, at);
                        }
                    }
                }
                None
            }
            _ => None,
        }
    }
}

/// A straight way over triangles.
struct Walk {
    triangle: usize,
    weights: DVec3,
    /// What is left of it, in space.
    way: DVec3,
}

impl Walk {
    /// The weights where the way ends in the triangle; or the edge over which it leaves (opposite the
    /// corner of this number), and the weights there, with what is left of the way.
    fn on(&mut self, [a, b, c]: &[DVec3; 3], from: Option<usize>) -> Result<DVec3, (usize, DVec3)> {
        let (u, v) = (*b - *a, *c - *a);
        let squares = DMat2::from_cols(
            DVec2::new(u.dot(u), u.dot(v)),
            DVec2::new(u.dot(v), v.dot(v)),
        );
        let step = squares.inverse() * DVec2::new(u.dot(self.way), v.dot(self.way));
        let change = DVec3::new(-step.x - step.y, step.x, step.y);
        let end = self.weights + change;
        // The first edge that is crossed; the one that was just entered by is left behind.
        let mut first = None;
        for edge in 0..3 {
            let entered = from.is_some() && self.weights[edge] == 0.0 && change[edge] >= 0.0;
            if end[edge] >= 0.0 || entered {
                continue;
            }
            let share = (self.weights[edge] / (self.weights[edge] - end[edge])).clamp(0.0, 1.0);
            if first.is_none_or(|(_, least)| share < least) {
                first = Some((edge, share));
            }
        }
        let Some((edge, share)) = first else {
            return Ok(end);
        };
        let mut at = self.weights + share * change;
        at[edge] = 0.0;
        self.way *= 1.0 - share;
        Err((edge, at))
    }

    /// Goes on in a neighbour, at the place of the shared edge with these weights.
    fn enter(&mut self, mesh: &Mesh, next: usize, at: DVec3) {
        let (old, new) = (mesh.triangles[self.triangle], mesh.triangles[next]);
        let weight = |corner: u32| {
            let known = old.iter().position(|other| *other == corner);
            known.map_or(0.0, |index| at[index])
        };
        self.weights = DVec3::from_array(new.map(weight));
        self.triangle = next;
    }
}

/// Corners and normals of a triangle, at rest.
fn triangle_of(rest: &Mesh, posed: Posed<'_>, triangle: usize) -> ([DVec3; 3], [DVec3; 3]) {
    let of = |mesh: &Mesh| {
        (
            mesh.triangles[triangle].map(|index| mesh.positions[index as usize].as_dvec3()),
            mesh.normals[triangle].map(Vec3::as_dvec3),
        )
    };
    match posed {
        None => of(rest),
        Some((mesh, pose)) => {
            let (corners, normals) = of(mesh);
            (
                corners.map(|corner| pose.undone(corner)),
                normals.map(|normal| pose.unturned(normal)),
            )
        }
    }
}

/// Of each triangle the ones beyond the edges opposite its corners; `None` at a border, and where more
/// than two triangles meet.
fn neighbours(mesh: &Mesh) -> Vec<[Option<u32>; 3]> {
    let edge = |triangle: usize, corner: usize| {
        let [a, b] = [1, 2].map(|next| mesh.triangles[triangle][(corner + next) % 3]);
        (a.min(b), a.max(b))
    };
    let mut sides: HashMap<(u32, u32), Vec<u32>> = HashMap::new();
    for triangle in 0..mesh.triangles.len() {
        for corner in 0..3 {
            let sides = sides.entry(edge(triangle, corner)).or_default();
            sides.push(triangle as u32);
        }
    }
    let beyond = |triangle: usize, corner: usize| match &sides[&edge(triangle, corner)][..] {
        [one, other] if *one as usize == triangle => Some(*other),
        [one, other] if *other as usize == triangle => Some(*one),
        _ => None,
    };
    (0..mesh.triangles.len())
        .map(|triangle| [0, 1, 2].map(|corner| beyond(triangle, corner)))
        .collect()
}

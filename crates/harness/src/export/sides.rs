//! Which sides of a triangle can be seen.
//!
//! An area emitter of Mitsuba is black from behind, while our objects show their colour on both
//! sides. All rays start at the eye or on a mirror, so most triangles are seen from one side only
//! and are written once, facing it. The others are written twice, as two sheets.

use catoptric_scene::{Mesh, Scene};
use glam::{DVec3, Vec3};

/// Distance of each of the two sheets from the triangle, as a share of 1 + its largest coordinate:
/// some ten steps of f32, so that Mitsuba's rounding does not mix them up.
pub(crate) const SHEET: f32 = 2e-6;

/// Everything rays start from.
pub struct Viewpoints {
    eye: DVec3,
    /// Corners of the boxes around the mirrors.
    mirrors: Vec<(DVec3, DVec3)>,
}

impl Viewpoints {
    /// Of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mirrors = scene.mirrors.iter().map(|mirror| mirror.shape.bounds());
        Self {
            eye: scene.camera.eye,
            mirrors: mirrors.collect(),
        }
    }

    /// Points of which the convex hull holds all viewpoints.
    fn hull(&self) -> impl Iterator<Item = DVec3> {
        let corners = |&(low, high): &(DVec3, DVec3)| {
            (0..8).map(move |corner| {
                DVec3::new(
                    if corner & 1 == 0 { low.x } else { high.x },
                    if corner & 2 == 0 { low.y } else { high.y },
                    if corner & 4 == 0 { low.z } else { high.z },
                )
            })
        };
        std::iter::once(self.eye).chain(self.mirrors.iter().flat_map(corners))
    }

    /// True where no viewpoint can lie inside a closed mesh.
    fn all_outside(&self, mesh: &Mesh) -> bool {
        let Some((low, high)) = mesh.bounds() else {
            return true;
        };
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let apart = |(l, h): &(DVec3, DVec3)| l.cmpgt(high).any() || h.cmplt(low).any();
        self.mirrors.iter().all(apart) && mesh.winding_number(self.eye).abs() < 0.5
    }
}

/// Triangles as they must be written to look the same from wherever they are seen: the index of the
/// triangle, its corners counter-clockwise for the viewer, and whether they are in reverse order.
pub fn visible(mesh: &Mesh, viewpoints: &Viewpoints) -> Vec<(usize, [Vec3; 3], bool)> {
    let outside = mesh.is_closed() && viewpoints.all_outside(mesh);
    let outward = outside.then(|| volume(mesh) > 0.0);
    let hull: Vec<DVec3> = viewpoints.hull().collect();
    let mut faces = Vec::new();
    for (index, corners) in mesh.triangles.iter().enumerate() {
        let corners = corners.map(|corner| mesh.positions[corner as usize]);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a);
        let heights = || hull.iter().map(|point| (point - a).dot(normal));
        let front = outward.unwrap_or_else(|| heights().any(|height| height > 0.0));
        let back = outward.map_or_else(|| heights().any(|height| height < 0.0), |front| !front);
        let offset = if front && back {
            let largest = corners
                .iter()
                .fold(0.0f32, |most, corner| most.max(corner.abs().max_element()));
            normal.normalize_or_zero().as_vec3() * (1.0 + largest) * SHEET
        } else {
            Vec3::ZERO
        };
        let ahead = corners.map(|corner| corner + offset);
        if front {
            faces.push((index, ahead, false));
        }
        if back {
            // As far behind as the other is ahead, after rounding: the middle is the corner.
            let [a, b, c] = [0, 1, 2].map(|at| corners[at] - (ahead[at] - corners[at]));
            faces.push((index, [a, c, b], true));
        }
    }
    faces
}

/// Six times the volume that a closed mesh bounds, negative where its triangles face inwards.
fn volume(mesh: &Mesh) -> f64 {
    let signed = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize].as_dvec3());
        a.dot(b.cross(c))
    };
    mesh.triangles.iter().map(signed).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
            ..Mesh::default()
        }
    }

    fn eye(eye: DVec3) -> Viewpoints {
        Viewpoints {
            eye,
            mirrors: Vec::new(),
        }
    }

    #[test]
    fn a_closed_mesh_is_seen_from_outside() {
        let mesh = tetrahedron();
        let seen = visible(&mesh, &eye(DVec3::splat(3.0)));
        assert_eq!(seen.len(), 4);
        assert!(seen.iter().all(|(_, _, flipped)| !flipped));
        let inside_out = Mesh {
            triangles: mesh
                .triangles
                .iter()
                .map(|[a, b, c]| [*a, *c, *b])
                .collect(),
            ..mesh
        };
        let seen = visible(&inside_out, &eye(DVec3::splat(3.0)));
        assert!(seen.len() == 4 && seen.iter().all(|(_, _, flipped)| *flipped));
    }

    #[test]
    fn from_inside_it_is_seen_from_inside() {
        let seen = visible(&tetrahedron(), &eye(DVec3::splat(0.1)));
        assert!(seen.len() == 4 && seen.iter().all(|(_, _, flipped)| *flipped));
    }

    #[test]
    fn a_triangle_between_eye_and_mirror_gets_two_sheets() {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let mirror = |z: f64| Viewpoints {
            eye: DVec3::Z,
            mirrors: vec![(DVec3::new(-1.0, -1.0, z), DVec3::new(1.0, 1.0, z + 0.5))],
        };
        let seen = visible(&mesh, &mirror(0.25));
        assert_eq!(seen.len(), 1);
        assert_eq!(seen[0].1, [Vec3::ZERO, Vec3::X, Vec3::Y]);
        let seen = visible(&mesh, &mirror(-1.0));
        let heights: Vec<f32> = seen.iter().map(|(_, corners, _)| corners[0].z).collect();
        assert!(heights.len() == 2 && heights[0] > 0.0 && heights[1] < 0.0);
    }
}

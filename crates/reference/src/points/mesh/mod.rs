//! All points of a mesh mirror that reflect a vertex.
//!
//! A hierarchy over the triangles ([`cones`]) leaves few candidates. Each candidate gives all of its points,
//! and how many of its parts stay undecided ([`facet`]).

mod cones;
mod facet;
mod polynomial;

use catoptric_frame::VertexClass;
use catoptric_scene::Mesh;
use glam::{DVec3, Vec3};

use self::cones::Cones;
use self::facet::{Facet, Found};
use super::solutions::{ExactPoints, Solutions};
use crate::bvh::TriangleBvh;

/// Points closer than this share of the mirror's extent are one, found from two triangles.
const SAME: f64 = 1e-9;

/// Something hides a point if it is nearer to the eye by this share of the mirror's extent.
const BEFORE: f64 = 1e-6;

/// A mesh mirror made ready for one eye.
pub(super) struct MeshPoints {
    facets: Vec<Facet>,
    cones: Cones,
    surface: TriangleBvh,
    closed: bool,
    /// Length of the diagonal of its bounding box.
    extent: f64,
}

impl MeshPoints {
    pub(super) fn new(mesh: &Mesh, eye: DVec3) -> Self {
        let triangles = mesh.triangles.iter().zip(&mesh.normals);
        let facets: Vec<Facet> = triangles
            .filter_map(|(corners, normals)| {
                let corner = |index: u32| mesh.positions[index as usize].as_dvec3();
                Facet::new(corners.map(corner), normals.map(Vec3::as_dvec3))
            })
            .collect();
        let corners: Vec<[Vec3; 3]> = facets
            .iter()
            .map(|facet| facet.corners.map(|corner| corner.as_vec3()))
            .collect();
        let surface = TriangleBvh::new(&corners);
        Self {
            cones: Cones::new(&facets, eye),
            extent: 2.0 * surface.radius(),
            surface,
            closed: mesh.is_closed(),
            facets,
        }
    }

    /// Whether the mirror hides none of the way from the eye to the point.
    fn seen(&self, eye: DVec3, point: DVec3) -> bool {
        let offset = point - eye;
        let end = offset.length() - BEFORE * self.extent;
        let first = self.surface.intersect(eye, offset.normalize(), 0.0, end);
        first.is_none()
    }
}

impl ExactPoints for MeshPoints {
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let mut found = Found::default();
        self.cones.candidates(vertex, |triangle| {
            self.facets[triangle as usize].solve(eye, vertex, &mut found);
        });
        let mut points: Vec<DVec3> = Vec::new();
        for point in found.points {
            let known = |other: &DVec3| other.distance(point) < SAME * self.extent;
            if !points.iter().any(known) && self.seen(eye, point) {
                points.push(point);
            }
        }
        let class = match (points.is_empty(), found.undecided) {
            (false, _) => VertexClass::Reflected,
            (true, 1..) => VertexClass::Unknown,
            (true, 0) if self.closed || !self.seen(eye, vertex) => VertexClass::Hidden,
            (true, 0) => VertexClass::Unreflected,
        };
        Solutions {
            class,
            points,
            undecided: found.undecided,
        }
    }
}

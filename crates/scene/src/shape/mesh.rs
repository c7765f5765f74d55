//! A mirror of triangles with shading normals. It has no exact surface: its reflecting side is
//! where the normals point, and rays meet the flat triangles.

use glam::{DVec3, Vec3};

use super::mirror_shape::{Facing, HIDDEN, MirrorShape, ShaderInput, SurfaceHit};
use crate::mesh::Mesh;
use crate::pose::Pose;

impl MirrorShape for Mesh {
    fn intersect(&self, _origin: DVec3, _dir: DVec3, _t_min: f64) -> Option<SurfaceHit> {
        None
    }

    fn normal_at(&self, _point: DVec3) -> Option<DVec3> {
        None
    }

    fn center(&self) -> DVec3 {
        let bounds = self.bounds();
        bounds.map_or(DVec3::ZERO, |(low, high)| {
            (low.as_dvec3() + high.as_dvec3()) / 2.0
        })
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let bounds = self.bounds();
        bounds.map_or((DVec3::ZERO, DVec3::ZERO), |(low, high)| {
            (low.as_dvec3(), high.as_dvec3())
        })
    }

    fn tessellate(&self, _segments: u32) -> Mesh {
        self.clone()
    }

    fn cover(&self, _segments: u32) -> Mesh {
        self.clone()
    }

    fn carry(&mut self, pose: &Pose) {
        pose.carry(self);
    }

    fn is_closed(&self) -> bool {
        self.is_closed()
    }

    fn encloses(&self, point: DVec3) -> bool {
        self.winding_number(point).abs() > 0.5
    }

    fn as_mesh(&self) -> Option<&Mesh> {
        Some(self)
    }

    fn facing(&self) -> Result<Facing, &'static str> {
        if !self.is_closed() {
            return Err("is open, and no closed shape stands for it");
        }
        match is_star_shaped(self, MirrorShape::center(self)) {
            true => Ok(Facing::Outwards),
            false => Err(HIDDEN),
        }
    }

    fn numbers(&self) -> Vec<f64> {
        Vec::new()
    }

    fn shader_input(&self) -> Option<ShaderInput> {
        None
    }
}

/// Whether a closed mesh turns the reflecting side of every triangle away from `center`, so that
/// each ray from there meets it exactly once.
fn is_star_shaped(mesh: &Mesh, center: DVec3) -> bool {
    let corners = |triangle: &[u32; 3]| {
        triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3() - center)
    };
    let volumes = mesh.triangles.iter().map(|triangle| {
        let [a, b, c] = corners(triangle);
        a.dot(b.cross(c))
    });
    let (least, greatest) = volumes.fold((f64::MAX, f64::MIN), |(least, greatest), volume| {
        (least.min(volume), greatest.max(volume))
    });
    let outwards = |(triangle, normals): (&[u32; 3], &[Vec3; 3])| {
        let middle: DVec3 = corners(triangle).into_iter().sum();
        middle.dot((normals[0] + normals[1] + normals[2]).as_dvec3()) > 0.0
    };
    (least > 0.0 || greatest < 0.0) && (mesh.triangles.iter().zip(&mesh.normals)).all(outwards)
}

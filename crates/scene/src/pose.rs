//! Where something stands after it has moved rigidly.

use glam::{DMat3, DVec3, Vec3};

use crate::geometry::Transform;
use crate::mesh::Mesh;

/// A rigid transform that has happened since the first frame: a rotation, then a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose(Transform);

impl Pose {
    /// Nothing has moved.
    pub const REST: Self = Self(Transform::IDENTITY);

    /// A rotation Rz·Ry·Rx by degrees about a point, then a translation.
    pub(crate) fn new(rotate_deg: DVec3, about: DVec3, translate: DVec3) -> Self {
        Self(Transform::rigid(rotate_deg, about, translate))
    }

    /// Where the motion brings a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        self.0.apply(point)
    }

    /// How the motion turns a direction.
    pub fn turn(&self, direction: DVec3) -> DVec3 {
        self.0.linear * direction
    }

    /// How the motion turns axes, one a column.
    pub fn turn_axes(&self, axes: DMat3) -> DMat3 {
        self.0.linear * axes
    }

    /// Where a point was before the motion that brought it here.
    pub fn undone(&self, point: DVec3) -> DVec3 {
        self.0.linear.transpose() * (point - self.0.translate)
    }

    /// What a direction was before the motion that turned it to this one.
    pub fn unturned(&self, direction: DVec3) -> DVec3 {
        self.0.linear.transpose() * direction
    }

    /// Moves a mesh; its vertices keep their order.
    pub(crate) fn carry(&self, mesh: &mut Mesh) {
        for position in &mut mesh.positions {
            // Adding zero turns −0 into +0, as it is done for meshes at rest.
            *position = self.point(position.as_dvec3()).as_vec3() + Vec3::ZERO;
        }
        for normal in mesh.normals.as_flattened_mut() {
            *normal = self.turn(normal.as_dvec3()).normalize_or_zero().as_vec3();
        }
    }
}

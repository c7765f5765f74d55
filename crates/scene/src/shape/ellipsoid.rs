//! An ellipsoid: `shape = "ellipsoid"` with `center`, `radii` and `rotate_deg`.

use glam::{DMat3, DVec3};

use super::mirror_shape::{Facing, MirrorShape, Primitive, ShaderInput, SurfaceHit};
use super::{keys, proxy, unit_sphere};
use crate::SceneError;
use crate::document::{SMALLEST, Table};
use crate::geometry::rotation;
use crate::mesh::Mesh;
use crate::pose::Pose;

/// An ellipsoid that reflects on its outside: the points `center + rotation · p` with
/// `|p / radii| = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Centre, world space.
    pub center: DVec3,
    /// Half axes before the rotation, in world units, positive.
    pub radii: DVec3,
    /// World from ellipsoid axes.
    pub rotation: DMat3,
}

impl Ellipsoid {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let radii = table.vector("radii")?;
        let degrees = table.vector("rotate_deg")?.unwrap_or(DVec3::ZERO);
        table.finish()?;
        let radii = table.required("radii", radii)?;
        if radii.min_element() < SMALLEST {
            return Err(table.error("radii", "must be positive"));
        }
        Ok(Self {
            center,
            radii,
            rotation: rotation(degrees),
        })
    }

    /// In the space where the surface is the unit sphere: a direction, or a point relative to the
    /// centre.
    fn local(&self, vector: DVec3) -> DVec3 {
        self.rotation.transpose() * vector / self.radii
    }

    /// Outward unit normal at the image of a point of the unit sphere.
    fn normal(&self, on_unit: DVec3) -> DVec3 {
        (self.rotation * (on_unit / self.radii)).normalize()
    }
}

impl MirrorShape for Ellipsoid {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        let (local_origin, local_dir) = (self.local(origin - self.center), self.local(dir));
        let t = unit_sphere::roots(local_origin, local_dir)?
            .into_iter()
            .find(|t| *t > t_min)?;
        let on_unit = (local_origin + t * local_dir).normalize();
        Some(SurfaceHit {
            t,
            position: self.center + self.rotation * (on_unit * self.radii),
            normal: self.normal(on_unit),
        })
    }

    fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        let local = self.rotation.transpose() * (point - self.center);
        Some((self.rotation * (local / (self.radii * self.radii))).normalize())
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let axes = self.rotation * DMat3::from_diagonal(self.radii);
        let rows = axes.transpose();
        let half = DVec3::new(
            rows.x_axis.length(),
            rows.y_axis.length(),
            rows.z_axis.length(),
        );
        (self.center - half, self.center + half)
    }

    fn tessellate(&self, segments: u32) -> Mesh {
        proxy::closed(segments, |unit| {
            let position = self.center + self.rotation * (unit * self.radii);
            (position, self.normal(unit))
        })
    }

    fn cover(&self, segments: u32) -> Mesh {
        let (segments, grow) = proxy::around(segments);
        proxy::closed(segments, |unit| {
            let position = self.center + self.rotation * (unit * self.radii * grow);
            (position, self.normal(unit))
        })
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
        self.rotation = pose.turn_axes(self.rotation);
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn encloses(&self, point: DVec3) -> bool {
        self.local(point - self.center).length() < 1.0
    }

    fn facing(&self) -> Result<Facing, &'static str> {
        Ok(Facing::Outwards)
    }

    fn numbers(&self) -> Vec<f64> {
        let vectors = [self.center, self.radii].map(|vector| vector.to_array());
        let rotation = self.rotation.to_cols_array();
        [vectors.as_flattened(), &rotation].concat()
    }

    fn shader_input(&self) -> Option<ShaderInput> {
        Some(ShaderInput {
            module: "ellipsoid",
            axes: self.rotation,
            sizes: self.radii,
            more: DVec3::ZERO,
            beyond: None,
        })
    }

    fn primitive(&self) -> Option<Primitive> {
        Some(Primitive::Ellipsoid {
            center: self.center,
            axes: self.rotation * DMat3::from_diagonal(self.radii),
        })
    }
}

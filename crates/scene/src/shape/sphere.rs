//! A sphere: `shape = "sphere"` with `center` and `radius`.

use glam::{DMat3, DVec3};

use super::mirror_shape::{Facing, MirrorShape, Primitive, ShaderInput, SurfaceHit};
use super::{keys, proxy, unit_sphere};
use crate::SceneError;
use crate::document::Table;
use crate::mesh::Mesh;
use crate::pose::Pose;

/// A sphere that reflects on its outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre, world space.
    pub center: DVec3,
    /// Radius in world units, positive.
    pub radius: f64,
}

impl Sphere {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let radius = table.positive("radius")?;
        table.finish()?;
        Ok(Self {
            center,
            radius: table.required("radius", radius)?,
        })
    }
}

impl MirrorShape for Sphere {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        let Self { center, radius } = *self;
        let roots = unit_sphere::roots((origin - center) / radius, dir / radius)?;
        let t = roots.into_iter().find(|t| *t > t_min)?;
        let normal = (origin + t * dir - center).normalize();
        Some(SurfaceHit {
            t,
            position: center + radius * normal,
            normal,
        })
    }

    fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        Some((point - self.center).normalize())
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        (self.center - self.radius, self.center + self.radius)
    }

    fn tessellate(&self, segments: u32) -> Mesh {
        let Self { center, radius } = *self;
        proxy::closed(segments, |unit| (center + radius * unit, unit))
    }

    fn cover(&self, segments: u32) -> Mesh {
        let Self { center, radius } = *self;
        let (segments, grow) = proxy::around(segments);
        proxy::closed(segments, |unit| (center + radius * grow * unit, unit))
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn encloses(&self, point: DVec3) -> bool {
        point.distance(self.center) < self.radius
    }

    fn facing(&self) -> Result<Facing, &'static str> {
        Ok(Facing::Outwards)
    }

    fn numbers(&self) -> Vec<f64> {
        let [x, y, z] = self.center.to_array();
        vec![x, y, z, self.radius]
    }

    /// An ellipsoid with equal half axes.
    fn shader_input(&self) -> Option<ShaderInput> {
        Some(ShaderInput {
            module: "ellipsoid",
            axes: DMat3::IDENTITY,
            sizes: DVec3::splat(self.radius),
            more: DVec3::ZERO,
            beyond: None,
        })
    }

    fn primitive(&self) -> Option<Primitive> {
        let Self { center, radius } = *self;
        Some(Primitive::Sphere { center, radius })
    }
}

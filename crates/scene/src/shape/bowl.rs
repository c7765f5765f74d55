//! A spherical cap that reflects on its inside: `shape = "bowl"` with `center`, `radius`, `axis`
//! and `half_angle_deg`.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::mirror_shape::{Facing, MirrorShape, ShaderInput, SurfaceHit};
use super::{keys, proxy, unit_sphere};
use crate::SceneError;
use crate::document::{Table, short};
use crate::mesh::Mesh;
use crate::pose::Pose;

/// How far its sphere is looked at beyond the rim, radians.
const BEYOND: f64 = 0.3;

/// A spherical cap whose inside reflects: the points of a sphere within `half_angle` of `axis`,
/// seen from the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bowl {
    /// Centre of the sphere, world space.
    pub center: DVec3,
    /// Radius of the sphere, world units.
    pub radius: f64,
    /// Unit, from the sphere's centre to the middle of the cap.
    pub axis: DVec3,
    /// Angle at the sphere's centre from the axis to the rim: radians, in (0, π).
    pub half_angle: f64,
}

impl Bowl {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let radius = table.positive("radius")?;
        let axis = table.direction("axis")?;
        let degrees = table.number("half_angle_deg")?;
        table.finish()?;
        let radius = table.required("radius", radius)?;
        let axis = table.required("axis", axis)?;
        let degrees = table.required("half_angle_deg", degrees)?;
        if !(1e-3..180.0).contains(&degrees) {
            let message = format_args!("must be between 0 and 180 degrees, not {}", short(degrees));
            return Err(table.error("half_angle_deg", message));
        }
        Ok(Self {
            center,
            radius,
            axis,
            half_angle: degrees.to_radians(),
        })
    }

    /// Nearest hit with `t > t_min` whose direction from the centre `keep` accepts.
    fn hit(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        keep: impl Fn(DVec3) -> bool,
    ) -> Option<SurfaceHit> {
        let Self { center, radius, .. } = *self;
        unit_sphere::roots((origin - center) / radius, dir / radius)?
            .into_iter()
            .filter(|t| *t > t_min)
            .map(|t| (t, (origin + t * dir - center).normalize()))
            .find(|(_, outward)| keep(*outward))
            .map(|(t, outward)| SurfaceHit {
                t,
                position: center + radius * outward,
                normal: -outward,
            })
    }
}

impl MirrorShape for Bowl {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        self.hit(origin, dir, t_min, |outward| self.covers(outward))
    }

    fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        Some((self.center - point).normalize())
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    /// Halfway between the plane of the rim and the farthest point on the axis.
    fn middle(&self) -> DVec3 {
        self.center + self.axis * self.radius * (0.5 + 0.5 * self.half_angle.cos())
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        (self.center - self.radius, self.center + self.radius)
    }

    fn tessellate(&self, segments: u32) -> Mesh {
        let Self {
            center,
            radius,
            axis,
            half_angle,
        } = *self;
        let side = axis.any_orthonormal_vector();
        let other = axis.cross(side);
        // Latitude runs from the rim towards the axis; the mirrored frame (side and other
        // swapped) turns the winding to the inside.
        proxy::cap(segments, half_angle, |polar, around| {
            let unit =
                axis * polar.cos() + (other * around.cos() + side * around.sin()) * polar.sin();
            (center + radius * unit, -unit)
        })
    }

    fn cover(&self, segments: u32) -> Mesh {
        let Self { center, radius, .. } = *self;
        let (segments, grow) = proxy::around(segments);
        proxy::closed(segments, |unit| (center + radius * grow * unit, -unit))
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
        self.axis = pose.turn(self.axis);
    }

    fn is_closed(&self) -> bool {
        false
    }

    /// The inside of the whole sphere.
    fn facing(&self) -> Result<Facing, &'static str> {
        Ok(Facing::Inwards)
    }

    fn from_center(&self, direction: DVec3) -> Option<SurfaceHit> {
        self.hit(self.center, direction, 0.0, |_| true)
    }

    fn covers(&self, direction: DVec3) -> bool {
        direction.dot(self.axis) >= self.half_angle.cos()
    }

    fn numbers(&self) -> Vec<f64> {
        let ([x, y, z], [u, v, w]) = (self.center.to_array(), self.axis.to_array());
        vec![x, y, z, self.radius, u, v, w, self.half_angle]
    }

    /// `more.x` is the cosine of the half angle; z is the axis.
    fn shader_input(&self) -> Option<ShaderInput> {
        let x = self.axis.any_orthonormal_vector();
        Some(ShaderInput {
            module: "bowl",
            axes: DMat3::from_cols(x, self.axis.cross(x), self.axis),
            sizes: DVec3::splat(self.radius),
            more: DVec3::X * self.half_angle.cos(),
            beyond: Some((
                DVec3::splat(self.radius),
                (self.half_angle + BEYOND).min(PI).cos(),
            )),
        })
    }
}

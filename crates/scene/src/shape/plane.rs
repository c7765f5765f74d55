//! A flat rectangle: `shape = "plane"` with `center`, `normal`, `up` and `size`.

use glam::{DMat3, DVec2, DVec3};

use super::mirror_shape::{Facing, MirrorShape, OPEN, Primitive, ShaderInput, SurfaceHit};
use super::{keys, proxy};
use crate::SceneError;
use crate::document::Table;
use crate::mesh::Mesh;
use crate::pose::Pose;

/// So many times as wide and high, the surface is looked at beyond its rim.
const BEYOND: f64 = 1.5;

/// A rectangle that reflects on the side its normal points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Centre of the rectangle, world space.
    pub center: DVec3,
    /// Unit normal of the reflecting side.
    pub normal: DVec3,
    /// Unit, in the plane: the direction of `size.y`.
    pub up: DVec3,
    /// Full width (along `up × normal`) and height (along `up`), world units.
    pub size: DVec2,
}

impl Plane {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let (normal, up, size) = keys::oriented(table)?;
        Ok(Self {
            center,
            normal,
            up,
            size,
        })
    }

    /// Unit direction of the width.
    fn right(&self) -> DVec3 {
        self.up.cross(self.normal)
    }
}

impl MirrorShape for Plane {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        let Self {
            center,
            normal,
            up,
            size,
        } = *self;
        let towards = dir.dot(normal);
        if towards == 0.0 {
            return None;
        }
        let t = (center - origin).dot(normal) / towards;
        if t.is_nan() || t <= t_min || t.is_infinite() {
            return None;
        }
        let offset = origin + t * dir - center;
        let (x, y) = (offset.dot(self.right()), offset.dot(up));
        let inside = x.abs() <= size.x / 2.0 && y.abs() <= size.y / 2.0;
        let position = center + offset - offset.dot(normal) * normal;
        inside.then_some(SurfaceHit {
            t,
            position,
            normal,
        })
    }

    fn normal_at(&self, _point: DVec3) -> Option<DVec3> {
        Some(self.normal)
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let size = self.size;
        let half = (self.right() * size.x / 2.0).abs() + (self.up * size.y / 2.0).abs();
        (self.center - half, self.center + half)
    }

    fn tessellate(&self, _segments: u32) -> Mesh {
        let half = self.size / 2.0;
        proxy::rectangle(self.center, self.normal, self.up, half)
    }

    fn cover(&self, _segments: u32) -> Mesh {
        let half = self.size * 0.5005;
        proxy::rectangle(self.center, self.normal, self.up, half)
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
        self.normal = pose.turn(self.normal);
        self.up = pose.turn(self.up);
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn is_convex(&self) -> bool {
        true
    }

    fn flat(&self) -> Option<(DVec3, DVec3)> {
        Some((self.center, self.normal))
    }

    fn facing(&self) -> Result<Facing, &'static str> {
        Err(OPEN)
    }

    fn numbers(&self) -> Vec<f64> {
        let vectors = [self.center, self.normal, self.up].map(|vector| vector.to_array());
        [vectors.as_flattened(), &self.size.to_array()].concat()
    }

    fn shader_input(&self) -> Option<ShaderInput> {
        Some(ShaderInput {
            module: "plane",
            axes: DMat3::from_cols(self.right(), self.up, self.normal),
            sizes: (self.size / 2.0).extend(1.0),
            more: DVec3::ZERO,
            beyond: Some(((BEYOND * self.size / 2.0).extend(1.0), 0.0)),
        })
    }

    fn primitive(&self) -> Option<Primitive> {
        let x = self.right() * self.size.x / 2.0;
        let y = self.up * self.size.y / 2.0;
        Some(Primitive::Rectangle {
            center: self.center,
            axes: DMat3::from_cols(x, y, self.normal),
        })
    }
}

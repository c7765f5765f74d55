//! A torus: `shape = "torus"` with `center`, `axis`, `major` and `minor`.
//!
//! Where a line meets it: with the torus' axis `a` through the origin, radii `R` and `r`, and the
//! line `q + s d` with `q` its point closest to the origin, the surface's equation
//! `(|p|² + R² − r²)² = 4R² (|p|² − (p·a)²)` becomes a quartic in `s` without a cubic term. Its
//! roots are found in order and each is then polished on the distance to the surface.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::mirror_shape::{MirrorShape, ShaderInput, SurfaceHit};
use super::polynomial::{Few, between};
use super::{keys, proxy};
use crate::SceneError;
use crate::document::Table;
use crate::mesh::Mesh;
use crate::pose::Pose;

/// A torus that reflects on its outside: the points `minor` away from a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Centre of the circle, world space.
    pub center: DVec3,
    /// Unit, perpendicular to the circle.
    pub axis: DVec3,
    /// Radius of the circle, world units.
    pub major: f64,
    /// Radius of the tube in world units, positive and smaller than `major`.
    pub minor: f64,
}

impl Torus {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let axis = table.direction("axis")?.unwrap_or(DVec3::Y);
        let major = table.positive("major")?;
        let minor = table.positive("minor")?;
        table.finish()?;
        let major = table.required("major", major)?;
        let minor = table.required("minor", minor)?;
        if minor >= major {
            return Err(table.error("minor", "must be smaller than `major`"));
        }
        Ok(Self {
            center,
            axis,
            major,
            minor,
        })
    }

    /// Signed distance of a point, negative inside, and the outward unit normal there.
    fn distance(&self, point: DVec3) -> (f64, DVec3) {
        distance(point - self.center, self.axis, self.major, self.minor)
    }

    /// With `segments` around the axis, half as many around a tube of radius `minor`.
    fn tube(&self, segments: u32, minor: f64) -> Mesh {
        let Self {
            center,
            axis,
            major,
            ..
        } = *self;
        let (columns, rows) = (segments.max(4), segments.max(6) / 2);
        let side = axis.any_orthonormal_vector();
        let other = axis.cross(side);
        let angle = |index: u32, count: u32| 2.0 * PI * f64::from(index) / f64::from(count);
        let mut points = Vec::new();
        for column in 0..columns {
            let (sin, cos) = angle(column, columns).sin_cos();
            let outward = side * cos + other * sin;
            for row in 0..rows {
                let (sin, cos) = angle(row, rows).sin_cos();
                let normal = outward * cos + axis * sin;
                points.push((center + major * outward + minor * normal, normal));
            }
        }
        let at = |column: u32, row: u32| column % columns * rows + row % rows;
        let mut triangles = Vec::new();
        for column in 0..columns {
            for row in 0..rows {
                let [a, b] = [at(column, row), at(column + 1, row)];
                let [c, d] = [at(column, row + 1), at(column + 1, row + 1)];
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        proxy::assemble(&points, triangles)
    }
}

impl MirrorShape for Torus {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        let Self {
            center,
            axis,
            major,
            minor,
        } = *self;
        let start = origin - center;
        let t = roots(start, dir, axis, major, minor)
            .iter()
            .find(|t| *t > t_min)?;
        let point = start + t * dir;
        let (off, normal) = distance(point, axis, major, minor);
        Some(SurfaceHit {
            t,
            position: center + (point - off * normal),
            normal,
        })
    }

    fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        Some(self.distance(point).1)
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let across = (DVec3::ONE - self.axis * self.axis).max(DVec3::ZERO);
        let across = DVec3::new(across.x.sqrt(), across.y.sqrt(), across.z.sqrt());
        let half = self.major * across + self.minor;
        (self.center - half, self.center + half)
    }

    fn tessellate(&self, segments: u32) -> Mesh {
        self.tube(segments, self.minor)
    }

    fn cover(&self, segments: u32) -> Mesh {
        let segments = segments.max(proxy::LEAST_AROUND);
        // Halfway between two cross-sections the tube is drawn towards the axis by the factor
        // `around`; the polygon that is its cross-section is as far out as its sides are.
        let around = (PI / f64::from(segments)).cos();
        let across = (PI / f64::from(segments / 2)).cos();
        let needed = self.minor / around + self.major * (1.0 / around - 1.0);
        let minor = needed * (1.0 + proxy::SLACK) / across;
        self.tube(segments, minor)
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
        self.axis = pose.turn(self.axis);
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn encloses(&self, point: DVec3) -> bool {
        self.distance(point).0 < 0.0
    }

    fn numbers(&self) -> Vec<f64> {
        let vectors = [self.center, self.axis].map(|vector| vector.to_array());
        [vectors.as_flattened(), &[self.major, self.minor]].concat()
    }

    /// `sizes` are the radii of the circle and of the tube; z is the axis.
    fn shader_input(&self) -> Option<ShaderInput> {
        let x = self.axis.any_orthonormal_vector();
        Some(ShaderInput {
            module: "torus",
            axes: DMat3::from_cols(x, self.axis.cross(x), self.axis),
            sizes: DVec3::new(self.major, self.minor, 1.0),
            more: DVec3::ZERO,
            beyond: None,
        })
    }

    /// A torus shows glancing angles all along, where a small error of the surface moves the reflection by far
    /// more. With three times as many segments its normals are as exact as those of a sphere.
    fn fine_segments(&self) -> u32 {
        3072
    }
}

/// Signed distance of a point to the torus around the unit `axis` through the origin, negative inside, and the
/// outward unit normal there. On the axis, where no direction is nearest, any normal will do.
fn distance(point: DVec3, axis: DVec3, major: f64, minor: f64) -> (f64, DVec3) {
    let height = point.dot(axis);
    let radial = point - height * axis;
    let outward = radial
        .try_normalize()
        .unwrap_or_else(|| axis.any_orthonormal_vector());
    let from_ring = point - major * outward;
    let normal = from_ring.try_normalize().unwrap_or(axis);
    (from_ring.length() - minor, normal)
}

/// Where the line `origin + t · dir` (`dir` of unit length) meets the torus around the origin.
/// Where it only touches, it may count as meeting twice or not at all.
fn roots(origin: DVec3, dir: DVec3, axis: DVec3, major: f64, minor: f64) -> Few<4> {
    let size = major + minor;
    let (ring, tube) = (major / size, minor / size);
    let start = -origin.dot(dir);
    let nearest = (origin + start * dir) / size;
    // Again, for what rounding leaves along the line when the origin is far away.
    let nearest = nearest - nearest.dot(dir) * dir;
    let square = nearest.length_squared();
    let mut found = Few::NONE;
    // A little more than the sphere around all, on which roots lie where the equator is met.
    let reach = (1.0 + 1e-6 - square).sqrt();
    if reach.is_nan() {
        return found;
    }
    let (height, slope) = (nearest.dot(axis), dir.dot(axis));
    let k = square + (ring - tube) * (ring + tube);
    let ring4 = 4.0 * ring * ring;
    let quartic = [
        k * k - ring4 * (square - height * height),
        2.0 * ring4 * height * slope,
        2.0 * k - ring4 * (1.0 - slope) * (1.0 + slope),
        0.0,
        1.0,
    ];
    let unpolished = between::<4>(&quartic, -reach, reach);
    let mut last = f64::NEG_INFINITY;
    for s in unpolished.iter() {
        let s = polish(s, nearest, dir, axis, ring, tube).max(last);
        last = s;
        found.push(start + s * size);
    }
    found
}

/// Newton's steps on the distance, as long as they get closer.
fn polish(start: f64, nearest: DVec3, dir: DVec3, axis: DVec3, ring: f64, tube: f64) -> f64 {
    let at = |s: f64| distance(nearest + s * dir, axis, ring, tube);
    let mut s = start;
    let (mut off, mut normal) = at(s);
    for _ in 0..4 {
        let next = s - off / normal.dot(dir);
        let (next_off, next_normal) = at(next);
        // Not where the line grazes: there the step may lead to another root.
        if !((next - s).abs() < 1e-6 && next_off.abs() < off.abs()) {
            break;
        }
        (s, off, normal) = (next, next_off, next_normal);
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_the_tube_twice_meets_it_four_times() {
        let origin = DVec3::new(-1e6, 0.05, 0.0);
        let found: Vec<f64> = roots(origin, DVec3::X, DVec3::Y, 1.0, 0.25)
            .iter()
            .collect();
        let half = (0.25f64 * 0.25 - 0.05 * 0.05).sqrt();
        let expected = [-1.0 - half, -1.0 + half, 1.0 - half, 1.0 + half];
        assert_eq!(found.len(), 4);
        for (t, x) in found.iter().zip(expected) {
            assert!((t - 1e6 - x).abs() < 1e-9, "{t}");
        }
    }
}

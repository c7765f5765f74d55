//! Triangle proxies of mirrors: on the surface, or slightly outside to cover it.

use std::f64::consts::{PI, SQRT_2};

use glam::{DVec3, Vec3};

use crate::mesh::{Material, Mesh, Paint};
use crate::mirror::Shape;

/// A mirror's proxy has no colour of its own.
fn no_paint() -> Material {
    Material {
        name: "mirror".to_owned(),
        paint: Paint::Color(Vec3::ZERO),
    }
}

impl Shape {
    /// Triangles with vertices on the surface and exact normals of the reflecting side at each,
    /// counter-clockwise seen from that side. `segments` (at least 4) run around, half as many
    /// rings across; a plane is two triangles; a mesh is returned as it is.
    pub fn tessellate(&self, segments: u32) -> Mesh {
        match self {
            Self::Sphere { center, radius } => {
                closed(segments, |unit| (*center + *radius * unit, unit))
            }
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => closed(segments, |unit| {
                (
                    *center + *rotation * (unit * *radii),
                    (*rotation * (unit / *radii)).normalize(),
                )
            }),
            Self::Plane {
                center,
                normal,
                up,
                size,
            } => rectangle(*center, *normal, *up, size.x / 2.0, size.y / 2.0),
            Self::Bowl {
                center,
                radius,
                axis,
                half_angle,
            } => {
                let side = axis.any_orthonormal_vector();
                let other = axis.cross(side);
                // Latitude runs from the rim towards the axis; the mirrored frame (side and
                // other swapped) turns the winding to the inside.
                patch(segments, *half_angle, false, |polar, around| {
                    let unit = *axis * polar.cos()
                        + (other * around.cos() + side * around.sin()) * polar.sin();
                    (*center + *radius * unit, -unit)
                })
            }
            Self::Mesh(mesh) => mesh.clone(),
        }
    }

    /// Triangles slightly outside the surface: every ray that meets the surface meets them too,
    /// from any eye, if both faces are drawn. A bowl's is the whole sphere, a mesh's the mesh.
    /// Normals are the nearest surface normals, for lack of better ones.
    pub fn cover(&self, segments: u32) -> Mesh {
        let segments = segments.max(16);
        // No face plane is further from the centre than half a cell's diagonal is wide.
        let grow = (1.0 + 1e-4) / (SQRT_2 * PI / f64::from(segments & !1)).cos();
        match self {
            Self::Sphere { center, radius } => {
                closed(segments, |unit| (*center + *radius * grow * unit, unit))
            }
            Self::Ellipsoid {
                center,
                radii,
                rotation,
            } => closed(segments, |unit| {
                let normal = (*rotation * (unit / *radii)).normalize();
                (*center + *rotation * (unit * *radii * grow), normal)
            }),
            Self::Plane {
                center,
                normal,
                up,
                size,
            } => rectangle(*center, *normal, *up, size.x * 0.5005, size.y * 0.5005),
            Self::Bowl { center, radius, .. } => {
                closed(segments, |unit| (*center + *radius * grow * unit, -unit))
            }
            Self::Mesh(mesh) => mesh.clone(),
        }
    }
}

/// A whole unit sphere, poles on ±y, mapped to (position, normal).
fn closed(segments: u32, map: impl Fn(DVec3) -> (DVec3, DVec3)) -> Mesh {
    patch(segments, PI, true, |polar, around| {
        let (sin, cos) = polar.sin_cos();
        map(DVec3::new(sin * around.sin(), cos, sin * around.cos()))
    })
}

/// Rings of a polar grid from the pole to `end`; with `pole` a single vertex closes the far side.
/// Counter-clockwise where `∂/∂polar × ∂/∂around` points to the viewer.
fn patch(segments: u32, end: f64, pole: bool, map: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Mesh {
    let segments = segments.max(4);
    let rings = segments / 2;
    let mut points = vec![map(0.0, 0.0)];
    let last_open = if pole { rings - 1 } else { rings };
    for ring in 1..=last_open {
        let polar = end * f64::from(ring) / f64::from(rings);
        for segment in 0..segments {
            points.push(map(
                polar,
                2.0 * PI * f64::from(segment) / f64::from(segments),
            ));
        }
    }
    let at = |ring: u32, segment: u32| 1 + (ring - 1) * segments + segment % segments;
    let mut triangles = Vec::new();
    for segment in 0..segments {
        triangles.push([0, at(1, segment), at(1, segment + 1)]);
    }
    for ring in 1..last_open {
        for segment in 0..segments {
            let [a, b] = [at(ring, segment), at(ring, segment + 1)];
            let [c, d] = [at(ring + 1, segment), at(ring + 1, segment + 1)];
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    if pole {
        let south = points.len() as u32;
        points.push(map(end, 0.0));
        for segment in 0..segments {
            triangles.push([at(last_open, segment + 1), at(last_open, segment), south]);
        }
    }
    assemble(&points, triangles)
}

/// Two triangles around `center`, `half_width` along `up × normal` and `half_height` along `up`.
fn rectangle(center: DVec3, normal: DVec3, up: DVec3, half_width: f64, half_height: f64) -> Mesh {
    let (x, y) = (up.cross(normal) * half_width, up * half_height);
    let points = [
        center - x - y,
        center + x - y,
        center + x + y,
        center - x + y,
    ]
    .map(|p| (p, normal));
    assemble(&points, vec![[0, 1, 2], [0, 2, 3]])
}

fn assemble(points: &[(DVec3, DVec3)], triangles: Vec<[u32; 3]>) -> Mesh {
    let normal = |index: u32| points[index as usize].1.as_vec3();
    Mesh {
        positions: points
            .iter()
            .map(|(position, _)| position.as_vec3())
            .collect(),
        normals: triangles
            .iter()
            .map(|corners| corners.map(normal))
            .collect(),
        material: vec![0; triangles.len()],
        materials: vec![no_paint()],
        triangles,
        ..Mesh::default()
    }
}

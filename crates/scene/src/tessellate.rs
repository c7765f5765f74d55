//! Triangle proxies of mirrors: on the surface, or slightly outside to cover it.

use std::f64::consts::{PI, SQRT_2};

use glam::{DMat3, DVec2, DVec3, Vec3};

use crate::mesh::{Material, Mesh, Paint};
use crate::mirror::Shape;
use crate::saddle::Patch;
use crate::surface::saddle;

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
    /// rings across (a torus' tube, or cells along each side of a saddle); a plane is two
    /// triangles; a mesh is returned as it is.
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
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => tube(segments, *center, *axis, *major, *minor),
            Self::Saddle {
                center,
                normal,
                up,
                size,
                curvature,
            } => {
                let (frame, patch) = saddle(*normal, *up, *size, *curvature);
                sheet(segments.max(4) / 2, *center, frame, &patch)
            }
            Self::Mesh(mesh) => mesh.clone(),
        }
    }

    /// Triangles slightly outside the surface: every ray that meets the surface meets them too,
    /// from any eye, if both faces are drawn. A bowl's is the whole sphere, a saddle's the box
    /// around it, a mesh's the mesh.
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
            Self::Torus {
                center,
                axis,
                major,
                minor,
            } => {
                // Halfway between two cross-sections the tube is drawn towards the axis by the
                // factor `around`; the polygon that is its cross-section is as far out as its
                // sides are.
                let around = (PI / f64::from(segments)).cos();
                let across = (PI / f64::from(segments / 2)).cos();
                let needed = minor / around + major * (1.0 / around - 1.0);
                let minor = needed * (1.0 + 1e-4) / across;
                tube(segments, *center, *axis, *major, minor)
            }
            Self::Saddle {
                center,
                normal,
                up,
                size,
                curvature,
            } => {
                let (frame, patch) = saddle(*normal, *up, *size, *curvature);
                cuboid(*center, frame, &patch)
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

/// A torus: `segments` around its axis, half as many around its tube.
fn tube(segments: u32, center: DVec3, axis: DVec3, major: f64, minor: f64) -> Mesh {
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
    assemble(&points, triangles)
}

/// A saddle in `cells` × `cells` parts.
fn sheet(cells: u32, center: DVec3, frame: DMat3, patch: &Patch) -> Mesh {
    let mut points = Vec::new();
    for j in 0..=cells {
        for i in 0..=cells {
            let share = DVec2::new(f64::from(i), f64::from(j)) / f64::from(cells);
            let at = (2.0 * share - 1.0) * patch.half;
            points.push((center + frame * patch.point(at), frame * patch.normal(at)));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..cells {
        for i in 0..cells {
            let a = j * (cells + 1) + i;
            let (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    assemble(&points, triangles)
}

/// A box around a saddle, a little larger, with the saddle's normal in its middle.
fn cuboid(center: DVec3, frame: DMat3, patch: &Patch) -> Mesh {
    let [low, high] = patch.heights();
    let margin = 5e-4 * patch.half.max_element();
    let corner = |index: u32| {
        let pick = |bit: u32, low: f64, high: f64| if index & bit == 0 { low } else { high };
        let half = patch.half + margin;
        let local = DVec3::new(
            pick(1, -half.x, half.x),
            pick(2, -half.y, half.y),
            pick(4, low - margin, high + margin),
        );
        (center + frame * local, frame.z_axis)
    };
    let points: Vec<_> = (0..8).map(corner).collect();
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = faces
        .into_iter()
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    assemble(&points, triangles.collect())
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

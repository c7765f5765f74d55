//! Triangles that stand for round and flat surfaces.

use std::f64::consts::{PI, SQRT_2};

use glam::{DVec2, DVec3, Vec3};

use crate::mesh::{Material, Mesh, Paint};

/// A mirror's proxy has no colour of its own.
fn no_paint() -> Material {
    Material {
        name: "mirror".to_owned(),
        paint: Paint::Color(Vec3::ZERO),
    }
}

/// For a proxy that covers a sphere: how many segments it has at least, and how far out its
/// vertices have to be.
pub(super) fn around(segments: u32) -> (u32, f64) {
    let segments = segments.max(LEAST_AROUND);
    // No face plane is further from the centre than half a cell's diagonal is wide.
    let grow = (1.0 + SLACK) / (SQRT_2 * PI / f64::from(segments & !1)).cos();
    (segments, grow)
}

/// Least number of segments of a proxy that covers a round surface.
pub(super) const LEAST_AROUND: u32 = 16;
/// Share of its size by which a proxy is drawn larger than it would have to be.
pub(super) const SLACK: f64 = 1e-4;

/// A whole unit sphere, poles on ±y, mapped to (position, normal).
pub(super) fn closed(segments: u32, map: impl Fn(DVec3) -> (DVec3, DVec3)) -> Mesh {
    rings(segments, PI, true, |polar, around| {
        let (sin, cos) = polar.sin_cos();
        map(DVec3::new(sin * around.sin(), cos, sin * around.cos()))
    })
}

/// A polar grid from the pole to the angle `end`, mapped to (position, normal).
pub(super) fn cap(segments: u32, end: f64, map: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Mesh {
    rings(segments, end, false, map)
}

/// Rings of a polar grid from the pole to `end`; with `pole` a single vertex closes the far side.
/// Counter-clockwise where `∂/∂polar × ∂/∂around` points to the viewer.
fn rings(segments: u32, end: f64, pole: bool, map: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Mesh {
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

/// Two triangles around `center`, with half the width along `up × normal` and half the height along
/// `up`.
pub(super) fn rectangle(center: DVec3, normal: DVec3, up: DVec3, half: DVec2) -> Mesh {
    let (x, y) = (up.cross(normal) * half.x, up * half.y);
    let points = [
        center - x - y,
        center + x - y,
        center + x + y,
        center - x + y,
    ]
    .map(|p| (p, normal));
    assemble(&points, vec![[0, 1, 2], [0, 2, 3]])
}

/// A mesh of (position, normal) pairs.
pub(super) fn assemble(points: &[(DVec3, DVec3)], triangles: Vec<[u32; 3]>) -> Mesh {
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

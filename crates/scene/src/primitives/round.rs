//! Surfaces of revolution around the y axis.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::geometry::Geometry;

/// A sphere with poles on ±y: `segments` around, half as many rings.
pub(crate) fn sphere(center: DVec3, radius: f64, segments: u32) -> Geometry {
    let rings = (segments / 2).max(2);
    let profile = (0..=rings).map(|ring| {
        let angle = PI * f64::from(ring) / f64::from(rings);
        let sin = if ring == 0 || ring == rings {
            0.0
        } else {
            angle.sin()
        };
        let normal = DVec2::new(sin, -angle.cos());
        (radius * normal, normal)
    });
    let mut geometry = revolve(&profile.collect::<Vec<_>>(), segments, TAU);
    geometry
        .positions
        .iter_mut()
        .for_each(|position| *position += center);
    geometry
}

/// A torus around the y axis: `radius` to the middle of a tube of radius `tube`; `segments`
/// around the axis, half as many around the tube.
pub(crate) fn torus(radius: f64, tube: f64, segments: u32) -> Geometry {
    let around = (segments / 2).max(3);
    let profile = (0..=around).map(|step| {
        let angle = 2.0 * PI * f64::from(step % around) / f64::from(around);
        let normal = DVec2::new(angle.cos(), angle.sin());
        (DVec2::new(radius, 0.0) + tube * normal, normal)
    });
    revolve(&profile.collect::<Vec<_>>(), segments, TAU)
}

/// A polyline of (distance from the axis, height), from bottom to top of the outside, turned
/// by the angle `turn` around the y axis; each of its sides is flat and in `cells` parts.
pub(crate) fn lathe(profile: &[DVec2], cells: u32, segments: u32, turn: f64) -> Geometry {
    let mut all = Geometry::default();
    for side in profile.windows(2) {
        let along = side[1] - side[0];
        let normal = DVec2::new(along.y, -along.x).normalize_or_zero();
        let point = |step: u32| side[0].lerp(side[1], f64::from(step) / f64::from(cells));
        let steps: Vec<_> = (0..=cells).map(|step| (point(step), normal)).collect();
        let part = revolve(&steps, segments, turn);
        let start = all.positions.len() as u32;
        all.positions.extend(part.positions);
        all.triangles.extend(
            part.triangles
                .iter()
                .map(|corners| corners.map(|i| i + start)),
        );
        all.normals.extend(part.normals);
        all.uvs.extend(part.uvs);
    }
    all
}

/// Turns (point, normal) pairs, each (distance from the axis, height), around the y axis, from
/// +z towards +x by the angle `turn`, all the way round if it is a full one. u runs around, v
/// along the profile.
fn revolve(profile: &[(DVec2, DVec2)], segments: u32, turn: f64) -> Geometry {
    let mut geometry = Geometry::default();
    let columns = if turn < TAU { segments + 1 } else { segments };
    let turned = |at: DVec2, segment: u32| {
        let angle = turn * f64::from(segment % columns) / f64::from(segments);
        let (sin, cos) = angle.sin_cos();
        DVec3::new(at.x * sin, at.y, at.x * cos)
    };
    for (point, _) in profile {
        for segment in 0..columns {
            geometry.vertex(turned(*point, segment));
        }
    }
    let rows = (profile.len() - 1) as f64;
    let mut triangle = |corners: [(usize, u32); 3]| {
        geometry.triangle(
            corners.map(|(row, segment)| row as u32 * columns + segment % columns),
            corners.map(|(row, segment)| turned(profile[row].1, segment)),
            corners.map(|(row, segment)| {
                DVec2::new(f64::from(segment) / f64::from(segments), row as f64 / rows).as_vec2()
            }),
        );
    };
    for row in 0..profile.len() - 1 {
        for segment in 0..segments {
            // At a pole one of the two triangles has no area.
            if profile[row].0.x > 0.0 {
                triangle([(row, segment), (row, segment + 1), (row + 1, segment + 1)]);
            }
            if profile[row + 1].0.x > 0.0 {
                triangle([(row, segment), (row + 1, segment + 1), (row + 1, segment)]);
            }
        }
    }
    geometry
}

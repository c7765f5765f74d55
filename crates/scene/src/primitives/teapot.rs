//! The Utah teapot from its bicubic Bézier patches.

use glam::{DMat3, DVec3, Vec2};

use super::teapot_data::{HALVES, POINTS, QUARTERS};
use crate::geometry::Geometry;

/// All 32 patches in `cells` × `cells` squares, with the normals of the exact surface.
/// +y up, spout along +x, standing on y = 0.
pub(crate) fn teapot(cells: u32) -> Geometry {
    let mut geometry = Geometry::default();
    let mirror = DMat3::from_diagonal(DVec3::new(1.0, 1.0, -1.0));
    for patch in &QUARTERS {
        // Signs instead of turns: exact, and what Newell's symmetric data means.
        for (x, z) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            let signs = DMat3::from_diagonal(DVec3::new(x, 1.0, z));
            tessellate(&mut geometry, &control(patch, signs), cells, x * z < 0.0);
        }
    }
    for patch in &HALVES {
        tessellate(
            &mut geometry,
            &control(patch, DMat3::IDENTITY),
            cells,
            false,
        );
        tessellate(&mut geometry, &control(patch, mirror), cells, true);
    }
    geometry
}

type Control = [[DVec3; 4]; 4];

/// Control points in rows, turned from z up to y up.
fn control(patch: &[usize; 16], map: DMat3) -> Control {
    let point = |index: usize| {
        let [x, y, z] = POINTS[index];
        map * DVec3::new(x, z, -y)
    };
    [0, 1, 2, 3].map(|row| [0, 1, 2, 3].map(|column| point(patch[4 * row + column])))
}

fn tessellate(geometry: &mut Geometry, control: &Control, cells: u32, flip: bool) {
    let start = geometry.positions.len() as u32;
    let mut normals = Vec::new();
    let parameter = |index: u32| f64::from(index) / f64::from(cells);
    for j in 0..=cells {
        for i in 0..=cells {
            let (position, normal) = evaluate(control, parameter(j), parameter(i));
            geometry.vertex(position);
            normals.push(if flip { -normal } else { normal });
        }
    }
    let mut triangle = |mut corners: [(u32, u32); 3]| {
        if flip {
            corners.swap(1, 2);
        }
        let local = corners.map(|(i, j)| j * (cells + 1) + i);
        geometry.triangle(
            local.map(|index| start + index),
            local.map(|index| normals[index as usize]),
            corners.map(|(i, j)| Vec2::new(parameter(i) as f32, 1.0 - parameter(j) as f32)),
        );
    };
    for j in 0..cells {
        for i in 0..cells {
            triangle([(i, j), (i + 1, j), (i + 1, j + 1)]);
            triangle([(i, j), (i + 1, j + 1), (i, j + 1)]);
        }
    }
}

/// Point and unit normal; at a collapsed edge the normal is the limit from inside the patch.
fn evaluate(control: &Control, v: f64, u: f64) -> (DVec3, DVec3) {
    let position = combine(control, bernstein(v), bernstein(u));
    let normal_at = |v: f64, u: f64| {
        let along_v = combine(control, bernstein_slope(v), bernstein(u));
        let along_u = combine(control, bernstein(v), bernstein_slope(u));
        along_u.cross(along_v)
    };
    let mut normal = normal_at(v, u);
    if normal.length() < 1e-9 {
        const INSIDE: f64 = 1e-5;
        normal = normal_at(v.clamp(INSIDE, 1.0 - INSIDE), u.clamp(INSIDE, 1.0 - INSIDE));
    }
    (position, normal.normalize_or_zero())
}

fn combine(control: &Control, rows: [f64; 4], columns: [f64; 4]) -> DVec3 {
    let along = |row: &[DVec3; 4]| -> DVec3 { row.iter().zip(columns).map(|(p, w)| *p * w).sum() };
    control
        .iter()
        .zip(rows)
        .map(|(row, weight)| along(row) * weight)
        .sum()
}

fn bernstein(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
}

fn bernstein_slope(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    [
        -3.0 * s * s,
        3.0 * s * (s - 2.0 * t),
        3.0 * t * (2.0 * s - t),
        3.0 * t * t,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Purpose, Transform};

    #[test]
    fn known_size_and_place() {
        let mesh = teapot(16)
            .into_mesh(&[Transform::IDENTITY], Purpose::Object)
            .unwrap();
        // As the patches of 1975 give it: 32 · 512 triangles, less those collapsed at 8 poles.
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8257, 16256));
        let (low, high) = mesh.bounds().unwrap();
        assert!(low.distance(glam::vec3(-3.0, 0.0, -2.0)) < 1e-6, "{low}");
        assert!(
            high.distance(glam::vec3(3.433_514, 3.15, 2.0)) < 1e-5,
            "{high}"
        );
    }

    #[test]
    fn normals_match_the_triangles_and_point_outside() {
        let mesh = teapot(24)
            .into_mesh(&[Transform::IDENTITY], Purpose::Object)
            .unwrap();
        for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
            let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
            let face = (b - a).cross(c - a).normalize();
            for normal in normals {
                assert!(face.dot(*normal) > 0.8, "{a} {face} {normal}");
            }
        }
        let bottom = mesh
            .positions
            .iter()
            .position(|p| p.length() < 1e-6)
            .unwrap() as u32;
        for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
            for (corner, normal) in corners.iter().zip(normals) {
                assert!(
                    *corner != bottom || normal.y < -0.999,
                    "the bottom faces down: {normal}"
                );
            }
        }
    }
}

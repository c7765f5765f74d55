//! Surfaces made of squares, and triangles as they are written.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::geometry::Geometry;
use crate::mesh::{Material, Paint};

/// [−1, 1]² in the xz plane, normal +y, in `cells` × `cells` squares; u along +x, v along −z.
pub(crate) fn grid(cells: u32) -> Geometry {
    let mut geometry = Geometry::default();
    square(&mut geometry, cells, DVec3::ZERO, DVec3::X, DVec3::NEG_Z);
    geometry
}

/// [−1, 1]³, each face in `cells` × `cells` squares with texture coordinates of its own.
pub(crate) fn cuboid(cells: u32) -> Geometry {
    let mut geometry = Geometry::default();
    for (right, up) in [
        (DVec3::X, DVec3::Y),
        (DVec3::NEG_Z, DVec3::Y),
        (DVec3::NEG_X, DVec3::Y),
        (DVec3::Z, DVec3::Y),
        (DVec3::X, DVec3::NEG_Z),
        (DVec3::X, DVec3::Z),
    ] {
        square(&mut geometry, cells, right.cross(up), right, up);
    }
    geometry
}

/// A square with half axes `right` and `up`, facing `right × up`.
fn square(geometry: &mut Geometry, cells: u32, center: DVec3, right: DVec3, up: DVec3) {
    let normal = right.cross(up);
    let start = geometry.positions.len() as u32;
    let uv = |i: u32, j: u32| DVec2::new(f64::from(i), f64::from(j)) / f64::from(cells);
    for j in 0..=cells {
        for i in 0..=cells {
            let at = 2.0 * uv(i, j) - 1.0;
            geometry.vertex(center + at.x * right + at.y * up);
        }
    }
    let mut triangle = |corners: [(u32, u32); 3]| {
        let indices = corners.map(|(i, j)| start + j * (cells + 1) + i);
        let uvs: [Vec2; 3] = corners.map(|(i, j)| uv(i, j).as_vec2());
        geometry.triangle(indices, [normal; 3], uvs);
    };
    for j in 0..cells {
        for i in 0..cells {
            triangle([(i, j), (i + 1, j), (i + 1, j + 1)]);
            triangle([(i, j), (i + 1, j + 1), (i, j + 1)]);
        }
    }
}

/// Triangles as given, with their own flat normals, and each with a colour if there are any.
pub(crate) fn triangles(positions: &[DVec3], triangles: &[[u32; 3]], colors: &[Vec3]) -> Geometry {
    let normal = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|index| positions[index as usize]);
        [(b - a).cross(c - a).normalize_or_zero(); 3]
    };
    let material = |(index, color): (usize, &Vec3)| Material {
        name: format!("triangle {index}"),
        paint: Paint::Color(*color),
    };
    Geometry {
        positions: positions.to_vec(),
        normals: triangles.iter().map(normal).collect(),
        material: (0..colors.len() as u32).collect(),
        materials: colors.iter().enumerate().map(material).collect(),
        triangles: triangles.to_vec(),
        ..Geometry::default()
    }
}

//! What `export --mitsuba` makes of a triangle that is seen from both sides, made one triangle again.
//!
//! Mitsuba's emitters are black from behind, so such a triangle is exported as two, back to back, a few
//! steps of a 32-bit float apart. In the middle between them is the triangle as it was.

use catoptric_scene::model::Triangles;
use glam::DVec3;

use crate::export::SHEET;

/// Puts each pair of sheets, one right after the other, together again.
pub fn join(mesh: &mut Triangles) {
    let corners =
        |index: usize| mesh.triangles[index].map(|corner| mesh.positions[corner as usize]);
    let mut joined = Triangles::default();
    let mut index = 0;
    while index < mesh.triangles.len() {
        let here = corners(index);
        let pair = (index + 1 < mesh.triangles.len())
            .then(|| corners(index + 1))
            .filter(|next| are_sheets(here, *next));
        let first = joined.positions.len() as u32;
        joined.triangles.push([first, first + 1, first + 2]);
        joined.positions.extend(match pair {
            // The second one runs the other way around.
            Some([a, c, b]) => [
                (here[0] + a) / 2.0,
                (here[1] + b) / 2.0,
                (here[2] + c) / 2.0,
            ]
            .map(|middle| middle.as_vec3().as_dvec3()),
            None => here,
        });
        joined.normals.extend(mesh.normals.get(index));
        joined.uvs.extend(mesh.uvs.get(index));
        joined.colors.extend(mesh.colors.get(index));
        index += if pair.is_some() { 2 } else { 1 };
    }
    *mesh = joined;
}

/// Whether two triangles are one in reverse, as far apart as the exporter puts them.
fn are_sheets(here: [DVec3; 3], next: [DVec3; 3]) -> bool {
    let [a, c, b] = next;
    let normal = (here[1] - here[0])
        .cross(here[2] - here[0])
        .normalize_or_zero();
    let largest = here
        .iter()
        .fold(0.0f64, |most, corner| most.max(corner.abs().max_element()));
    let apart = 2.0 * f64::from(SHEET) * (1.0 + largest);
    here.iter().zip([a, b, c]).all(|(front, back)| {
        let between = *front - back;
        // Each coordinate is rounded to a 32-bit float.
        (between - apart * normal).abs().max_element() <= 0.3 * apart
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sheets_become_the_triangle_they_were() {
        let corners = [
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(2.0, 2.0, 3.5),
            DVec3::new(1.5, 3.0, 3.0),
        ]
        .map(|corner| corner.as_vec3().as_dvec3());
        let normal = (corners[1] - corners[0])
            .cross(corners[2] - corners[0])
            .normalize();
        let offset = normal * f64::from(SHEET) * (1.0 + 3.5);
        let [a, b, c] = corners.map(|corner| (corner + offset).as_vec3().as_dvec3());
        let [d, e, f] = corners.map(|corner| (corner - offset).as_vec3().as_dvec3());
        let mut mesh = Triangles {
            positions: vec![a, b, c, d, f, e, a, b, c],
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            ..Triangles::default()
        };
        join(&mut mesh);
        assert_eq!(mesh.triangles.len(), 2);
        for (joined, corner) in mesh.positions.iter().zip(corners) {
            assert!((*joined - corner).length() < 5e-7, "{joined} {corner}");
        }
        assert_eq!(mesh.positions[3], a);
    }
}

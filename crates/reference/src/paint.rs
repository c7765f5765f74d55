//! The colour of an unlit surface at a point of a triangle.

use catoptric_scene::{Background, Mesh, Paint, Texture};
use glam::{DVec2, DVec3, Vec3};

/// Colour of triangle `triangle` at barycentric coordinates. Texture coordinates that a mesh does
/// not have count as (0, 0).
pub(crate) fn surface(mesh: &Mesh, triangle: usize, barycentric: DVec3) -> Vec3 {
    let uv = || {
        mesh.uvs.get(triangle).map_or(DVec2::ZERO, |[a, b, c]| {
            a.as_dvec2() * barycentric.x
                + b.as_dvec2() * barycentric.y
                + c.as_dvec2() * barycentric.z
        })
    };
    match &mesh.materials[mesh.material[triangle] as usize].paint {
        Paint::Color(color) => *color,
        Paint::Checker { a, b, cells } => {
            let cell = (uv() * f64::from(*cells)).floor();
            if (cell.x + cell.y).rem_euclid(2.0) == 0.0 {
                *a
            } else {
                *b
            }
        }
        Paint::Texture { tint, image } => *tint * bilinear(image, uv()),
        Paint::Vertex => {
            let [a, b, c] = mesh.colors[triangle].map(Vec3::as_dvec3);
            (a * barycentric.x + b * barycentric.y + c * barycentric.z).as_vec3()
        }
    }
}

/// The four texels around `uv`, blended by their bilinear weights; the picture repeats.
fn bilinear(image: &Texture, uv: DVec2) -> Vec3 {
    // In texels from the top left, texel centres at whole numbers.
    let x = uv.x * f64::from(image.width()) - 0.5;
    let y = (1.0 - uv.y) * f64::from(image.height()) - 0.5;
    let wrap = |at: f64, count: u32| (at as i64).rem_euclid(i64::from(count)) as usize;
    let texel = |x: f64, y: f64| {
        let index = wrap(y, image.height()) * image.width() as usize + wrap(x, image.width());
        image.texel(index).as_dvec3()
    };
    let (left, top) = (x.floor(), y.floor());
    let (right, bottom) = (left + 1.0, top + 1.0);
    let upper = texel(left, top).lerp(texel(right, top), x - left);
    let lower = texel(left, bottom).lerp(texel(right, bottom), x - left);
    upper.lerp(lower, y - top).as_vec3()
}

/// Colour of a ray in direction `dir` (unit) that meets nothing.
pub(crate) fn background(background: &Background, dir: DVec3) -> Vec3 {
    match background {
        Background::Color(color) => *color,
        Background::Gradient {
            zenith,
            horizon,
            nadir,
        } => {
            let towards = if dir.y >= 0.0 { zenith } else { nadir };
            let height = dir.y.abs().min(1.0);
            horizon
                .as_dvec3()
                .lerp(towards.as_dvec3(), height)
                .as_vec3()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use catoptric_scene::Material;
    use glam::{Vec2, vec2, vec3};

    use super::*;

    /// Two by two texels: black and red above, green and blue below.
    fn picture() -> Texture {
        Texture::linear([2; 2], vec![[0; 3], [255, 0, 0], [0, 255, 0], [0, 0, 255]])
    }

    fn painted(paint: Paint, uvs: [Vec2; 3]) -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            uvs: vec![uvs],
            colors: vec![[Vec3::X, Vec3::Y, Vec3::Z]],
            material: vec![0],
            materials: vec![Material {
                name: "paint".into(),
                paint,
            }],
            ..Mesh::default()
        }
    }

    #[test]
    fn texel_centres_have_their_own_colour() {
        let picture = picture();
        for (u, v, color) in [
            (0.25, 0.75, Vec3::ZERO),
            (0.75, 0.75, Vec3::X),
            (0.25, 0.25, Vec3::Y),
            (0.75, 0.25, Vec3::Z),
            (1.75, -0.75, Vec3::Z),
            (-0.75, 2.25, Vec3::Y),
        ] {
            assert_eq!(bilinear(&picture, DVec2::new(u, v)), color, "at {u} {v}");
        }
    }

    #[test]
    fn between_texels_colours_mix_across_the_border_too() {
        let picture = picture();
        let all = vec3(0.25, 0.25, 0.25);
        for uv in [
            DVec2::splat(0.5),
            DVec2::ZERO,
            DVec2::ONE,
            DVec2::new(0.5, 1.0),
        ] {
            assert_eq!(bilinear(&picture, uv), all, "at {uv}");
        }
        assert_eq!(bilinear(&picture, DVec2::new(0.5, 0.75)), Vec3::X / 2.0);
        assert_eq!(bilinear(&picture, DVec2::new(0.0, 0.75)), Vec3::X / 2.0);
        assert_eq!(bilinear(&picture, DVec2::new(0.375, 0.75)), Vec3::X / 4.0);
    }

    #[test]
    fn textures_are_tinted_and_follow_the_corners() {
        let image = Arc::new(picture());
        let paint = Paint::Texture {
            tint: vec3(0.5, 0.5, 0.5),
            image,
        };
        let mesh = painted(
            paint,
            [vec2(0.25, 0.25), vec2(0.75, 0.25), vec2(0.25, 0.75)],
        );
        assert_eq!(surface(&mesh, 0, DVec3::X), Vec3::Y / 2.0);
        assert_eq!(surface(&mesh, 0, DVec3::Y), Vec3::Z / 2.0);
        assert_eq!(surface(&mesh, 0, DVec3::Z), Vec3::ZERO);
        assert_eq!(
            surface(&mesh, 0, DVec3::new(0.5, 0.5, 0.0)),
            (Vec3::Y + Vec3::Z) / 4.0
        );
    }

    #[test]
    fn checker_alternates_and_reaches_below_zero() {
        let paint = Paint::Checker {
            a: Vec3::X,
            b: Vec3::Y,
            cells: 4,
        };
        let mesh = painted(paint, [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(0.0, -1.0)]);
        let at = |u: f64, v: f64| surface(&mesh, 0, DVec3::new(1.0 - u - v, u, v));
        assert_eq!(at(0.1, 0.0), Vec3::X);
        assert_eq!(at(0.3, 0.0), Vec3::Y);
        assert_eq!(at(0.1, 0.1), Vec3::Y);
        assert_eq!(at(0.3, 0.1), Vec3::X);
    }

    #[test]
    fn corner_colours_are_interpolated() {
        let mesh = painted(Paint::Vertex, [Vec2::ZERO; 3]);
        let color = surface(&mesh, 0, DVec3::new(0.5, 0.25, 0.25));
        assert_eq!(color, vec3(0.5, 0.25, 0.25));
    }

    #[test]
    fn gradient_is_linear_in_height() {
        let gradient = Background::Gradient {
            zenith: Vec3::X,
            horizon: Vec3::Y,
            nadir: Vec3::Z,
        };
        assert_eq!(background(&gradient, DVec3::Y), Vec3::X);
        assert_eq!(background(&gradient, DVec3::X), Vec3::Y);
        assert_eq!(background(&gradient, DVec3::NEG_Y), Vec3::Z);
        let half = background(&gradient, DVec3::new(0.75f64.sqrt(), 0.5, 0.0));
        assert_eq!(half, (Vec3::X + Vec3::Y) / 2.0);
    }
}

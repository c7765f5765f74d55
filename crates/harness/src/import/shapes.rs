//! Shapes of other renderers: spheres, boxes and disks under any affine map.

use std::f64::consts::{PI, TAU};

use catoptric_scene::model::Triangles;
use glam::{DMat3, DMat4, DVec3, Vec2};

use super::found::Form;

/// Segments around a sphere or disk that becomes triangles.
pub const SEGMENTS: u32 = 128;

/// The image of a sphere: a sphere or an ellipsoid.
pub fn sphere(center: DVec3, radius: f64, matrix: &DMat4) -> Form {
    let axes = DMat3::from_mat4(*matrix) * radius;
    let center = matrix.transform_point3(center);
    let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
    let lengths = columns.map(DVec3::length);
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.max(b);
    let skew = |a: DVec3, b: DVec3| a.dot(b).abs() > 1e-12 * a.length() * b.length();
    let [x, y, z] = columns;
    let is_round = same(lengths[0], lengths[1])
        && same(lengths[1], lengths[2])
        && !(skew(x, y) || skew(y, z) || skew(z, x));
    match is_round {
        true => Form::Sphere {
            center,
            radius: lengths[0],
        },
        false => Form::Ellipsoid { center, axes },
    }
}

/// The image of [−1, 1]² in the xy plane; as triangles where it is no rectangle any more.
pub fn rectangle(matrix: &DMat4) -> Form {
    let linear = DMat3::from_mat4(*matrix);
    let (x, y) = (linear.x_axis, linear.y_axis);
    let normal = (linear.inverse().transpose() * DVec3::Z).normalize_or_zero();
    match x.dot(y).abs() <= 1e-12 * x.length() * y.length() {
        true => Form::Rectangle {
            center: matrix.transform_point3(DVec3::ZERO),
            axes: DMat3::from_cols(x, y, normal),
        },
        false => mesh(square(), matrix),
    }
}

/// Triangles under a map.
pub fn mesh(mut triangles: Triangles, matrix: &DMat4) -> Form {
    triangles.transform(matrix);
    Form::Mesh {
        mesh: triangles,
        flat: true,
    }
}

/// [−1, 1]² in the xy plane, facing +z, with texture coordinates from 0 to 1.
pub fn square() -> Triangles {
    let mut square = Triangles::default();
    quad(
        &mut square,
        [
            -DVec3::X - DVec3::Y,
            DVec3::X - DVec3::Y,
            DVec3::X + DVec3::Y,
            DVec3::Y - DVec3::X,
        ],
    );
    square
}

/// Adds four corners, counter-clockwise from outside, with texture coordinates from 0 to 1.
fn quad(into: &mut Triangles, corners: [DVec3; 4]) {
    let first = into.positions.len() as u32;
    into.positions.extend(corners);
    let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    for three in [[0, 1, 2], [0, 2, 3]] {
        into.triangles.push(three.map(|corner| first + corner));
        into.uvs.push(three.map(|corner| uvs[corner as usize]));
    }
}

/// [−1, 1]³.
pub fn cube() -> Triangles {
    let mut cube = Triangles::default();
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    for (right, up, out) in [
        (x, y, z),
        (-x, y, -z),
        (y, z, x),
        (z, y, -x),
        (z, x, y),
        (x, z, -y),
    ] {
        let corner = |a: f64, b: f64| out + a * right + b * up;
        let corners = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        quad(&mut cube, corners);
    }
    cube
}

/// The unit disk in the xy plane, facing +z.
pub fn disk() -> Triangles {
    let mut disk = Triangles::default();
    disk.positions.push(DVec3::ZERO);
    let around = (0..SEGMENTS).map(|step| TAU * f64::from(step) / f64::from(SEGMENTS));
    let around = around.map(|angle| DVec3::new(angle.cos(), angle.sin(), 0.0));
    disk.positions.extend(around);
    disk.triangles
        .extend((0..SEGMENTS).map(|step| [0, 1 + step, 1 + (step + 1) % SEGMENTS]));
    disk
}

/// The unit sphere in triangles with its normals; `inside` turned over.
pub fn ball(inside: bool) -> Triangles {
    let (around, rings) = (SEGMENTS, SEGMENTS / 2);
    let mut ball = Triangles::default();
    let point = |ring: u32, step: u32| {
        let (polar, turn) = (
            PI * f64::from(ring) / f64::from(rings),
            TAU * f64::from(step % around) / f64::from(around),
        );
        DVec3::new(
            polar.sin() * turn.cos(),
            polar.sin() * turn.sin(),
            polar.cos(),
        )
    };
    ball.positions.push(DVec3::Z);
    for ring in 1..rings {
        ball.positions
            .extend((0..around).map(|step| point(ring, step)));
    }
    ball.positions.push(-DVec3::Z);
    let last = ball.positions.len() as u32 - 1;
    let index = |ring: u32, step: u32| match ring {
        0 => 0,
        ring if ring == rings => last,
        ring => 1 + (ring - 1) * around + step % around,
    };
    for ring in 0..rings {
        for step in 0..around {
            let [a, b, c, d] = [
                (ring, step),
                (ring + 1, step),
                (ring + 1, step + 1),
                (ring, step + 1),
            ]
            .map(|(ring, step)| index(ring, step));
            if ring + 1 < rings {
                ball.triangles.push([a, b, c]);
            }
            if ring > 0 {
                ball.triangles.push([a, c, d]);
            }
        }
    }
    let normal = |index: u32| ball.positions[index as usize];
    ball.normals = ball
        .triangles
        .iter()
        .map(|three| three.map(normal))
        .collect();
    if inside {
        ball.turn_over();
        for normal in ball.normals.as_flattened_mut() {
            *normal = -*normal;
        }
    }
    ball
}

/// Half axes of an ellipsoid and the rotation that turns x, y and z into their directions.
pub fn half_axes(axes: DMat3) -> (DVec3, DMat3) {
    let columns = [axes.x_axis, axes.y_axis, axes.z_axis];
    let skew = |a: DVec3, b: DVec3| a.dot(b).abs() > 1e-12 * a.length() * b.length();
    let [x, y, z] = columns;
    let (radii, mut turn) = match skew(x, y) || skew(y, z) || skew(z, x) {
        false => {
            let radii = DVec3::from(columns.map(DVec3::length));
            (
                radii,
                DMat3::from_cols(x / radii.x, y / radii.y, z / radii.z),
            )
        }
        true => {
            let (squares, turn) = symmetric(axes * axes.transpose());
            (squares.max(DVec3::ZERO).map(f64::sqrt), turn)
        }
    };
    if turn.determinant() < 0.0 {
        turn.z_axis = -turn.z_axis;
    }
    (radii, turn)
}

/// Eigenvalues and eigenvectors of a symmetric matrix (Jacobi's rotations).
fn symmetric(mut matrix: DMat3) -> (DVec3, DMat3) {
    let mut vectors = DMat3::IDENTITY;
    for _ in 0..24 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = matrix.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let angle = 0.5 * (2.0 * off).atan2(matrix.col(q)[q] - matrix.col(p)[p]);
            let (sin, cos) = angle.sin_cos();
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cos;
            turn.col_mut(q)[q] = cos;
            turn.col_mut(q)[p] = sin;
            turn.col_mut(p)[q] = -sin;
            matrix = turn.transpose() * matrix * turn;
            vectors *= turn;
        }
    }
    let values = DVec3::new(matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.z);
    (values, vectors)
}

/// Angles of a rotation Rz·Ry·Rx about x, y and z, degrees.
pub fn angles(turn: DMat3) -> DVec3 {
    let down = -turn.x_axis.z;
    let y = down.clamp(-1.0, 1.0).asin();
    let (x, z) = match down.abs() < 1.0 - 1e-12 {
        true => (
            turn.y_axis.z.atan2(turn.z_axis.z),
            turn.x_axis.y.atan2(turn.x_axis.x),
        ),
        // Looking along z, x and z turn about one axis.
        false => ((-turn.z_axis.y).atan2(turn.y_axis.y), 0.0),
    };
    DVec3::new(x, y, z).map(f64::to_degrees)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(mesh: &Triangles) -> f64 {
        let signed = |three: &[u32; 3]| {
            let [a, b, c] = three.map(|index| mesh.positions[index as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        mesh.triangles.iter().map(signed).sum()
    }

    #[test]
    fn shapes_face_outwards() {
        assert!((volume(&cube()) - 8.0).abs() < 1e-12);
        let sphere = volume(&ball(false));
        assert!(
            (sphere / (4.0 / 3.0 * PI) - 1.0).abs() < 2e-3 && sphere > 0.0,
            "{sphere}"
        );
        assert!((volume(&ball(true)) + sphere).abs() < 1e-9);
        let mut mirrored = cube();
        mirrored.transform(&DMat4::from_scale(DVec3::new(-1.0, 1.0, 2.0)));
        assert!((volume(&mirrored) - 16.0).abs() < 1e-12);
        let up = disk();
        let [a, b, c] = up.triangles[7].map(|index| up.positions[index as usize]);
        assert!((b - a).cross(c - a).z > 0.0);
    }

    #[test]
    fn a_rotation_is_the_product_of_its_angles() {
        for degrees in [
            [10.0, 20.0, 30.0],
            [-170.0, 80.0, 5.0],
            [0.0, 90.0, 0.0],
            [33.0, -90.0, 0.0],
        ] {
            let [x, y, z] = degrees.map(f64::to_radians);
            let turn =
                DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
            let [x, y, z] = angles(turn).to_array().map(f64::to_radians);
            let again =
                DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x);
            assert!(again.abs_diff_eq(turn, 1e-7), "{degrees:?}");
        }
    }

    #[test]
    fn a_sheared_sphere_is_an_ellipsoid() {
        let axes = DMat3::from_cols_array(&[2.0, 0.3, 0.0, 0.5, 1.0, 0.2, 0.0, 0.0, 0.7]);
        let (radii, turn) = half_axes(axes);
        let again = turn * DMat3::from_diagonal(radii);
        let square = |m: DMat3| m * m.transpose();
        assert!(square(again).abs_diff_eq(square(axes), 1e-12));
        assert!((turn.determinant() - 1.0).abs() < 1e-12);
        assert!(
            matches!(sphere(DVec3::X, 2.0, &DMat4::from_scale(DVec3::splat(3.0))),
            Form::Sphere { radius, .. } if radius == 6.0)
        );
    }
}

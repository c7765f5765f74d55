//! Cameras of other renderers as ours.

use catoptric_scene::Fov;
use glam::{DMat4, DVec3};

use super::found::{Form, Thing, View};

/// Which angle a number is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
    /// Of the shorter side.
    Smaller,
    /// Of the longer side.
    Larger,
    /// From corner to corner.
    Diagonal,
}

/// A full angle in degrees across an axis of a picture of this size.
pub fn fov(degrees: f64, axis: Axis, [width, height]: [f64; 2]) -> Fov {
    match axis {
        Axis::X => Fov::X(degrees),
        Axis::Y => Fov::Y(degrees),
        Axis::Smaller if width < height => Fov::X(degrees),
        Axis::Smaller => Fov::Y(degrees),
        Axis::Larger if width > height => Fov::X(degrees),
        Axis::Larger => Fov::Y(degrees),
        Axis::Diagonal => {
            let tangent = (degrees.to_radians() / 2.0).tan() * width / width.hypot(height);
            Fov::X(2.0 * tangent.atan().to_degrees())
        }
    }
}

/// The camera of a matrix, world from camera, which looks along +z with +y up; and whether it shows the
/// picture mirrored, which ours cannot.
pub fn looking_along_z(matrix: &DMat4) -> Option<(DVec3, DVec3, DVec3, bool)> {
    let eye = matrix.transform_point3(DVec3::ZERO);
    let forward = matrix.transform_vector3(DVec3::Z).try_normalize()?;
    let up = matrix.transform_vector3(DVec3::Y).try_normalize()?;
    let right = forward.cross(up);
    // Mitsuba's and ours agree where the camera's own x points to the left.
    let mirrored = matrix.transform_vector3(DVec3::X).dot(right) > 0.0;
    let all_finite = eye.is_finite() && forward.is_finite() && up.is_finite();
    all_finite.then_some((eye, forward, up, mirrored))
}

/// A camera that has all things in view.
pub fn around(things: &[Thing]) -> View {
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    let mut add = |point: DVec3| {
        low = low.min(point);
        high = high.max(point);
    };
    for thing in things {
        match &thing.form {
            Form::Mesh { mesh, .. } => mesh.positions.iter().copied().for_each(&mut add),
            Form::Sphere { center, radius } => {
                add(*center - DVec3::splat(*radius));
                add(*center + DVec3::splat(*radius));
            }
            Form::Ellipsoid { center, axes } => {
                let reach = axes.x_axis.abs() + axes.y_axis.abs() + axes.z_axis.abs();
                add(*center - reach);
                add(*center + reach);
            }
            Form::Rectangle { center, axes } => {
                let reach = axes.x_axis.abs() + axes.y_axis.abs();
                add(*center - reach);
                add(*center + reach);
            }
        }
    }
    let target = (low + high) / 2.0;
    let reach = ((high - low).length() / 2.0).max(1e-3);
    let direction = DVec3::new(0.45, 0.35, 1.0).normalize();
    let distance = reach / (FOV_Y / 2.0).to_radians().sin() * 1.05;
    View {
        eye: target + distance * direction,
        target,
        up: DVec3::Y,
        fov: Fov::Y(FOV_Y),
        resolution: None,
    }
}

/// Vertical angle of a camera of ours, degrees.
const FOV_Y: f64 = 40.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_of_other_axes() {
        let wide = [4.0, 3.0];
        assert_eq!(fov(50.0, Axis::Smaller, wide), Fov::Y(50.0));
        assert_eq!(fov(50.0, Axis::Larger, wide), Fov::X(50.0));
        let Fov::X(diagonal) = fov(90.0, Axis::Diagonal, wide) else {
            panic!("an angle across");
        };
        assert!((diagonal - 2.0 * 0.8_f64.atan().to_degrees()).abs() < 1e-12);
    }
}

//! A mirror's shape and place, as shaders read them.

use catoptric_scene::Shape;
use encase::ShaderType;
use glam::{DVec2, DVec3, Vec3};

/// Twin of `shared/mirror.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MirrorUniform {
    pub center: Vec3,
    pub shape: u32,
    pub eye: Vec3,
    pub id: u32,
    pub axis_x: Vec3,
    pub cos_half_angle: f32,
    pub axis_y: Vec3,
    pub curvature_x: f32,
    pub axis_z: Vec3,
    pub curvature_y: f32,
    pub radii: Vec3,
}

impl MirrorUniform {
    /// `eye` in world space.
    pub(crate) fn new(shape: &Shape, id: u32, eye: DVec3) -> Self {
        let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut curvature = DVec2::ZERO;
        let (kind, radii, cos_half_angle) = match shape {
            Shape::Sphere { radius, .. } => (0, DVec3::splat(*radius), 0.0),
            Shape::Ellipsoid {
                radii, rotation, ..
            } => {
                axes = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
                (0, *radii, 0.0)
            }
            Shape::Bowl {
                radius,
                axis,
                half_angle,
                ..
            } => {
                let x = axis.any_orthonormal_vector();
                axes = [x, axis.cross(x), *axis];
                (1, DVec3::splat(*radius), half_angle.cos())
            }
            Shape::Plane {
                normal, up, size, ..
            } => {
                axes = [up.cross(*normal), *up, *normal];
                (2, DVec3::new(size.x / 2.0, size.y / 2.0, 1.0), 0.0)
            }
            Shape::Torus {
                axis, major, minor, ..
            } => {
                let x = axis.any_orthonormal_vector();
                axes = [x, axis.cross(x), *axis];
                (3, DVec3::new(*major, *minor, 1.0), 0.0)
            }
            Shape::Saddle {
                normal,
                up,
                size,
                curvature: bend,
                ..
            } => {
                axes = [up.cross(*normal), *up, *normal];
                curvature = *bend;
                (4, DVec3::new(size.x / 2.0, size.y / 2.0, 1.0), 0.0)
            }
            Shape::Mesh(_) => (0, DVec3::ONE, 0.0),
        };
        let center = shape.center();
        Self {
            center: center.as_vec3(),
            shape: kind,
            eye: (eye - center).as_vec3(),
            id,
            axis_x: axes[0].as_vec3(),
            cos_half_angle: cos_half_angle as f32,
            axis_y: axes[1].as_vec3(),
            curvature_x: curvature.x as f32,
            axis_z: axes[2].as_vec3(),
            curvature_y: curvature.y as f32,
            radii: radii.as_vec3(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::assert_layout;

    #[test]
    fn the_uniform_lies_as_the_shaders_read_it() {
        assert_layout!(
            MirrorUniform {
                center,
                shape,
                eye,
                id,
                axis_x,
                cos_half_angle,
                axis_y,
                curvature_x,
                axis_z,
                curvature_y,
                radii
            },
            "gbuffer",
            &[],
            "Mirror"
        );
    }
}

//! A mirror's shape and place, as shaders read them.

use catoptric_scene::MirrorShape;
use catoptric_scene::shape::ShaderInput;
use encase::ShaderType;
use glam::{DMat3, DVec3, Vec3, Vec4};

use crate::gpu::shaders;

/// Folder of the shader functions of mirror shapes, one module each.
const SHAPES: &str = "shared/shape";

/// Twin of `shared/mirror.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MirrorUniform {
    pub center: Vec3,
    pub shape: u32,
    pub eye: Vec3,
    pub id: u32,
    pub axis_x: Vec3,
    pub more_x: f32,
    pub axis_y: Vec3,
    pub more_y: f32,
    pub axis_z: Vec3,
    pub more_z: f32,
    pub sizes: Vec3,
    pub beyond: Vec4,
}

impl MirrorUniform {
    /// `eye` in world space. A mesh has no shader function: rays meet its triangles.
    ///
    /// # Panics
    /// Where the shape's shader function is not in its folder: a bug.
    pub(crate) fn new(shape: &dyn MirrorShape, id: u32, eye: DVec3) -> Self {
        let center = shape.center();
        let input = shape.shader_input();
        let number = input.map_or(u32::MAX, |input| {
            shaders::number_in(SHAPES, input.module)
                .unwrap_or_else(|| panic!("no shader {SHAPES}/{}.wesl", input.module))
        });
        let input = input.unwrap_or(ShaderInput {
            module: "",
            axes: DMat3::IDENTITY,
            sizes: DVec3::ONE,
            more: DVec3::ZERO,
            beyond: None,
        });
        let beyond = input.beyond.map_or(Vec4::ZERO, |(sizes, more)| {
            sizes.as_vec3().extend(more as f32)
        });
        let (axes, more) = (input.axes, input.more.as_vec3());
        Self {
            center: center.as_vec3(),
            shape: number,
            eye: (eye - center).as_vec3(),
            id,
            axis_x: axes.x_axis.as_vec3(),
            more_x: more.x,
            axis_y: axes.y_axis.as_vec3(),
            more_y: more.y,
            axis_z: axes.z_axis.as_vec3(),
            more_z: more.z,
            sizes: input.sizes.as_vec3(),
            beyond,
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
                more_x,
                axis_y,
                more_y,
                axis_z,
                more_z,
                sizes,
                beyond
            },
            "stage/gbuffer",
            &[],
            "Mirror"
        );
    }
}

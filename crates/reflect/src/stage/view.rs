//! The eye and the background, as every pass reads them.

use catoptric_scene::{Background, Scene, View};
use encase::ShaderType;
use glam::{UVec2, Vec3};

use super::extent::diagonal;
use super::options::Under;

/// Twin of `shared/view.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct ViewUniform {
    pub eye: Vec3,
    pub near: f32,
    pub right: Vec3,
    pub tan_x: f32,
    pub up: Vec3,
    pub tan_y: f32,
    pub forward: Vec3,
    pub depth_range: f32,
    pub size: UVec2,
    pub background_kind: u32,
    pub under: u32,
    pub zenith: Vec3,
    pub horizon: Vec3,
    pub nadir: Vec3,
}

/// Distance along the optical axis before which nothing is drawn, world units.
const NEAR: f32 = 1e-3;

impl ViewUniform {
    /// The scene's camera.
    pub(crate) fn new(scene: &Scene, size: [u32; 2], under: Under) -> Self {
        Self {
            under: under as u32,
            ..Self::from_view(scene, &scene.camera.view(size))
        }
    }

    /// Any view of the scene, such as from behind a flat mirror or out of a cube map.
    pub(crate) fn from_view(scene: &Scene, view: &View) -> Self {
        let (background_kind, zenith, horizon, nadir) = match scene.background {
            Background::Color(color) => (0, color, color, color),
            Background::Gradient {
                zenith,
                horizon,
                nadir,
            } => (1, zenith, horizon, nadir),
        };
        Self {
            eye: view.eye.as_vec3(),
            near: NEAR,
            right: view.right.as_vec3(),
            tan_x: view.tan.x as f32,
            up: view.up.as_vec3(),
            tan_y: view.tan.y as f32,
            forward: view.forward.as_vec3(),
            depth_range: diagonal(scene),
            size: UVec2::from_array(view.size),
            background_kind,
            under: 0,
            zenith,
            horizon,
            nadir,
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
            ViewUniform {
                eye,
                near,
                right,
                tan_x,
                up,
                tan_y,
                forward,
                depth_range,
                size,
                background_kind,
                under,
                zenith,
                horizon,
                nadir
            },
            "stage/composite",
            &[],
            "View"
        );
    }
}

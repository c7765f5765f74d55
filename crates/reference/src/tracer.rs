//! Single rays through a scene.

use catoptric_scene::Scene;
use glam::{DVec3, Vec3};

use crate::error::ReferenceError;

/// A scene made ready for rays.
#[derive(Debug)]
pub struct Tracer {
    scene: Scene,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// As in every id layer.
    pub id: u32,
    /// Distance along the (unit) ray.
    pub t: f64,
    /// World-space point.
    pub position: DVec3,
    /// Unit normal: a mirror's on its reflecting side (of a mesh the interpolated shading
    /// normal), an object's geometric one turned towards the ray's origin.
    pub normal: DVec3,
    /// Unit normal of the surface itself: of a mesh mirror that of the triangle, on the side the
    /// shading normal is on; else equal to `normal`.
    pub geometric: DVec3,
    /// What was met.
    pub surface: Surface,
}

/// What a ray has met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// A triangle of an object.
    Object {
        /// Index into the scene's objects.
        index: usize,
        /// Index into the object's triangles.
        triangle: usize,
        /// Weights of the triangle's corners, summing to 1.
        barycentric: DVec3,
    },
    /// A mirror.
    Mirror {
        /// Index into the scene's mirrors.
        index: usize,
        /// True on the reflecting side.
        front: bool,
    },
}

impl Tracer {
    /// Checks the scene and builds the hierarchies.
    pub fn new(scene: &Scene) -> Result<Self, ReferenceError> {
        Ok(Self { scene: scene.clone() })
    }

    /// The scene traced.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Nearest object or mirror along the ray (`dir` of unit length).
    pub fn trace(&self, origin: DVec3, dir: DVec3) -> Option<Hit> {
        todo!("{origin} {dir}")
    }

    /// Nearest object along the ray; mirrors are not seen.
    pub fn trace_objects(&self, origin: DVec3, dir: DVec3) -> Option<Hit> {
        todo!("{origin} {dir}")
    }

    /// Colour of an object's surface at a hit; black for mirrors.
    pub fn color(&self, hit: &Hit) -> Vec3 {
        todo!("{hit:?}")
    }

    /// Colour of a ray that meets nothing.
    pub fn background(&self, dir: DVec3) -> Vec3 {
        todo!("{dir}")
    }
}

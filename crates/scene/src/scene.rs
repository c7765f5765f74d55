//! A scene and what it is made of.

use glam::Vec3;

use crate::camera::Camera;
use crate::mesh::Mesh;
use crate::mirror::Mirror;
use crate::motion::Motion;

/// Everything a picture shows, in world space.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The built-in name, or the file's stem.
    pub name: String,
    /// What the scene is for, in a sentence.
    pub why: String,
    /// The eye.
    pub camera: Camera,
    /// What rays see that hit nothing.
    pub background: Background,
    /// The surfaces that are not mirrors, in file order; object `i` has id `1 + i`.
    pub objects: Vec<Object>,
    /// The mirrors, in file order; mirror `i` has id `1 + objects.len() + i`.
    pub mirrors: Vec<Mirror>,
    /// How all this changes over a sequence of frames, of which it is the first.
    pub motion: Option<Motion>,
    /// SHA-256 (hex) of all that influences the picture: geometry, colours, camera. Motion does
    /// not: each frame that [`Scene::at`] gives has a hash of its own.
    pub hash: String,
    /// What is odd in the files that it was loaded from, though nothing keeps it from loading: one
    /// line each, with file and line.
    pub warnings: Vec<String>,
}

impl Scene {
    /// Id of object `index` in every id layer. Id 0 is the background.
    pub fn object_id(&self, index: usize) -> u32 {
        1 + index as u32
    }

    /// Id of mirror `index` in every id layer.
    pub fn mirror_id(&self, index: usize) -> u32 {
        (1 + self.objects.len() + index) as u32
    }

    /// `(id, name, is_mirror)` of everything, objects first, ids ascending from 1.
    pub fn ids(&self) -> Vec<(u32, String, bool)> {
        let objects = self
            .objects
            .iter()
            .map(|object| (object.name.clone(), false));
        let mirrors = self
            .mirrors
            .iter()
            .map(|mirror| (mirror.name.clone(), true));
        objects
            .chain(mirrors)
            .zip(1..)
            .map(|((name, is_mirror), id)| (id, name, is_mirror))
            .collect()
    }

    /// Unique vertex positions of all objects: what a search has to find reflections of.
    pub fn vertex_count(&self) -> usize {
        self.objects
            .iter()
            .map(|object| object.mesh.positions.len())
            .sum()
    }

    /// Triangles of all objects, mirrors not counted.
    pub fn triangle_count(&self) -> usize {
        self.objects
            .iter()
            .map(|object| object.mesh.triangles.len())
            .sum()
    }
}

/// A named surface that is not a mirror. Two-sided and unlit: it shows its own colour.
#[derive(Clone, Debug)]
pub struct Object {
    /// Unique within the scene.
    pub name: String,
    /// World-space geometry; may have vertices and no triangles (`shape = "points"`).
    pub mesh: Mesh,
}

/// The colour of a ray that hits nothing, by its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One linear RGB colour.
    Color(Vec3),
    /// Blended by the direction's height `y`: `horizon` at 0, `zenith` at +1, `nadir` at −1,
    /// linear in `y` between (unit directions).
    Gradient {
        /// Colour straight up.
        zenith: Vec3,
        /// Colour at eye level.
        horizon: Vec3,
        /// Colour straight down.
        nadir: Vec3,
    },
}

//! What is looked at: camera, background, objects and mirrors.
//!
//! A [`Scene`] is complete and in world space: meshes are loaded, transforms applied, identical
//! positions merged, names and ids settled. It renders nothing; both renderers (the reference and
//! the GPU techniques) read it and share nothing else.
//!
//! A scene may move ([`Motion`]): [`Scene::at`] gives it as it stands at a frame. Whoever shows a
//! single picture shows the scene as it is, which is frame 0. In a scene file:
//!
//! ```toml
//! [motion]
//! frames = 40                            # 2 or more; the first shows the scene as written
//! camera = { orbit_deg = 30.0 }          # by the last frame: the eye around the target, about `up`
//! # or, evenly spaced in time after where [camera] has them, along a spline:
//! # camera = { eye = [[1.0, 0.5, 4.0], [2.0, 0.5, 3.0]], target = [[0.0, 0.2, 0.0]] }
//!
//! [[motion.move]]                        # any number, each for another object or mirror
//! name = "ring"
//! rotate_deg = [0.0, 180.0, 0.0]         # by the last frame, evenly; x, then y, then z
//! about = [1.0, 0.0, 0.5]                # default: middle of its box, of a mirror its centre
//! translate = [0.0, 0.0, 1.0]            # by the last frame, evenly
//! ```
//!
//! Spaces and units: right-handed, +y up, metres if anything; angles in degrees in files and in
//! radians in code unless a name says `_deg`; colours linear RGB.

pub mod builtin;
pub mod camera;
mod coincident;
mod document;
mod error;
mod file;
mod geometry;
mod hash;
mod load;
mod loading;
pub mod mesh;
pub mod mirror;
pub mod motion;
mod mtl;
mod obj;
mod picture;
mod pose;
mod primitives;
mod random;
pub mod shape;
mod suggest;
mod text;
mod texture;

pub use camera::{Camera, Fov, View};
pub use coincident::first_of_coincident;
pub use error::SceneError;
pub use load::{LoadOptions, open};
pub use mesh::{Material, Mesh, Paint};
pub use mirror::Mirror;
pub use motion::{CameraPath, Motion, Move, Subject};
pub use pose::Pose;
pub use random::Random;
pub use shape::{MirrorShape, Shape, SurfaceHit};
pub use suggest::suggest;
pub use texture::{Samples, Texture};

use glam::Vec3;

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
    /// Loads a built-in scene by its name, or a scene file by its path; the same as [`open`].
    pub fn load(name_or_path: &str, options: &LoadOptions) -> Result<Self, SceneError> {
        open(name_or_path, options)
    }

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

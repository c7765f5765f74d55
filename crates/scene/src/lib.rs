//! What is looked at: camera, background, objects and mirrors.
//!
//! A [`Scene`] is complete and in world space: meshes are loaded, transforms applied, identical
//! positions merged, names and ids settled. It renders nothing; both renderers (the reference and
//! the GPU techniques) read it and share nothing else.
//!
//! A scene may move ([`Motion`]): [`Scene::at`] gives it as it stands at a frame. A single picture
//! shows the scene as it is, which is frame 0. In a scene file:
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

mod at;
pub mod builtin;
pub mod camera;
mod coincident;
mod document;
mod error;
mod file;
mod geometry;
mod hash;
pub mod list;
mod load;
mod load_options;
mod loading;
pub mod mesh;
pub mod mirror;
pub mod model;
pub mod motion;
mod mtl;
mod obj;
mod picture;
mod pose;
mod primitives;
mod random;
mod scene;
pub mod shape;
mod suggest;
mod text;
mod texture;

pub use camera::{Camera, Fov, View};
pub use coincident::first_of_coincident;
pub use error::SceneError;
pub use load::open;
pub use load_options::LoadOptions;
pub use mesh::{Material, Mesh, Paint};
pub use mirror::Mirror;
pub use motion::{CameraPath, Motion, Move, Subject};
pub use picture::linear_from_srgb;
pub use pose::Pose;
pub use random::Random;
pub use scene::{Background, Object, Scene};
pub use shape::{MirrorShape, Shape, SurfaceHit};
pub use suggest::suggest;
pub use texture::{Samples, Texture};

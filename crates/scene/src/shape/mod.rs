//! The shapes a mirror can have, one file each.
//!
//! A shape is a type that answers [`MirrorShape`], with a function `read` for its keys in a scene
//! file, and a line in the list of `shapes!` below. The GPU's half of it is a shader function; what
//! else is known of a shape (its exact reflection points, how another renderer is told of it) is
//! asked of it or added where it is needed.

mod bowl;
mod ellipsoid;
mod enclosure;
mod keys;
mod mesh;
mod mirror_shape;
mod plane;
mod polynomial;
mod proxy;
mod saddle;
mod sphere;
mod torus;
mod unit_sphere;

use std::ops::{Deref, DerefMut};

pub use self::bowl::Bowl;
pub use self::ellipsoid::Ellipsoid;
pub(crate) use self::enclosure::Enclosure;
pub use self::mirror_shape::{Facing, MirrorShape, Primitive, ShaderInput, SurfaceHit};
pub use self::plane::Plane;
pub use self::saddle::Saddle;
pub use self::sphere::Sphere;
pub use self::torus::Torus;
use crate::SceneError;
use crate::document::Table;
use crate::mesh::Mesh;

/// From `name in scene files => type`: the enum of all shapes, meshes among them.
macro_rules! shapes {
    ($($name:literal => $Shape:ident),* $(,)?) => {
        /// A mirror's shape. What it is like is asked through [`MirrorShape`], which it answers by
        /// dereferencing; a `match` is for what only one shape has.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Shape {
            $(
                #[doc = concat!("`shape = \"", $name, "\"` in scene files.")]
                $Shape($Shape),
            )*
            /// Triangles with shading normals (never empty), reflecting where the normals point.
            Mesh(Mesh),
        }

        /// Names of the shapes that are known exactly, as scene files have them.
        pub(crate) const EXACT: &[&str] = &[$($name),*];

        /// Reads an exact shape; `None` if there is none of that name.
        pub(crate) fn read(name: &str, table: &Table<'_>) -> Option<Result<Shape, SceneError>> {
            match name {
                $($name => Some($Shape::read(table).map(Shape::from)),)*
                _ => None,
            }
        }

        impl Shape {
            /// Its name, as scene files and hashes have it.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$Shape(_) => $name,)*
                    Self::Mesh(_) => "mesh",
                }
            }
        }

        impl Deref for Shape {
            type Target = dyn MirrorShape;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$Shape(shape) => shape,)*
                    Self::Mesh(mesh) => mesh,
                }
            }
        }

        impl DerefMut for Shape {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(Self::$Shape(shape) => shape,)*
                    Self::Mesh(mesh) => mesh,
                }
            }
        }

        $(
            impl From<$Shape> for Shape {
                fn from(shape: $Shape) -> Self {
                    Self::$Shape(shape)
                }
            }
        )*

        impl From<Mesh> for Shape {
            fn from(mesh: Mesh) -> Self {
                Self::Mesh(mesh)
            }
        }
    };
}

shapes! {
    "sphere" => Sphere,
    "ellipsoid" => Ellipsoid,
    "plane" => Plane,
    "bowl" => Bowl,
    "torus" => Torus,
    "saddle" => Saddle,
}

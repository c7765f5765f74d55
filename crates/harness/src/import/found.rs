//! What is found in a file from elsewhere, in world space and in our terms.

use catoptric_scene::model::{PictureSource, Triangles};
use catoptric_scene::{Background, Fov};
use glam::{DMat3, DVec3, Vec3};

/// What the user may choose.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Metals that are rougher than this are no mirrors.
    pub roughness: f64,
    /// Names of things or of materials that are mirrors, whatever they are made of.
    pub mirrors: Vec<String>,
}

/// What was found in a file.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Where one looks from; the first camera of the file.
    pub camera: Option<View>,
    /// What rays see that hit nothing.
    pub background: Option<Background>,
    /// Objects and mirrors, in the file's order.
    pub things: Vec<Thing>,
    /// What is left out or not quite the same, a sentence each, with its name.
    pub left_out: Vec<String>,
}

/// A place to look from.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Where it stands, world space.
    pub eye: DVec3,
    /// A point on the optical axis, world space.
    pub target: DVec3,
    /// Roughly up, world space.
    pub up: DVec3,
    /// Full angle, degrees.
    pub fov: Fov,
    /// Width and height in pixels, where they are said.
    pub resolution: Option<[u32; 2]>,
}

/// A surface.
#[derive(Clone, Debug)]
pub struct Thing {
    /// As the file calls it, or by its number.
    pub name: String,
    /// Its material's name; may be empty.
    pub material: String,
    /// Whether its material makes it a mirror.
    pub is_mirror: bool,
    /// Where it is.
    pub form: Form,
    /// Its colour.
    pub coat: Coat,
    /// Parts of one object share it.
    pub group: Option<String>,
}

/// Where a surface is, in world space.
#[derive(Clone, Debug)]
pub enum Form {
    /// Triangles.
    Mesh {
        /// In world space.
        mesh: Triangles,
        /// Each triangle has its own flat normal, where the mesh has none.
        flat: bool,
    },
    /// A whole sphere, seen from outside.
    Sphere {
        /// Its middle.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// The image of the unit sphere.
    Ellipsoid {
        /// Its middle.
        center: DVec3,
        /// World from the unit sphere's space.
        axes: DMat3,
    },
    /// The image of [−1, 1]² in the xy plane.
    Rectangle {
        /// Its middle.
        center: DVec3,
        /// Half its width, half its height, its unit normal.
        axes: DMat3,
    },
}

/// The colour of a surface.
#[derive(Clone, Debug, PartialEq)]
pub enum Coat {
    /// Linear RGB.
    Color(Vec3),
    /// The mesh's vertex colours.
    Vertex,
    /// Two colours in cells.
    Checker {
        /// Of the even cells.
        a: Vec3,
        /// Of the odd ones.
        b: Vec3,
        /// Along each of u and v in [0, 1].
        cells: u32,
    },
    /// A picture as it is stored.
    Picture {
        /// Linear RGB factor.
        tint: Vec3,
        /// Where it is.
        source: PictureSource,
    },
    /// A linear picture, rows from the top.
    Texels {
        /// Width and height.
        size: [u32; 2],
        /// Linear RGB.
        texels: Vec<Vec3>,
    },
}

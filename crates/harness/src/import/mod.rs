//! Scenes from elsewhere: glTF 2, Mitsuba 3's XML and PBRT's files, as a folder with a scene file of ours,
//! its meshes and textures.
//!
//! What cannot be said in our terms is left out and listed. A mirror is what a name is given for, or
//! what is made of a smooth metal or of glass.

mod cameras;
mod colors;
mod gltf;
mod mitsuba;
mod pbrt;
mod shapes;
mod sheets;
mod toml;
mod write;

use std::collections::HashSet;
use std::path::Path;

use catoptric_scene::model::{PictureSource, Triangles};
use catoptric_scene::{Background, Fov, suggest};
use glam::{DMat3, DVec3, Vec3};

use crate::exit::bad_input;

pub use write::write;

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
    /// Where it stands.
    pub eye: DVec3,
    /// A point on the optical axis.
    pub target: DVec3,
    /// Roughly up.
    pub up: DVec3,
    /// Full angle.
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

/// Kinds of files, by their endings.
const KINDS: &str = ".gltf or .glb (glTF 2), .xml (Mitsuba 3), .pbrt (PBRT)";

/// Reads a file of a kind that is known by its ending, and decides what is a mirror.
///
/// # Errors
/// Whatever is wrong with it, or a name that nothing has.
pub fn read(path: &Path, choice: &Choice) -> anyhow::Result<Found> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let mut found = match ending.to_ascii_lowercase().as_str() {
        "gltf" | "glb" => gltf::read(path, choice)?,
        "xml" => mitsuba::read(path, choice)?,
        "pbrt" => pbrt::read(path, choice)?,
        _ => {
            return Err(bad_input(format!(
                "{}: what kind of scene it is says its ending: {KINDS}",
                path.display()
            )));
        }
    };
    if found.things.is_empty() {
        return Err(bad_input(format!(
            "{}: no surface is left{}",
            path.display(),
            match found.left_out.first() {
                Some(what) => format!(": left out was {what}"),
                None => String::new(),
            }
        )));
    }
    name_all(&mut found.things);
    choose(&mut found.things, &choice.mirrors)?;
    Ok(found)
}

/// Gives each thing a name of its own. Parts of one object share theirs.
fn name_all(things: &mut [Thing]) {
    let mut known: HashSet<String> = HashSet::new();
    for number in 0..things.len() {
        let group = things[number].group.clone();
        let earlier = things[..number].iter();
        let sibling = earlier
            .rev()
            .find(|thing| group.is_some() && thing.group == group);
        if let Some(sibling) = sibling {
            things[number].name = sibling.name.clone();
            continue;
        }
        let plain = |c: char| if c.is_control() { ' ' } else { c };
        let name: String = things[number].name.chars().map(plain).collect();
        let name = match name.trim() {
            "" => format!("thing {}", number + 1),
            name => name.to_owned(),
        };
        let mut unique = name.clone();
        let mut count = 1;
        while !known.insert(unique.clone()) {
            count += 1;
            unique = format!("{name} {count}");
        }
        things[number].name = unique;
    }
}

/// Makes mirrors of what is called so, or made of what is called so.
fn choose(things: &mut [Thing], names: &[String]) -> anyhow::Result<()> {
    for name in names {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let mut any = false;
        for thing in things.iter_mut() {
            if is(&thing.name) || is(&thing.material) {
                thing.is_mirror = true;
                any = true;
            }
        }
        if !any {
            let mut known: Vec<&str> = Vec::new();
            for name in things
                .iter()
                .flat_map(|thing| [&thing.name, &thing.material])
            {
                if !name.is_empty() && !known.contains(&name.as_str()) {
                    known.push(name);
                }
            }
            let hint = suggest(name, known.iter().copied());
            known.truncate(MOST_NAMES);
            return Err(bad_input(format!(
                "--mirror {name}: nothing is called or made of it{hint}; there are: {}",
                known.join(", ")
            )));
        }
    }
    Ok(())
}

/// Most names in a message.
const MOST_NAMES: usize = 40;

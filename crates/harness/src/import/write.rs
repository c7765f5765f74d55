//! A folder with what was found: `scene.toml`, its meshes and textures.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::Context;
use catoptric_frame::{Image, png16};
use catoptric_scene::model::{PictureSource, Triangles};
use catoptric_scene::{Background, Fov};
use glam::{DMat4, Vec3};

use crate::exit::bad_input;
use crate::export::ply::Ply;
use crate::output::Bundle;

use super::found::{Coat, Form, Found, Thing};
use super::toml::{color, number, quoted, vector};
use super::{cameras, shapes};

/// The scene file.
pub const SCENE_FILE: &str = "scene.toml";
/// Folder of the meshes.
const MESHES: &str = "meshes";
/// Folder of the textures.
const TEXTURES: &str = "textures";

/// Picture size where a file says none.
const RESOLUTION: [u32; 2] = [640, 480];

/// Writes everything at once: an earlier import is kept until then. The answer is the path of
/// `scene.toml`, and what could not be written as it is.
///
/// # Errors
/// The folder has something in it already, or cannot be written into, or a picture cannot be copied.
pub fn write(found: &Found, from: &Path, folder: &Path) -> anyhow::Result<(PathBuf, Vec<String>)> {
    if folder.exists() {
        let entries = std::fs::read_dir(folder);
        let mut entries = entries.with_context(|| format!("cannot read {}", folder.display()))?;
        let ours = folder.join(SCENE_FILE).is_file();
        if entries.next().is_some() && !ours {
            return Err(bad_input(format!(
                "-o {}: there are other files in it: name another folder",
                folder.display()
            )));
        }
    }
    let (files, notes) = files(found, from)?;
    files.put(folder)?;
    Ok((folder.join(SCENE_FILE), notes))
}

/// All files, the scene last, and what could not be written as it is.
fn files(found: &Found, from: &Path) -> anyhow::Result<(Bundle, Vec<String>)> {
    let mut writer = Writer {
        bundle: Bundle::default(),
        text: String::new(),
        notes: Vec::new(),
        files: HashMap::new(),
        textures: 0,
    };
    writer.head(found, from);
    let objects = found.things.iter().filter(|thing| !thing.is_mirror);
    let mut groups: Vec<Vec<&Thing>> = Vec::new();
    for thing in objects {
        let known = groups.iter_mut().find(|group| {
            thing.group.is_some() && group.iter().any(|other| other.group == thing.group)
        });
        match known {
            Some(group) => group.push(thing),
            None => groups.push(vec![thing]),
        }
    }
    for (place, group) in groups.iter().enumerate() {
        writer.object(place, group)?;
    }
    let mirrors = found.things.iter().filter(|thing| thing.is_mirror);
    for (place, thing) in mirrors.enumerate() {
        writer.mirror(place, thing);
    }
    let mut files = writer.bundle;
    files.add(SCENE_FILE, writer.text.into_bytes());
    Ok((files, writer.notes))
}

struct Writer {
    bundle: Bundle,
    text: String,
    /// What is not as it was, a sentence each.
    notes: Vec<String>,
    /// Pictures that were added, by what they are.
    files: HashMap<Vec<u8>, String>,
    textures: usize,
}

impl Writer {
    fn line(&mut self, line: &str) {
        self.text += line;
        self.text.push('\n');
    }

    fn head(&mut self, found: &Found, from: &Path) {
        let name = from.file_name().unwrap_or_default().to_string_lossy();
        let why = format!("Imported from {name}.");
        self.line(&format!("why = {}", quoted(&why)));
        let view = match &found.camera {
            Some(view) => view.clone(),
            None => {
                self.notes
                    .push("there is no camera in it: one was placed around all".to_owned());
                cameras::around(&found.things)
            }
        };
        let [width, height] = view.resolution.unwrap_or(RESOLUTION);
        let (axis, degrees) = match view.fov {
            Fov::X(degrees) => ("x", degrees),
            Fov::Y(degrees) => ("y", degrees),
        };
        let _ = write!(
            self.text,
            "\n[camera]\neye = {}\ntarget = {}\nup = {}\nfov_{axis} = {}\nresolution = [{width}, {height}]\n",
            vector(view.eye),
            vector(view.target),
            vector(view.up),
            number(degrees),
        );
        match found.background {
            None => {}
            Some(Background::Color(one)) => {
                let _ = write!(self.text, "\n[background]\ncolor = {}\n", color(one));
            }
            Some(Background::Gradient {
                zenith,
                horizon,
                nadir,
            }) => {
                let _ = write!(
                    self.text,
                    "\n[background]\ngradient = {{ zenith = {}, horizon = {}, nadir = {} }}\n",
                    color(zenith),
                    color(horizon),
                    color(nadir)
                );
            }
        }
    }

    /// An object: one thing, or several that differ in their materials.
    fn object(&mut self, place: usize, group: &[&Thing]) -> anyhow::Result<()> {
        let Some(first) = group.first() else {
            return Ok(());
        };
        self.text += "\n[[object]]\n";
        self.line(&format!("name = {}", quoted(&first.name)));
        if let [_, _, ..] = group {
            let file = self.obj(place, group)?;
            self.line(&format!("mesh = {}", quoted(&file)));
            return Ok(());
        }
        match &first.form {
            Form::Sphere { center, radius } => {
                self.line("shape = \"sphere\"");
                self.line(&format!("center = {}", vector(*center)));
                self.line(&format!("radius = {}", number(*radius)));
                self.line("segments = 128");
                self.rounded(first);
            }
            Form::Ellipsoid { center, axes } => {
                let mut matrix = DMat4::from_mat3(*axes);
                matrix.w_axis = center.extend(1.0);
                let mut ball = shapes::ball(false);
                ball.transform(&matrix);
                self.mesh("object", place, &ball, true, false);
                self.rounded(first);
            }
            Form::Rectangle { center, axes } => {
                let mut matrix = DMat4::from_mat3(*axes);
                matrix.w_axis = center.extend(1.0);
                let mut square = shapes::square();
                square.transform(&matrix);
                self.mesh("object", place, &square, true, false);
            }
            Form::Mesh { mesh, .. } => {
                let with_uvs = !matches!(first.coat, Coat::Color(_) | Coat::Vertex);
                self.mesh("object", place, mesh, with_uvs, first.coat == Coat::Vertex);
            }
        }
        match &first.coat {
            Coat::Color(one) => self.line(&format!("color = {}", color(*one))),
            Coat::Vertex => self.line("vertex_colors = true"),
            Coat::Checker { a, b, cells } => self.line(&format!(
                "checker = {{ a = {}, b = {}, cells = {cells} }}",
                color(*a),
                color(*b)
            )),
            coat => {
                let (file, tint) = self.picture(&first.name, coat)?;
                if let Some(file) = file {
                    self.line(&format!("texture = {}", quoted(&file)));
                }
                if tint != Vec3::ONE {
                    self.line(&format!("color = {}", color(tint)));
                }
            }
        }
        Ok(())
    }

    /// Says that a round object has corners now.
    fn rounded(&mut self, thing: &Thing) {
        self.notes.push(format!(
            "the object `{}` was round and has triangles now: only mirrors are exact",
            thing.name
        ));
    }

    fn mirror(&mut self, place: usize, thing: &Thing) {
        self.text += "\n[[mirror]]\n";
        self.line(&format!("name = {}", quoted(&thing.name)));
        match &thing.form {
            Form::Sphere { center, radius } => {
                self.line("shape = \"sphere\"");
                self.line(&format!("center = {}", vector(*center)));
                self.line(&format!("radius = {}", number(*radius)));
            }
            Form::Ellipsoid { center, axes } => {
                let (radii, turn) = shapes::half_axes(*axes);
                self.line("shape = \"ellipsoid\"");
                self.line(&format!("center = {}", vector(*center)));
                self.line(&format!("radii = {}", vector(radii)));
                self.line(&format!("rotate_deg = {}", vector(shapes::angles(turn))));
            }
            Form::Rectangle { center, axes } => {
                self.line("shape = \"plane\"");
                self.line(&format!("center = {}", vector(*center)));
                self.line(&format!("normal = {}", vector(axes.z_axis)));
                self.line(&format!("up = {}", vector(axes.y_axis.normalize())));
                let size = [axes.x_axis, axes.y_axis].map(|side| number(2.0 * side.length()));
                self.line(&format!("size = [{}, {}]", size[0], size[1]));
            }
            Form::Mesh { mesh, flat } => {
                self.mesh("mirror", place, mesh, false, false);
                if *flat && mesh.normals.is_empty() {
                    self.line("facets = true");
                }
            }
        }
    }

    /// Writes a mesh and the line that names it.
    fn mesh(
        &mut self,
        kind: &str,
        place: usize,
        mesh: &Triangles,
        with_uvs: bool,
        with_colors: bool,
    ) {
        let with_normals = kind == "mirror" && !mesh.normals.is_empty();
        let with_uvs = with_uvs && !mesh.uvs.is_empty();
        let with_colors = with_colors && !mesh.colors.is_empty();
        let mut ply = Ply::new(match (with_normals, with_uvs, with_colors) {
            (true, ..) => &["x", "y", "z", "nx", "ny", "nz"],
            (false, true, false) => &["x", "y", "z", "u", "v"],
            (false, false, true) => &["x", "y", "z", "r", "g", "b"],
            (false, true, true) => &["x", "y", "z", "u", "v", "r", "g", "b"],
            (false, false, false) => &["x", "y", "z"],
        });
        for (index, three) in mesh.triangles.iter().enumerate() {
            let corner = |corner: usize| {
                let position = mesh.positions[three[corner] as usize].as_vec3();
                let mut row = position.to_array().to_vec();
                if with_normals {
                    row.extend(mesh.normals[index][corner].as_vec3().to_array());
                }
                if with_uvs {
                    row.extend(mesh.uvs[index][corner].to_array());
                }
                if with_colors {
                    row.extend(mesh.colors[index][corner].to_array());
                }
                row
            };
            let [a, b, c] = [0, 1, 2].map(corner);
            ply.triangle([&a, &b, &c]);
        }
        let file = format!("{MESHES}/{kind}-{}.ply", place + 1);
        self.bundle.add(file.as_str(), ply.bytes());
        self.line(&format!("mesh = {}", quoted(&file)));
    }

    /// Things of several materials as one OBJ with its MTL.
    fn obj(&mut self, place: usize, group: &[&Thing]) -> anyhow::Result<String> {
        let stem = format!("object-{}", place + 1);
        let mut obj = format!("mtllib {stem}.mtl\n");
        let mut mtl = String::new();
        let (mut vertices, mut uvs) = (0u64, 0u64);
        for (number, thing) in group.iter().enumerate() {
            let Form::Mesh { mesh, .. } = &thing.form else {
                self.notes.push(format!(
                    "a part of `{}` is left out: it is no mesh",
                    thing.name
                ));
                continue;
            };
            let _ = writeln!(mtl, "newmtl m{number}");
            match &thing.coat {
                Coat::Color(one) => {
                    let [r, g, b] = one.to_array();
                    let _ = writeln!(mtl, "Kd {r:?} {g:?} {b:?}");
                }
                Coat::Vertex => {
                    self.notes.push(format!(
                        "the vertex colours of a part of `{}` are left out",
                        thing.name
                    ));
                }
                Coat::Checker { a, b, .. } => {
                    let [r, g, b] = ((*a + *b) / 2.0).to_array();
                    let _ = writeln!(mtl, "Kd {r:?} {g:?} {b:?}");
                    self.notes.push(format!(
                        "the cells of a part of `{}` are left out",
                        thing.name
                    ));
                }
                coat => {
                    let (file, tint) = self.picture(&thing.name, coat)?;
                    let [r, g, b] = tint.to_array();
                    let _ = writeln!(mtl, "Kd {r:?} {g:?} {b:?}");
                    if let Some(file) = file {
                        let _ = writeln!(mtl, "map_Kd ../{file}");
                    }
                }
            }
            for position in &mesh.positions {
                let [x, y, z] = position.as_vec3().to_array();
                let _ = writeln!(obj, "v {x:?} {y:?} {z:?}");
            }
            for uv in mesh.uvs.as_flattened() {
                let _ = writeln!(obj, "vt {:?} {:?}", uv.x, uv.y);
            }
            let _ = writeln!(obj, "usemtl m{number}");
            for (index, three) in mesh.triangles.iter().enumerate() {
                obj.push('f');
                for (corner, vertex) in three.iter().enumerate() {
                    let vertex = vertices + u64::from(*vertex) + 1;
                    let _ = match mesh.uvs.is_empty() {
                        true => write!(obj, " {vertex}"),
                        false => write!(obj, " {vertex}/{}", uvs + (3 * index + corner) as u64 + 1),
                    };
                }
                obj.push('\n');
            }
            vertices += mesh.positions.len() as u64;
            uvs += 3 * mesh.uvs.len() as u64;
        }
        for (ending, text) in [("mtl", mtl), ("obj", obj)] {
            self.bundle
                .add(format!("{MESHES}/{stem}.{ending}"), text.into_bytes());
        }
        Ok(format!("{MESHES}/{stem}.obj"))
    }

    /// Writes a picture; its path beside the scene, and its factor. `None` where it is of no kind that
    /// scene files have.
    fn picture(&mut self, of: &str, coat: &Coat) -> anyhow::Result<(Option<String>, Vec3)> {
        match coat {
            Coat::Texels { size, texels } => {
                let most = texels
                    .iter()
                    .fold(1.0f32, |most, color| most.max(color.max_element()));
                let image =
                    Image::from_vec(*size, texels.iter().map(|color| *color / most).collect());
                let file = self.next("png");
                let bytes = png16(&image, Path::new(&file))?;
                self.bundle.add(file.as_str(), bytes);
                Ok((Some(file), Vec3::splat(most)))
            }
            Coat::Picture { tint, source } => {
                let bytes = match source {
                    PictureSource::Bytes(bytes) => bytes.clone(),
                    PictureSource::File(path) => std::fs::read(path).map_err(|error| {
                        bad_input(format!("cannot read {}: {error}", path.display()))
                    })?,
                };
                let ending = match bytes.as_slice() {
                    [0x89, b'P', b'N', b'G', ..] => "png",
                    [0xff, 0xd8, 0xff, ..] => "jpg",
                    _ => {
                        self.notes.push(format!(
                            "the picture of `{of}` is left out: it is neither PNG nor JPEG"
                        ));
                        return Ok((None, *tint));
                    }
                };
                if let Some(known) = self.files.get(&bytes) {
                    return Ok((Some(known.clone()), *tint));
                }
                let file = self.next(ending);
                self.bundle.add(file.as_str(), bytes.clone());
                self.files.insert(bytes, file.clone());
                Ok((Some(file), *tint))
            }
            other => Ok((None, tint_of(other))),
        }
    }

    fn next(&mut self, ending: &str) -> String {
        self.textures += 1;
        format!("{TEXTURES}/{}.{ending}", self.textures)
    }
}

/// One colour of a coat.
fn tint_of(coat: &Coat) -> Vec3 {
    match coat {
        Coat::Color(color) | Coat::Picture { tint: color, .. } => *color,
        Coat::Checker { a, b, .. } => (*a + *b) / 2.0,
        Coat::Vertex | Coat::Texels { .. } => Vec3::ONE,
    }
}

//! Model files: meshes with their materials, in one space of their own.
//!
//! `mesh = "…"` of a scene file reads any of them as one surface. The import of whole scenes gets the
//! parts one by one.

mod accessors;
mod gltf;
mod parts;
mod ply;
mod stl;

use std::path::Path;

use glam::{DVec3, Vec2};

use crate::SceneError;
use crate::geometry::{Geometry, Smoothing};
use crate::loading::Loading;
use crate::mesh::{Material, Paint};
use crate::obj::{self, Materials};

pub use self::parts::{Model, ModelCamera, Part, Surface, Triangles};
pub use crate::picture::PictureSource;

/// Reads a model file of any kind that is known by its ending.
///
/// # Errors
/// Whatever is wrong with the file, or with one that it names.
pub fn read(path: &Path) -> Result<Model, SceneError> {
    let loading = Loading::default();
    let mut model = match kind(path) {
        Kind::Obj => {
            let geometry = obj::read(path, &Materials::Ignored, 1, &loading)?;
            single(geometry.into())
        }
        Kind::Ply => single(ply::read(path, 1, &loading)?),
        Kind::Stl => single(stl::read(path, 1, &loading)?),
        Kind::Gltf => gltf::read(path, 1, &loading)?,
    };
    model.left_out.extend(loading.into_warnings());
    Ok(model)
}

fn single(mesh: Triangles) -> Model {
    let part = Part {
        mesh,
        ..Part::default()
    };
    Model {
        parts: vec![part],
        ..Model::default()
    }
}

/// Kinds of model files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Obj,
    Ply,
    Stl,
    /// As JSON or binary.
    Gltf,
}

/// By the ending of a file's name; whatever has another one is taken for an OBJ.
pub(crate) fn kind(path: &Path) -> Kind {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    match ending.to_ascii_lowercase().as_str() {
        "ply" => Kind::Ply,
        "stl" => Kind::Stl,
        "gltf" | "glb" => Kind::Gltf,
        _ => Kind::Obj,
    }
}

/// Reads a model that is no OBJ as one surface, of which there are to be so many copies; `painted`
/// where something replaces its materials.
pub(crate) fn surface(
    path: &Path,
    painted: bool,
    copies: usize,
    loading: &Loading,
) -> Result<Geometry, SceneError> {
    // A glTF without normals is to be shown flat, says its specification.
    let smoothing = match kind(path) {
        Kind::Gltf => Smoothing::Flat,
        _ => Smoothing::Unsaid,
    };
    let model = match kind(path) {
        Kind::Ply => single(ply::read(path, copies, loading)?),
        Kind::Stl => single(stl::read(path, copies, loading)?),
        Kind::Gltf | Kind::Obj => gltf::read(path, copies, loading)?,
    };
    for what in &model.left_out {
        loading.warn(format!("{}: {what}: left out", path.display()));
    }
    let whole = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let with_colors = model.parts.iter().any(|part| !part.mesh.colors.is_empty());
    let with_uvs = model.parts.iter().any(|part| !part.mesh.uvs.is_empty());
    let mut geometry = Geometry::default();
    for part in model.parts {
        let paint = match painted {
            true => Paint::Color(part.surface.color),
            false => paint(&part, loading).map_err(whole)?,
        };
        let number = geometry.materials.len() as u32;
        geometry.materials.push(Material {
            name: part.surface.name,
            paint,
        });
        let mesh = part.mesh;
        let (first, count) = (geometry.positions.len() as u32, mesh.triangles.len());
        geometry.positions.extend(mesh.positions);
        let moved = |three: [u32; 3]| three.map(|index| index + first);
        geometry
            .triangles
            .extend(mesh.triangles.into_iter().map(moved));
        let bare = mesh.normals.is_empty();
        let none = || std::iter::repeat_n([DVec3::ZERO; 3], count);
        match bare {
            true => geometry.normals.extend(none()),
            false => geometry.normals.extend(mesh.normals),
        }
        geometry.bare.extend(std::iter::repeat_n([bare; 3], count));
        geometry
            .smoothing
            .extend(std::iter::repeat_n(smoothing, count));
        geometry.material.extend(std::iter::repeat_n(number, count));
        let plain = std::iter::repeat_n([part.surface.color; 3], count);
        match (with_colors, mesh.colors.is_empty()) {
            (false, _) => {}
            (true, true) => geometry.colors.extend(plain),
            (true, false) => geometry.colors.extend(mesh.colors),
        }
        match (with_uvs, mesh.uvs.is_empty()) {
            (false, _) => {}
            (true, true) => geometry
                .uvs
                .extend(std::iter::repeat_n([Vec2::ZERO; 3], count)),
            (true, false) => geometry.uvs.extend(mesh.uvs),
        }
    }
    if geometry.triangles.is_empty() {
        return Err(whole("the mesh is empty: no triangle".to_owned()));
    }
    if geometry.bare.iter().all(|three| *three == [true; 3]) {
        geometry.normals.clear();
        geometry.bare.clear();
    }
    Ok(geometry)
}

/// What a part shows.
fn paint(part: &Part, loading: &Loading) -> Result<Paint, String> {
    Ok(match &part.surface.picture {
        Some(source) => Paint::Texture {
            tint: part.surface.color,
            image: loading.picture(source)?,
        },
        None if part.mesh.colors.is_empty() => Paint::Color(part.surface.color),
        None => Paint::Vertex,
    })
}

//! OBJ files, read with `tobj` after a scan of our own that can name the line of what is wrong.

mod scan;

use std::cell::Cell;
use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec2, Vec3};

use self::scan::{Scan, scan};
use crate::SceneError;
use crate::geometry::Geometry;
use crate::mesh::Paint;
use crate::mtl::{self, Painted};
use crate::text::{self, at_line};

/// Which materials a mesh is read with.
pub(crate) enum Materials {
    /// Those of the MTL files that the OBJ names.
    Own,
    /// Those of another MTL file.
    Other(PathBuf),
    /// None: something else gives the colour.
    Ignored,
}

/// Reads a mesh in its own space.
pub(crate) fn read(path: &Path, materials: &Materials) -> Result<Geometry, SceneError> {
    let scan = scan(path, &text::read(path, "OBJ")?)?;
    let mut palette = palette(path, materials, &scan)?;
    let by_name = used(path, materials, &scan, &palette)?;
    textured_faces_have_coordinates(path, &scan, &palette, &by_name)?;

    // The loader learns all materials from the first library named, so one has to be.
    let source = format!("mtllib all\n{}", scan.clean);
    let by_name = Cell::new(Some(by_name));
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    let loaded = tobj::load_obj_buf(&mut Cursor::new(source.as_bytes()), &options, |_| {
        let by_name = by_name.take().unwrap_or_default();
        let count = if by_name.is_empty() { 0 } else { palette.len() };
        Ok((
            vec![tobj::Material::default(); count],
            by_name.into_iter().collect(),
        ))
    });
    let (models, _) = loaded.map_err(|error| SceneError::File {
        file: path.display().to_string(),
        message: error.to_string(),
    })?;
    let fallback = palette.len() as u32;
    palette.push(Painted::plain("default"));
    let geometry = assemble(&models, &scan, palette, fallback);
    if geometry.triangles.is_empty() {
        return Err(SceneError::File {
            file: path.display().to_string(),
            message: "the mesh is empty: no face with area".to_owned(),
        });
    }
    Ok(geometry)
}

/// All materials of the MTL files.
fn palette(path: &Path, materials: &Materials, scan: &Scan) -> Result<Vec<Painted>, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut palette = Vec::new();
    match materials {
        Materials::Ignored => {}
        Materials::Other(file) => palette = mtl::read(file)?,
        Materials::Own => {
            for (line, names) in &scan.libraries {
                let files = libraries(folder, names)
                    .map_err(|message| at_line(path, *line, format!("`mtllib`: {message}")))?;
                for file in files {
                    palette.extend(mtl::read(&file)?);
                }
            }
        }
    }
    Ok(palette)
}

/// The files that a `mtllib` line names: all of it one, or else each of its words.
fn libraries(folder: &Path, names: &str) -> Result<Vec<PathBuf>, String> {
    if let Some(file) = text::beside(folder, names) {
        return Ok(vec![file]);
    }
    let words: Vec<_> = text::without_comment(names).split_whitespace().collect();
    if words.is_empty() {
        return Err("names no file".to_owned());
    }
    let file = |word: &&str| {
        text::beside(folder, word)
            .ok_or_else(|| format!("no file `{}`", folder.join(word).display()))
    };
    words.iter().map(file).collect()
}

/// Where in the palette each material is that the OBJ uses.
fn used(
    path: &Path,
    materials: &Materials,
    scan: &Scan,
    palette: &[Painted],
) -> Result<HashMap<String, usize>, SceneError> {
    let names_a_library = match materials {
        Materials::Own => !scan.libraries.is_empty(),
        Materials::Other(_) => true,
        Materials::Ignored => false,
    };
    let mut known: HashMap<&str, usize> = HashMap::new();
    // Whole names take precedence over those before a comment.
    for spelling in [0, 1] {
        for (index, painted) in palette.iter().enumerate() {
            let name = text::spellings(&painted.material.name).nth(spelling);
            name.map(|name| known.entry(name).or_insert(index));
        }
    }
    let mut used = HashMap::new();
    for (line, name) in &scan.materials {
        match text::spellings(name).find_map(|name| known.get(name)) {
            Some(index) => _ = used.insert(name.clone(), *index),
            None if names_a_library => {
                let message = format!("no material `{name}` in its MTL file");
                return Err(at_line(path, *line, message));
            }
            None => {}
        }
    }
    Ok(used)
}

fn textured_faces_have_coordinates(
    path: &Path,
    scan: &Scan,
    palette: &[Painted],
    by_name: &HashMap<String, usize>,
) -> Result<(), SceneError> {
    for (line, material) in &scan.bare {
        let painted = by_name.get(material).map(|index| &palette[*index].material);
        if painted.is_some_and(|material| matches!(material.paint, Paint::Texture { .. })) {
            let message = format!(
                "the face has no texture coordinates, which the `map_Kd` of its material \
                 `{material}` needs"
            );
            return Err(at_line(path, *line, message));
        }
    }
    Ok(())
}

/// All models in one. Normals that not all corners have are left out; so are such texture
/// coordinates, unless a material needs them.
fn assemble(models: &[tobj::Model], scan: &Scan, palette: Vec<Painted>, fallback: u32) -> Geometry {
    let mut geometry = Geometry::default();
    let meshes = || {
        models
            .iter()
            .map(|model| &model.mesh)
            .filter(|mesh| !mesh.indices.is_empty())
    };
    let [_, uvs, normals] = scan.everywhere;
    let textured = palette
        .iter()
        .any(|painted| matches!(painted.material.paint, Paint::Texture { .. }));
    let colors = meshes().all(|mesh| !mesh.vertex_color.is_empty());
    for mesh in meshes() {
        let material = mesh.material_id.map_or(fallback, |id| id as u32);
        let painted = &palette[material as usize];
        let start = geometry.positions.len() as u32;
        geometry.positions.extend(
            mesh.positions
                .chunks_exact(3)
                .map(|p| Vec3::from_slice(p).as_dvec3()),
        );
        for (face, corners) in mesh.indices.chunks_exact(3).enumerate() {
            geometry
                .triangles
                .push([0, 1, 2].map(|corner| start + corners[corner]));
            geometry.material.push(material);
            let three = |values: &[f32], indices: &[u32], corner: usize| {
                let at = 3 * index(indices, 3 * face + corner, corners[corner]);
                Vec3::from_slice(&values[at..at + 3])
            };
            if normals {
                let corner = |corner| three(&mesh.normals, &mesh.normal_indices, corner).as_dvec3();
                geometry
                    .normals
                    .push([0, 1, 2].map(corner).map(DVec3::normalize_or_zero));
            }
            if uvs || textured {
                // A part without coordinates beside one with them shows one texel.
                let corner = |corner: usize| {
                    let at = 2 * index(&mesh.texcoord_indices, 3 * face + corner, corners[corner]);
                    let uv = mesh.texcoords.get(at..at + 2).unwrap_or(&[0.0; 2]);
                    painted.uv_scale * Vec2::from_slice(uv) + painted.uv_offset
                };
                geometry.uvs.push([0, 1, 2].map(corner));
            }
            if colors {
                geometry
                    .colors
                    .push([0, 1, 2].map(|corner| three(&mesh.vertex_color, &[], corner)));
            }
        }
    }
    geometry.materials = palette
        .into_iter()
        .map(|painted| painted.material)
        .collect();
    geometry
}

/// Attributes have indices of their own, or share those of the positions.
fn index(own: &[u32], at: usize, shared: u32) -> usize {
    own.get(at).copied().unwrap_or(shared) as usize
}

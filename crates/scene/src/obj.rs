//! OBJ files, read with `tobj` after a scan of our own that can name the line of what is wrong.

use std::cell::Cell;
use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec2, Vec3};

use crate::SceneError;
use crate::geometry::Geometry;
use crate::mesh::{Material, Paint};
use crate::mtl::{self, DEFAULT_COLOR, at_line};

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
    let mut text = mtl::read_text(path)?;
    let scan = scan(path, &text)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut palette = Vec::new();
    match materials {
        Materials::Ignored => {}
        Materials::Other(file) => palette = mtl::read(file)?,
        Materials::Own => {
            for (line, library) in &scan.libraries {
                let file = folder.join(library);
                if !file.is_file() {
                    return Err(at_line(
                        path,
                        *line,
                        format!("no file `{}`", file.display()),
                    ));
                }
                palette.extend(mtl::read(&file)?);
            }
        }
    }
    let mut by_name: HashMap<&str, usize> = HashMap::new();
    for (index, material) in palette.iter().enumerate() {
        by_name.entry(&material.name).or_insert(index);
    }
    let names_a_library = match materials {
        Materials::Own => !scan.libraries.is_empty(),
        Materials::Other(_) => true,
        Materials::Ignored => false,
    };
    let unknown = scan
        .materials
        .iter()
        .find(|(_, name)| !by_name.contains_key(name.as_str()));
    if let Some((line, name)) = unknown.filter(|_| names_a_library) {
        return Err(at_line(
            path,
            *line,
            format!("no material `{name}` in its MTL file"),
        ));
    }

    // The loader learns all materials from the first library named, so one has to be.
    text.insert_str(0, "mtllib all\n");
    let palette_names = Cell::new(Some(by_name));
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    let loaded = tobj::load_obj_buf(&mut Cursor::new(text.as_bytes()), &options, |_| {
        let names = palette_names.take().unwrap_or_default();
        let materials =
            vec![tobj::Material::default(); if names.is_empty() { 0 } else { palette.len() }];
        Ok((
            materials,
            names
                .iter()
                .map(|(name, index)| ((*name).to_owned(), *index))
                .collect(),
        ))
    });
    let (models, _) = loaded.map_err(|error| SceneError::File {
        file: path.display().to_string(),
        message: error.to_string(),
    })?;
    let fallback = palette.len() as u32;
    palette.push(Material {
        name: "default".to_owned(),
        paint: Paint::Color(DEFAULT_COLOR),
    });
    let geometry = assemble(&models, &scan, palette, fallback);
    if geometry.triangles.is_empty() {
        return Err(SceneError::File {
            file: path.display().to_string(),
            message: "the mesh is empty: no face with area".to_owned(),
        });
    }
    Ok(geometry)
}

/// All models in one. Normals that not all corners have are left out; so are such texture
/// coordinates, unless a material needs them.
fn assemble(
    models: &[tobj::Model],
    scan: &Scan,
    palette: Vec<Material>,
    fallback: u32,
) -> Geometry {
    let mut geometry = Geometry {
        materials: palette,
        ..Geometry::default()
    };
    let meshes = || {
        models
            .iter()
            .map(|model| &model.mesh)
            .filter(|mesh| !mesh.indices.is_empty())
    };
    let [_, uvs, normals] = scan.everywhere;
    let textured = geometry
        .materials
        .iter()
        .any(|m| matches!(m.paint, Paint::Texture { .. }));
    let colors = meshes().all(|mesh| !mesh.vertex_color.is_empty());
    for mesh in meshes() {
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
            geometry
                .material
                .push(mesh.material_id.map_or(fallback, |id| id as u32));
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
                    Vec2::from_slice(mesh.texcoords.get(at..at + 2).unwrap_or(&[0.0; 2]))
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
    geometry
}

/// Attributes have indices of their own, or share those of the positions.
fn index(own: &[u32], at: usize, shared: u32) -> usize {
    own.get(at).copied().unwrap_or(shared) as usize
}

/// What a look at every line finds.
struct Scan {
    /// Whether every face corner has a position, a texture coordinate, a normal.
    everywhere: [bool; 3],
    /// Lines and values of `mtllib`.
    libraries: Vec<(usize, String)>,
    /// Lines and values of `usemtl`.
    materials: Vec<(usize, String)>,
}

/// Finds what is wrong with numbers and indices, and what the file refers to.
fn scan(path: &Path, text: &str) -> Result<Scan, SceneError> {
    let mut scan = Scan {
        everywhere: [true; 3],
        libraries: Vec::new(),
        materials: Vec::new(),
    };
    // Positions, texture coordinates and normals so far.
    let mut counts = [0i64; 3];
    let mut faces = 0;
    let mut colored = None;
    // Legal where the index exists at the end of the file.
    let mut ahead = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let error = |message: String| at_line(path, number, message);
        let mut words = line.split_whitespace();
        let key = words.next().unwrap_or("");
        match key {
            "v" | "vt" | "vn" => {
                let wanted = if key == "vt" { 2 } else { 3 };
                let values = words.map(|word| word.parse().ok().filter(|v: &f32| v.is_finite()));
                let values: Option<Vec<f32>> = values.collect();
                let Some(values) = values else {
                    return Err(error(format!(
                        "`{key}` has a value that is no finite number"
                    )));
                };
                if values.len() < wanted {
                    return Err(error(format!("`{key}` needs {wanted} numbers")));
                }
                match key {
                    "v" => {
                        counts[0] += 1;
                        let color = values.len() >= 6;
                        if *colored.get_or_insert(color) != color {
                            return Err(error(
                                "either all vertices have colours or none".to_owned(),
                            ));
                        }
                    }
                    "vt" => counts[1] += 1,
                    _ => counts[2] += 1,
                }
            }
            "f" => {
                let corners: Vec<&str> = words.collect();
                if corners.len() < 3 {
                    return Err(error("a face needs at least 3 corners".to_owned()));
                }
                faces += 1;
                for corner in corners {
                    let mut parts = corner.split('/');
                    for (kind, count) in counts.into_iter().enumerate() {
                        let part = parts.next().unwrap_or("");
                        if part.is_empty() && kind > 0 {
                            scan.everywhere[kind] = false;
                            continue;
                        }
                        let Ok(index) = part.parse::<i64>() else {
                            return Err(error(format!("`{corner}` is no face corner")));
                        };
                        if index == 0 || index < -count {
                            return Err(out_of_range(path, number, index, kind, count));
                        }
                        if index > count {
                            ahead.push((number, index, kind));
                        }
                    }
                }
            }
            "mtllib" => scan
                .libraries
                .push((number, words.collect::<Vec<_>>().join(" "))),
            "usemtl" => scan
                .materials
                .push((number, words.collect::<Vec<_>>().join(" "))),
            _ => {}
        }
    }
    let beyond = ahead
        .into_iter()
        .find(|(_, index, kind)| *index > counts[*kind]);
    if let Some((line, index, kind)) = beyond {
        return Err(out_of_range(path, line, index, kind, counts[kind]));
    }
    if faces == 0 {
        let message = "the mesh is empty: no face".to_owned();
        return Err(SceneError::File {
            file: path.display().to_string(),
            message,
        });
    }
    Ok(scan)
}

fn out_of_range(path: &Path, line: usize, index: i64, kind: usize, count: i64) -> SceneError {
    let what = ["vertex", "texture coordinate", "normal"][kind];
    at_line(
        path,
        line,
        format!("{what} index {index} is out of range: there are {count}"),
    )
}

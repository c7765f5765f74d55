//! PLY files, as text or binary.
//!
//! Positions, normals and texture coordinates of vertices (`x y z`, `nx ny nz`, `u v` or `s t`), of
//! faces their corners and, where there are any, texture coordinates of each corner (`texcoord`). Colours
//! are `red green blue`, `r g b` or `color_0 color_1 color_2`: bytes are sRGB as in a picture, other
//! numbers are linear.

use std::io::BufReader;
use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult};

use super::parts::Triangles;
use crate::SceneError;
use crate::loading::Loading;
use crate::obj::Triangulator;
use crate::picture::linear_from_srgb;
use crate::text::at_line;

/// Names of a vertex' numbers, in the order of [`Vertex::values`]; several may mean the same.
const NAMES: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texture_s"],
    &["v", "t", "texture_v", "texture_t"],
    &["r", "red", "diffuse_red", "color_0"],
    &["g", "green", "diffuse_green", "color_1"],
    &["b", "blue", "diffuse_blue", "color_2"],
];
const NORMAL: usize = 3;
const UV: usize = 6;
const COLOR: usize = 8;

/// A vertex as it is written.
struct Vertex {
    values: [f64; NAMES.len()],
}

/// A face as it is written.
struct Face {
    corners: Option<Vec<u32>>,
    uvs: Vec<f64>,
}

/// What is skipped.
struct Other;

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self {
            values: [0.0; NAMES.len()],
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(place) = NAMES.iter().position(|names| names.contains(&name)) else {
            return PropertyAccessResult::Ignored;
        };
        self.values[place] = match property {
            Property::UChar(value) if place >= COLOR => linear_from_srgb(f64::from(value) / 255.0),
            Property::UShort(value) if place >= COLOR => {
                linear_from_srgb(f64::from(value) / 65535.0)
            }
            Property::Char(value) => f64::from(value),
            Property::UChar(value) => f64::from(value),
            Property::Short(value) => f64::from(value),
            Property::UShort(value) => f64::from(value),
            Property::Int(value) => f64::from(value),
            Property::UInt(value) => f64::from(value),
            Property::Float(value) => f64::from(value),
            Property::Double(value) => value,
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self {
            corners: Some(Vec::new()),
            uvs: Vec::new(),
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match (name, property) {
            ("vertex_indices" | "vertex_index", list) => self.corners = list.to_u32_list(),
            ("texcoord", Property::ListFloat(list)) => {
                self.uvs = list.into_iter().map(f64::from).collect();
            }
            ("texcoord", Property::ListDouble(list)) => self.uvs = list,
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}

/// Reads a mesh, of which there are to be so many copies.
pub(super) fn read(path: &Path, copies: usize, loading: &Loading) -> Result<Triangles, SceneError> {
    let whole = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let bytes = std::fs::read(path).map_err(|error| whole(format!("cannot be read: {error}")))?;
    let length = bytes.len();
    let failed = |error: ParseError| {
        let text = said(&error);
        match error.line() {
            Some(line) => at_line(path, line, text),
            None => whole(text),
        }
    };
    let mut reader = Reader::new(BufReader::new(bytes.as_slice()));
    let header = Parser::<Other>::new()
        .read_header(&mut reader)
        .map_err(failed)?;
    check(&header, length).map_err(whole)?;

    let mut vertices: Vec<Vertex> = Vec::new();
    let mut faces: Vec<Face> = Vec::new();
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" => {
                vertices = Parser::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            "face" => {
                faces = Parser::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
            _ => {
                Parser::<Other>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(failed)?;
            }
        }
    }
    assemble(&header, &vertices, &faces, copies, loading).map_err(whole)
}

/// Longest piece of a file in a message.
const LONGEST: usize = 160;

/// What the reader says, on one line.
fn said(error: &ParseError) -> String {
    let text = error.to_string();
    let text = match error.line() {
        Some(line) => text.trim_start_matches(&format!("Line {line}: ")),
        None => &text,
    };
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").chars().take(LONGEST).collect()
}

/// Refuses a header that promises more than the file can hold, or no vertices.
fn check(header: &Header, length: usize) -> Result<(), String> {
    for (name, element) in &header.elements {
        let least = element.properties.len().max(1);
        if element.count.saturating_mul(least) > length {
            return Err(format!(
                "its header promises {} of `{name}`, more than {length} bytes can hold",
                element.count
            ));
        }
    }
    let Some(vertex) = header.elements.get("vertex") else {
        return Err("has no element `vertex`".to_owned());
    };
    for name in ["x", "y", "z"] {
        if !vertex.properties.contains_key(name) {
            return Err(format!("its vertices have no `{name}`"));
        }
    }
    Ok(())
}

/// Faces in triangles.
fn assemble(
    header: &Header,
    vertices: &[Vertex],
    faces: &[Face],
    copies: usize,
    loading: &Loading,
) -> Result<Triangles, String> {
    let has = |place: usize| {
        let vertex = header.elements.get("vertex");
        vertex.is_some_and(|vertex| {
            NAMES[place]
                .iter()
                .any(|name| vertex.properties.contains_key(*name))
        })
    };
    let has_all = |first: usize, count: usize| (first..first + count).all(has);
    let (with_normals, with_colors) = (has_all(NORMAL, 3), has_all(COLOR, 3));
    let with_wedges = faces.iter().any(|face| !face.uvs.is_empty());
    let with_uvs = has_all(UV, 2) || with_wedges;

    let count: usize = faces
        .iter()
        .map(|face| {
            face.corners
                .as_ref()
                .map_or(0, |list| list.len().saturating_sub(2))
        })
        .sum();
    loading.triangles(count as u64, copies)?;
    let vector = |index: u32, first: usize| {
        let values = &vertices[index as usize].values;
        DVec3::new(values[first], values[first + 1], values[first + 2])
    };
    let positions = vertices.iter().map(|vertex| {
        let [x, y, z, ..] = vertex.values;
        DVec3::new(x, y, z)
    });
    let mut mesh = Triangles {
        positions: positions.collect(),
        ..Triangles::default()
    };
    if let Some(index) = mesh.positions.iter().position(|at| !at.is_finite()) {
        return Err(format!("vertex {index} (from 0) is not finite"));
    }
    let mut triangulator = Triangulator::new();
    let mut around = Vec::new();
    for (number, face) in faces.iter().enumerate() {
        let corners = face.corners.as_deref();
        let corners =
            corners.filter(|list| list.iter().all(|index| (*index as usize) < vertices.len()));
        let Some(corners) = corners else {
            return Err(format!(
                "face {number} (from 0) has a corner that is none of {} vertices",
                vertices.len()
            ));
        };
        if corners.len() < 3 {
            return Err(format!(
                "face {number} (from 0) has {} corners",
                corners.len()
            ));
        }
        around.clear();
        around.extend(corners.iter().map(|index| mesh.positions[*index as usize]));
        for three in triangulator.triangulate(&around) {
            let three = three.map(|corner| corner as usize);
            let of = three.map(|corner| corners[corner]);
            mesh.triangles.push(of);
            if with_normals {
                mesh.normals.push(of.map(|index| vector(index, NORMAL)));
            }
            if with_uvs {
                let uv = |place: usize| match face.uvs.get(2 * three[place]..2 * three[place] + 2) {
                    Some(wedge) => Vec2::new(wedge[0] as f32, wedge[1] as f32),
                    None => {
                        let values = &vertices[of[place] as usize].values;
                        Vec2::new(values[UV] as f32, values[UV + 1] as f32)
                    }
                };
                mesh.uvs.push([0, 1, 2].map(uv));
            }
            if with_colors {
                let color = |index: u32| vector(index, COLOR).as_vec3().max(Vec3::ZERO);
                mesh.colors.push(of.map(color));
            }
        }
    }
    if mesh.triangles.is_empty() {
        return Err("the mesh is empty: no face with area".to_owned());
    }
    Ok(mesh)
}

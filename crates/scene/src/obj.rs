//! OBJ files as geometry: statements, then materials, then triangles.

mod palette;
mod polygon;
mod statements;

use std::num::NonZeroU32;
use std::path::Path;

use glam::{DVec2, DVec3};

pub(crate) use self::palette::Materials;
use self::palette::Palette;
pub(crate) use self::polygon::Triangulator;
use self::statements::{Corner, Statements};
use crate::SceneError;
use crate::geometry::Geometry;
use crate::loading::Loading;
use crate::mtl::Painted;

/// Reads a mesh in its own space, of which there are to be so many copies.
pub(crate) fn read(
    path: &Path,
    materials: &Materials,
    copies: usize,
    loading: &Loading,
) -> Result<Geometry, SceneError> {
    let whole = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let statements = Statements::read(path, loading)?;
    let triangles: usize = statements
        .faces()
        .map(|(_, corners)| corners.len() - 2)
        .sum();
    loading.triangles(triangles as u64, copies).map_err(whole)?;
    let palette = Palette::of(path, materials, &statements, loading)?;
    let geometry = assemble(path, &statements, palette, loading);
    if geometry.triangles.is_empty() {
        return Err(whole("the mesh is empty: no face with area".to_owned()));
    }
    Ok(geometry)
}

/// All faces in triangles. Texture coordinates that not all corners have are left out, unless a
/// material needs them.
fn assemble(path: &Path, statements: &Statements, palette: Palette, loading: &Loading) -> Geometry {
    let all_have_uvs = statements.corners.iter().all(|corner| corner.uv.is_some());
    let with_uvs = all_have_uvs || palette.used.iter().any(Painted::is_textured);
    let with_normals = statements
        .corners
        .iter()
        .any(|corner| corner.normal.is_some());
    let with_colors = !statements.colors.is_empty();

    let mut geometry = Geometry {
        positions: statements.positions.clone(),
        ..Geometry::default()
    };
    let mut triangulator = Triangulator::new();
    let mut around = Vec::new();
    let mut crossed = Vec::new();
    for ((face, corners), material) in statements.faces().zip(&palette.of_face) {
        let painted = &palette.used[*material as usize];
        let uv = |corner: &Corner| {
            let written = corner
                .uv
                .map_or(DVec2::ZERO, |index| of(&statements.uvs, index));
            (painted.uv_scale * written + painted.uv_offset).as_vec2()
        };
        around.clear();
        around.extend(
            corners
                .iter()
                .map(|corner| of(&statements.positions, corner.position)),
        );
        let triangles = triangulator.triangulate(&around);
        for triangle in triangles {
            let corners = triangle.map(|corner| &corners[corner as usize]);
            geometry
                .triangles
                .push(corners.map(|corner| corner.position.get() - 1));
            geometry.material.push(*material);
            geometry.smoothing.push(face.smoothing);
            if with_uvs {
                geometry.uvs.push(corners.map(uv));
            }
            if with_normals {
                let normal = |corner: &Corner| corner.normal.map(|n| of(&statements.normals, n));
                let normals = corners.map(normal);
                geometry.bare.push(normals.map(|normal| normal.is_none()));
                geometry
                    .normals
                    .push(normals.map(|normal| normal.unwrap_or(DVec3::ZERO)));
            }
            if with_colors {
                let color = |corner: &Corner| of(&statements.colors, corner.position);
                geometry.colors.push(corners.map(color));
            }
        }
        if triangulator.is_crossed() {
            crossed.push(face.line);
        }
    }
    if let [first, others @ ..] = crossed.as_slice() {
        let others = match others.len() {
            0 => String::new(),
            count => format!(", as do {count} others of this file"),
        };
        loading.warn(format!(
            "{}:{first}: the face crosses itself{others}: what of it shows is arbitrary",
            path.display()
        ));
    }
    geometry.materials = palette
        .used
        .into_iter()
        .map(|painted| painted.material)
        .collect();
    geometry
}

/// An element by its index from 1.
fn of<T: Copy>(all: &[T], index: NonZeroU32) -> T {
    all[index.get() as usize - 1]
}

//! `[[mirror]]`.

use glam::DVec3;

use super::origin::{Origin, name};
use super::surface::{PRIMITIVES, Surface, copies, primitive};
use crate::document::Table;
use crate::geometry::Purpose;
use crate::mesh::{Material, Mesh, Paint};
use crate::pose::Pose;
use crate::shape::{self, EXACT, Shape};
use crate::suggest::suggest;
use crate::{Mirror, SceneError};

/// Reads a mirror, with its mesh if it is one.
pub(super) fn mirror(table: &Table<'_>, origin: &Origin<'_>) -> Result<Mirror, SceneError> {
    let name = name(table)?;
    let tessellation = table.count("tessellation", 4..=2048)?.unwrap_or(128);
    let cubemaps = table.rows::<3>("cubemaps")?.unwrap_or_default();
    let is_mesh =
        table.has("mesh") || (table.string("shape")?).is_some_and(|name| !EXACT.contains(&name));
    let proxies = match is_mesh {
        true => table.tables("proxy")?,
        false => Vec::new(),
    };
    let exact = table.boolean("exact")?;
    let shape = surface_of(table, origin)?;
    let shape = match (exact, shape.is_analytic()) {
        (Some(false), true) => Shape::Mesh(shape.tessellate(tessellation)),
        (Some(true), false) => {
            return Err(table.error("exact", "a mesh has no exact surface"));
        }
        _ => shape,
    };
    let proxies = proxies.iter().map(|table| proxy(table, origin));
    Ok(Mirror {
        name,
        shape,
        tessellation,
        cubemaps: cubemaps.into_iter().map(DVec3::from_array).collect(),
        proxies: proxies.collect::<Result<_, _>>()?,
        pose: Pose::REST,
    })
}

/// A closed mesh from which a piece of the mirror was cut.
fn proxy(table: &Table<'_>, origin: &Origin<'_>) -> Result<Mesh, SceneError> {
    match surface_of(table, origin)? {
        Shape::Mesh(mesh) if mesh.is_closed() => Ok(mesh),
        Shape::Mesh(_) => Err(table.error_here("is open: it has to be a closed mesh")),
        exact => {
            let name = exact.name();
            let message =
                format_args!("`{name}` is no mesh: a mirror of that shape needs no proxy");
            Err(table.error("shape", message))
        }
    }
}

/// The surface that `mesh` or `shape` names.
fn surface_of(table: &Table<'_>, origin: &Origin<'_>) -> Result<Shape, SceneError> {
    let mesh = table.string("mesh")?;
    let shape = table.string("shape")?;
    Ok(match (mesh, shape) {
        (Some(_), Some(_)) => return Err(table.error("mesh", "and `shape` exclude each other")),
        (Some(file), None) => {
            let surface = Surface::Mesh {
                file: file.to_owned(),
                mtl: None,
            };
            Shape::Mesh(reflecting(table, origin, &surface)?)
        }
        (None, Some(name)) => match shape::read(name, table) {
            Some(shape) => shape?,
            None => Shape::Mesh(reflecting(table, origin, &other(table, name)?)?),
        },
        (None, None) => {
            table.finish()?;
            return Err(table.error_here(format_args!(
                "needs `shape = \"…\"` (one of {}) or `mesh = \"FILE.obj\"`",
                EXACT.join(", ")
            )));
        }
    })
}

/// A primitive that makes a mesh mirror: every one that is not a shape known exactly.
fn other(table: &Table<'_>, name: &str) -> Result<Surface, SceneError> {
    primitive(table, name)?.ok_or_else(|| {
        let meshes = PRIMITIVES.iter().filter(|name| !EXACT.contains(name));
        let known: Vec<_> = EXACT.iter().chain(meshes).copied().collect();
        let suggestion = suggest(name, known.iter().copied());
        let known = known.join(", ");
        let message = format_args!("`{name}` is unknown{suggestion}; known: {known}");
        table.error("shape", message)
    })
}

/// A mesh with shading normals: its own, or smooth ones, or with `facets` those of its triangles.
fn reflecting(
    table: &Table<'_>,
    origin: &Origin<'_>,
    surface: &Surface,
) -> Result<Mesh, SceneError> {
    let copies = copies(table)?;
    let facets = table.boolean("facets")?.unwrap_or(false);
    table.finish()?;
    let mut geometry = surface.geometry(table, origin, true, copies.len())?;
    let paint = Paint::Color(glam::Vec3::ZERO);
    geometry.materials = vec![Material {
        name: "mirror".to_owned(),
        paint,
    }];
    geometry.material.clear();
    geometry.uvs.clear();
    geometry.colors.clear();
    let mut mesh = geometry
        .into_mesh(&copies, Purpose::Mirror)
        .map_err(|message| table.error_here(message))?;
    if mesh.triangles.is_empty() {
        return Err(table.error_here("the mesh is empty: no triangle with area"));
    }
    mesh.wind_by_normals();
    if facets {
        mesh.flat_normals();
    }
    Ok(mesh)
}

//! `[[mirror]]`.

use glam::{DVec2, DVec3};

use super::surface::{PRIMITIVES, Surface, copies, primitive};
use super::{Origin, name};
use crate::document::{SMALLEST, Table, short};
use crate::error::suggest;
use crate::geometry::rotation;
use crate::mesh::{Material, Mesh, Paint};
use crate::{Mirror, SceneError, Shape};

/// Shapes known exactly. Every other primitive makes a mesh mirror.
const EXACT: [&str; 6] = ["sphere", "ellipsoid", "plane", "bowl", "torus", "saddle"];

/// Reads a mirror, with its mesh if it is one.
pub(super) fn mirror(table: &Table<'_>, origin: &Origin<'_>) -> Result<Mirror, SceneError> {
    let name = name(table)?;
    let tessellation = table.count("tessellation", 4..=2048)?.unwrap_or(128);
    let cubemaps = table.rows::<3>("cubemaps")?.unwrap_or_default();
    let mesh = table.string("mesh")?;
    let shape = table.string("shape")?;
    let shape = match (mesh, shape) {
        (Some(_), Some(_)) => return Err(table.error("mesh", "and `shape` exclude each other")),
        (Some(file), None) => {
            let surface = Surface::Mesh {
                file: file.to_owned(),
                mtl: None,
            };
            Shape::Mesh(reflecting(table, origin, &surface)?)
        }
        (None, Some("sphere")) => sphere(table)?,
        (None, Some("ellipsoid")) => ellipsoid(table)?,
        (None, Some("plane")) => plane(table)?,
        (None, Some("bowl")) => bowl(table)?,
        (None, Some("torus")) => torus(table)?,
        (None, Some("saddle")) => saddle(table)?,
        (None, Some(shape)) => {
            let Some(surface) = primitive(table, shape)? else {
                let meshes = PRIMITIVES.into_iter().filter(|name| !EXACT.contains(name));
                let known: Vec<_> = EXACT.into_iter().chain(meshes).collect();
                let suggestion = suggest(shape, known.iter().copied());
                let known = known.join(", ");
                let message = format_args!("`{shape}` is unknown{suggestion}; known: {known}");
                return Err(table.error("shape", message));
            };
            Shape::Mesh(reflecting(table, origin, &surface)?)
        }
        (None, None) => {
            table.finish()?;
            return Err(table.error_here("needs `shape` or `mesh`"));
        }
    };
    Ok(Mirror {
        name,
        shape,
        tessellation,
        cubemaps: cubemaps.into_iter().map(DVec3::from_array).collect(),
    })
}

fn center(table: &Table<'_>) -> Result<DVec3, SceneError> {
    Ok(table.vector("center")?.unwrap_or(DVec3::ZERO))
}

fn sphere(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let radius = table.positive("radius")?;
    table.finish()?;
    Ok(Shape::Sphere {
        center,
        radius: table.required("radius", radius)?,
    })
}

fn ellipsoid(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let radii = table.vector("radii")?;
    let degrees = table.vector("rotate_deg")?.unwrap_or(DVec3::ZERO);
    table.finish()?;
    let radii = table.required("radii", radii)?;
    if radii.min_element() < SMALLEST {
        return Err(table.error("radii", "must be positive"));
    }
    Ok(Shape::Ellipsoid {
        center,
        radii,
        rotation: rotation(degrees),
    })
}

/// `normal` and `up` (made perpendicular to it), and `size`.
fn oriented(table: &Table<'_>) -> Result<(DVec3, DVec3, DVec2), SceneError> {
    let normal = table.direction("normal")?;
    let up = table.direction("up")?.unwrap_or(DVec3::Y);
    let size = table.numbers::<2>("size")?;
    table.finish()?;
    let normal = table.required("normal", normal)?;
    let size = DVec2::from(table.required("size", size)?);
    if size.min_element() < SMALLEST {
        return Err(table.error("size", "must be positive: the mirror has no area"));
    }
    let up = up - up.dot(normal) * normal;
    if up.length() < 1e-6 {
        return Err(table.error("up", "must not be parallel to `normal`"));
    }
    Ok((normal, up.normalize(), size))
}

fn plane(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let (normal, up, size) = oriented(table)?;
    Ok(Shape::Plane {
        center,
        normal,
        up,
        size,
    })
}

fn saddle(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let curvature = table.numbers::<2>("curvature")?;
    let (normal, up, size) = oriented(table)?;
    let curvature = DVec2::from(table.required("curvature", curvature)?);
    if curvature.x * curvature.y >= 0.0 {
        let message = "must be two numbers of opposite signs: along the width and along `up`";
        return Err(table.error("curvature", message));
    }
    Ok(Shape::Saddle {
        center,
        normal,
        up,
        size,
        curvature,
    })
}

fn torus(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let axis = table.direction("axis")?.unwrap_or(DVec3::Y);
    let major = table.positive("major")?;
    let minor = table.positive("minor")?;
    table.finish()?;
    let major = table.required("major", major)?;
    let minor = table.required("minor", minor)?;
    if minor >= major {
        return Err(table.error("minor", "must be smaller than `major`"));
    }
    Ok(Shape::Torus {
        center,
        axis,
        major,
        minor,
    })
}

fn bowl(table: &Table<'_>) -> Result<Shape, SceneError> {
    let center = center(table)?;
    let radius = table.positive("radius")?;
    let axis = table.direction("axis")?;
    let degrees = table.number("half_angle_deg")?;
    table.finish()?;
    let radius = table.required("radius", radius)?;
    let axis = table.required("axis", axis)?;
    let degrees = table.required("half_angle_deg", degrees)?;
    if !(1e-3..180.0).contains(&degrees) {
        let message = format_args!("must be between 0 and 180 degrees, not {}", short(degrees));
        return Err(table.error("half_angle_deg", message));
    }
    Ok(Shape::Bowl {
        center,
        radius,
        axis,
        half_angle: degrees.to_radians(),
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
    let mut geometry = surface.geometry(table, origin, true)?;
    let paint = Paint::Color(glam::Vec3::ZERO);
    geometry.materials = vec![Material {
        name: "mirror".to_owned(),
        paint,
    }];
    geometry.material.clear();
    geometry.uvs.clear();
    geometry.colors.clear();
    let mut mesh = geometry
        .into_mesh(&copies)
        .map_err(|message| table.error_here(message))?;
    if mesh.triangles.is_empty() {
        return Err(table.error_here("the mesh is empty: no triangle with area"));
    }
    if mesh.normals.is_empty() {
        mesh.smooth_normals();
    }
    mesh.wind_by_normals();
    if facets {
        mesh.flat_normals();
    }
    Ok(mesh)
}

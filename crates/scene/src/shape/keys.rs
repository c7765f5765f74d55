//! Keys of the scene file that several shapes have in common.

use glam::{DVec2, DVec3};

use crate::SceneError;
use crate::document::{SMALLEST, Table};

/// `center`, by default the origin.
pub(super) fn center(table: &Table<'_>) -> Result<DVec3, SceneError> {
    Ok(table.vector("center")?.unwrap_or(DVec3::ZERO))
}

/// `normal`, `up` (made perpendicular to it) and `size`; the last keys that are read.
pub(super) fn oriented(table: &Table<'_>) -> Result<(DVec3, DVec3, DVec2), SceneError> {
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

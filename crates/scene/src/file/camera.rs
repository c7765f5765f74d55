//! `[camera]` and `[background]`.

use glam::{DVec3, Vec3};

use crate::document::{SMALLEST, Table, short};
use crate::{Background, Camera, Fov, SceneError};

/// Largest width or height of an image.
const LARGEST_IMAGE: u32 = 16384;

pub(super) fn camera(
    table: &Table<'_>,
    resolution: Option<[u32; 2]>,
) -> Result<Camera, SceneError> {
    let eye = table.vector("eye")?;
    let target = table.vector("target")?;
    let up = table.direction("up")?.unwrap_or(DVec3::Y);
    let fov = match (table.number("fov_x")?, table.number("fov_y")?) {
        (Some(_), Some(_)) => return Err(table.error("fov_x", "and `fov_y` exclude each other")),
        (Some(x), None) => Some(("fov_x", x, Fov::X(x))),
        (None, Some(y)) => Some(("fov_y", y, Fov::Y(y))),
        (None, None) => None,
    };
    let in_file = table.counts("resolution", 1..=LARGEST_IMAGE)?;
    table.finish()?;

    let eye = table.required("eye", eye)?;
    let target = table.required("target", target)?;
    let (key, degrees, fov) = table.required("fov_y", fov)?;
    if degrees <= 0.0 || degrees >= 180.0 {
        let message = format_args!("must be between 0 and 180 degrees, not {}", short(degrees));
        return Err(table.error(key, message));
    }
    let forward = target - eye;
    if forward.length() < SMALLEST {
        return Err(table.error("target", "is the same point as `eye`"));
    }
    if forward.normalize().cross(up).length() < 1e-6 {
        // An axis that is far from parallel to it.
        let other = match forward.y.abs() > 0.7 * forward.length() {
            true => "[0.0, 0.0, 1.0]",
            false => "[0.0, 1.0, 0.0]",
        };
        return Err(match table.has("up") {
            true => table.error(
                "up",
                format_args!(
                    "is parallel to the viewing direction, from `eye` to `target`: give another \
                     direction, such as {other}"
                ),
            ),
            false => table.error(
                "target",
                format_args!(
                    "lies straight above or below `eye`, so that no direction is up: add `up`, such \
                     as up = {other}"
                ),
            ),
        });
    }
    let resolution = match resolution {
        Some(size) if size.iter().any(|side| !(1..=LARGEST_IMAGE).contains(side)) => {
            let [width, height] = size;
            let message = format_args!(
                "asked for, {width}x{height}, must be from 1 to {LARGEST_IMAGE} on each side"
            );
            return Err(table.error("resolution", message));
        }
        size => size.or(in_file).unwrap_or([640, 480]),
    };
    Ok(Camera {
        eye,
        target,
        up,
        fov,
        resolution,
    })
}

pub(super) fn background(table: Option<&Table<'_>>) -> Result<Background, SceneError> {
    let Some(table) = table else {
        return Ok(Background::Color(Vec3::ZERO));
    };
    let color = table.color("color")?;
    let gradient = table.table("gradient")?;
    table.finish()?;
    match (color, gradient) {
        (Some(_), Some(_)) => Err(table.error("color", "and `gradient` exclude each other")),
        (Some(color), None) => Ok(Background::Color(color)),
        (None, Some(gradient)) => {
            let zenith = gradient.color("zenith")?;
            let horizon = gradient.color("horizon")?;
            let nadir = gradient.color("nadir")?;
            gradient.finish()?;
            Ok(Background::Gradient {
                zenith: gradient.required("zenith", zenith)?,
                horizon: gradient.required("horizon", horizon)?,
                nadir: gradient.required("nadir", nadir)?,
            })
        }
        (None, None) => Err(table.error_here("needs `color` or `gradient`")),
    }
}

//! `[motion]`.

use glam::DVec3;

use crate::document::{SMALLEST, Table};
use crate::motion::{CameraPath, Motion, Move, Subject};
use crate::shape::Enclosure;
use crate::suggest::suggest;
use crate::{Camera, Mirror, Object, SceneError};

/// Most frames of a sequence.
const MOST_FRAMES: u32 = 10_000;
/// The longest step of a sequence is at most so many times as long as the shortest.
const MOST_GROWTH: f64 = 1e6;

/// Reads how the scene moves, and checks the camera at every frame.
pub(super) fn motion(
    table: &Table<'_>,
    camera: &Camera,
    objects: &[Object],
    mirrors: &[Mirror],
) -> Result<Motion, SceneError> {
    let frames = table.count("frames", 2..=MOST_FRAMES)?;
    let growth = table.positive("growth")?.unwrap_or(1.0);
    let camera_table = table.table("camera")?;
    let move_tables = table.tables("move")?;
    table.finish()?;
    let frames = table.required("frames", frames)?;
    let steps = f64::from(frames - 1);
    if growth.ln().abs() * (steps - 1.0) > MOST_GROWTH.ln() {
        let message = format_args!(
            "makes the longest of {steps} steps more than {MOST_GROWTH:e} times as long as the shortest: \
             bring it nearer to 1"
        );
        return Err(table.error("growth", message));
    }
    if camera_table.is_none() && move_tables.is_empty() {
        return Err(table.error_here("needs `camera` or [[motion.move]]: what moves"));
    }

    let path = match &camera_table {
        Some(table) => camera_path(table, camera)?,
        None => CameraPath::Still,
    };
    let mut moves: Vec<Move> = Vec::new();
    for table in &move_tables {
        let next = step(table, objects, mirrors)?;
        if moves.iter().any(|other| other.subject == next.subject) {
            return Err(table.error("name", "is moved twice"));
        }
        moves.push(next);
    }
    let motion = Motion {
        frames,
        growth,
        camera: path,
        moves,
    };
    check(&motion, camera, mirrors)
        .map_err(|message| camera_table.as_ref().unwrap_or(table).error_here(message))?;
    Ok(motion)
}

fn camera_path(table: &Table<'_>, camera: &Camera) -> Result<CameraPath, SceneError> {
    let orbit = table.number("orbit_deg")?;
    let eye = table.rows::<3>("eye")?;
    let target = table.rows::<3>("target")?;
    table.finish()?;
    let other = match (&eye, &target) {
        (Some(_), _) => Some("eye"),
        (None, Some(_)) => Some("target"),
        (None, None) => None,
    };
    match (orbit, other) {
        (Some(_), Some(other)) => Err(table.error(
            "orbit_deg",
            format_args!("and `{other}` exclude each other"),
        )),
        (Some(degrees), None) => Ok(CameraPath::Orbit {
            angle: degrees.to_radians(),
        }),
        (None, Some(_)) => {
            let keys = |start: DVec3, rows: Option<Vec<[f64; 3]>>| {
                let rows = rows.into_iter().flatten().map(DVec3::from_array);
                std::iter::once(start).chain(rows).collect()
            };
            Ok(CameraPath::Keys {
                eye: keys(camera.eye, eye),
                target: keys(camera.target, target),
            })
        }
        (None, None) => Err(table.error_here("needs `orbit_deg`, `eye` or `target`")),
    }
}

fn step(table: &Table<'_>, objects: &[Object], mirrors: &[Mirror]) -> Result<Move, SceneError> {
    let name = table.string("name")?;
    let translate = table.vector("translate")?;
    let rotate_deg = table.vector("rotate_deg")?;
    let about = table.vector("about")?;
    table.finish()?;
    let name = table.required("name", name)?;
    let object = objects.iter().position(|object| object.name == name);
    let mirror = mirrors.iter().position(|mirror| mirror.name == name);
    let (subject, middle) = if let Some(index) = object {
        let bounds = objects[index].mesh.bounds();
        let middle = bounds.map_or(DVec3::ZERO, |(low, high)| {
            (low.as_dvec3() + high.as_dvec3()) / 2.0
        });
        (Subject::Object(index), middle)
    } else if let Some(index) = mirror {
        (Subject::Mirror(index), mirrors[index].shape.center())
    } else {
        let names = objects.iter().map(|object| object.name.as_str());
        let names = names.chain(mirrors.iter().map(|mirror| mirror.name.as_str()));
        let suggestion = suggest(name, names);
        let message = format_args!("`{name}` is no object and no mirror{suggestion}");
        return Err(table.error("name", message));
    };
    if translate.is_none() && rotate_deg.is_none() {
        return Err(table.error_here("needs `translate` or `rotate_deg`"));
    }
    if about.is_some() && rotate_deg.is_none() {
        return Err(table.error("about", "needs `rotate_deg`"));
    }
    Ok(Move {
        subject,
        rotate_deg: rotate_deg.unwrap_or(DVec3::ZERO),
        about: about.unwrap_or(middle),
        translate: translate.unwrap_or(DVec3::ZERO),
    })
}

/// The camera must have a direction and stay out of closed mirrors, at every frame.
fn check(motion: &Motion, camera: &Camera, mirrors: &[Mirror]) -> Result<(), String> {
    let closed: Vec<_> = mirrors
        .iter()
        .enumerate()
        .filter(|(_, mirror)| mirror.shape.is_closed())
        .collect();
    let meshes = closed.iter().map(|(_, mirror)| mirror.shape.as_mesh());
    let meshes: Vec<_> = meshes.map(|mesh| mesh.map(Enclosure::new)).collect();
    for frame in 0..motion.frames {
        let time = motion.time(frame);
        let now = motion.camera_at(camera, time);
        let forward = now.target - now.eye;
        if forward.length() < SMALLEST {
            return Err(format!("at frame {frame} the eye is at the target"));
        }
        if forward.normalize().cross(now.up).length() < 1e-6 {
            return Err(format!(
                "at frame {frame} the viewing direction is parallel to the camera's `up`: let the path \
                 pass beside it, or give the camera another `up`"
            ));
        }
        for ((index, mirror), mesh) in closed.iter().zip(&meshes) {
            let eye = motion.pose(Subject::Mirror(*index), time).undone(now.eye);
            let encloses = match mesh {
                Some(mesh) => mesh.holds(eye),
                None => mirror.shape.encloses(eye),
            };
            if encloses {
                let name = &mirror.name;
                return Err(format!(
                    "at frame {frame} the eye lies inside mirror \"{name}\", which is closed"
                ));
            }
        }
    }
    Ok(())
}

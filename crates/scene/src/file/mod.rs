//! Scene files: what each table means.

mod camera;
mod mirror;
mod motion;
mod object;
mod origin;
mod surface;

use std::collections::HashSet;

use crate::document::{Source, Table, parse};
use crate::hash::hash;
use crate::{Object, Scene, SceneError};

pub(crate) use self::origin::Origin;

/// Reads a whole scene.
pub(crate) fn read(text: &str, origin: Origin<'_>) -> Result<Scene, SceneError> {
    let source = Source::new(origin.file, text);
    let document = parse(&source, text)?;
    let root = Table::root(&source, &document);

    let why = root.string("why")?;
    let camera = root.table("camera")?;
    let background = root.table("background")?;
    let object_tables = root.tables("object")?;
    let mirror_tables = root.tables("mirror")?;
    let motion_table = root.table("motion")?;
    root.finish()?;
    let why = root.required("why", why)?;
    if why.trim().is_empty() {
        return Err(root.error("why", "must say what the scene is for"));
    }

    let camera_table = root.required("camera", camera)?;
    let camera = camera::camera(&camera_table, origin.options.resolution)?;
    let background = camera::background(background.as_ref())?;

    let mut names = HashSet::new();
    let mut mirrors = Vec::new();
    let specs = object_tables
        .iter()
        .map(object::spec)
        .collect::<Result<Vec<_>, _>>()?;
    for table in &mirror_tables {
        let mirror = mirror::mirror(table, &origin)?;
        if mirror.shape.contains(camera.eye) {
            let message = format_args!("lies inside {}, which is closed", table.owner());
            return Err(camera_table.error("eye", message));
        }
        mirrors.push(mirror);
    }
    let mut objects = Vec::new();
    for (table, spec) in object_tables.iter().zip(specs) {
        unique(table, &mut names, spec.name())?;
        let (name, mesh) = spec.build(table, &origin, &camera, &mirrors)?;
        objects.push(Object { name, mesh });
    }
    for (table, mirror) in mirror_tables.iter().zip(&mirrors) {
        unique(table, &mut names, &mirror.name)?;
    }

    let motion = motion_table
        .map(|table| motion::motion(&table, &camera, &objects, &mirrors))
        .transpose()?;
    let hash = hash(&camera, &background, &objects, &mirrors);
    Ok(Scene {
        name: origin.name.to_owned(),
        why: why.to_owned(),
        camera,
        background,
        objects,
        mirrors,
        motion,
        hash,
        warnings: origin.loading.into_warnings(),
    })
}

fn unique(table: &Table<'_>, names: &mut HashSet<String>, name: &str) -> Result<(), SceneError> {
    if names.insert(name.to_owned()) {
        return Ok(());
    }
    Err(table.error("name", format_args!("`{name}` is used twice")))
}

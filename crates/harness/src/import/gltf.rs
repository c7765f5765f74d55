//! glTF 2: every mesh of the default scene is a thing of its own.

use std::path::Path;

use catoptric_scene::{Fov, model};

use super::colors;
use super::found::{Choice, Coat, Form, Found, Thing, View};

/// How far away the target of a camera is that only has a direction.
const AHEAD: f64 = 1.0;

/// Reads a file.
pub fn read(path: &Path, choice: &Choice) -> anyhow::Result<Found> {
    let model = model::read(path)?;
    let mut found = Found {
        left_out: model.left_out,
        ..Found::default()
    };
    for camera in model.cameras {
        if found.camera.is_some() {
            found
                .left_out
                .push(format!("camera `{}`: the first one is taken", camera.name));
            continue;
        }
        let height = 480.0;
        let width = camera
            .aspect
            .filter(|aspect| (0.05..=20.0).contains(aspect));
        found.camera = Some(View {
            eye: camera.eye,
            target: camera.eye + AHEAD * camera.forward,
            up: camera.up,
            fov: Fov::Y(camera.fov_y),
            resolution: width.map(|aspect| [(aspect * height).round() as u32, height as u32]),
        });
    }
    for part in model.parts {
        let surface = part.surface;
        let flat = part.mesh.normals.is_empty();
        let coat = match surface.picture {
            Some(source) => Coat::Picture {
                tint: colors::usable(surface.color),
                source,
            },
            None if !part.mesh.colors.is_empty() => Coat::Vertex,
            None => Coat::Color(colors::usable(surface.color)),
        };
        found.things.push(Thing {
            name: part.name,
            material: surface.name,
            is_mirror: surface.metal && surface.roughness <= choice.roughness,
            form: Form::Mesh {
                mesh: part.mesh,
                flat,
            },
            coat,
            group: None,
        });
    }
    Ok(found)
}

//! Shapes as triangles or spheres.

use catoptric_scene::model::{self, Triangles};
use glam::{DMat3, DMat4, DVec3, Vec2};

use super::lexer::Lexer;
use super::params::Params;
use super::reader::{Reader, beside};
use super::surface::Texture;
use crate::import::found::{Coat, Form, Thing};
use crate::import::{colors, shapes};

/// Most triangles of all things together.
const MOST_TRIANGLES: usize = 4_000_000;

/// Triangles of a thing.
pub fn triangles(thing: &Thing) -> usize {
    match &thing.form {
        Form::Mesh { mesh, .. } => mesh.triangles.len(),
        _ => 0,
    }
}

/// Refuses more triangles than a scene may have.
pub fn count(reader: &Reader<'_>, lexer: &Lexer, line: usize, new: usize) -> anyhow::Result<()> {
    let all: usize = reader.found.things.iter().map(triangles).sum();
    if new > 0 && all + new > MOST_TRIANGLES {
        let message = format!(
            "makes {} triangles in the scene: the most is {MOST_TRIANGLES}",
            all + new
        );
        return Err(lexer.error(line, message));
    }
    Ok(())
}

/// A form under a further map.
pub fn moved(form: Form, matrix: &DMat4) -> Form {
    match form {
        Form::Mesh { mut mesh, flat } => {
            mesh.transform(matrix);
            Form::Mesh { mesh, flat }
        }
        Form::Sphere { center, radius } => shapes::sphere(center, radius, matrix),
        Form::Ellipsoid { center, axes } => {
            let mut own = DMat4::from_mat3(axes);
            own.w_axis = center.extend(1.0);
            shapes::sphere(DVec3::ZERO, 1.0, &(*matrix * own))
        }
        Form::Rectangle { center, axes } => {
            let mut own = DMat4::from_mat3(DMat3::from_cols(axes.x_axis, axes.y_axis, axes.z_axis));
            own.w_axis = center.extend(1.0);
            shapes::rectangle(&(*matrix * own))
        }
    }
}

impl Reader<'_> {
    pub(super) fn shape(
        &mut self,
        lexer: &Lexer,
        kind: &str,
        params: &Params,
    ) -> anyhow::Result<()> {
        self.shapes += 1;
        let line = params.line;
        if self.state.material.is_invisible && self.state.light.is_none() {
            self.leave_out(
                lexer,
                line,
                &format!("the shape `{kind}`, whose material shows nothing"),
            );
            return Ok(());
        }
        if self.state.matrix.determinant().abs() < f64::MIN_POSITIVE {
            return Err(lexer.error(line, "the transform cannot be undone"));
        }
        let mut name = format!("{kind} {}", self.shapes);
        let Some(mut form) = self.form(lexer, kind, params, &mut name)? else {
            return Ok(());
        };
        let material = self.state.material.clone();
        let color = match self.state.light {
            Some(light) => Texture::Color(light),
            None => material.color,
        };
        let coat = painted(color, &mut form);
        if let Form::Mesh { mesh, .. } = &mut form
            && self.state.reversed
        {
            mesh.turn_over();
            for normal in mesh.normals.as_flattened_mut() {
                *normal = -*normal;
            }
        }
        // In an object, its own space is the one that it began in.
        let matrix = match &self.within {
            Some((_, began)) => began.inverse() * self.state.matrix,
            None => self.state.matrix,
        };
        let form = moved(form, &matrix);
        let thing = Thing {
            name,
            material: material.name,
            is_mirror: material.is_mirror && self.state.light.is_none(),
            form,
            coat,
            group: None,
        };
        count(self, lexer, line, triangles(&thing))?;
        self.add(thing);
        Ok(())
    }

    /// A shape in its own space; `None` of a kind that is left out.
    fn form(
        &mut self,
        lexer: &Lexer,
        kind: &str,
        params: &Params,
        name: &mut String,
    ) -> anyhow::Result<Option<Form>> {
        let line = params.line;
        Ok(Some(match kind {
            "sphere" => {
                let radius = params.number(lexer, "radius", 1.0)?;
                if radius <= 0.0 {
                    return Err(
                        lexer.error(line, format!("`radius` must be above 0, not {radius}"))
                    );
                }
                for part in ["zmin", "zmax", "phimax"] {
                    if params.has(part) {
                        self.leave_out(
                            lexer,
                            line,
                            &format!("`{part}` of a sphere, which is whole"),
                        );
                    }
                }
                if self.state.reversed {
                    let mut mesh = shapes::ball(false);
                    mesh.transform(&DMat4::from_scale(DVec3::splat(radius)));
                    self.leave_out(
                        lexer,
                        line,
                        "the roundness of a sphere seen from inside; it has triangles",
                    );
                    return Ok(Some(Form::Mesh { mesh, flat: false }));
                }
                Form::Sphere {
                    center: DVec3::ZERO,
                    radius,
                }
            }
            "disk" => {
                let radius = params.number(lexer, "radius", 1.0)?;
                let height = params.number(lexer, "height", 0.0)?;
                if radius <= 0.0 {
                    return Err(
                        lexer.error(line, format!("`radius` must be above 0, not {radius}"))
                    );
                }
                for part in ["innerradius", "phimax"] {
                    if params.has(part) {
                        self.leave_out(lexer, line, &format!("`{part}` of a disk, which is whole"));
                    }
                }
                let mut mesh = shapes::disk();
                mesh.transform(&DMat4::from_scale_rotation_translation(
                    DVec3::new(radius, radius, 1.0),
                    glam::DQuat::IDENTITY,
                    DVec3::new(0.0, 0.0, height),
                ));
                Form::Mesh { mesh, flat: true }
            }
            "trianglemesh" => written(lexer, params, 3)?,
            "bilinearmesh" => written(lexer, params, 4)?,
            "loopsubdiv" => {
                self.leave_out(
                    lexer,
                    line,
                    "the subdivision of a `loopsubdiv`; its control mesh stands for it",
                );
                match written(lexer, params, 3)? {
                    Form::Mesh { mesh, .. } => Form::Mesh { mesh, flat: false },
                    other => other,
                }
            }
            "plymesh" => {
                let Some(file) = params.word("filename") else {
                    let hint = params.nearest("filename");
                    return Err(lexer.error(line, format!("plymesh has no `filename`{hint}")));
                };
                if file.to_ascii_lowercase().ends_with(".gz") {
                    self.leave_out(lexer, line, &format!("the packed mesh `{file}`: unpack it"));
                    return Ok(None);
                }
                let path = beside(lexer, file);
                if !path.is_file() {
                    return Err(lexer.error(line, format!("there is no file {}", path.display())));
                }
                if let Some(stem) = path.file_stem() {
                    *name = stem.to_string_lossy().into_owned();
                }
                for part in ["displacement", "alpha"] {
                    if params.has(part) {
                        self.leave_out(lexer, line, &format!("`{part}` of `{file}`"));
                    }
                }
                let mut model = model::read(&path)?;
                self.found.left_out.append(&mut model.left_out);
                let mesh = model.parts.pop().map(|part| part.mesh).unwrap_or_default();
                let flat = mesh.normals.is_empty();
                Form::Mesh { mesh, flat }
            }
            other => {
                self.leave_out(lexer, line, &format!("the shape `{other}`"));
                return Ok(None);
            }
        }))
    }
}

/// A mesh whose corners stand in the file, `corners` a face.
fn written(lexer: &Lexer, params: &Params, corners: usize) -> anyhow::Result<Form> {
    let line = params.line;
    let positions = params.vectors(lexer, "P")?;
    if positions.is_empty() {
        let hint = params.nearest("P");
        return Err(lexer.error(line, format!("the mesh has no `P`{hint}")));
    }
    let mut indices = params.indices(lexer, "indices")?;
    if indices.is_empty() {
        if positions.len() != corners {
            return Err(lexer.error(line, "the mesh has no `indices`"));
        }
        indices = (0..corners as u32).collect();
    }
    if indices.len() % corners != 0 {
        let message = format!(
            "`indices` has {} numbers, no multiple of {corners}",
            indices.len()
        );
        return Err(lexer.error(line, message));
    }
    if let Some(index) = indices
        .iter()
        .find(|index| **index as usize >= positions.len())
    {
        let message = format!(
            "`indices` has {index}, but there are {} points from 0",
            positions.len()
        );
        return Err(lexer.error(line, message));
    }
    let faces = indices.chunks_exact(corners);
    let triangles: Vec<[u32; 3]> = match corners {
        3 => faces.map(|face| [face[0], face[1], face[2]]).collect(),
        // Corners of a patch stand row by row.
        _ => faces
            .flat_map(|face| [[face[0], face[1], face[3]], [face[0], face[3], face[2]]])
            .collect(),
    };
    let normals = params.vectors(lexer, "N")?;
    let mut uvs = params.pairs(lexer, "uv")?;
    if uvs.is_empty() {
        uvs = params.pairs(lexer, "st")?;
    }
    for (given, what) in [(normals.len(), "N"), (uvs.len(), "uv")] {
        if given != 0 && given != positions.len() {
            let message = format!(
                "`{what}` has {given} entries for {} points",
                positions.len()
            );
            return Err(lexer.error(line, message));
        }
    }
    let of = |three: &[u32; 3]| three.map(|index| index as usize);
    let mut mesh = Triangles {
        positions,
        ..Triangles::default()
    };
    if !normals.is_empty() {
        mesh.normals = triangles
            .iter()
            .map(|three| of(three).map(|at| normals[at]))
            .collect();
    }
    if !uvs.is_empty() {
        mesh.uvs = triangles
            .iter()
            .map(|three| of(three).map(|at| uvs[at]))
            .collect();
    }
    mesh.triangles = triangles;
    let flat = mesh.normals.is_empty();
    Ok(Form::Mesh { mesh, flat })
}

/// What a form shows, its texture coordinates moved as the texture wants.
fn painted(color: Texture, form: &mut Form) -> Coat {
    let Form::Mesh { mesh, .. } = form else {
        return Coat::Color(colors::usable(color.mean()));
    };
    if mesh.uvs.is_empty() {
        return Coat::Color(colors::usable(color.mean()));
    }
    match color {
        Texture::Color(color) => Coat::Color(color),
        Texture::Checker { a, b, cells } => Coat::Checker { a, b, cells },
        Texture::Picture {
            tint,
            source,
            scale,
            offset,
        } => {
            for uv in mesh.uvs.as_flattened_mut() {
                *uv = *uv * Vec2::from(scale) + Vec2::from(offset);
            }
            Coat::Picture { tint, source }
        }
    }
}

//! `[[object]]`.

use glam::{DVec3, Vec3};

use super::origin::{Origin, name};
use super::surface::{PRIMITIVES, Surface, copies, find, primitive};
use crate::document::Table;
use crate::geometry::{Geometry, Purpose, Transform};
use crate::mesh::{Material, Mesh, Paint};
use crate::mtl::DEFAULT_COLOR;
use crate::primitives::{Inverse, inverse_points};
use crate::suggest::suggest;
use crate::{Camera, Mirror, SceneError};

/// An object as written, checked but not built.
pub(super) struct Spec {
    name: String,
    form: Form,
    paint: Option<Paint>,
    /// A picture of its colour, and what that is multiplied by.
    texture: Option<(String, Vec3)>,
    copies: Vec<Transform>,
}

enum Form {
    Surface(Surface),
    Points(Vec<DVec3>),
    Inverse {
        inverse: Inverse,
        mirror: Option<String>,
    },
}

/// Reads an object's keys.
pub(super) fn spec(table: &Table<'_>) -> Result<Spec, SceneError> {
    let name = name(table)?;
    let mesh = table.string("mesh")?;
    let shape = table.string("shape")?;
    let color = table.color("color")?;
    let checker = table.table("checker")?;
    let vertex_colors = table.boolean("vertex_colors")?.filter(|wanted| *wanted);
    let texture = table.string("texture")?.map(str::to_owned);
    let copies = copies(table)?;
    let form = match (mesh, shape) {
        (Some(_), Some(_)) => return Err(table.error("mesh", "and `shape` exclude each other")),
        (Some(file), None) => {
            let mtl = table.string("mtl")?.map(str::to_owned);
            Some(Form::Surface(Surface::Mesh {
                file: file.to_owned(),
                mtl,
            }))
        }
        (None, Some("points")) => Some(points(table)?),
        (None, Some(shape)) => match primitive(table, shape)? {
            Some(surface) => Some(Form::Surface(surface)),
            None => {
                let known = PRIMITIVES.into_iter().chain(["points"]);
                let suggestion = suggest(shape, known.clone());
                let known = known.collect::<Vec<_>>().join(", ");
                let message = format_args!("`{shape}` is unknown{suggestion}; known: {known}");
                return Err(table.error("shape", message));
            }
        },
        (None, None) => None,
    };
    table.finish()?;
    let Some(form) = form else {
        return Err(table.error_here(format_args!(
            "needs `shape = \"…\"` (one of {}, points) or `mesh = \"FILE.obj\"`",
            PRIMITIVES.join(", ")
        )));
    };

    let mut paints = Vec::new();
    if texture.is_none() {
        paints.extend(color.map(|color| ("color", Paint::Color(color))));
    }
    if let Some(checker) = checker {
        paints.push(("checker", paint_checker(&checker)?));
    }
    paints.extend(vertex_colors.map(|_| ("vertex_colors", Paint::Vertex)));
    if let (Form::Surface(Surface::Triangles { colors, .. }), Some((first, _))) =
        (&form, paints.first())
        && !colors.is_empty()
    {
        return Err(table.error("colors", format_args!("and `{first}` exclude each other")));
    }
    if let (Some(_), Some((other, _))) = (&texture, paints.first()) {
        return Err(table.error("texture", format_args!("and `{other}` exclude each other")));
    }
    if let [(first, _), (second, _), ..] = paints.as_slice() {
        return Err(table.error(first, format_args!("and `{second}` exclude each other")));
    }
    let paint = paints.pop().map(|(_, paint)| paint);
    Ok(Spec {
        name,
        form,
        paint,
        texture: texture.map(|file| (file, color.unwrap_or(Vec3::ONE))),
        copies,
    })
}

fn paint_checker(table: &Table<'_>) -> Result<Paint, SceneError> {
    let a: Option<Vec3> = table.color("a")?;
    let b = table.color("b")?;
    let cells = table.count("cells", 1..=65536)?.unwrap_or(8);
    table.finish()?;
    Ok(Paint::Checker {
        a: table.required("a", a)?,
        b: table.required("b", b)?,
        cells,
    })
}

fn points(table: &Table<'_>) -> Result<Form, SceneError> {
    let positions = table.rows::<3>("positions")?;
    let count = table.count("count", 1..=10_000_000)?;
    let seed = table.count("seed", 0..=u32::MAX)?;
    let t = table.numbers::<2>("t")?;
    let mirror = table.string("mirror")?;
    match (positions, count) {
        (Some(_), Some(_)) => Err(table.error("count", "and `positions` exclude each other")),
        (Some(_), None) if seed.is_some() || t.is_some() || mirror.is_some() => {
            Err(table.error("positions", "does not go with `seed`, `t` and `mirror`"))
        }
        (Some(positions), None) if positions.is_empty() => {
            Err(table.error("positions", "must not be empty"))
        }
        (Some(positions), None) => Ok(Form::Points(
            positions.into_iter().map(DVec3::from_array).collect(),
        )),
        (None, None) if seed.is_none() && t.is_none() && mirror.is_none() => {
            // A key that nobody knows says more than those that are missing.
            table.finish()?;
            Err(table.error_here(
                "`shape = \"points\"` needs `positions = [[x, y, z], …]`, or `count = N` for so many points that \
                 a mirror reflects",
            ))
        }
        (None, count) => {
            let count = table.required("count", count)?;
            let distance = t.unwrap_or([0.05, 8.0]);
            if distance[0] <= 0.0 || distance[1] < distance[0] {
                return Err(table.error("t", "must be two distances above 0, the least first"));
            }
            let seed = u64::from(seed.unwrap_or(1));
            let inverse = Inverse {
                count,
                seed,
                distance,
            };
            Ok(Form::Inverse {
                inverse,
                mirror: mirror.map(str::to_owned),
            })
        }
    }
}

impl Spec {
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The object's name and its world-space mesh.
    pub(super) fn build(
        self,
        table: &Table<'_>,
        origin: &Origin<'_>,
        camera: &Camera,
        mirrors: &[Mirror],
    ) -> Result<(String, Mesh), SceneError> {
        let copies = self.copies.len();
        let counted = |key: &str, count: u64| {
            (origin.loading.points(count, copies)).map_err(|message| table.error(key, message))
        };
        let mut geometry = match &self.form {
            Form::Surface(surface) => {
                let painted = self.paint.is_some() || self.texture.is_some();
                surface.geometry(table, origin, painted, copies)?
            }
            Form::Points(positions) => {
                counted("positions", positions.len() as u64)?;
                Geometry {
                    positions: positions.clone(),
                    ..Geometry::default()
                }
            }
            Form::Inverse { inverse, mirror } => {
                counted("count", u64::from(inverse.count))?;
                let which = chosen(table, mirror.as_deref(), mirrors)?;
                let positions = inverse_points(inverse, camera, mirrors, which)
                    .map_err(|message| table.error("count", format_args!("points: {message}")))?;
                Geometry {
                    positions,
                    ..Geometry::default()
                }
            }
        };
        let is_mesh = matches!(self.form, Form::Surface(Surface::Mesh { .. }));
        let mut this = self;
        if let Some((file, tint)) = &this.texture {
            let path = find(table, "texture", file, origin)?;
            let image = origin.loading.texture(&path).map_err(|message| {
                table.error("texture", format_args!("{} {message}", path.display()))
            })?;
            if geometry.uvs.is_empty() {
                return Err(table.error("texture", "needs texture coordinates, which it has not"));
            }
            let tint = *tint;
            this.paint = Some(Paint::Texture { tint, image });
        }
        this.paint(table, &mut geometry, is_mesh)?;
        let mesh = geometry
            .into_mesh(&this.copies, Purpose::Object)
            .map_err(|message| table.error_here(message))?;
        let no_points = !matches!(this.form, Form::Surface(_));
        if mesh.triangles.is_empty() && !no_points {
            return Err(table.error_here("the mesh is empty: no triangle with area"));
        }
        Ok((this.name, mesh))
    }

    fn paint(
        &self,
        table: &Table<'_>,
        geometry: &mut Geometry,
        is_mesh: bool,
    ) -> Result<(), SceneError> {
        match self.paint {
            Some(Paint::Checker { .. }) if geometry.uvs.is_empty() => {
                return Err(table.error("checker", "needs texture coordinates, which it has not"));
            }
            Some(Paint::Vertex) if is_mesh && geometry.colors.is_empty() => {
                return Err(table.error("vertex_colors", "needs a mesh with vertex colours"));
            }
            Some(Paint::Vertex) if !is_mesh => geometry.color_by_position(),
            Some(Paint::Vertex) => {}
            _ => geometry.colors.clear(),
        }
        if self.paint.is_some() || geometry.materials.is_empty() {
            let paint = self.paint.clone().unwrap_or(Paint::Color(DEFAULT_COLOR));
            geometry.materials = vec![Material {
                name: self.name.clone(),
                paint,
            }];
            geometry.material.clear();
        }
        Ok(())
    }
}

/// Index of the mirror named, else of the first.
fn chosen(table: &Table<'_>, name: Option<&str>, mirrors: &[Mirror]) -> Result<usize, SceneError> {
    let Some(index) = (match name {
        Some(name) => mirrors.iter().position(|mirror| mirror.name == name),
        None => (!mirrors.is_empty()).then_some(0),
    }) else {
        let names = mirrors.iter().map(|mirror| mirror.name.as_str());
        return Err(match name {
            Some(name) => table.error(
                "mirror",
                format_args!("`{name}` is no mirror{}", suggest(name, names)),
            ),
            None => table.error("count", "needs a mirror in the scene"),
        });
    };
    if mirrors[index].shape.is_analytic() {
        return Ok(index);
    }
    let key = if name.is_some() { "mirror" } else { "count" };
    Err(table.error(key, "needs an analytic mirror, not a mesh"))
}

//! Mitsuba 3's XML: what we export, and the common rest of shapes and materials.

mod materials;
mod nodes;
mod ours;
mod reader;

use std::collections::HashMap;
use std::path::Path;

use catoptric_scene::Background;
use catoptric_scene::model;
use glam::{DMat4, DVec3, Vec3};
use roxmltree::Node;

use super::cameras::{self, Axis, looking_along_z};
use super::found::{Choice, Coat, Form, Found, Thing, View};
use super::{shapes, sheets};

use self::materials::Material;
use self::nodes::{File, Files, child, children, name_of, normalized, read_all};
use self::reader::{DEEPEST, GRAY, Reader, turn_v};

/// Reads a file and those that it includes.
pub fn read(path: &Path, choice: &Choice) -> anyhow::Result<Found> {
    let mut found = Found::default();
    let texts = read_all(path)?;
    let files = Files::new(&texts)?;
    let ours = ours::beside(path)?;
    let mut reader = Reader {
        choice,
        ours: ours.as_ref(),
        found: &mut found,
        defaults: HashMap::new(),
        shapes: 0,
    };
    reader.file(files.first(), 0)?;
    Ok(found)
}

impl Reader<'_> {
    fn file(&mut self, file: File<'_>, depth: usize) -> anyhow::Result<()> {
        for node in children(file.root()) {
            self.node(file, node, depth)?;
        }
        Ok(())
    }

    fn node<'f>(&mut self, file: File<'f>, node: Node<'f, 'f>, depth: usize) -> anyhow::Result<()> {
        match node.tag_name().name() {
            "default" => {
                let (name, value) = (
                    file.attribute(node, "name")?,
                    file.attribute(node, "value")?,
                );
                self.defaults
                    .entry(name.to_owned())
                    .or_insert_with(|| value.to_owned());
            }
            "include" => {
                if depth > DEEPEST {
                    return Err(file.error(node, "files include each other without end"));
                }
                let name = self.said(file, node, "filename")?;
                let included = file.included(&name);
                let included = included
                    .ok_or_else(|| file.error(node, &format!("there is no file `{name}`")))?;
                self.file(included, depth + 1)?;
            }
            "sensor" => self.sensor(file, node)?,
            "emitter" => self.emitter(file, node)?,
            "shape" => self.shape(file, node, &DMat4::IDENTITY, None, 0)?,
            "integrator" | "bsdf" | "texture" | "sampler" | "film" | "path" | "alias" => {}
            _ => self.leave_out(file, node, ""),
        }
        Ok(())
    }

    fn sensor<'f>(&mut self, file: File<'f>, node: Node<'f, 'f>) -> anyhow::Result<()> {
        let kind = node.attribute("type").unwrap_or_default();
        if !["perspective", "thinlens"].contains(&kind) {
            self.leave_out(file, node, "");
            return Ok(());
        }
        if self.found.camera.is_some() {
            self.leave_out(file, node, ": the first one is taken");
            return Ok(());
        }
        if kind == "thinlens" {
            self.leave_out(file, node, ": its blur; it is taken for `perspective`");
        }
        let mut size = [768.0, 576.0];
        if let Some(film) = children(node).find(|child| child.has_tag_name("film")) {
            for (place, name) in ["width", "height"].into_iter().enumerate() {
                if let Some(number) = self.number(file, film, name)? {
                    size[place] = number.round().clamp(1.0, 16384.0);
                }
            }
        }
        let axis = match self.text(file, node, "fov_axis")?.as_deref() {
            None | Some("x") => Axis::X,
            Some("y") => Axis::Y,
            Some("smaller") => Axis::Smaller,
            Some("larger") => Axis::Larger,
            Some("diagonal") => Axis::Diagonal,
            Some(other) => return Err(file.error(node, &format!("there is no fov_axis `{other}`"))),
        };
        let (degrees, axis) = match self.number(file, node, "fov")? {
            Some(degrees) => (degrees, axis),
            None => {
                let length = self.text(file, node, "focal_length")?;
                let length = length.unwrap_or_else(|| "50mm".to_owned());
                let millimetres = length.trim().trim_end_matches("mm").trim().parse::<f64>();
                let Some(millimetres) = millimetres.ok().filter(|mm| *mm > 0.0) else {
                    return Err(file.error(node, &format!("`{length}` is no focal length")));
                };
                // Half the diagonal of a film of 36 by 24 millimetres.
                let half = 36.0_f64.hypot(24.0) / 2.0;
                (
                    2.0 * (half / millimetres).atan().to_degrees(),
                    Axis::Diagonal,
                )
            }
        };
        if !(degrees > 0.0 && degrees < 180.0) {
            return Err(file.error(
                node,
                &format!("its `fov` must be between 0 and 180, not {degrees}"),
            ));
        }
        let to_world = self.transform(file, node, "to_world")?;
        let Some((eye, forward, up, mirrored)) = looking_along_z(&to_world) else {
            return Err(file.error(node, "its transform cannot be undone"));
        };
        if mirrored {
            self.leave_out(
                file,
                node,
                ": that it shows the picture mirrored, left to right",
            );
        }
        // Where the file says it, what it looks at: the numbers come back as they were.
        let said = self.look_at(file, node)?;
        let (eye, target, up) = said.unwrap_or((eye, eye + forward, up));
        self.found.camera = Some(View {
            eye,
            target,
            up,
            fov: cameras::fov(degrees, axis, size),
            resolution: Some(size.map(|side| side as u32)),
        });
        Ok(())
    }

    /// Eye, target and up, where the transform is one `lookat` and nothing else.
    fn look_at<'f>(
        &self,
        file: File<'f>,
        of: Node<'f, 'f>,
    ) -> anyhow::Result<Option<(DVec3, DVec3, DVec3)>> {
        let node = child(of, "to_world");
        let steps: Vec<_> = node
            .iter()
            .flat_map(|node| node.children().filter(Node::is_element))
            .collect();
        let [step] = steps[..] else { return Ok(None) };
        if normalized(step.tag_name().name()) != "look_at" && !step.has_tag_name("lookat") {
            return Ok(None);
        }
        let at = |key| self.vector(file, step, step.attribute(key).unwrap_or("0, 1, 0"));
        Ok(Some((at("origin")?, at("target")?, at("up")?)))
    }

    fn emitter<'f>(&mut self, file: File<'f>, node: Node<'f, 'f>) -> anyhow::Result<()> {
        match node.attribute("type") {
            Some("constant") => {
                let radiance = child(node, "radiance");
                let color = match radiance {
                    Some(radiance) => self.color(file, radiance)?,
                    None => Some(Vec3::ONE),
                };
                let color = super::colors::usable(color.unwrap_or(Vec3::ONE));
                self.found.background = Some(Background::Color(color));
            }
            Some("envmap") => {
                let name = self.text(file, node, "filename")?.unwrap_or_default();
                let gradient = match self.ours {
                    Some(_) => ours::gradient(&file.find(&name))?,
                    None => None,
                };
                match gradient {
                    Some(gradient) => self.found.background = Some(gradient),
                    None => self.leave_out(
                        file,
                        node,
                        ": a background has one colour here, or a gradient",
                    ),
                }
            }
            _ => self.leave_out(
                file,
                node,
                ": surfaces show their own colour here, without lights",
            ),
        }
        Ok(())
    }

    /// A shape under a transform, `within` the instance of this name.
    fn shape<'f>(
        &mut self,
        file: File<'f>,
        node: Node<'f, 'f>,
        above: &DMat4,
        within: Option<&str>,
        depth: usize,
    ) -> anyhow::Result<()> {
        let kind = node.attribute("type").unwrap_or_default();
        match kind {
            // Shown by its instances.
            "shapegroup" => return Ok(()),
            "instance" => {
                if depth > DEEPEST {
                    return Err(file.error(node, "groups are in each other without end"));
                }
                let matrix = *above * self.transform(file, node, "to_world")?;
                let groups = children(node)
                    .filter(|child| child.has_tag_name("ref") || child.has_tag_name("shape"));
                for group in groups {
                    let Some((of, inner)) = file.resolved(group) else {
                        return Err(file.error(group, "nothing has this id"));
                    };
                    for shape in children(inner).filter(|child| child.has_tag_name("shape")) {
                        self.shape(of, shape, &matrix, node.attribute("id"), depth + 1)?;
                    }
                }
                return Ok(());
            }
            _ => {}
        }
        self.shapes += 1;
        let id = node.attribute("id").map(str::to_owned);
        let name = self.shape_name(file, node, within)?;
        let matrix = *above * self.transform(file, node, "to_world")?;
        if matrix.determinant().abs() < f64::MIN_POSITIVE || !matrix.is_finite() {
            return Err(file.error(node, "its transform cannot be undone"));
        }
        let material = self.material(file, node)?;
        let flipped = self.flag(file, node, "flip_normals")?;
        let Some(mut form) = self.form(file, node, kind, &matrix)? else {
            return Ok(());
        };
        if flipped {
            form = turned_over(form);
        }
        if material.two_sided {
            self.leave_out(
                file,
                node,
                ": that both its sides reflect; the outer one does",
            );
        }
        let entry = id
            .as_deref()
            .and_then(|id| self.ours.and_then(|ours| ours.of(id)));
        if !material.is_mirror {
            // In triangles it can be painted, and seen from both sides.
            if matches!(form, Form::Rectangle { .. }) {
                form = shapes::mesh(shapes::square(), &matrix);
            }
            if let (Form::Mesh { mesh, .. }, Some(_)) = (&mut form, self.ours) {
                sheets::join(mesh);
            }
        }
        if let (false, Some(coat)) = (material.is_mirror, &material.coat) {
            let lacking = match &form {
                Form::Mesh { mesh, .. } => coat.lacks(mesh),
                _ if coat.is_plain() => None,
                _ => Some("texture coordinates"),
            };
            if let Some(lacking) = lacking {
                let why = format!(": its texture; it has one colour, since it has no {lacking}");
                self.leave_out(file, node, &why);
            }
        }
        let coat = match (material.coat, &mut form) {
            (Some(coat), Form::Mesh { mesh, .. }) => coat.lay(mesh),
            (Some(coat), _) => coat.color(),
            (None, Form::Mesh { mesh, .. }) if !mesh.colors.is_empty() => Coat::Vertex,
            (None, _) => Coat::Color(GRAY),
        };
        self.found.things.push(Thing {
            name: entry.map_or(name, |entry| entry.name.clone()),
            material: material.name,
            is_mirror: material.is_mirror,
            form,
            coat,
            group: entry.map(|entry| format!("{} {}", entry.kind, entry.id)),
        });
        Ok(())
    }

    fn shape_name<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        within: Option<&str>,
    ) -> anyhow::Result<String> {
        let stem = || -> anyhow::Result<Option<String>> {
            let name = self.text(file, node, "filename")?;
            Ok(name.and_then(|name| {
                let stem = Path::new(&name).file_stem()?;
                Some(stem.to_string_lossy().into_owned())
            }))
        };
        Ok(match (node.attribute("id"), within) {
            (Some(id), _) => id.to_owned(),
            (None, Some(within)) => within.to_owned(),
            (None, None) => match stem()? {
                Some(stem) => stem,
                None => format!(
                    "{} {}",
                    node.attribute("type").unwrap_or_default(),
                    self.shapes
                ),
            },
        })
    }

    /// Where a shape is; `None` of a kind that is left out.
    fn form<'f>(
        &mut self,
        file: File<'f>,
        node: Node<'f, 'f>,
        kind: &str,
        matrix: &DMat4,
    ) -> anyhow::Result<Option<Form>> {
        Ok(Some(match kind {
            "sphere" => {
                let center = match child(node, "center") {
                    Some(point) => self.xyz(file, point, 0.0)?,
                    None => DVec3::ZERO,
                };
                let radius = self.number(file, node, "radius")?.unwrap_or(1.0);
                if radius <= 0.0 {
                    return Err(
                        file.error(node, &format!("its radius must be above 0, not {radius}"))
                    );
                }
                shapes::sphere(center, radius, matrix)
            }
            "rectangle" => shapes::rectangle(matrix),
            "cube" => shapes::mesh(shapes::cube(), matrix),
            "disk" => {
                self.leave_out(file, node, ": its round edge; it has 128 corners");
                shapes::mesh(shapes::disk(), matrix)
            }
            "obj" | "ply" => {
                let name = self.text(file, node, "filename")?;
                let name = name.ok_or_else(|| file.error(node, "has no `filename`"))?;
                let path = file.find(&name);
                if !path.is_file() {
                    return Err(file.error(node, &format!("there is no file {}", path.display())));
                }
                let wanted = format!(".{kind}");
                if !name.to_ascii_lowercase().ends_with(&wanted) {
                    return Err(file.error(node, &format!("`{name}` does not end in {wanted}")));
                }
                let mut model = model::read(&path)?;
                self.found.left_out.append(&mut model.left_out);
                let flat = self.flag(file, node, "face_normals")?;
                let mut mesh = model.parts.pop().map(|part| part.mesh).unwrap_or_default();
                if flat {
                    mesh.normals.clear();
                }
                // Of OBJ files Mitsuba turns v by itself, of others where it is told so.
                let turns = match child(node, "flip_tex_coords") {
                    Some(_) => self.flag(file, node, "flip_tex_coords")?,
                    None => kind == "obj",
                };
                if turns {
                    turn_v(&mut mesh);
                }
                mesh.transform(matrix);
                Form::Mesh { mesh, flat }
            }
            _ => {
                self.leave_out(file, node, ": there is no such shape here");
                return Ok(None);
            }
        }))
    }
}

/// The same surface seen from behind.
fn turned_over(form: Form) -> Form {
    match form {
        Form::Mesh { mut mesh, flat } => {
            mesh.turn_over();
            for normal in mesh.normals.as_flattened_mut() {
                *normal = -*normal;
            }
            Form::Mesh { mesh, flat }
        }
        Form::Rectangle { center, mut axes } => {
            axes.x_axis = -axes.x_axis;
            axes.z_axis = -axes.z_axis;
            Form::Rectangle { center, axes }
        }
        Form::Sphere { center, radius } => inside_out(DMat4::from_scale_rotation_translation(
            DVec3::splat(radius),
            glam::DQuat::IDENTITY,
            center,
        )),
        Form::Ellipsoid { center, axes } => {
            let mut matrix = DMat4::from_mat3(axes);
            matrix.w_axis = center.extend(1.0);
            inside_out(matrix)
        }
    }
}

/// The inside of a sphere, in triangles.
fn inside_out(matrix: DMat4) -> Form {
    let mut mesh = shapes::ball(true);
    mesh.transform(&matrix);
    Form::Mesh { mesh, flat: false }
}

impl Reader<'_> {
    /// The material of a shape: its own, or the one that it refers to.
    fn material<'f>(&mut self, file: File<'f>, shape: Node<'f, 'f>) -> anyhow::Result<Material> {
        let mut material = Material::default();
        for part in children(shape) {
            let Some((file, node)) = file.resolved(part) else {
                return Err(file.error(part, "nothing has this id"));
            };
            match node.tag_name().name() {
                "bsdf" => {
                    let name = name_of(node).unwrap_or_default().to_owned();
                    let made = materials::read(self, file, node, 0)?;
                    material = Material {
                        name,
                        coat: material.coat.clone().or(made.coat),
                        is_mirror: made.is_mirror && !material.shines,
                        shines: material.shines,
                        two_sided: made.two_sided && made.is_mirror && !material.shines,
                    };
                }
                "emitter" => {
                    material.shines = true;
                    material.is_mirror = false;
                    material.two_sided = false;
                    let radiance = child(node, "radiance");
                    let coat = match radiance {
                        Some(radiance) => materials::coat(self, file, radiance, 0)?,
                        None => None,
                    };
                    material.coat = coat.or(material.coat);
                }
                _ => {}
            }
        }
        Ok(material)
    }
}

//! Mitsuba 3's XML: what we export, and the common rest of shapes and materials.

mod materials;
mod nodes;
mod ours;

use std::collections::HashMap;
use std::path::Path;

use catoptric_scene::Background;
use catoptric_scene::model::{self, Triangles};
use glam::{DMat4, DVec3, Vec2, Vec3};
use roxmltree::Node;

use super::cameras::{self, Axis, looking_along_z};
use super::{Choice, Coat, Form, Found, Thing, View, shapes, sheets};
use crate::exit::bad_input;

use self::materials::Material;
use self::nodes::{File, Files, child, children, line, name_of, normalized, read_all};

/// Deepest nesting of what is followed: groups, materials in materials, files.
const DEEPEST: usize = 16;

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

struct Reader<'r> {
    choice: &'r Choice,
    /// What our exporter wrote beside the scene.
    ours: Option<&'r ours::Ids>,
    found: &'r mut Found,
    /// Values of `$names`.
    defaults: HashMap<String, String>,
    /// Shapes met so far.
    shapes: usize,
}

impl Reader<'_> {
    fn file(&mut self, file: File<'_>, depth: usize) -> anyhow::Result<()> {
        for node in children(file.root()) {
            self.node(file, node, depth)?;
        }
        Ok(())
    }

    fn leave_out<'f>(&mut self, file: File<'f>, node: Node<'f, 'f>, why: &str) {
        let line = line(node);
        let mut what = format!("<{}>", node.tag_name().name());
        for key in ["type", "id", "name"] {
            if let Some(value) = node.attribute(key) {
                what += &format!(" {key} `{value}`");
            }
        }
        let of = file
            .path()
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        let said = format!("{what} of {of}, line {line}{why}");
        self.found.left_out.push(said);
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

    /// An attribute with its `$names` replaced.
    fn said<'f>(&self, file: File<'f>, node: Node<'f, 'f>, key: &str) -> anyhow::Result<String> {
        let text = file.attribute(node, key)?;
        self.replaced(file, node, text)
    }

    fn replaced<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        text: &str,
    ) -> anyhow::Result<String> {
        if !text.contains('$') {
            return Ok(text.to_owned());
        }
        let text = substituted(text, &self.defaults);
        match text.find('$') {
            None => Ok(text),
            Some(at) => Err(file.error(node, &format!("`{}` has no <default>", &text[at..]))),
        }
    }

    /// The number of a parameter; `None` where it is not there.
    fn number<'f>(
        &self,
        file: File<'f>,
        of: Node<'f, 'f>,
        name: &str,
    ) -> anyhow::Result<Option<f64>> {
        let Some(node) = child(of, name) else {
            return Ok(None);
        };
        let text = self.said(file, node, "value")?;
        let number = text
            .trim()
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite());
        let message = format!("`{name}` must be a finite number, not `{text}`");
        number.map(Some).ok_or_else(|| file.error(node, &message))
    }

    fn flag<'f>(&self, file: File<'f>, of: Node<'f, 'f>, name: &str) -> anyhow::Result<bool> {
        let Some(node) = child(of, name) else {
            return Ok(false);
        };
        Ok(self
            .said(file, node, "value")?
            .trim()
            .eq_ignore_ascii_case("true"))
    }

    /// A text parameter; `None` where it is not there.
    fn text<'f>(
        &self,
        file: File<'f>,
        of: Node<'f, 'f>,
        name: &str,
    ) -> anyhow::Result<Option<String>> {
        let node = child(of, name);
        node.map(|node| self.said(file, node, "value")).transpose()
    }

    fn numbers<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        text: &str,
    ) -> anyhow::Result<Vec<f64>> {
        let text = self.replaced(file, node, text)?;
        let words = text
            .split([',', ' ', '\t', '\n', '\r'])
            .filter(|word| !word.is_empty());
        words
            .map(|word| {
                let number = word.parse::<f64>().ok().filter(|number| number.is_finite());
                number.ok_or_else(|| file.error(node, &format!("`{word}` is no finite number")))
            })
            .collect()
    }

    fn vector<'f>(&self, file: File<'f>, node: Node<'f, 'f>, text: &str) -> anyhow::Result<DVec3> {
        match self.numbers(file, node, text)?[..] {
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            [all] => Ok(DVec3::splat(all)),
            _ => Err(file.error(node, &format!("`{text}` must be three numbers"))),
        }
    }

    /// The vector of attributes x, y and z, or of `value`.
    fn xyz<'f>(&self, file: File<'f>, node: Node<'f, 'f>, missing: f64) -> anyhow::Result<DVec3> {
        if let Some(value) = node.attribute("value") {
            return self.vector(file, node, value);
        }
        let mut vector = DVec3::splat(missing);
        for (place, key) in ["x", "y", "z"].into_iter().enumerate() {
            if let Some(text) = node.attribute(key) {
                let [number] = self.numbers(file, node, text)?[..] else {
                    return Err(file.error(node, &format!("`{key}` must be one number")));
                };
                vector[place] = number;
            }
        }
        Ok(vector)
    }

    /// A transform by its name; the identity where it is not there.
    fn transform<'f>(&self, file: File<'f>, of: Node<'f, 'f>, name: &str) -> anyhow::Result<DMat4> {
        let Some(node) = child(of, name) else {
            return Ok(DMat4::IDENTITY);
        };
        let mut all = DMat4::IDENTITY;
        for step in node.children().filter(Node::is_element) {
            let matrix = match step.tag_name().name() {
                "translate" => DMat4::from_translation(self.xyz(file, step, 0.0)?),
                "scale" => DMat4::from_scale(self.xyz(file, step, 1.0)?),
                "rotate" => {
                    let axis = self.xyz(file, step, 0.0)?.try_normalize();
                    let axis = axis.ok_or_else(|| file.error(step, "turns about no axis"))?;
                    let degrees = self.numbers(file, step, file.attribute(step, "angle")?)?;
                    let [degrees] = degrees[..] else {
                        return Err(file.error(step, "`angle` must be one number"));
                    };
                    DMat4::from_axis_angle(axis, degrees.to_radians())
                }
                "matrix" => {
                    let numbers = self.numbers(file, step, file.attribute(step, "value")?)?;
                    match <[f64; 16]>::try_from(numbers.clone()) {
                        Ok(rows) => DMat4::from_cols_array(&rows).transpose(),
                        Err(_) => match <[f64; 9]>::try_from(numbers) {
                            Ok(rows) => {
                                DMat4::from_mat3(glam::DMat3::from_cols_array(&rows).transpose())
                            }
                            Err(_) => {
                                return Err(file.error(step, "a matrix has 16 numbers, or 9"));
                            }
                        },
                    }
                }
                "lookat" | "lookAt" => {
                    let at = |key| self.vector(file, step, file.attribute(step, key)?);
                    let (origin, target) = (at("origin")?, at("target")?);
                    let up = match step.attribute("up") {
                        Some(text) => self.vector(file, step, text)?,
                        None => DVec3::Y,
                    };
                    let forward = (target - origin).try_normalize();
                    let left = forward.and_then(|forward| up.cross(forward).try_normalize());
                    let (Some(forward), Some(left)) = (forward, left) else {
                        return Err(file.error(step, "looks nowhere: `up` lies along the view"));
                    };
                    DMat4::from_cols(
                        left.extend(0.0),
                        forward.cross(left).extend(0.0),
                        forward.extend(0.0),
                        origin.extend(1.0),
                    )
                }
                other => return Err(file.error(step, &format!("there is no transform <{other}>"))),
            };
            all = matrix * all;
        }
        match all.is_finite() {
            true => Ok(all),
            false => Err(file.error(node, "the transform is not finite")),
        }
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

/// A text with `$names` replaced by their values.
fn substituted(text: &str, defaults: &HashMap<String, String>) -> String {
    let mut names: Vec<&String> = defaults.keys().collect();
    // The longest first: `$a` must not be taken out of `$ab`.
    names.sort_by_key(|name| std::cmp::Reverse(name.len()));
    let mut text = text.to_owned();
    for name in names {
        text = text.replace(&format!("${name}"), &defaults[name]);
    }
    text
}

/// The colour of what has none: that of Mitsuba's `diffuse`.
const GRAY: Vec3 = Vec3::splat(0.5);

fn turn_v(mesh: &mut Triangles) {
    for uv in mesh.uvs.as_flattened_mut() {
        *uv = Vec2::new(uv.x, 1.0 - uv.y);
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

    fn color<'f>(&self, file: File<'f>, node: Node<'f, 'f>) -> anyhow::Result<Option<Vec3>> {
        let value = match node.attribute("value").or(node.attribute("intent")) {
            Some(value) => self.replaced(file, node, value)?,
            None => return Ok(None),
        };
        if let Some(color) = super::colors::of_hex(&value) {
            return Ok(Some(color));
        }
        if value.contains(':') {
            let mut samples = Vec::new();
            for pair in value
                .split([',', ' ', '\n', '\t'])
                .filter(|pair| !pair.is_empty())
            {
                let pair = self.numbers(file, node, &pair.replace(':', " "))?;
                let [wavelength, value] = pair[..] else {
                    return Err(file.error(node, &format!("`{value}` is no spectrum")));
                };
                samples.push((wavelength, value));
            }
            samples.sort_by(|a, b| a.0.total_cmp(&b.0));
            return Ok(super::colors::of_spectrum(&samples));
        }
        let color = match self.numbers(file, node, &value)?[..] {
            [all] => Vec3::splat(all as f32),
            [r, g, b] => Vec3::new(r as f32, g as f32, b as f32),
            _ => return Err(file.error(node, &format!("`{value}` is no colour"))),
        };
        Ok(Some(match node.has_tag_name("srgb") {
            true => super::colors::of_srgb(color),
            false => color,
        }))
    }

    /// Refuses a picture that is not there.
    fn picture<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
    ) -> anyhow::Result<std::path::PathBuf> {
        let name = self.text(file, node, "filename")?;
        let name = name.ok_or_else(|| file.error(node, "has no `filename`"))?;
        let path = file.find(&name);
        match path.is_file() {
            true => Ok(path),
            false => Err(bad_input(format!(
                "{}:{}: there is no file {}",
                file.path().display(),
                line(node),
                path.display()
            ))),
        }
    }
}

//! Values of elements: numbers, vectors, transforms, colours, files.

use std::collections::HashMap;

use catoptric_scene::model::Triangles;
use glam::{DMat4, DVec3, Vec2, Vec3};
use roxmltree::Node;

use super::nodes::{File, child, line, substituted};
use super::ours;
use crate::exit::bad_input;
use crate::import::colors;
use crate::import::found::{Choice, Found};

/// Deepest nesting of what is followed: groups, materials in materials, files.
pub const DEEPEST: usize = 16;

/// Reads values of elements, and gathers what is found.
pub struct Reader<'r> {
    pub choice: &'r Choice,
    /// What our exporter wrote beside the scene.
    pub ours: Option<&'r ours::Ids>,
    pub found: &'r mut Found,
    /// Values of `$names`.
    pub defaults: HashMap<String, String>,
    /// Shapes met so far.
    pub shapes: usize,
}

impl Reader<'_> {
    pub fn leave_out<'f>(&mut self, file: File<'f>, node: Node<'f, 'f>, why: &str) {
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

    /// An attribute with its `$names` replaced.
    pub fn said<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        key: &str,
    ) -> anyhow::Result<String> {
        let text = file.attribute(node, key)?;
        self.replaced(file, node, text)
    }

    pub fn replaced<'f>(
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
    pub fn number<'f>(
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

    /// The number of a parameter that may be a texture, which is left out.
    pub fn untextured<'f>(
        &mut self,
        file: File<'f>,
        of: Node<'f, 'f>,
        name: &str,
    ) -> anyhow::Result<Option<f64>> {
        match child(of, name) {
            Some(node) if ["texture", "ref"].contains(&node.tag_name().name()) => {
                self.leave_out(file, node, ": a texture of what is no colour");
                Ok(None)
            }
            _ => self.number(file, of, name),
        }
    }

    pub fn flag<'f>(&self, file: File<'f>, of: Node<'f, 'f>, name: &str) -> anyhow::Result<bool> {
        let Some(node) = child(of, name) else {
            return Ok(false);
        };
        Ok(self
            .said(file, node, "value")?
            .trim()
            .eq_ignore_ascii_case("true"))
    }

    /// A text parameter; `None` where it is not there.
    pub fn text<'f>(
        &self,
        file: File<'f>,
        of: Node<'f, 'f>,
        name: &str,
    ) -> anyhow::Result<Option<String>> {
        let node = child(of, name);
        node.map(|node| self.said(file, node, "value")).transpose()
    }

    pub fn numbers<'f>(
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

    pub fn vector<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        text: &str,
    ) -> anyhow::Result<DVec3> {
        match self.numbers(file, node, text)?[..] {
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            [all] => Ok(DVec3::splat(all)),
            _ => Err(file.error(node, &format!("`{text}` must be three numbers"))),
        }
    }

    /// The vector of attributes x, y and z, or of `value`.
    pub fn xyz<'f>(
        &self,
        file: File<'f>,
        node: Node<'f, 'f>,
        missing: f64,
    ) -> anyhow::Result<DVec3> {
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
    pub fn transform<'f>(
        &self,
        file: File<'f>,
        of: Node<'f, 'f>,
        name: &str,
    ) -> anyhow::Result<DMat4> {
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

    pub fn color<'f>(&self, file: File<'f>, node: Node<'f, 'f>) -> anyhow::Result<Option<Vec3>> {
        let value = match node.attribute("value").or(node.attribute("intent")) {
            Some(value) => self.replaced(file, node, value)?,
            None => return Ok(None),
        };
        if let Some(color) = colors::of_hex(&value) {
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
            return Ok(colors::of_spectrum(&samples));
        }
        let color = match self.numbers(file, node, &value)?[..] {
            [all] => Vec3::splat(all as f32),
            [r, g, b] => Vec3::new(r as f32, g as f32, b as f32),
            _ => return Err(file.error(node, &format!("`{value}` is no colour"))),
        };
        Ok(Some(match node.has_tag_name("srgb") {
            true => colors::of_srgb(color),
            false => color,
        }))
    }

    /// Refuses a picture that is not there.
    pub fn picture<'f>(
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

/// The colour of what has none: that of Mitsuba's `diffuse`.
pub const GRAY: Vec3 = Vec3::splat(0.5);

/// Turns texture coordinates upside down.
pub fn turn_v(mesh: &mut Triangles) {
    for uv in mesh.uvs.as_flattened_mut() {
        *uv = Vec2::new(uv.x, 1.0 - uv.y);
    }
}

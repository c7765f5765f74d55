//! PBRT's scene files, version 4 and what version 3 has in common with it.
//!
//! PBRT's space is left-handed. Positions are kept as the file has them, so the picture is mirrored,
//! left to right, unless the file itself flips it.

mod lexer;
mod materials;
mod params;
mod reader;
mod shapes;
mod surface;

use std::collections::HashMap;
use std::path::Path;

use catoptric_scene::{Background, SceneError};
use glam::{DMat4, DVec3};

use super::cameras::{self, Axis, looking_along_z};
use super::colors;
use super::found::{Choice, Found, Thing, View};

use self::lexer::{Lexer, Word};
use self::params::Params;
use self::reader::{Reader, State, beside};
use self::surface::Material;

/// Deepest nesting of files and of states.
const DEEPEST: usize = 4096;
/// Files in files.
const DEEPEST_FILES: usize = 32;
/// Largest file.
const LARGEST: u64 = 1 << 30;
/// Most instances of objects.
const MOST_INSTANCES: usize = 100_000;

/// Reads a file and those that it includes.
pub fn read(path: &Path, choice: &Choice) -> anyhow::Result<Found> {
    let mut reader = Reader {
        choice,
        found: Found::default(),
        state: State {
            matrix: DMat4::IDENTITY,
            material: Material::default(),
            light: None,
            reversed: false,
        },
        kept: Vec::new(),
        named_spaces: HashMap::new(),
        materials: HashMap::new(),
        textures: HashMap::new(),
        objects: HashMap::new(),
        within: None,
        in_world: false,
        instances: 0,
        shapes: 0,
        files: 0,
        size: [1280.0, 720.0],
        camera: None,
    };
    reader.file(path)?;
    if let Some((mut view, degrees, axis, _)) = reader.camera.take() {
        view.fov = cameras::fov(degrees, axis, reader.size);
        view.resolution = Some(reader.size.map(|side| side as u32));
        reader.found.camera = Some(view);
    }
    Ok(reader.found)
}

impl Reader<'_> {
    fn file(&mut self, path: &Path) -> anyhow::Result<()> {
        let whole = |message: String| SceneError::File {
            file: path.display().to_string(),
            message,
        };
        if self.files >= DEEPEST_FILES {
            return Err(whole("files include each other without end".to_owned()).into());
        }
        let size = std::fs::metadata(path).map_or(0, |about| about.len());
        if size > LARGEST {
            return Err(whole(format!("has {size} bytes: the most is {LARGEST}")).into());
        }
        let text =
            std::fs::read(path).map_err(|error| whole(format!("cannot be read: {error}")))?;
        self.files += 1;
        let mut lexer = Lexer::new(path, text);
        while let Some(token) = lexer.next()? {
            match token.word {
                Word::Bare(name) => self.directive(&mut lexer, &name, token.line)?,
                other => {
                    return Err(lexer.error(
                        token.line,
                        format!("a directive is wanted, not {}", shown(&other)),
                    ));
                }
            }
        }
        self.files -= 1;
        Ok(())
    }

    fn directive(&mut self, lexer: &mut Lexer, name: &str, line: usize) -> anyhow::Result<()> {
        match name {
            "Identity" => self.state.matrix = DMat4::IDENTITY,
            "Translate" => {
                let [x, y, z] = numbers(lexer, name)?;
                self.apply(lexer, line, DMat4::from_translation(DVec3::new(x, y, z)))?;
            }
            "Scale" => {
                let [x, y, z] = numbers(lexer, name)?;
                self.apply(lexer, line, DMat4::from_scale(DVec3::new(x, y, z)))?;
            }
            "Rotate" => {
                let [degrees, x, y, z] = numbers(lexer, name)?;
                let axis = DVec3::new(x, y, z).try_normalize();
                let axis = axis.ok_or_else(|| lexer.error(line, "Rotate turns about no axis"))?;
                self.apply(
                    lexer,
                    line,
                    DMat4::from_axis_angle(axis, degrees.to_radians()),
                )?;
            }
            "LookAt" => {
                let [ex, ey, ez, tx, ty, tz, ux, uy, uz] = numbers(lexer, name)?;
                let (eye, target) = (DVec3::new(ex, ey, ez), DVec3::new(tx, ty, tz));
                let up = DVec3::new(ux, uy, uz);
                let forward = (target - eye).try_normalize();
                let right = forward.and_then(|forward| up.cross(forward).try_normalize());
                let (Some(forward), Some(right)) = (forward, right) else {
                    return Err(lexer.error(line, "LookAt looks nowhere: `up` lies along the view"));
                };
                let camera = DMat4::from_cols(
                    right.extend(0.0),
                    forward.cross(right).extend(0.0),
                    forward.extend(0.0),
                    eye.extend(1.0),
                );
                self.apply(lexer, line, camera.inverse())?;
            }
            "Transform" | "ConcatTransform" => {
                let matrix = DMat4::from_cols_array(&numbers::<16>(lexer, name)?);
                if name == "Transform" {
                    self.state.matrix = DMat4::IDENTITY;
                }
                self.apply(lexer, line, matrix)?;
            }
            "CoordinateSystem" => {
                let space = quoted(lexer, name)?;
                self.named_spaces.insert(space, self.state.matrix);
            }
            "CoordSysTransform" => {
                let space = quoted(lexer, name)?;
                let known = self.named_spaces.get(&space);
                let known = known
                    .ok_or_else(|| lexer.error(line, format!("there is no space `{space}`")))?;
                self.state.matrix = *known;
            }
            "AttributeBegin" | "TransformBegin" => self.begin(lexer, line)?,
            "AttributeEnd" => self.end(lexer, line, name)?,
            "TransformEnd" => {
                let state = self.state.clone();
                self.end(lexer, line, name)?;
                self.state = State {
                    matrix: self.state.matrix,
                    ..state
                };
            }
            "WorldBegin" => {
                self.in_world = true;
                self.named_spaces
                    .insert("world".to_owned(), DMat4::IDENTITY);
                self.state.matrix = DMat4::IDENTITY;
            }
            "WorldEnd" => {}
            "ReverseOrientation" => self.state.reversed = !self.state.reversed,
            "ObjectBegin" => {
                let object = quoted(lexer, name)?;
                if self.within.is_some() {
                    return Err(lexer.error(line, "an object begins in another one"));
                }
                self.begin(lexer, line)?;
                self.objects.insert(object.clone(), Vec::new());
                self.within = Some((object, self.state.matrix));
            }
            "ObjectEnd" => {
                if self.within.take().is_none() {
                    return Err(lexer.error(line, "ObjectEnd without ObjectBegin"));
                }
                self.end(lexer, line, name)?;
            }
            "ObjectInstance" => {
                let object = quoted(lexer, name)?;
                self.instance(lexer, line, &object)?;
            }
            "Include" | "Import" => {
                let file = quoted(lexer, name)?;
                let path = beside(lexer, &file);
                self.file(&path)?;
            }
            "Camera" | "Film" | "Shape" | "Material" | "MakeNamedMaterial" | "LightSource"
            | "AreaLightSource" => {
                let kind = quoted(lexer, name)?;
                let params = Params::read(lexer, line)?;
                match name {
                    "Camera" => self.camera(lexer, &kind, &params)?,
                    "Film" => {
                        for (place, side) in ["xresolution", "yresolution"].into_iter().enumerate()
                        {
                            let number = params.number(lexer, side, self.size[place])?;
                            self.size[place] = number.round().clamp(1.0, 16384.0);
                        }
                    }
                    "Shape" => self.shape(lexer, &kind, &params)?,
                    "Material" => {
                        self.state.material = self.material(lexer, &kind, &kind, &params)?;
                    }
                    "MakeNamedMaterial" => {
                        let of = params.word("type").unwrap_or("matte").to_owned();
                        let material = self.material(lexer, &kind, &of, &params)?;
                        self.materials.insert(kind, material);
                    }
                    "AreaLightSource" => {
                        let color = params.color(lexer, "L")?;
                        let scale = params.number(lexer, "scale", 1.0)? as f32;
                        let color = color.unwrap_or(glam::Vec3::ONE) * scale;
                        self.state.light = Some(colors::usable(color));
                    }
                    _ => self.light(lexer, &kind, &params)?,
                }
            }
            "NamedMaterial" => {
                let material = quoted(lexer, name)?;
                self.state.material = match self.materials.get(&material) {
                    Some(known) => known.clone(),
                    None => {
                        self.leave_out(
                            lexer,
                            line,
                            &format!("the material `{material}`, which is not there yet"),
                        );
                        Material::default()
                    }
                };
            }
            "Texture" => {
                let called = quoted(lexer, name)?;
                let _of = quoted(lexer, name)?;
                let kind = quoted(lexer, name)?;
                let params = Params::read(lexer, line)?;
                let texture = self.texture(lexer, &called, &kind, &params)?;
                self.textures.insert(called, texture);
            }
            "Sampler" | "Integrator" | "PixelFilter" | "ColorSpace" | "Accelerator"
            | "SurfaceIntegrator" | "VolumeIntegrator" | "Renderer" => {
                quoted(lexer, name)?;
                Params::read(lexer, line)?;
            }
            "Option" => {
                Params::read(lexer, line)?;
            }
            "Attribute" => {
                quoted(lexer, name)?;
                Params::read(lexer, line)?;
                self.leave_out(lexer, line, "`Attribute`");
            }
            "MakeNamedMedium" => {
                let medium = quoted(lexer, name)?;
                Params::read(lexer, line)?;
                self.leave_out(lexer, line, &format!("the medium `{medium}`"));
            }
            "MediumInterface" => {
                while let Some(token) = lexer.peek()? {
                    let Word::Quoted(_) = token.word else { break };
                    lexer.next()?;
                }
                self.leave_out(lexer, line, "`MediumInterface`");
            }
            "ActiveTransform" => {
                lexer.next()?;
                self.leave_out(lexer, line, "motion (`ActiveTransform`)");
            }
            "TransformTimes" => {
                numbers::<2>(lexer, name)?;
                self.leave_out(lexer, line, "motion (`TransformTimes`)");
            }
            other => {
                return Err(lexer.error(line, format!("there is no directive `{other}`")));
            }
        }
        Ok(())
    }

    fn apply(&mut self, lexer: &Lexer, line: usize, matrix: DMat4) -> anyhow::Result<()> {
        self.state.matrix *= matrix;
        match self.state.matrix.is_finite() {
            true => Ok(()),
            false => Err(lexer.error(line, "the transform is not finite")),
        }
    }

    fn begin(&mut self, lexer: &Lexer, line: usize) -> anyhow::Result<()> {
        if self.kept.len() >= DEEPEST {
            return Err(lexer.error(line, format!("blocks are nested more than {DEEPEST} deep")));
        }
        self.kept.push(self.state.clone());
        Ok(())
    }

    fn end(&mut self, lexer: &Lexer, line: usize, name: &str) -> anyhow::Result<()> {
        let kept = self.kept.pop();
        self.state =
            kept.ok_or_else(|| lexer.error(line, format!("{name} without a beginning")))?;
        Ok(())
    }

    fn camera(&mut self, lexer: &Lexer, kind: &str, params: &Params) -> anyhow::Result<()> {
        let line = params.line;
        if kind != "perspective" {
            self.leave_out(lexer, line, &format!("the camera `{kind}`"));
            return Ok(());
        }
        let to_world = self.state.matrix.inverse();
        self.named_spaces.insert("camera".to_owned(), to_world);
        let Some((eye, forward, up, mirrored)) = looking_along_z(&to_world) else {
            return Err(lexer.error(line, "the camera's transform cannot be undone"));
        };
        if mirrored {
            self.leave_out(
                lexer,
                line,
                "that the picture is mirrored, left to right (PBRT's space is left-handed)",
            );
        }
        let degrees = params.number(lexer, "fov", 90.0)?;
        if !(degrees > 0.0 && degrees < 180.0) {
            let message = format!("`fov` must be between 0 and 180, not {degrees}");
            return Err(lexer.error(line, message));
        }
        for name in ["lensradius", "screenwindow", "frameaspectratio"] {
            if params.has(name) {
                self.leave_out(lexer, line, &format!("`{name}` of the camera"));
            }
        }
        let view = View {
            eye,
            target: eye + forward,
            up,
            fov: catoptric_scene::Fov::Y(degrees),
            resolution: None,
        };
        self.camera = Some((view, degrees, Axis::Smaller, line));
        Ok(())
    }

    fn light(&mut self, lexer: &Lexer, kind: &str, params: &Params) -> anyhow::Result<()> {
        match kind {
            "infinite" if !params.has("filename") && !params.has("mapname") => {
                let color = params.color(lexer, "L")?.unwrap_or(glam::Vec3::ONE);
                let scale = params.number(lexer, "scale", 1.0)? as f32;
                self.found.background = Some(Background::Color(colors::usable(color * scale)));
            }
            _ => self.leave_out(
                lexer,
                params.line,
                &format!("the light `{kind}` (surfaces show their own colour here)"),
            ),
        }
        Ok(())
    }

    /// Puts the shapes of an object where the current space is.
    fn instance(&mut self, lexer: &Lexer, line: usize, object: &str) -> anyhow::Result<()> {
        let Some(things) = self.objects.get(object).cloned() else {
            return Err(lexer.error(line, format!("there is no object `{object}`")));
        };
        self.instances += 1;
        if self.instances > MOST_INSTANCES {
            return Err(lexer.error(
                line,
                format!("there are more than {MOST_INSTANCES} instances"),
            ));
        }
        let triangles: usize = things.iter().map(shapes::triangles).sum();
        shapes::count(self, lexer, line, triangles)?;
        let matrix = self.state.matrix;
        for thing in things {
            self.add(Thing {
                name: format!("{object} {}", thing.name),
                form: shapes::moved(thing.form, &matrix),
                ..thing
            });
        }
        Ok(())
    }
}

fn shown(word: &Word) -> String {
    match word {
        Word::Bare(text) => format!("`{text}`"),
        Word::Quoted(text) => format!("\"{text}\""),
        Word::Number(number) => number.to_string(),
        Word::Open => "`[`".to_owned(),
        Word::Close => "`]`".to_owned(),
    }
}

/// So many numbers, in brackets or not.
fn numbers<const N: usize>(lexer: &mut Lexer, of: &str) -> anyhow::Result<[f64; N]> {
    let line = lexer.line();
    let wanted = |lexer: &Lexer| lexer.error(line, format!("{of} wants {N} numbers"));
    let bracketed = matches!(lexer.peek()?, Some(token) if token.word == Word::Open);
    if bracketed {
        lexer.next()?;
    }
    let mut all = [0.0; N];
    for number in &mut all {
        match lexer.next()?.map(|token| token.word) {
            Some(Word::Number(value)) => *number = value,
            _ => return Err(wanted(lexer)),
        }
    }
    if bracketed && lexer.next()?.map(|token| token.word) != Some(Word::Close) {
        return Err(wanted(lexer));
    }
    Ok(all)
}

/// A word in quotation marks.
fn quoted(lexer: &mut Lexer, of: &str) -> anyhow::Result<String> {
    let line = lexer.line();
    match lexer.next()?.map(|token| token.word) {
        Some(Word::Quoted(text)) => Ok(text),
        Some(other) => Err(lexer.error(
            line,
            format!(
                "{of} wants a name in quotation marks, not {}",
                shown(&other)
            ),
        )),
        None => Err(lexer.error(line, format!("{of} wants a name in quotation marks"))),
    }
}

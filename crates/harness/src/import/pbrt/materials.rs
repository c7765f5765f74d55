//! Materials and textures as a colour, and whether they make a mirror.

use catoptric_scene::model::PictureSource;
use glam::Vec3;

use super::lexer::Lexer;
use super::params::Params;
use super::reader::{Reader, beside};
use super::surface::{GRAY, Material, Texture};
use crate::import::colors;

impl Reader<'_> {
    /// A material of a kind; `name` is what it is called.
    pub(super) fn material(
        &mut self,
        lexer: &Lexer,
        name: &str,
        kind: &str,
        params: &Params,
    ) -> anyhow::Result<Material> {
        let roughness = |missing: f64| -> anyhow::Result<f64> {
            let sides = ["uroughness", "vroughness", "roughness"]
                .into_iter()
                .map(|name| {
                    params.number(lexer, name, if name == "roughness" { missing } else { 0.0 })
                });
            let sides = sides.collect::<anyhow::Result<Vec<f64>>>()?;
            Ok(sides.into_iter().fold(0.0, f64::max))
        };
        let mut is_mirror = false;
        let color = match kind {
            "diffuse" | "coateddiffuse" | "diffusetransmission" => {
                self.colored(lexer, params, &["reflectance"])?
            }
            "matte" | "plastic" | "uber" | "substrate" | "translucent" | "disney" => {
                self.colored(lexer, params, &["Kd", "color"])?
            }
            "conductor" | "metal" => {
                let smooth = if kind == "metal" { 0.01 } else { 0.0 };
                is_mirror = roughness(smooth)? <= self.choice.roughness;
                self.colored(lexer, params, &["reflectance"])?
            }
            "coatedconductor" => {
                let rough = params.number(lexer, "conductor.roughness", 0.0)?;
                is_mirror = rough <= self.choice.roughness;
                self.colored(lexer, params, &["reflectance"])?
            }
            "dielectric" | "thindielectric" | "glass" | "mirror" => {
                is_mirror = roughness(0.0)? <= self.choice.roughness;
                Texture::Color(GRAY)
            }
            "interface" | "" | "none" => {
                return Ok(Material {
                    is_invisible: true,
                    ..Material::default()
                });
            }
            other => {
                self.leave_out(lexer, params.line, &format!("the material `{other}`"));
                self.colored(lexer, params, &["reflectance", "Kd"])?
            }
        };
        for what in ["displacement", "normalmap", "bumpmap"] {
            if params.has(what) {
                self.leave_out(
                    lexer,
                    params.line,
                    &format!("`{what}` of the material `{name}`"),
                );
            }
        }
        Ok(Material {
            name: name.to_owned(),
            color,
            is_mirror,
            is_invisible: false,
        })
    }

    /// The first parameter of these names as a colour or texture.
    fn colored(
        &mut self,
        lexer: &Lexer,
        params: &Params,
        names: &[&str],
    ) -> anyhow::Result<Texture> {
        for name in names.iter().filter(|name| params.has(name)) {
            if let Some(texture) = params.texture(name) {
                let known = self.textures.get(texture).cloned();
                return known.ok_or_else(|| {
                    lexer.error(params.line, format!("there is no texture `{texture}`"))
                });
            }
            match params.color(lexer, name)? {
                Some(color) => return Ok(Texture::Color(colors::usable(color))),
                None => self.leave_out(lexer, params.line, &format!("the spectrum of `{name}`")),
            }
        }
        Ok(Texture::Color(GRAY))
    }

    /// A texture by its kind.
    pub(super) fn texture(
        &mut self,
        lexer: &Lexer,
        called: &str,
        kind: &str,
        params: &Params,
    ) -> anyhow::Result<Texture> {
        let one = Texture::Color(Vec3::ONE);
        let mut get = |name: &str, missing: &Texture| -> anyhow::Result<Texture> {
            if !params.has(name) {
                return Ok(missing.clone());
            }
            self.colored(lexer, params, &[name])
        };
        Ok(match kind {
            "constant" => get("value", &one)?,
            "scale" => {
                let (texture, factor) = (get("tex", &one)?, get("scale", &one)?);
                // Version 3 calls them so.
                let (texture, factor) = match params.has("tex1") {
                    true => (get("tex1", &texture)?, get("tex2", &factor)?),
                    false => (texture, factor),
                };
                let by = factor.mean();
                texture.tinted(by)
            }
            "checkerboard" => {
                let (a, b) = (
                    get("tex1", &one)?,
                    get("tex2", &Texture::Color(Vec3::ZERO))?,
                );
                let (u, v) = (
                    params.number(lexer, "uscale", 1.0)?,
                    params.number(lexer, "vscale", 1.0)?,
                );
                let whole = u == v && u.fract() == 0.0 && (1.0..=65536.0).contains(&u);
                match whole && params.word("mapping").is_none_or(|mapping| mapping == "uv") {
                    true => Texture::Checker {
                        a: a.mean(),
                        b: b.mean(),
                        cells: u as u32,
                    },
                    false => {
                        self.leave_out(
                            lexer,
                            params.line,
                            &format!("the cells of the texture `{called}`"),
                        );
                        Texture::Color((a.mean() + b.mean()) / 2.0)
                    }
                }
            }
            "imagemap" => {
                let Some(file) = params.word("filename") else {
                    let hint = params.nearest("filename");
                    let message = format!("the texture `{called}` has no `filename`{hint}");
                    return Err(lexer.error(params.line, message));
                };
                let path = beside(lexer, file);
                let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
                if !["png", "jpg", "jpeg"].iter().any(|known| ending == *known) {
                    let what = format!(
                        "the picture `{file}` of the texture `{called}` (PNG and JPEG are read)"
                    );
                    self.leave_out(lexer, params.line, &what);
                    return Ok(Texture::Color(GRAY));
                }
                if !path.is_file() {
                    let message = format!("there is no file {}", path.display());
                    return Err(lexer.error(params.line, message));
                }
                if params
                    .word("mapping")
                    .is_some_and(|mapping| mapping != "uv")
                {
                    self.leave_out(
                        lexer,
                        params.line,
                        &format!("the mapping of the texture `{called}`"),
                    );
                }
                let number = |name: &str, missing: f64| -> anyhow::Result<f32> {
                    Ok(params.number(lexer, name, missing)? as f32)
                };
                Texture::Picture {
                    tint: Vec3::splat(number("scale", 1.0)?.max(0.0)),
                    source: PictureSource::File(path),
                    scale: [number("uscale", 1.0)?, number("vscale", 1.0)?],
                    offset: [number("udelta", 0.0)?, number("vdelta", 0.0)?],
                }
            }
            other => {
                self.leave_out(
                    lexer,
                    params.line,
                    &format!("the texture `{called}` of kind `{other}`"),
                );
                Texture::Color(GRAY)
            }
        })
    }
}

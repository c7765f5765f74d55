//! MTL files: diffuse colours and their textures.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use crate::SceneError;
use crate::mesh::{Material, Paint, Texture};
use crate::text::{self, at_line};

/// Colour of a surface that nothing gives a colour.
pub(crate) const DEFAULT_COLOR: Vec3 = Vec3::splat(0.8);

/// A material, and how its texture lies on a mesh.
pub(crate) struct Painted {
    pub material: Material,
    /// Texture coordinates are multiplied by this (`map_Kd -s`), then
    pub uv_scale: Vec2,
    /// this is added (`map_Kd -o`).
    pub uv_offset: Vec2,
}

impl Painted {
    /// In the default colour.
    pub(crate) fn plain(name: &str) -> Self {
        Self {
            material: Material {
                name: name.to_owned(),
                paint: Paint::Color(DEFAULT_COLOR),
            },
            uv_scale: Vec2::ONE,
            uv_offset: Vec2::ZERO,
        }
    }
}

/// Reads all materials of an MTL file with their textures, which lie relative to it.
pub(crate) fn read(path: &Path) -> Result<Vec<Painted>, SceneError> {
    let text = text::read(path, "MTL")?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut textures = HashMap::new();
    let mut materials: Vec<Painted> = Vec::new();
    for (number, line) in text::lines(&text) {
        let error = |message: String| at_line(path, number, message);
        let (key, rest) = text::split_key(&line);
        if key == "newmtl" {
            materials.push(Painted::plain(rest));
        } else if key == "Kd" || key == "map_Kd" {
            let Some(painted) = materials.last_mut() else {
                return Err(error(format!("`{key}` before the first `newmtl`")));
            };
            let paint = &mut painted.material.paint;
            if key == "Kd" {
                let kd = color(text::without_comment(rest))
                    .ok_or_else(|| error("`Kd` must be three finite numbers ≥ 0".to_owned()))?;
                match paint {
                    Paint::Texture { tint, .. } => *tint = kd,
                    paint => *paint = Paint::Color(kd),
                }
            } else {
                let map =
                    Map::parse(rest).map_err(|message| error(format!("`map_Kd` {message}")))?;
                let file =
                    text::beside(folder, &map.name).unwrap_or_else(|| folder.join(&map.name));
                let image = match textures.get(&file) {
                    Some(image) => Arc::clone(image),
                    None => {
                        let image = Arc::new(texture(&file).map_err(|message| {
                            error(format!("`map_Kd`: {}: {message}", file.display()))
                        })?);
                        textures.insert(file, Arc::clone(&image));
                        image
                    }
                };
                let tint = match paint {
                    Paint::Color(kd) if *kd != DEFAULT_COLOR => *kd,
                    _ => Vec3::ONE,
                };
                *paint = Paint::Texture { tint, image };
                (painted.uv_scale, painted.uv_offset) = (map.scale, map.offset);
            }
        }
    }
    Ok(materials)
}

fn color(text: &str) -> Option<Vec3> {
    let mut words = text.split_whitespace().map(|word| word.parse().ok());
    let mut channel = || words.next().flatten();
    let color = Vec3::new(channel()?, channel()?, channel()?);
    (color.is_finite() && color.min_element() >= 0.0).then_some(color)
}

/// What a `map_Kd` line says: options, then all the rest is the file's name.
#[derive(Debug, PartialEq)]
struct Map {
    name: String,
    scale: Vec2,
    offset: Vec2,
}

impl Map {
    /// Understands `-s u [v [w]]` and `-o u [v [w]]`; `w` is for pictures with depth.
    fn parse(text: &str) -> Result<Self, String> {
        let (mut scale, mut offset) = (Vec2::ONE, Vec2::ZERO);
        let mut rest = text;
        while rest.starts_with('-') {
            let (option, after) = text::split_key(rest);
            let place = match option {
                "-s" => &mut scale,
                "-o" => &mut offset,
                _ => {
                    return Err(format!(
                        "has the option `{option}`: only -s and -o are understood"
                    ));
                }
            };
            let mut numbers = 0;
            rest = after;
            // A number at the very end is the file's name.
            while let (word, after) = text::split_key(rest)
                && let Ok(value) = word.parse::<f32>()
                && numbers < 3
                && !after.is_empty()
            {
                if !value.is_finite() {
                    return Err(format!("{option} must be finite, not {word}"));
                }
                if numbers < 2 {
                    place[numbers] = value;
                }
                (numbers, rest) = (numbers + 1, after);
            }
            if numbers == 0 {
                return Err(format!("{option} needs a number"));
            }
        }
        if text::without_comment(rest).is_empty() {
            return Err("names no file".to_owned());
        }
        Ok(Self {
            name: rest.to_owned(),
            scale,
            offset,
        })
    }
}

/// Decodes a PNG or JPEG picture from sRGB to linear RGB.
fn texture(path: &Path) -> Result<Texture, String> {
    let picture = image::open(path)
        .map_err(|error| error.to_string())?
        .to_rgb8();
    let linear: Vec<f32> = (0..=255u8).map(srgb_to_linear).collect();
    let texels = picture
        .pixels()
        .map(|p| Vec3::from(p.0.map(|byte| linear[usize::from(byte)])))
        .collect();
    Ok(Texture {
        width: picture.width(),
        height: picture.height(),
        texels,
    })
}

fn srgb_to_linear(byte: u8) -> f32 {
    let value = f64::from(byte) / 255.0;
    let linear = if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    };
    linear as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_ends_and_middle() {
        assert_eq!(srgb_to_linear(0), 0.0);
        assert_eq!(srgb_to_linear(255), 1.0);
        assert!((srgb_to_linear(128) - 0.215_86).abs() < 1e-5);
    }

    #[test]
    fn maps_have_a_name_and_may_be_scaled_and_moved() {
        let map = |text: &str| Map::parse(text).map(|map| (map.name, map.scale, map.offset));
        let plain = |name: &str| Ok((name.to_owned(), Vec2::ONE, Vec2::ZERO));
        assert_eq!(map("old wood.png"), plain("old wood.png"));
        assert_eq!(map("maps\\wood.png"), plain("maps\\wood.png"));
        let (scale, offset) = (Vec2::new(4.0, 2.0), Vec2::new(0.5, 0.0));
        let moved = Ok(("a b.png".to_owned(), scale, offset));
        assert_eq!(map("-s 4 2 1 -o 0.5 a b.png"), moved);
        assert_eq!(
            map("-s 4 7"),
            Ok(("7".to_owned(), Vec2::new(4.0, 1.0), Vec2::ZERO))
        );
        for (text, wanted) in [
            ("", "names no file"),
            ("# none", "names no file"),
            ("-bm 1 a.png", "option `-bm`"),
            ("-s a.png", "-s needs a number"),
            ("-o inf 0 a.png", "-o must be finite"),
        ] {
            let message = map(text).unwrap_err();
            assert!(message.contains(wanted), "{message}, not {wanted}");
        }
    }

    #[test]
    fn colours_and_textures() {
        let folder = tempfile::tempdir().unwrap();
        image::RgbImage::from_pixel(2, 1, image::Rgb([255, 128, 0]))
            .save(folder.path().join("t.png"))
            .unwrap();
        let path = folder.path().join("m.mtl");
        std::fs::write(&path, "newmtl a b\nKd 0.1 0.2 0.3\nnewmtl t\nmap_Kd t.png\nnewmtl u\nmap_Kd t.png\nKd .5 .5 .5\n")
            .unwrap();
        let materials = read(&path).unwrap();
        assert_eq!(materials[0].material.name, "a b");
        assert!(
            matches!(materials[0].material.paint, Paint::Color(c) if c == Vec3::new(0.1, 0.2, 0.3))
        );
        let Paint::Texture { tint, image } = &materials[1].material.paint else {
            panic!("no texture")
        };
        assert_eq!((*tint, image.width, image.height), (Vec3::ONE, 2, 1));
        assert!((image.texels[0].y - 0.215_86).abs() < 1e-5);
        let Paint::Texture { tint, image: same } = &materials[2].material.paint else {
            panic!("no texture")
        };
        assert_eq!(*tint, Vec3::splat(0.5));
        assert!(Arc::ptr_eq(image, same));
    }

    #[test]
    fn errors_name_the_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.mtl");
        for (text, wanted) in [
            ("Kd 1 1 1", "m.mtl:1: `Kd` before"),
            ("newmtl a\nKd 1 1", "m.mtl:2: `Kd` must be"),
            ("newmtl a\nKd 1 nan 1", "m.mtl:2: `Kd` must be"),
            ("newmtl a\n\nmap_Kd none.png", "m.mtl:3: `map_Kd`"),
        ] {
            std::fs::write(&path, text).unwrap();
            let message = read(&path).err().unwrap().to_string();
            assert!(message.contains(wanted), "{message}");
        }
    }
}

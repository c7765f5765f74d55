//! MTL files: diffuse colours and their textures.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;

use crate::SceneError;
use crate::mesh::{Material, Paint, Texture};

/// Colour of a surface that nothing gives a colour.
pub(crate) const DEFAULT_COLOR: Vec3 = Vec3::splat(0.8);

/// Reads all materials of an MTL file with their textures, which lie relative to it.
pub(crate) fn read(path: &Path) -> Result<Vec<Material>, SceneError> {
    let text = read_text(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut textures = HashMap::new();
    let mut materials: Vec<Material> = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let error = |message: String| at_line(path, number, message);
        let mut words = line.split_whitespace();
        let (key, rest) = (words.next().unwrap_or(""), words.collect::<Vec<_>>());
        if key == "newmtl" {
            let paint = Paint::Color(DEFAULT_COLOR);
            materials.push(Material {
                name: rest.join(" "),
                paint,
            });
        } else if key == "Kd" || key == "map_Kd" {
            let Some(material) = materials.last_mut() else {
                return Err(error(format!("`{key}` before the first `newmtl`")));
            };
            if key == "Kd" {
                let kd = color(&rest)
                    .ok_or_else(|| error("`Kd` must be three finite numbers ≥ 0".to_owned()))?;
                match &mut material.paint {
                    Paint::Texture { tint, .. } => *tint = kd,
                    paint => *paint = Paint::Color(kd),
                }
            } else {
                let name = texture_name(&rest)
                    .ok_or_else(|| error("`map_Kd` names no file".to_owned()))?;
                let file = folder.join(name);
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
                let tint = match material.paint {
                    Paint::Color(kd) if kd != DEFAULT_COLOR => kd,
                    _ => Vec3::ONE,
                };
                material.paint = Paint::Texture { tint, image };
            }
        }
    }
    Ok(materials)
}

fn color(words: &[&str]) -> Option<Vec3> {
    let [r, g, b] = words.get(..3)?.try_into().ok()?;
    let color = Vec3::new(number(r)?, number(g)?, number(b)?);
    (color.is_finite() && color.min_element() >= 0.0).then_some(color)
}

fn number(word: &str) -> Option<f32> {
    word.parse().ok()
}

/// The file name of a `map_Kd` line: all of it, or the last word where options come first.
fn texture_name(words: &[&str]) -> Option<PathBuf> {
    let name = match words.first()? {
        option if option.starts_with('-') => (*words.last()?).to_owned(),
        _ => words.join(" "),
    };
    Some(PathBuf::from(name.replace('\\', "/")))
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

/// A file's text; bytes that are no UTF-8 (in comments of old files) are replaced.
pub(crate) fn read_text(path: &Path) -> Result<String, SceneError> {
    let bytes = std::fs::read(path).map_err(|error| SceneError::File {
        file: path.display().to_string(),
        message: format!("cannot be read: {error}"),
    })?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// An error at a line of an OBJ or MTL file.
pub(crate) fn at_line(path: &Path, line: usize, message: impl Into<String>) -> SceneError {
    SceneError::AtLine {
        file: path.display().to_string(),
        line,
        message: message.into(),
    }
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
    fn texture_names_with_options_spaces_and_backslashes() {
        let name = |line: &str| texture_name(&line.split_whitespace().collect::<Vec<_>>());
        assert_eq!(name("-bm 1 a.png"), Some("a.png".into()));
        assert_eq!(name("old wood.png"), Some("old wood.png".into()));
        assert_eq!(name("maps\\wood.png"), Some("maps/wood.png".into()));
        assert_eq!(name(""), None);
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
        assert_eq!(materials[0].name, "a b");
        assert!(matches!(materials[0].paint, Paint::Color(c) if c == Vec3::new(0.1, 0.2, 0.3)));
        let Paint::Texture { tint, image } = &materials[1].paint else {
            panic!("no texture")
        };
        assert_eq!((*tint, image.width, image.height), (Vec3::ONE, 2, 1));
        assert!((image.texels[0].y - 0.215_86).abs() < 1e-5);
        let Paint::Texture { tint, image: same } = &materials[2].paint else {
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
            let message = read(&path).unwrap_err().to_string();
            assert!(message.contains(wanted), "{message}");
        }
    }
}

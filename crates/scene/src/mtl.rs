//! MTL files: diffuse colours and their textures.
//!
//! A file is read as the statements of its materials. Only the materials that are used are
//! interpreted, and only their pictures are read, so that an error in an unused material does no
//! harm.

use std::path::{Path, PathBuf};

use glam::{DVec2, Vec3};

use crate::SceneError;
use crate::loading::Loading;
use crate::mesh::{Material, Paint};
use crate::text::{self, at_line};

/// Colour of a surface for which no colour is given.
pub(crate) const DEFAULT_COLOR: Vec3 = Vec3::splat(0.8);

/// A material, and how its texture lies on a mesh.
pub(crate) struct Painted {
    pub material: Material,
    /// Texture coordinates are multiplied by this (`map_Kd -s`), then
    pub uv_scale: DVec2,
    /// this is added (`map_Kd -o`).
    pub uv_offset: DVec2,
}

impl Painted {
    /// In one colour.
    pub(crate) fn plain(name: String, color: Vec3) -> Self {
        Self {
            material: Material {
                name,
                paint: Paint::Color(color),
            },
            uv_scale: DVec2::ONE,
            uv_offset: DVec2::ZERO,
        }
    }

    /// Whether texture coordinates are needed.
    pub(crate) fn is_textured(&self) -> bool {
        matches!(self.material.paint, Paint::Texture { .. })
    }
}

/// All materials of an MTL file.
pub(crate) struct Library {
    path: PathBuf,
    pub entries: Vec<Entry>,
}

/// A material as it is written.
pub(crate) struct Entry {
    pub name: Vec<u8>,
    color: Option<Statement>,
    map: Option<Statement>,
}

/// What follows a key.
struct Statement {
    line: usize,
    value: Vec<u8>,
}

impl Library {
    /// Reads the statements of an MTL file; where a material has one twice, the last counts.
    pub(crate) fn read(path: &Path) -> Result<Self, SceneError> {
        let text = text::read(path, "MTL")?;
        let mut entries: Vec<Entry> = Vec::new();
        for (line, content) in text::lines(&text) {
            let (key, rest) = text::split_key(&content);
            if key == b"newmtl" {
                entries.push(Entry {
                    name: rest.to_owned(),
                    color: None,
                    map: None,
                });
            } else if key == b"Kd" || key == b"map_Kd" {
                let Some(entry) = entries.last_mut() else {
                    let message = format!("`{}` before the first `newmtl`", text::shown(key));
                    return Err(at_line(path, line, message));
                };
                let value = rest.to_owned();
                let statement = Some(Statement { line, value });
                if key == b"Kd" {
                    entry.color = statement;
                } else {
                    entry.map = statement;
                }
            }
        }
        Ok(Self {
            path: path.to_owned(),
            entries,
        })
    }

    /// Understands a material of the file; its picture lies relative to the file.
    pub(crate) fn paint(&self, entry: &Entry, loading: &Loading) -> Result<Painted, SceneError> {
        let name = text::shown(&entry.name);
        let color = (entry.color.as_ref())
            .map(|statement| {
                color(text::without_comment(&statement.value)).map_err(|message| {
                    at_line(&self.path, statement.line, format!("`Kd` {message}"))
                })
            })
            .transpose()?;
        let Some(statement) = &entry.map else {
            return Ok(Painted::plain(name, color.unwrap_or(DEFAULT_COLOR)));
        };
        let error = |message: String| at_line(&self.path, statement.line, message);
        let map =
            Map::parse(&statement.value).map_err(|message| error(format!("`map_Kd` {message}")))?;
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let Some(file) = text::beside(folder, &map.name) else {
            let name = text::shown(&map.name);
            let message = format!("`map_Kd`: no file `{name}` in {}", folder_name(folder));
            return Err(error(message));
        };
        let image = loading
            .texture(&file)
            .map_err(|message| error(format!("`map_Kd`: {} {message}", file.display())))?;
        let tint = color.unwrap_or(Vec3::ONE);
        Ok(Painted {
            material: Material {
                name,
                paint: Paint::Texture { tint, image },
            },
            uv_scale: map.scale,
            uv_offset: map.offset,
        })
    }
}

/// A folder for messages.
fn folder_name(folder: &Path) -> String {
    if folder.as_os_str().is_empty() {
        "this folder".to_owned()
    } else {
        folder.display().to_string()
    }
}

/// Red, green and blue, or one number for all of them.
fn color(text: &[u8]) -> Result<Vec3, String> {
    let channel = |word: &[u8]| text::number(word).filter(|value| *value >= 0.0);
    let channels: Vec<Option<f64>> = text::words(text).map(channel).collect();
    let [red, green, blue] = match channels[..] {
        [Some(grey)] => [grey; 3],
        [Some(red), Some(green), Some(blue), ..] => [red, green, blue],
        _ => {
            return Err(format!(
                "must be three finite numbers ≥ 0, or one for all three, not `{}`",
                text::shown(text.trim_ascii())
            ));
        }
    };
    Ok(Vec3::new(red as f32, green as f32, blue as f32))
}

/// What a `map_Kd` line says: options, then all the rest is the file's name.
#[derive(Debug, PartialEq)]
struct Map {
    name: Vec<u8>,
    scale: DVec2,
    offset: DVec2,
}

impl Map {
    /// Understands `-s u [v [w]]` and `-o u [v [w]]`; `w` is for pictures with depth.
    fn parse(text: &[u8]) -> Result<Self, String> {
        let (mut scale, mut offset) = (DVec2::ONE, DVec2::ZERO);
        let mut rest = text;
        while rest.starts_with(b"-") {
            let (option, after) = text::split_key(rest);
            let place = match option {
                b"-s" => &mut scale,
                b"-o" => &mut offset,
                _ => {
                    let option = text::shown(option);
                    return Err(format!(
                        "has the option `{option}`: only -s and -o are understood"
                    ));
                }
            };
            let option = text::shown(option);
            let mut numbers = 0;
            rest = after;
            // A number at the very end is the file's name.
            while let (word, after) = text::split_key(rest)
                && let Some(value) = any_number(word)
                && numbers < 3
                && !after.is_empty()
            {
                if text::number(word).is_none() {
                    let word = text::shown(word);
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

/// A word as a number, infinite ones too.
fn any_number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    fn paints(folder: &Path, text: &[u8]) -> Result<Vec<Painted>, SceneError> {
        let path = folder.join("m.mtl");
        std::fs::write(&path, text).unwrap();
        let library = Library::read(&path)?;
        let loading = Loading::default();
        let paint = |entry| library.paint(entry, &loading);
        library.entries.iter().map(paint).collect()
    }

    #[test]
    fn maps_have_a_name_and_may_be_scaled_and_moved() {
        let map = |text: &str| {
            Map::parse(text.as_bytes()).map(|map| (text::shown(&map.name), map.scale, map.offset))
        };
        let plain = |name: &str| Ok((name.to_owned(), DVec2::ONE, DVec2::ZERO));
        assert_eq!(map("old wood.png"), plain("old wood.png"));
        assert_eq!(map("maps\\wood.png"), plain("maps\\wood.png"));
        let (scale, offset) = (DVec2::new(4.0, 2.0), DVec2::new(0.5, 0.0));
        let moved = Ok(("a b.png".to_owned(), scale, offset));
        assert_eq!(map("-s 4 2 1 -o 0.5 a b.png"), moved);
        assert_eq!(
            map("-s 4 7"),
            Ok(("7".to_owned(), DVec2::new(4.0, 1.0), DVec2::ZERO))
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
        let text = b"newmtl a b\nKd 0.1 0.2 0.3\nnewmtl t\nmap_Kd t.png\n\
            newmtl u\nmap_Kd ./t.png\nKd .5 .5 .5\n";
        let paints = paints(folder.path(), text).unwrap();
        assert_eq!(paints[0].material.name, "a b");
        assert!(
            matches!(paints[0].material.paint, Paint::Color(c) if c == Vec3::new(0.1, 0.2, 0.3))
        );
        let Paint::Texture { tint, image } = &paints[1].material.paint else {
            panic!("no texture")
        };
        assert_eq!((*tint, image.width(), image.height()), (Vec3::ONE, 2, 1));
        assert!((image.texel(0).y - 0.215_86).abs() < 1e-5);
        let Paint::Texture { tint, image: same } = &paints[2].material.paint else {
            panic!("no texture")
        };
        assert_eq!(*tint, Vec3::splat(0.5));
        assert!(Arc::ptr_eq(image, same), "read once, however it is named");
    }

    #[test]
    fn a_colour_tints_a_texture_wherever_it_stands() {
        let folder = tempfile::tempdir().unwrap();
        image::RgbImage::new(1, 1)
            .save(folder.path().join("t.png"))
            .unwrap();
        for kd in ["0.8 0.8 0.8", "0.8", "1 1 1", "0 0 0", "0.79 0.8 0.8"] {
            let text = format!(
                "newmtl before\nKd {kd}\nmap_Kd t.png\nnewmtl behind\nmap_Kd t.png\nKd {kd}\n"
            );
            let tints: Vec<Vec3> = paints(folder.path(), text.as_bytes())
                .unwrap()
                .iter()
                .map(|painted| match painted.material.paint {
                    Paint::Texture { tint, .. } => tint,
                    _ => panic!("no texture"),
                })
                .collect();
            let expected = color(kd.as_bytes()).unwrap();
            assert_eq!(tints, [expected; 2], "{kd}");
        }
    }

    #[test]
    fn one_number_is_a_grey() {
        assert_eq!(color(b"0.5"), Ok(Vec3::splat(0.5)));
        assert_eq!(color(b" 1 0.5 0 "), Ok(Vec3::new(1.0, 0.5, 0.0)));
        for text in [
            "",
            "1 1",
            "1 nan 1",
            "-1 0 0",
            "xyz 1 1 1",
            "spectral a.rfl",
        ] {
            let message = color(text.as_bytes()).unwrap_err();
            assert!(message.contains(&format!("not `{text}`")), "{message}");
        }
    }

    #[test]
    fn errors_name_the_line() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("t.gif"), "GIF89a").unwrap();
        for (text, wanted) in [
            ("Kd 1 1 1", "m.mtl:1: `Kd` before"),
            ("newmtl a\nKd 1 1", "m.mtl:2: `Kd` must be"),
            ("newmtl a\nKd 1 nan 1", "m.mtl:2: `Kd` must be"),
            (
                "newmtl a\n\nmap_Kd none.png",
                "m.mtl:3: `map_Kd`: no file `none.png` in ",
            ),
            (
                "newmtl a\nmap_Kd t.gif",
                "t.gif is neither a PNG nor a JPEG",
            ),
        ] {
            let message = paints(folder.path(), text.as_bytes()).err().unwrap();
            let message = message.to_string();
            assert!(message.contains(wanted), "{message}");
        }
    }
}

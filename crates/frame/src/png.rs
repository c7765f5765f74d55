//! PNG pictures for showing: 8-bit sRGB, no alpha.

use std::collections::BTreeMap;
use std::path::Path;

use glam::Vec3;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use crate::{FrameError, Image, write_whole};

/// The sRGB code value (0 to 1) of a linear value, clamped; NaN gives 0.
pub fn srgb_from_linear(linear: f32) -> f32 {
    // Not `clamp` alone, which keeps NaN: `max` turns it into 0.
    let linear = linear.max(0.0).clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// A linear colour as 8-bit sRGB, clamped, rounded to nearest.
pub fn srgb8_from_linear(linear: Vec3) -> [u8; 3] {
    linear
        .to_array()
        .map(|channel| (srgb_from_linear(channel) * 255.0).round() as u8)
}

/// Writes a linear image as 8-bit sRGB; values outside 0 to 1 are clamped.
pub fn write_png(image: &Image<Vec3>, path: impl AsRef<Path>) -> Result<(), FrameError> {
    write_png_rgb8(&image.map(|&linear| srgb8_from_linear(linear)), path)
}

/// Writes pixels that are already 8-bit sRGB; with a palette where 256 colours are enough, as in error maps.
pub fn write_png_rgb8(image: &Image<[u8; 3]>, path: impl AsRef<Path>) -> Result<(), FrameError> {
    let path = path.as_ref();
    let size = image.size();
    let file = match palette(image) {
        Some((colors, places)) => encoded(&places, size, path, |encoder| {
            encoder.set_color(ColorType::Indexed);
            encoder.set_palette(colors);
            // The place of a colour says nothing of its neighbour's.
            encoder.set_filter(Filter::NoFilter);
        }),
        None => encoded(image.pixels().as_flattened(), size, path, |encoder| {
            encoder.set_color(ColorType::Rgb);
        }),
    }?;
    write_whole(path, &file)
}

/// The colours of an image, one after another, and each pixel's place among them; `None` if there are
/// more than 256.
fn palette(image: &Image<[u8; 3]>) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut places = BTreeMap::new();
    for color in image.pixels() {
        places.insert(*color, 0);
        if places.len() > 256 {
            return None;
        }
    }
    for (place, own) in (0..=255).zip(places.values_mut()) {
        *own = place;
    }
    let of_pixels = image.pixels().iter().map(|color| places[color]).collect();
    Some((places.into_keys().flatten().collect(), of_pixels))
}

/// A linear image as a PNG of 16-bit sRGB, for a texture; values outside 0 to 1 are clamped. Messages
/// name it by `path`.
pub fn png16(image: &Image<Vec3>, path: &Path) -> Result<Vec<u8>, FrameError> {
    let channel = |linear: f32| (srgb_from_linear(linear) * 65535.0).round() as u16;
    let bytes: Vec<u8> = image
        .pixels()
        .iter()
        .flat_map(|color| color.to_array().map(channel))
        .flat_map(u16::to_be_bytes)
        .collect();
    encoded(&bytes, image.size(), path, |encoder| {
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Sixteen);
    })
}

/// Encodes pixels as a PNG of the given `kind`, with 8 bits a channel unless it says otherwise.
fn encoded(
    bytes: &[u8],
    [width, height]: [u32; 2],
    path: &Path,
    kind: impl FnOnce(&mut Encoder<'_, &mut Vec<u8>>),
) -> Result<Vec<u8>, FrameError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    // The fast kinds make files half as large again.
    encoder.set_compression(Compression::Balanced);
    encoder.set_filter(Filter::Adaptive);
    kind(&mut encoder);
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(bytes));
    written.map_err(|source| FrameError::Png {
        path: path.into(),
        source,
    })?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transfer_function_at_known_values() {
        assert_eq!(
            srgb8_from_linear(Vec3::new(0.0, 1.0, 0.214_041_14)),
            [0, 255, 128]
        );
        assert_eq!(
            srgb8_from_linear(Vec3::new(-3.0, 7.0, f32::NAN)),
            [0, 255, 0]
        );
        assert_eq!(srgb8_from_linear(Vec3::splat(f32::INFINITY)), [255; 3]);
        assert!((srgb_from_linear(0.003_130_8) - 0.040_449_94).abs() < 1e-6);
    }

    #[test]
    fn written_pixels_come_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        let pixels = Image::from_vec([2, 1], vec![Vec3::X, Vec3::splat(0.214_041_14)]);
        write_png(&pixels, &path).unwrap();
        let read = image::open(&path).unwrap().into_rgb8();
        assert_eq!(read.dimensions(), (2, 1));
        assert_eq!(read.into_raw(), [255, 0, 0, 128, 128, 128]);
        let files = std::fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(files, 1, "no temporary file is left");
    }

    #[test]
    fn few_colours_take_less_room_and_many_come_back_as_well() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.png");
        for (colors, indexed) in [(1, true), (256, true), (257, false)] {
            let pixels = (0..64 * 64).map(|index: u32| {
                let [low, high, ..] = (index * 37 % colors).to_le_bytes();
                [low, high, low ^ 90]
            });
            let image = Image::from_vec([64, 64], pixels.collect());
            write_png_rgb8(&image, &path).unwrap();
            let read = image::open(&path).unwrap().into_rgb8();
            assert!(read.into_raw() == image.pixels().as_flattened(), "{colors}");
            let file = std::fs::File::open(&path).unwrap();
            let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info();
            let is_indexed = reader.unwrap().info().color_type == ColorType::Indexed;
            assert_eq!(is_indexed, indexed, "{colors}");
        }
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("nowhere").join("picture.png");
        let error = write_png(&Image::filled([1, 1], Vec3::ZERO), &path).unwrap_err();
        assert!(matches!(error, FrameError::Write { .. }));
        assert!(error.to_string().contains("nowhere"), "{error}");
    }
}

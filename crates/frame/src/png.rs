//! PNG pictures for showing: 8-bit sRGB, no alpha.

use std::path::Path;

use glam::Vec3;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

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

/// Writes pixels that are already 8-bit sRGB.
pub fn write_png_rgb8(image: &Image<[u8; 3]>, path: impl AsRef<Path>) -> Result<(), FrameError> {
    let bytes = image.pixels().as_flattened();
    write(bytes, image.size(), ExtendedColorType::Rgb8, path.as_ref())
}

/// Writes a linear image as 16-bit sRGB, for a texture; values outside 0 to 1 are clamped.
pub fn write_png16(image: &Image<Vec3>, path: impl AsRef<Path>) -> Result<(), FrameError> {
    let channel = |linear: f32| (srgb_from_linear(linear) * 65535.0).round() as u16;
    let bytes: Vec<u8> = image
        .pixels()
        .iter()
        .flat_map(|color| color.to_array().map(channel))
        .flat_map(u16::to_ne_bytes)
        .collect();
    write(
        &bytes,
        image.size(),
        ExtendedColorType::Rgb16,
        path.as_ref(),
    )
}

fn write(
    bytes: &[u8],
    [width, height]: [u32; 2],
    kind: ExtendedColorType,
    path: &Path,
) -> Result<(), FrameError> {
    let mut png = Vec::new();
    // The fast kind makes files half as large again.
    PngEncoder::new_with_quality(&mut png, CompressionType::Default, FilterType::Adaptive)
        .write_image(bytes, width, height, kind)
        .map_err(|source| FrameError::Png {
            path: path.into(),
            source,
        })?;
    write_whole(path, &png)
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
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("nowhere").join("picture.png");
        let error = write_png(&Image::filled([1, 1], Vec3::ZERO), &path).unwrap_err();
        assert!(matches!(error, FrameError::Write { .. }));
        assert!(error.to_string().contains("nowhere"), "{error}");
    }
}

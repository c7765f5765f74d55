//! Picture files of textures, and how their values become linear ones.
//!
//! The kind of a picture is recognized by its content, not by its name. A PNG states how its values
//! were encoded, in its chunks cICP, sRGB or gAMA (in this order; PNG specification, third edition,
//! 4.3); without any of them, and in a JPEG, they are sRGB. Colour profiles and primaries are
//! ignored, transparency is dropped.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::ImageFormat;

use crate::texture::{Samples, Texture};

/// Where a picture is to be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureSource {
    /// A file.
    File(PathBuf),
    /// A PNG or JPEG inside the model's file.
    Bytes(Vec<u8>),
}

/// A picture file as it lies on disk, of a kind that can be decoded.
pub(crate) struct Picture {
    bytes: Vec<u8>,
    format: ImageFormat,
    width: u32,
    height: u32,
}

impl Picture {
    /// Reads a file and looks at its header.
    pub(crate) fn open(path: &Path) -> Result<Self, String> {
        Self::of(std::fs::read(path).map_err(|error| error.to_string())?)
    }

    /// Looks at the header of a file's bytes.
    pub(crate) fn of(bytes: Vec<u8>) -> Result<Self, String> {
        let Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) = image::guess_format(&bytes)
        else {
            return Err("is neither a PNG nor a JPEG picture".to_owned());
        };
        let (width, height) = image::ImageReader::with_format(Cursor::new(&bytes), format)
            .into_dimensions()
            .map_err(|error| error.to_string())?;
        Ok(Self {
            bytes,
            format,
            width,
            height,
        })
    }

    /// Texels in each direction.
    pub(crate) fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Decodes all texels.
    pub(crate) fn decode(&self) -> Result<Texture, String> {
        let (samples, table) = match self.format {
            ImageFormat::Png => png(&self.bytes)?,
            _ => jpeg(&self.bytes)?,
        };
        Ok(Texture::new([self.width, self.height], samples, table))
    }
}

/// Texels of a PNG, of 8 or 16 bits a channel, and the linear values of what they hold.
///
/// The decoder is used directly: through `image` it does not say which of its chunks gave the
/// gamma, nor whether there is a cICP.
fn png(bytes: &[u8]) -> Result<(Samples, Vec<f32>), String> {
    let text = |error: png::DecodingError| error.to_string();
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(text)?;
    let transfer = transfer(reader.info())?;
    let size = reader.output_buffer_size().ok_or("is too large")?;
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(text)?;
    // Refuses a file that is cut behind its texels, too.
    reader.finish().map_err(text)?;
    samples.truncate(frame.buffer_size());
    let channels = frame.color_type.samples();
    // Red, green and blue among the channels.
    let places = match channels {
        1 | 2 => [0; 3],
        _ => [0, 1, 2],
    };
    Ok(if frame.bit_depth == png::BitDepth::Sixteen {
        let texel = |sample: &[u8]| {
            places.map(|place| u16::from_be_bytes([sample[2 * place], sample[2 * place + 1]]))
        };
        let texels = samples.chunks_exact(2 * channels).map(texel);
        (Samples::Sixteen(texels.collect()), transfer.table(u16::MAX))
    } else {
        let texels = samples.chunks_exact(channels);
        let texels = texels.map(|sample| places.map(|place| sample[place]));
        (
            Samples::Eight(texels.collect()),
            transfer.table(u16::from(u8::MAX)),
        )
    })
}

/// Texels of a JPEG, and the linear values of what they hold.
fn jpeg(bytes: &[u8]) -> Result<(Samples, Vec<f32>), String> {
    // The decoder fills what is missing with grey, without a word.
    if !jpeg_is_whole(bytes) {
        return Err("is cut: the JPEG has no end-of-image marker".to_owned());
    }
    let picture = image::load_from_memory_with_format(bytes, ImageFormat::Jpeg)
        .map_err(|error| error.to_string())?
        .into_rgb8();
    let texels = picture.as_raw().as_chunks().0.to_vec();
    Ok((
        Samples::Eight(texels),
        Transfer::Srgb.table(u16::from(u8::MAX)),
    ))
}

/// Whether the end-of-image marker is reached from segment to segment, so that those of
/// thumbnails inside a segment do not count.
fn jpeg_is_whole(bytes: &[u8]) -> bool {
    let mut at = 0;
    // In coded data a byte 0xff is followed by 0, or by 0xd0 to 0xd7 for a restart.
    while let Some(pair) = bytes.get(at..at + 2) {
        match pair {
            [0xff, 0xd9] => return true,
            [0xff, 0x02..=0xcf | 0xda..=0xfe] => {
                let Some(length) = bytes.get(at + 2..at + 4) else {
                    return false;
                };
                at += 2 + usize::from(u16::from_be_bytes([length[0], length[1]]));
            }
            [0xff, 0x00 | 0x01 | 0xd0..=0xd8] => at += 2,
            _ => at += 1,
        }
    }
    false
}

/// How stored values in [0, 1] become linear ones.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Transfer {
    /// IEC 61966-2-1.
    Srgb,
    /// ITU-R BT.709, as a camera encodes.
    Bt709,
    /// To the power of this.
    Power(f64),
}

/// The linear value of an encoded one, both 0 to 1 (IEC 61966-2-1).
pub fn linear_from_srgb(value: f64) -> f64 {
    Transfer::Srgb.linear(value)
}

impl Transfer {
    /// Linear values of all stored ones from 0 to `most`.
    fn table(self, most: u16) -> Vec<f32> {
        (0..=most)
            .map(|value| self.linear(f64::from(value) / f64::from(most)) as f32)
            .collect()
    }

    fn linear(self, value: f64) -> f64 {
        match self {
            Self::Srgb if value <= 0.04045 => value / 12.92,
            Self::Srgb => ((value + 0.055) / 1.055).powf(2.4),
            Self::Bt709 if value < 0.081 => value / 4.5,
            Self::Bt709 => ((value + 0.099) / 1.099).powf(1.0 / 0.45),
            Self::Power(exponent) => value.powf(exponent),
        }
    }
}

/// What a PNG says about its values.
fn transfer(info: &png::Info<'_>) -> Result<Transfer, String> {
    if let Some(points) = &info.coding_independent_code_points {
        if !points.is_video_full_range_image || points.matrix_coefficients != 0 {
            return Err("has values in a video range, by its cICP chunk".to_owned());
        }
        // Numbers of ITU-T H.273.
        return match points.transfer_function {
            1 | 6 | 14 | 15 => Ok(Transfer::Bt709),
            4 => Ok(Transfer::Power(2.2)),
            5 => Ok(Transfer::Power(2.8)),
            8 => Ok(Transfer::Power(1.0)),
            13 => Ok(Transfer::Srgb),
            other => Err(format!(
                "has the transfer function {other} by its cICP chunk: understood are 1, 4, 5, 6, \
                 8, 13, 14 and 15"
            )),
        };
    }
    Ok(match info.gama_chunk {
        Some(gamma) if info.srgb.is_none() => {
            Transfer::Power(100_000.0 / f64::from(gamma.into_scaled()))
        }
        _ => Transfer::Srgb,
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn decode(bytes: &[u8]) -> Result<Texture, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture");
        std::fs::write(&path, bytes).unwrap();
        Picture::open(&path)?.decode()
    }

    /// A PNG of one row of samples.
    fn encoded(color: png::ColorType, depth: png::BitDepth, samples: &[u8]) -> Vec<u8> {
        let per_texel = color.samples() * depth as usize / 8;
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, (samples.len() / per_texel) as u32, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(samples).unwrap();
        writer.finish().unwrap();
        bytes
    }

    /// The red, green and blue of a PNG of 200, 100, 50 with chunks behind its header.
    fn shown(chunks: &[([u8; 4], &[u8])]) -> Vec3 {
        first(&with_chunks(chunks))
    }

    fn with_chunks(chunks: &[([u8; 4], &[u8])]) -> Vec<u8> {
        let mut bytes = encoded(png::ColorType::Rgb, png::BitDepth::Eight, &[200, 100, 50]);
        let chunks = chunks.iter().flat_map(|(kind, data)| chunk(*kind, data));
        // Behind the signature, and the 13 bytes of IHDR between 12 of its own.
        bytes.splice(33..33, chunks.collect::<Vec<_>>());
        bytes
    }

    /// Length, kind, data, CRC-32.
    fn chunk(kind: [u8; 4], data: &[u8]) -> Vec<u8> {
        let body = [kind.as_slice(), data].concat();
        let crc = body.iter().fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
                (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
            })
        });
        let length = (data.len() as u32).to_be_bytes();
        [&length, body.as_slice(), &(!crc).to_be_bytes()].concat()
    }

    fn first(bytes: &[u8]) -> Vec3 {
        decode(bytes).unwrap().texel(0)
    }

    fn near(found: Vec3, expected: [f32; 3]) {
        assert!(found.distance(expected.into()) < 2e-6, "{found}");
    }

    const AS_SRGB: [f32; 3] = [0.577_580_45, 0.127_437_68, 0.031_896_033];
    const AS_LINEAR: [f32; 3] = [200.0 / 255.0, 100.0 / 255.0, 50.0 / 255.0];

    #[test]
    fn srgb_ends_and_middle() {
        let table = Transfer::Srgb.table(255);
        assert_eq!((table[0], table[255]), (0.0, 1.0));
        assert!((table[128] - 0.215_86).abs() < 1e-5);
    }

    #[test]
    fn sixteen_bits_stay_sixteen() {
        use png::{BitDepth::Sixteen, ColorType};
        let half = encoded(ColorType::Grayscale, Sixteen, &[0x80, 0]);
        near(first(&half), [0.214_049; 3]);
        // Red alone differs, and by less than eight bits can tell.
        let samples = [0x80, 0x01, 0x80, 0, 0x80, 0, 0, 0];
        let color = first(&encoded(ColorType::Rgba, Sixteen, &samples));
        assert!(color.x > color.y && color.x - color.y < 1e-4, "{color}");
        assert_eq!(color.y, color.z);
    }

    #[test]
    fn a_png_says_how_it_is_encoded() {
        let gamma = |value: u32| value.to_be_bytes();
        let power = |exponent: f32| AS_LINEAR.map(|value: f32| value.powf(exponent));
        near(shown(&[]), AS_SRGB);
        near(shown(&[(*b"gAMA", &gamma(100_000))]), AS_LINEAR);
        near(shown(&[(*b"gAMA", &gamma(50_000))]), power(2.0));
        near(shown(&[(*b"gAMA", &gamma(45_455))]), power(1.0 / 0.454_55));
        // sRGB comes before gAMA, and the code points before both.
        near(
            shown(&[(*b"gAMA", &gamma(100_000)), (*b"sRGB", &[0])]),
            AS_SRGB,
        );
        let points = |transfer: u8| [1, transfer, 0, 1];
        near(
            shown(&[(*b"cICP", &points(8)), (*b"sRGB", &[0])]),
            AS_LINEAR,
        );
        near(
            shown(&[(*b"cICP", &points(13)), (*b"gAMA", &gamma(100_000))]),
            AS_SRGB,
        );
        let message = decode(&with_chunks(&[(*b"cICP", &points(16))])).unwrap_err();
        assert!(message.contains("transfer function 16"), "{message}");
    }

    fn jpeg_bytes() -> Vec<u8> {
        let mut bytes = Vec::new();
        let noisy = |x: u32, y: u32| image::Rgb([(x * 37) as u8, (y * 91) as u8, (x * y) as u8]);
        image::RgbImage::from_fn(64, 64, noisy)
            .write_to(&mut Cursor::new(&mut bytes), ImageFormat::Jpeg)
            .unwrap();
        bytes
    }

    #[test]
    fn a_cut_picture_is_refused_wherever_it_is_cut() {
        let jpeg = jpeg_bytes();
        let noise: Vec<u8> = (0..3 * 4096u32).map(|i| (i * i / 7) as u8).collect();
        let png = encoded(png::ColorType::Rgb, png::BitDepth::Eight, &noise);
        for whole in [jpeg, png] {
            assert!(decode(&whole).is_ok());
            for part in 1..64 {
                let cut = &whole[..whole.len() * part / 64];
                assert!(decode(cut).is_err(), "{part} of 64 parts");
            }
            assert!(decode(&whole[..whole.len() - 1]).is_err());
            // Behind the picture anything may follow.
            assert!(decode(&[&whole, b"more".as_slice()].concat()).is_ok());
        }
    }

    #[test]
    fn a_thumbnail_is_not_the_end_of_a_picture() {
        let whole = jpeg_bytes();
        let thumbnail = [0xff, 0xe1, 0, 6, 0xff, 0xd8, 0xff, 0xd9];
        let with = [&whole[..2], &thumbnail, &whole[2..]].concat();
        assert!(decode(&with).is_ok());
        assert!(decode(&with[..with.len() / 2]).is_err());
    }

    #[test]
    fn other_kinds_of_files_are_refused() {
        for bytes in [b"".as_slice(), b"GIF89a", b"P6 1 1 255 abc", b"{}"] {
            let message = decode(bytes).unwrap_err();
            assert!(message.contains("neither a PNG nor a JPEG"), "{message}");
        }
    }
}

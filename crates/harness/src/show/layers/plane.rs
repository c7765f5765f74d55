//! A plane of values: quantised, predicted, compressed and written as text.
//!
//! Each value becomes a code of 1 to 4 bytes. A prediction is subtracted from it (modulo the codes'
//! range). There are three: the code of the pixel on its left (at the left border, of the one above);
//! the reference's code at the same pixel; or the reference's code plus the left pixel's difference
//! from its own reference. What remains is small; its sign is folded in (0, −1, 1, −2 → 0, 1, 2, 3).
//! For a plane of one channel the lowest bytes of all pixels are written, then the next ones; for
//! several channels, all bytes of a pixel, since colours repeat as a whole. These bytes are compressed
//! (zlib, RFC 1950) and written in base64.

use std::io::Write;

use catoptric_frame::Image;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use glam::Vec3;
use serde_json::{Value, json};

/// How a value becomes a code.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Code {
    /// The code is the value, a whole number from 0. The largest code stands for no value.
    Whole {
        /// Bytes of a code.
        bytes: u32,
    },
    /// The value is `from + step · code`. The largest code stands for no value (NaN); 0 for `from` or
    /// less, the largest but one for its value or more.
    Linear {
        /// The smallest value.
        from: f64,
        /// The distance of two values.
        step: f64,
        /// Bytes of a code.
        bytes: u32,
    },
    /// 0 stands for no value (NaN), 1 for values below 2^`from`, and code ≥ 2 for
    /// 2^(`from` + `step` · (code − 2)). Of 2 bytes.
    Octaves {
        /// Exponent of the smallest value that is not taken for 0.
        from: f64,
        /// Between two values, in octaves.
        step: f64,
    },
}

impl Code {
    /// A code of 2 bytes that holds all these values, in steps of a power of two.
    pub fn fitting(values: &Image<f32>) -> Self {
        let known = values.pixels().iter().map(|value| f64::from(*value));
        let known = known.filter(|value| value.is_finite());
        let range = known.fold(None, |range: Option<[f64; 2]>, value| {
            let [low, high] = range.unwrap_or([value; 2]);
            Some([low.min(value), high.max(value)])
        });
        let [low, high] = range.unwrap_or([0.0; 2]);
        // Two codes more than are needed, since the smallest value is rounded down.
        let least = ((high - low) / 65_531.0).max(2.0_f64.powi(-24));
        let step = 2.0_f64.powf(least.log2().ceil());
        Self::Linear {
            from: (low / step).floor() * step,
            step,
            bytes: 2,
        }
    }

    fn bytes(self) -> u32 {
        match self {
            Self::Whole { bytes } | Self::Linear { bytes, .. } => bytes,
            Self::Octaves { .. } => 2,
        }
    }

    /// The largest code.
    fn last(self) -> u32 {
        u32::MAX >> (32 - 8 * self.bytes())
    }

    fn of(self, value: f32) -> u32 {
        let value = f64::from(value);
        let last = self.last();
        let most = f64::from(last - 1);
        match self {
            Self::Octaves { .. } if value.is_nan() => 0,
            _ if value.is_nan() => last,
            Self::Whole { .. } => value.clamp(0.0, most) as u32,
            Self::Linear { from, step, .. } => {
                ((value - from) / step).round().clamp(0.0, most) as u32
            }
            Self::Octaves { from, step } => {
                let place = 2.0 + (value.max(0.0).log2() - from) / step;
                place.round().clamp(1.0, f64::from(last)) as u32
            }
        }
    }

    /// As the page reads it.
    fn stated(self) -> Value {
        match self {
            Self::Whole { bytes } => json!({"code": "whole", "bytes": bytes}),
            Self::Linear { from, step, bytes } => {
                json!({"code": "linear", "bytes": bytes, "from": from, "step": step})
            }
            Self::Octaves { from, step } => {
                json!({"code": "octaves", "bytes": 2, "from": from, "step": step})
            }
        }
    }
}

/// Numbers of each pixel.
pub struct Plane {
    /// As the page asks for it.
    pub name: String,
    width: usize,
    /// Numbers a pixel; they lie beside one another.
    channels: usize,
    code: Code,
    codes: Vec<u32>,
}

impl Plane {
    /// Quantises an image; NaN is no value.
    pub fn of(name: &str, image: &Image<f32>, code: Code) -> Self {
        Self {
            name: name.to_owned(),
            width: image.size()[0] as usize,
            channels: 1,
            code,
            codes: image.pixels().iter().map(|value| code.of(*value)).collect(),
        }
    }

    /// Quantises an image of vectors, as three channels.
    pub fn of_vectors(name: &str, image: &Image<Vec3>, code: Code) -> Self {
        let values = image.pixels().iter().flat_map(|vector| vector.to_array());
        Self {
            name: name.to_owned(),
            width: image.size()[0] as usize,
            channels: 3,
            code,
            codes: values.map(|value| code.of(value)).collect(),
        }
    }

    /// The plane as JSON, by the prediction that makes it shortest. The reference's plane serves where
    /// it is given and has the same code.
    pub fn encode(&self, reference: Option<&Self>) -> anyhow::Result<Value> {
        let row = self.width * self.channels;
        let before = |place: usize| match (place % row < self.channels, place < row) {
            (false, _) => Some(place - self.channels),
            (true, false) => Some(place - row),
            (true, true) => None,
        };
        let codes = &self.codes;
        let left = |place| before(place).map_or(0, |before| codes[before]);
        let mut found = vec![("left", self.compressed(left)?)];
        if let Some(reference) = reference.filter(|other| other.code == self.code) {
            let truth = &reference.codes;
            let change = |place| {
                let change = before(place).map(|before| codes[before].wrapping_sub(truth[before]));
                truth[place].wrapping_add(change.unwrap_or(0))
            };
            found.push(("reference", self.compressed(|place| truth[place])?));
            found.push(("change", self.compressed(change)?));
        }
        let (predict, bytes) = found
            .into_iter()
            .min_by_key(|(_, bytes)| bytes.len())
            .unwrap_or_default();
        let mut stated = self.code.stated();
        stated["channels"] = json!(self.channels);
        stated["predict"] = json!(predict);
        stated["data"] = json!(base64(&bytes));
        Ok(stated)
    }

    fn compressed(&self, prediction: impl Fn(usize) -> u32) -> anyhow::Result<Vec<u8>> {
        let bytes = self.code.bytes();
        let unused = 32 - 8 * bytes;
        let folded = self.codes.iter().enumerate().map(|(place, code)| {
            // The difference modulo the codes' range, as a signed number.
            let difference =
                (code.wrapping_sub(prediction(place)) << unused).cast_signed() >> unused;
            ((difference << 1) ^ (difference >> 31)).cast_unsigned()
        });
        let folded: Vec<u32> = folded.collect();
        let part = |value: u32, byte: u32| (value >> (8 * byte)) as u8;
        let written: Vec<u8> = match self.channels {
            1 => (0..bytes)
                .flat_map(|byte| folded.iter().map(move |value| part(*value, byte)))
                .collect(),
            _ => folded
                .iter()
                .flat_map(|value| (0..bytes).map(move |byte| part(*value, byte)))
                .collect(),
        };
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(&written)?;
        Ok(encoder.finish()?)
    }
}

/// RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const SIGNS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let groups = bytes.chunks(3).flat_map(|group| {
        let byte = |place: usize| u32::from(group.get(place).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        [18, 12, 6, 0]
            .into_iter()
            .enumerate()
            .map(move |(place, shift)| match place <= group.len() {
                true => char::from(SIGNS[(bits >> shift & 63) as usize]),
                false => '=',
            })
    });
    groups.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(values: &[f32], code: Code) -> Plane {
        Plane::of(
            "x",
            &Image::from_vec([values.len() as u32, 1], values.to_vec()),
            code,
        )
    }

    #[test]
    fn base64_as_in_the_rfc() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }

    #[test]
    fn codes_have_places_for_none_and_for_what_is_outside() {
        let linear = Code::Linear {
            from: -1.0,
            step: 0.5,
            bytes: 1,
        };
        let values = [f32::NAN, -7.0, -1.0, 0.2, 1e9, f32::INFINITY];
        assert_eq!(plane(&values, linear).codes, [255, 0, 0, 2, 254, 254]);
        let octaves = Code::Octaves {
            from: -2.0,
            step: 0.5,
        };
        let values = [f32::NAN, 0.0, 0.1, 0.25, 1.0, f32::INFINITY];
        assert_eq!(plane(&values, octaves).codes, [0, 1, 1, 2, 6, 65_535]);
        let whole = Code::Whole { bytes: 2 };
        assert_eq!(
            plane(&[0.0, 300.0, f32::NAN], whole).codes,
            [0, 300, 65_535]
        );
    }

    #[test]
    fn steps_that_fit_hold_every_value_within_half_a_step() {
        for values in [
            vec![-3.0, 1000.25, f32::NAN, 7.0],
            vec![0.0, 1e-9],
            vec![1e6, -1e6],
            vec![f32::NAN],
        ] {
            let image = Image::from_vec([values.len() as u32, 1], values.clone());
            let code = Code::fitting(&image);
            let Code::Linear { from, step, .. } = code else {
                panic!("{code:?}");
            };
            for value in values.iter().filter(|value| !value.is_nan()) {
                let got = code.of(*value);
                let back = from + step * f64::from(got);
                assert!(
                    (back - f64::from(*value)).abs() <= step / 2.0,
                    "{value} {back}"
                );
                assert!(got < 65_534, "{value}");
            }
        }
    }

    #[test]
    fn what_is_like_the_reference_costs_next_to_nothing() {
        let hash = |place: u32| {
            let once = place.wrapping_mul(2_654_435_761);
            (once ^ (once >> 15)).wrapping_mul(2_246_822_519) >> 20
        };
        let noise = || {
            (0..4096)
                .map(|place| hash(place) as f32)
                .collect::<Vec<_>>()
        };
        let code = Code::Whole { bytes: 2 };
        let (truth, same) = (plane(&noise(), code), plane(&noise(), code));
        let size = |value: &Value| value["data"].as_str().map_or(0, str::len);
        let alone = same.encode(None).unwrap();
        let beside = same.encode(Some(&truth)).unwrap();
        assert_eq!(
            (&alone["predict"], &beside["predict"]),
            (&json!("left"), &json!("reference"))
        );
        assert!(size(&beside) < 100 && size(&alone) > 4000);
        let brighter = noise().into_iter().zip((0..=255_u8).cycle());
        let brighter: Vec<f32> = brighter
            .map(|(value, more)| value + 3.0 * f32::from(more))
            .collect();
        let brighter = plane(&brighter, code).encode(Some(&truth)).unwrap();
        assert_eq!(brighter["predict"], "change");
        assert!(size(&brighter) < 300);
    }
}

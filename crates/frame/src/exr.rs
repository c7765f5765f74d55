//! Frames as OpenEXR files.
//!
//! Written: one part, scanlines, ZIP, every channel 32-bit float (ids and status codes included),
//! data window = display window. Channel names: `R G B`, `primary.id`, `primary.position.{X,Y,Z}`,
//! `primary.normal.{X,Y,Z}`, `reflected.id`, `reflected.position.{X,Y,Z}`, `reflected.distance`,
//! `reflected.status` (the code of [`Status`]) and, under truth `full`, `bounces`. The header text
//! `catoptric.ids` lists the ids, one a line: `1 object floor`.
//!
//! Read: the same, and what other renderers write: channels in any order, half or unsigned samples,
//! any lossless or lossy compression the `exr` crate knows, only colour, no status, no names.

use std::collections::BTreeMap;
use std::path::Path;

use exr::error::Error;
use exr::image::{
    AnyChannel, AnyChannels, Encoding, FlatImage, FlatSamples, Image as ExrImage, Layer,
};
use exr::prelude::{ReadChannels, ReadLayers, SmallVec, WritableImage};
use glam::Vec3;

use crate::atomic::write_atomically;
use crate::{Frame, FrameError, Image, Name, Primary, Reflected, Status, names};

/// Header attribute with the id → name list.
const IDS_ATTRIBUTE: &str = "catoptric.ids";

/// The largest id whose neighbours are all exact in a 32-bit float.
const MAX_ID: f32 = 16_777_216.0;

const AXES: [&str; 3] = ["X", "Y", "Z"];

impl Frame {
    /// Writes all layers as one OpenEXR file; see the module for the channels. The file is there
    /// whole or not at all.
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), FrameError> {
        let path = path.as_ref();
        let odd = |reason| FrameError::Odd {
            path: path.into(),
            reason,
        };
        self.check_sizes().map_err(odd)?;

        let channels = self.channels();
        if let Some((name, _)) = channels
            .iter()
            .filter(|(name, _)| name.ends_with("id"))
            .find(|(_, samples)| samples.iter().any(|&id| id > MAX_ID))
        {
            return Err(FrameError::OddChannel {
                path: path.into(),
                channel: name.clone(),
                reason: format!("an id above {MAX_ID} does not fit a 32-bit float"),
            });
        }
        let list: SmallVec<_> = channels
            .into_iter()
            .map(|(name, samples)| AnyChannel::new(&*name, FlatSamples::F32(samples)))
            .collect();

        let [width, height] = self.color.size().map(|side| side as usize);
        let mut image = ExrImage::from_layer(Layer::new(
            (width, height),
            exr::meta::header::LayerAttributes::default(),
            Encoding {
                compression: exr::compression::Compression::ZIP16,
                blocks: exr::image::Blocks::ScanLines,
                line_order: exr::meta::attribute::LineOrder::Increasing,
            },
            AnyChannels::sort(list),
        ));
        if !self.names.is_empty() {
            use exr::meta::attribute::{AttributeValue, Text};
            let list = names::to_text(&self.names).map_err(odd)?;
            // Bytes as they are: EXR text has no stated encoding, ours is UTF-8.
            let list = AttributeValue::Text(Text::from_slice_unchecked(list.as_bytes()));
            image
                .layer_data
                .attributes
                .other
                .insert(IDS_ATTRIBUTE.into(), list);
        }
        write_atomically(path, |writer| {
            image
                .write()
                .to_buffered(writer)
                .map_err(|error| match error {
                    Error::Io(source) => FrameError::Write {
                        path: path.into(),
                        source,
                    },
                    source => FrameError::Exr {
                        path: path.into(),
                        source,
                    },
                })
        })
    }

    /// Reads an OpenEXR file, ours or another renderer's.
    ///
    /// `R G B` must be there. The `primary` channels are there all or none, likewise the
    /// `reflected` ones; then the layer is `None`. Without `reflected.status`, the pixels of
    /// mirrors (by the name list) are taken as resolved; without a name list, `names` is empty:
    /// see [`Frame::assign_names`].
    pub fn read_exr(path: impl AsRef<Path>) -> Result<Self, FrameError> {
        let path = path.as_ref();
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_file(path)
            .map_err(|error| match error {
                Error::Io(source) => FrameError::Read {
                    path: path.into(),
                    source,
                },
                source => FrameError::Exr {
                    path: path.into(),
                    source,
                },
            })?;
        Reader::new(path, image)?.frame()
    }

    fn check_sizes(&self) -> Result<(), String> {
        let mut layers = Vec::new();
        if let Some(Primary {
            id,
            position,
            normal,
        }) = &self.primary
        {
            layers.extend([
                ("primary.id", id.size()),
                ("primary.position", position.size()),
                ("primary.normal", normal.size()),
            ]);
        }
        if let Some(Reflected {
            status,
            id,
            position,
            distance,
            bounces,
        }) = &self.reflected
        {
            layers.extend([
                ("reflected.status", status.size()),
                ("reflected.id", id.size()),
                ("reflected.position", position.size()),
                ("reflected.distance", distance.size()),
            ]);
            layers.extend(bounces.iter().map(|bounces| ("bounces", bounces.size())));
        }
        let expected = self.color.size();
        if expected.contains(&0) {
            return Err("the picture has no pixels".into());
        }
        match layers.into_iter().find(|&(_, size)| size != expected) {
            Some((name, size)) => Err(format!(
                "layer `{name}` is {size:?} where the colour is {expected:?}"
            )),
            None => Ok(()),
        }
    }

    /// All channels with their names, in no particular order.
    fn channels(&self) -> Vec<(String, Vec<f32>)> {
        let mut channels = Vec::new();
        let mut vectors = |prefix: &str, suffixes: [&str; 3], image: &Image<Vec3>| {
            for (axis, suffix) in suffixes.into_iter().enumerate() {
                let samples = image.pixels().iter().map(|pixel| pixel[axis]).collect();
                channels.push((format!("{prefix}{suffix}"), samples));
            }
        };
        vectors("", ["R", "G", "B"], &self.color);
        if let Some(primary) = &self.primary {
            vectors("primary.position.", AXES, &primary.position);
            vectors("primary.normal.", AXES, &primary.normal);
        }
        if let Some(reflected) = &self.reflected {
            vectors("reflected.position.", AXES, &reflected.position);
        }

        let ids = |image: &Image<u32>| image.pixels().iter().map(|&id| id as f32).collect();
        if let Some(primary) = &self.primary {
            channels.push(("primary.id".into(), ids(&primary.id)));
        }
        if let Some(Reflected {
            status,
            id,
            distance,
            bounces,
            ..
        }) = &self.reflected
        {
            let codes = status
                .pixels()
                .iter()
                .map(|&status| f32::from(status as u8))
                .collect();
            channels.push(("reflected.status".into(), codes));
            channels.push(("reflected.id".into(), ids(id)));
            channels.push(("reflected.distance".into(), distance.pixels().to_vec()));
            channels.extend(
                bounces
                    .iter()
                    .map(|bounces| ("bounces".into(), ids(bounces))),
            );
        }
        channels
    }
}

/// The channels of one file, taken out by name.
struct Reader<'path> {
    path: &'path Path,
    size: [u32; 2],
    channels: BTreeMap<String, Vec<f32>>,
    present: String,
    names: Vec<Name>,
}

impl<'path> Reader<'path> {
    fn new(path: &'path Path, mut image: FlatImage) -> Result<Self, FrameError> {
        let odd = |reason| FrameError::Odd {
            path: path.into(),
            reason,
        };
        if image.layer_data.len() != 1 {
            return Err(odd(format!(
                "has {} parts, one is expected",
                image.layer_data.len()
            )));
        }
        let layer = image.layer_data.remove(0);
        let display = image.attributes.display_window;
        let position = layer.attributes.layer_position;
        if (position, layer.size) != (display.position, display.size) {
            return Err(odd(format!(
                "the data window ({} × {} at {}, {}) is not the display window ({} × {} at {}, {})",
                layer.size.0,
                layer.size.1,
                position.0,
                position.1,
                display.size.0,
                display.size.1,
                display.position.0,
                display.position.1,
            )));
        }
        let names = match layer.attributes.other.get(IDS_ATTRIBUTE.as_bytes()) {
            Some(value) => {
                let text = value
                    .to_text()
                    .ok()
                    .and_then(|text| str::from_utf8(text.as_slice()).ok());
                text.ok_or_else(|| "is not UTF-8 text".to_owned())
                    .and_then(names::from_text)
                    .map_err(|reason| odd(format!("header `{IDS_ATTRIBUTE}`: {reason}")))?
            }
            None => Vec::new(),
        };

        let mut channels = BTreeMap::new();
        for channel in layer.channel_data.list {
            let name = channel.name.to_string();
            if channel.sampling != exr::math::Vec2(1, 1) {
                let reason = "is subsampled; one sample a pixel is expected".into();
                return Err(FrameError::OddChannel {
                    path: path.into(),
                    channel: name,
                    reason,
                });
            }
            let samples = match channel.sample_data {
                FlatSamples::F32(samples) => samples,
                other => other.values_as_f32().collect(),
            };
            channels.insert(name, samples);
        }
        let present = channels
            .keys()
            .map(String::as_str)
            .collect::<Vec<_>>()
            .join(" ");
        let size = [layer.size.0 as u32, layer.size.1 as u32];
        Ok(Self {
            path,
            size,
            channels,
            present,
            names,
        })
    }

    fn frame(mut self) -> Result<Frame, FrameError> {
        let color = self.vectors("", ["R", "G", "B"])?;
        let primary = if self.any("primary.") {
            Some(Primary {
                id: self.integers("primary.id")?,
                position: self.vectors("primary.position.", AXES)?,
                normal: self.vectors("primary.normal.", AXES)?,
            })
        } else {
            None
        };
        let reflected = if self.any("reflected.") {
            let id = self.integers("reflected.id")?;
            let status = if self.channels.contains_key("reflected.status") {
                self.status("reflected.status")?
            } else {
                names::derived_status(&self.names, primary.as_ref(), &id)
            };
            let bounces = self.channels.contains_key("bounces");
            Some(Reflected {
                status,
                id,
                position: self.vectors("reflected.position.", AXES)?,
                distance: self.numbers("reflected.distance")?,
                bounces: if bounces {
                    Some(self.integers("bounces")?)
                } else {
                    None
                },
            })
        } else {
            None
        };
        Ok(Frame {
            color,
            primary,
            reflected,
            names: self.names,
        })
    }

    fn any(&self, prefix: &str) -> bool {
        self.channels.keys().any(|name| name.starts_with(prefix))
    }

    fn numbers(&mut self, name: &str) -> Result<Image<f32>, FrameError> {
        match self.channels.remove(name) {
            Some(samples) => Ok(Image::from_vec(self.size, samples)),
            None => Err(FrameError::MissingChannel {
                path: self.path.into(),
                channel: name.into(),
                present: self.present.clone(),
            }),
        }
    }

    fn vectors(&mut self, prefix: &str, suffixes: [&str; 3]) -> Result<Image<Vec3>, FrameError> {
        let mut pixels = vec![Vec3::ZERO; self.size[0] as usize * self.size[1] as usize];
        for (axis, suffix) in suffixes.into_iter().enumerate() {
            let samples = self.numbers(&format!("{prefix}{suffix}"))?;
            for (pixel, &sample) in pixels.iter_mut().zip(samples.pixels()) {
                pixel[axis] = sample;
            }
        }
        Ok(Image::from_vec(self.size, pixels))
    }

    fn integers(&mut self, name: &str) -> Result<Image<u32>, FrameError> {
        let samples = self.numbers(name)?;
        let whole = |&sample: &f32| sample.fract() == 0.0 && (0.0..=MAX_ID).contains(&sample);
        self.check(name, &samples, whole, "a whole number from 0")?;
        Ok(samples.map(|&sample| sample as u32))
    }

    fn status(&mut self, name: &str) -> Result<Image<Status>, FrameError> {
        let samples = self.numbers(name)?;
        self.check(
            name,
            &samples,
            |&code| status_of(code).is_some(),
            "a status code",
        )?;
        Ok(samples.map(|&code| status_of(code).unwrap_or_default()))
    }

    fn check(
        &self,
        name: &str,
        samples: &Image<f32>,
        fits: impl Fn(&f32) -> bool,
        expected: &str,
    ) -> Result<(), FrameError> {
        match samples.pixels().iter().position(|sample| !fits(sample)) {
            None => Ok(()),
            Some(index) => {
                let (value, width) = (samples.pixels()[index], self.size[0] as usize);
                let (x, y) = (index % width, index / width);
                Err(FrameError::OddChannel {
                    path: self.path.into(),
                    channel: name.into(),
                    reason: format!("{value} at column {x}, row {y} is not {expected}"),
                })
            }
        }
    }
}

/// The status with this code.
fn status_of(code: f32) -> Option<Status> {
    [
        Status::NotMirror,
        Status::Resolved,
        Status::Unresolved,
        Status::Below,
        Status::Back,
    ]
    .into_iter()
    .find(|&status| f32::from(status as u8) == code)
}

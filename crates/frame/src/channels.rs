//! The channels of an OpenEXR file by name, each of them there or not.
//!
//! [`Frame::read_exr`](crate::Frame::read_exr) wants whole layers; this is for callers that can use
//! less.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Seek};
use std::path::{Path, PathBuf};

use exr::error::Error;
use exr::image::{FlatImage, FlatSamples};
use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers};
use glam::Vec3;

use crate::{FrameError, Image, Name, Status, names};

/// Header attribute with the id → name list.
pub(crate) const IDS_ATTRIBUTE: &str = "catoptric.ids";

/// What the `exr` crate says of a file that ends too early.
const MISSING_BYTES: &str = "reference to missing bytes";

/// The largest id up to which a 32-bit float holds every whole number.
pub(crate) const MAX_ID: f32 = 16_777_216.0;

pub(crate) const AXES: [&str; 3] = ["X", "Y", "Z"];

/// The most pixels of a picture that is read.
pub const MOST_PIXELS: u64 = 1 << 25;

/// The most channels of a picture that is read.
pub const MOST_CHANNELS: usize = 64;

/// One byte of a file never holds more bytes of pixels than this, not even in a picture of one
/// colour: a header that promises more is wrong, or the file was cut off.
const MOST_EXPANSION: u64 = 1 << 17;

/// What a file holds.
#[derive(Clone, Debug)]
pub struct Channels {
    path: PathBuf,
    size: [u32; 2],
    channels: BTreeMap<String, Channel>,
    names: Vec<Name>,
}

#[derive(Clone, Debug)]
struct Channel {
    samples: Vec<f32>,
    half: bool,
}

impl Channels {
    /// Reads a file of one part whose data window is its display window; see
    /// [`exr`](crate::exr) for what else is accepted. The header is checked before anything is
    /// decoded: `MOST_PIXELS` and `MOST_CHANNELS` at most.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FrameError> {
        let path = path.as_ref();
        let read_error = |source| FrameError::Read {
            path: path.into(),
            source,
        };
        let refused = |reason: &str| FrameError::Refused {
            path: path.into(),
            reason: reason.into(),
        };
        let exr_error = |error| match error {
            Error::Io(source) => read_error(source),
            Error::Invalid(text) if text == MISSING_BYTES => {
                refused("ends before the picture does: it was cut off, or not written to the end")
            }
            source => FrameError::Exr {
                path: path.into(),
                source,
            },
        };
        let metadata = std::fs::metadata(path).map_err(read_error)?;
        if !metadata.is_file() {
            return Err(refused(
                "is a folder, a device or a pipe; an OpenEXR file is expected",
            ));
        }
        if metadata.len() == 0 {
            return Err(refused("is empty; an OpenEXR file is expected"));
        }
        let mut file = BufReader::new(File::open(path).map_err(read_error)?);
        let header = MetaData::read_from_buffered(&mut file, false).map_err(exr_error)?;
        check_header(path, &header.headers, metadata.len())?;
        file.rewind().map_err(read_error)?;
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(file)
            .map_err(exr_error)?;
        Self::of(path, image)
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The id → name list in the header, ids ascending; empty without one.
    pub fn names(&self) -> &[Name] {
        &self.names
    }

    /// Where the file itself does not say which pixels are mirrors, a sentence about how that was
    /// found out: see [`Frame::from_channels`](crate::Frame::from_channels).
    pub fn status_note(&self) -> Option<String> {
        if !self.any("reflected.") || self.any("reflected.status") {
            return None;
        }
        let from = if self.names.is_empty() {
            "a pixel is taken to be a mirror's where its `primary.id` has a `reflected.id` somewhere, \
             since the header has no `catoptric.ids`"
        } else {
            "a pixel is taken to be a mirror's where `catoptric.ids` says so of its `primary.id`"
        };
        Some(format!(
            "{}: no channel `reflected.status`: {from}; each such pixel counts as resolved",
            self.path.display()
        ))
    }

    /// Full names of all channels, in alphabetical order.
    pub fn channel_names(&self) -> impl Iterator<Item = &str> {
        self.channels.keys().map(String::as_str)
    }

    /// True if the name of some channel begins with `prefix`.
    pub fn any(&self, prefix: &str) -> bool {
        self.channels.keys().any(|name| name.starts_with(prefix))
    }

    /// True if some channel whose name begins with `prefix` has 16-bit samples.
    pub fn half(&self, prefix: &str) -> bool {
        let mut channels = self.channels.iter();
        channels.any(|(name, channel)| name.starts_with(prefix) && channel.half)
    }

    /// What `read` finds under a name, or the error that it is missing.
    pub(crate) fn required<T>(
        &self,
        name: &str,
        read: impl Fn(&Self, &str) -> Result<Option<T>, FrameError>,
    ) -> Result<T, FrameError> {
        read(self, name)?.ok_or_else(|| self.missing(name))
    }

    /// One number a pixel; `None` where there is no such channel.
    pub fn numbers(&self, name: &str) -> Result<Option<Image<f32>>, FrameError> {
        let channel = self.channels.get(name);
        Ok(channel.map(|channel| Image::from_vec(self.size, channel.samples.clone())))
    }

    /// `R`, `G` and `B` after a prefix; `None` where none of them is there.
    pub fn colors(&self, prefix: &str) -> Result<Option<Image<Vec3>>, FrameError> {
        self.vectors(prefix, ["R", "G", "B"])
    }

    /// `X`, `Y` and `Z` after a prefix; `None` where none of them is there.
    pub fn positions(&self, prefix: &str) -> Result<Option<Image<Vec3>>, FrameError> {
        self.vectors(prefix, AXES)
    }

    fn vectors(
        &self,
        prefix: &str,
        suffixes: [&str; 3],
    ) -> Result<Option<Image<Vec3>>, FrameError> {
        let full = suffixes.map(|suffix| format!("{prefix}{suffix}"));
        if !full.iter().any(|name| self.channels.contains_key(name)) {
            return Ok(None);
        }
        let mut pixels = vec![Vec3::ZERO; self.size[0] as usize * self.size[1] as usize];
        for (axis, name) in full.iter().enumerate() {
            let channel = self.channels.get(name).ok_or_else(|| self.missing(name))?;
            for (pixel, &sample) in pixels.iter_mut().zip(&channel.samples) {
                pixel[axis] = sample;
            }
        }
        Ok(Some(Image::from_vec(self.size, pixels)))
    }

    /// One whole number from 0 a pixel; `None` where there is no such channel.
    pub fn integers(&self, name: &str) -> Result<Option<Image<u32>>, FrameError> {
        let Some(samples) = self.numbers(name)? else {
            return Ok(None);
        };
        let whole = |&sample: &f32| sample.fract() == 0.0 && (0.0..=MAX_ID).contains(&sample);
        self.check(name, &samples, whole, "a whole number from 0")?;
        Ok(Some(samples.map(|&sample| sample as u32)))
    }

    /// One [`Status`] code a pixel; `None` where there is no such channel.
    pub fn statuses(&self, name: &str) -> Result<Option<Image<Status>>, FrameError> {
        let Some(samples) = self.numbers(name)? else {
            return Ok(None);
        };
        let known = |&code: &f32| status_of(code).is_some();
        self.check(name, &samples, known, "a status code")?;
        let status = |&code: &f32| status_of(code).unwrap_or_default();
        Ok(Some(samples.map(status)))
    }

    fn missing(&self, name: &str) -> FrameError {
        let present: Vec<&str> = self.channels.keys().map(String::as_str).collect();
        // Of a group the prefix is known, and which channel of it is missed first.
        let first = match name {
            "" => "R".to_owned(),
            group if group.ends_with('.') => format!("{group}X"),
            channel => channel.to_owned(),
        };
        FrameError::MissingChannel {
            path: self.path.clone(),
            channel: first,
            present: present.join(" "),
        }
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
                Err(FrameError::RefusedChannel {
                    path: self.path.clone(),
                    channel: name.into(),
                    reason: format!("{value} at column {x}, row {y} is not {expected}"),
                })
            }
        }
    }

    fn of(path: &Path, mut image: FlatImage) -> Result<Self, FrameError> {
        let refused = |reason| FrameError::Refused {
            path: path.into(),
            reason,
        };
        let layer = image.layer_data.remove(0);
        let names = match layer.attributes.other.get(IDS_ATTRIBUTE.as_bytes()) {
            Some(value) => {
                let text = value
                    .to_text()
                    .ok()
                    .and_then(|text| str::from_utf8(text.as_slice()).ok());
                text.ok_or_else(|| "is not UTF-8 text".to_owned())
                    .and_then(names::from_text)
                    .map_err(|reason| refused(format!("header `{IDS_ATTRIBUTE}`: {reason}")))?
            }
            None => Vec::new(),
        };

        let mut channels = BTreeMap::new();
        for channel in layer.channel_data.list {
            let half = matches!(channel.sample_data, FlatSamples::F16(_));
            let samples = match channel.sample_data {
                FlatSamples::F32(samples) => samples,
                other => other.values_as_f32().collect(),
            };
            channels.insert(channel.name.to_string(), Channel { samples, half });
        }
        let size = [layer.size.0 as u32, layer.size.1 as u32];
        Ok(Self {
            path: path.into(),
            size,
            channels,
            names,
        })
    }
}

/// Refuses what cannot be read, or would take more memory than a picture may, before it is decoded.
fn check_header(path: &Path, parts: &[Header], file_bytes: u64) -> Result<(), FrameError> {
    let refused = |reason| FrameError::Refused {
        path: path.into(),
        reason,
    };
    let [header] = parts else {
        let count = parts.len();
        return Err(refused(format!("has {count} parts, one is expected")));
    };
    if header.deep {
        return Err(refused(
            "holds deep data; one sample a pixel is expected".into(),
        ));
    }
    let (window, display) = (header.layer_size, header.shared_attributes.display_window);
    let (width, height) = (window.0 as u64, window.1 as u64);
    let pixels = width.saturating_mul(height);
    if pixels > MOST_PIXELS {
        return Err(refused(format!(
            "the data window is {width} × {height} pixels; {MOST_PIXELS} in all are the most"
        )));
    }
    let position = header.own_attributes.layer_position;
    if (position, window) != (display.position, display.size) {
        return Err(refused(format!(
            "the data window ({width} × {height} at {}, {}) is not the display window ({} × {} at {}, {})",
            position.0,
            position.1,
            display.size.0,
            display.size.1,
            display.position.0,
            display.position.1,
        )));
    }
    let channels = &header.channels.list;
    if channels.len() > MOST_CHANNELS {
        let count = channels.len();
        return Err(refused(format!(
            "has {count} channels; {MOST_CHANNELS} are the most"
        )));
    }
    for channel in channels {
        if channel.sampling != exr::math::Vec2(1, 1) {
            return Err(FrameError::RefusedChannel {
                path: path.into(),
                channel: channel.name.to_string(),
                reason: "is subsampled; one sample a pixel is expected".into(),
            });
        }
    }
    let bytes = pixels * channels.iter().map(bytes_per_sample).sum::<u64>();
    if bytes > file_bytes.saturating_mul(MOST_EXPANSION) {
        return Err(refused(format!(
            "{width} × {height} pixels of {} channels cannot be in {file_bytes} bytes",
            channels.len()
        )));
    }
    Ok(())
}

fn bytes_per_sample(channel: &exr::meta::attribute::ChannelDescription) -> u64 {
    channel.sample_type.bytes_per_sample() as u64
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

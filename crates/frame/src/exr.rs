//! Frames as OpenEXR files.
//!
//! Written: one part, scanlines, ZIP, every channel 32-bit float (ids and status codes included), data
//! window = display window. Channel names: `R G B`, `primary.id`, `primary.position.{X,Y,Z}`,
//! `primary.normal.{X,Y,Z}`, `reflected.id`, `reflected.position.{X,Y,Z}`, `reflected.distance`,
//! `reflected.status` (the code of [`crate::Status`]) and, under truth `full`, `bounces`. Where the
//! motion of the reflections is known, also `motion.{X,Y}` and `motion.valid` (1, or 0 where the vector
//! means nothing); from the reference also `motion.disoccluded` (1 where the point was hidden in the
//! frame before); if another program's convention was asked for, also `mv.{X,Y}` and `mv.distance`. The
//! header text `catoptric.ids` lists the ids, one a line: `1 object floor`.
//!
//! Read: the same, and what other renderers write: channels in any order, half or unsigned samples,
//! any lossless or lossy compression the `exr` crate knows, only colour, no status, no names.

use std::io::Cursor;
use std::path::Path;

use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image as ExrImage, Layer};
use exr::prelude::{SmallVec, WritableImage};
use glam::{Vec2, Vec3};

use crate::channels::{AXES, Channels, IDS_ATTRIBUTE, MAX_ID};
use crate::{Frame, FrameError, Image, Motion, Primary, Reflected, names, write_whole};

impl Frame {
    /// Writes all layers as one OpenEXR file; see the module for the channels. The file is there
    /// whole or not at all.
    pub fn write_exr(&self, path: impl AsRef<Path>) -> Result<(), FrameError> {
        let path = path.as_ref();
        write_whole(path, &self.to_exr(path)?)
    }

    /// The OpenEXR file that [`Frame::write_exr`] writes; messages name it by `path`.
    ///
    /// # Errors
    /// Layers differ in size, or hold what the format cannot.
    pub fn to_exr(&self, path: &Path) -> Result<Vec<u8>, FrameError> {
        let refused = |reason| FrameError::Refused {
            path: path.into(),
            reason,
        };
        self.check_sizes().map_err(refused)?;

        let channels = self.channels();
        if let Some((name, _)) = channels
            .iter()
            .filter(|(name, _)| name.ends_with("id"))
            .find(|(_, samples)| samples.iter().any(|&id| id > MAX_ID))
        {
            return Err(FrameError::RefusedChannel {
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
            let list = names::to_text(&self.names).map_err(refused)?;
            // Bytes as they are: EXR text has no stated encoding, ours is UTF-8.
            let list = AttributeValue::Text(Text::from_slice_unchecked(list.as_bytes()));
            image
                .layer_data
                .attributes
                .other
                .insert(IDS_ATTRIBUTE.into(), list);
        }
        let mut bytes = Cursor::new(Vec::new());
        image
            .write()
            .to_buffered(&mut bytes)
            .map_err(|source| FrameError::Exr {
                path: path.into(),
                source,
            })?;
        Ok(bytes.into_inner())
    }

    /// Reads an OpenEXR file, ours or another renderer's: see [`Frame::from_channels`].
    pub fn read_exr(path: impl AsRef<Path>) -> Result<Self, FrameError> {
        Self::from_channels(&Channels::read(path)?)
    }

    /// The layers of a file.
    ///
    /// `R G B` must be there. Either all `primary` channels are there or none, and likewise the
    /// `reflected` ones; without its channels a layer is `None`. Without `reflected.status`, the pixels
    /// of mirrors count as resolved: those whose ids the name list calls mirrors, or, without a name
    /// list, those of every `primary.id` that has a `reflected.id` at some pixel. Without
    /// `motion.valid`, a vector is known where it is finite. Without a name list, `names` is empty: see
    /// [`Frame::assign_names`].
    pub fn from_channels(channels: &Channels) -> Result<Self, FrameError> {
        let primary = if channels.any("primary.") {
            Some(Primary {
                id: channels.required("primary.id", Channels::integers)?,
                position: channels.required("primary.position.", Channels::positions)?,
                normal: channels.required("primary.normal.", Channels::positions)?,
            })
        } else {
            None
        };
        let reflected = if channels.any("reflected.") {
            let id = channels.required("reflected.id", Channels::integers)?;
            let status = match channels.statuses("reflected.status")? {
                Some(status) => status,
                None => names::derived_status(channels.names(), primary.as_ref(), &id),
            };
            Some(Reflected {
                status,
                id,
                position: channels.required("reflected.position.", Channels::positions)?,
                distance: channels.required("reflected.distance", Channels::numbers)?,
                bounces: channels.integers("bounces")?,
            })
        } else {
            None
        };
        let motion = if channels.any("motion.") {
            let [x, y] =
                ["motion.X", "motion.Y"].map(|name| channels.required(name, Channels::numbers));
            Some(motion(channels, &x?, &y?)?)
        } else {
            None
        };
        Ok(Frame {
            color: channels.required("", Channels::colors)?,
            primary,
            reflected,
            motion,
            names: channels.names().to_vec(),
        })
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
        if let Some(Motion {
            vector,
            valid,
            disoccluded,
            converted,
        }) = &self.motion
        {
            layers.extend([("motion", vector.size()), ("motion.valid", valid.size())]);
            let hidden = disoccluded.iter();
            layers.extend(hidden.map(|hidden| ("motion.disoccluded", hidden.size())));
            if let Some(converted) = converted {
                layers.extend([
                    ("mv", converted.vector.size()),
                    ("mv.distance", converted.virtual_distance.size()),
                ]);
            }
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
        if let Some(motion) = &self.motion {
            let axis = |vectors: &Image<Vec2>, axis: usize| {
                let pixels = vectors.pixels().iter();
                pixels.map(|vector| vector[axis]).collect()
            };
            let flags = |image: &Image<bool>| {
                let pixels = image.pixels().iter();
                pixels.map(|&holds| f32::from(u8::from(holds))).collect()
            };
            channels.push(("motion.X".into(), axis(&motion.vector, 0)));
            channels.push(("motion.Y".into(), axis(&motion.vector, 1)));
            if let Some(converted) = &motion.converted {
                let distance = converted.virtual_distance.pixels().to_vec();
                channels.push(("mv.X".into(), axis(&converted.vector, 0)));
                channels.push(("mv.Y".into(), axis(&converted.vector, 1)));
                channels.push(("mv.distance".into(), distance));
            }
            channels.push(("motion.valid".into(), flags(&motion.valid)));
            channels.extend(
                motion
                    .disoccluded
                    .iter()
                    .map(|hidden| ("motion.disoccluded".into(), flags(hidden))),
            );
        }
        channels
    }
}

/// The motion of reflections. Unknown vectors are 0, so that NaN is never taken for a vector.
fn motion(channels: &Channels, x: &Image<f32>, y: &Image<f32>) -> Result<Motion, FrameError> {
    let size = channels.size();
    let vectors = x.pixels().iter().zip(y.pixels());
    let vectors: Vec<Vec2> = vectors.map(|(&x, &y)| Vec2::new(x, y)).collect();
    let flags = |name: &str| -> Result<Option<Vec<bool>>, FrameError> {
        let flags = channels.numbers(name)?;
        Ok(flags.map(|flags| flags.pixels().iter().map(|flag| *flag > 0.0).collect()))
    };
    let finite = vectors.iter().map(|vector| vector.is_finite());
    let valid: Vec<bool> = match flags("motion.valid")? {
        Some(valid) => finite
            .zip(valid)
            .map(|(finite, valid)| finite && valid)
            .collect(),
        None => finite.collect(),
    };
    let known = vectors.iter().zip(&valid);
    let vectors = known.map(|(vector, &valid)| if valid { *vector } else { Vec2::ZERO });
    Ok(Motion {
        vector: Image::from_vec(size, vectors.collect()),
        valid: Image::from_vec(size, valid),
        disoccluded: flags("motion.disoccluded")?.map(|hidden| Image::from_vec(size, hidden)),
        converted: None,
    })
}

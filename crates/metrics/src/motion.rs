//! Motion of reflections: how far vectors are off the true ones, and what a viewer would see of that.

use std::collections::BTreeMap;

use catoptric_frame::{Frame, Image, Motion, Reflected};
use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::MetricsError;
use crate::coverage::{is_reflecting, rim};
use crate::flip::{DEFAULT_PIXELS_PER_DEGREE, flip};
use crate::stats::Summary;

/// The record's `motion`: vectors from where a reflection is to where it was a frame before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct MotionError {
    /// Pairs of frames.
    pub pairs: u64,
    /// Mirror pixels of which the true motion is known, in all pairs.
    pub pixels: u64,
    /// Share of those without an answer. `None` if there are none of them.
    pub missing: Option<f64>,
    /// Distance between the answer and the true motion, pixels. `None` without answers.
    pub error_px: Option<Summary>,
    /// Length of the true motion, pixels.
    pub true_px: Option<TrueMotion>,
    /// Mirror pixels within 3 pixels of the mirrors' border.
    pub rim: MotionPart,
    /// All others.
    pub interior: MotionPart,
    /// By mirror, ids ascending.
    pub mirrors: Vec<MirrorMotion>,
    /// What a viewer would see. `None` where the frame before was not there to look at.
    pub picture: Option<MotionPicture>,
}

/// How long the true motion is, pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct TrueMotion {
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
}

/// A part of the pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct MotionPart {
    /// As in [`MotionError`].
    pub pixels: u64,
    /// As in [`MotionError`].
    pub missing: Option<f64>,
    /// As in [`MotionError`].
    pub error_px: Option<Summary>,
}

/// A mirror's pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct MirrorMotion {
    /// The mirror's name, or its id where that has none.
    pub name: String,
    /// As in [`MotionError`].
    pub pixels: u64,
    /// As in [`MotionError`].
    pub missing: Option<f64>,
    /// As in [`MotionError`].
    pub error_px: Option<Summary>,
}

/// The picture that the vectors fetch from the frame before, beside this frame's: mean FLIP over the
/// pixels whose true motion is known and whose reflection was not hidden by something else.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct MotionPicture {
    /// Fetched by the answers; a pixel without one fetches itself.
    pub flip: f64,
    /// Fetched by the true vectors: what blending between pixels costs.
    pub flip_true: f64,
    /// The first less the second.
    pub excess: f64,
}

/// Answers and truth of any number of pairs of frames.
#[derive(Clone, Debug, Default)]
pub struct MotionSamples {
    pairs: u64,
    all: Part,
    lengths: Vec<f64>,
    rim: Part,
    interior: Part,
    mirrors: BTreeMap<u32, (String, Part)>,
    /// Sums of FLIP by the answers and by the true vectors, and the number of pixels.
    flip: [f64; 2],
    seen: u64,
}

#[derive(Clone, Debug, Default)]
struct Part {
    pixels: u64,
    errors: Vec<f64>,
}

impl Part {
    fn add(&mut self, error: Option<f64>) {
        self.pixels += 1;
        self.errors.extend(error);
    }

    fn report(&self) -> MotionPart {
        let unanswered = self.pixels - self.errors.len() as u64;
        MotionPart {
            pixels: self.pixels,
            missing: (self.pixels > 0).then(|| unanswered as f64 / self.pixels as f64),
            error_px: Summary::of(self.errors.iter().copied()),
        }
    }
}

/// The layers that the motion is judged by.
struct Layers<'f> {
    truth: &'f Motion,
    test: &'f Motion,
    ids: &'f Image<u32>,
    reflected: &'f Reflected,
}

impl<'f> Layers<'f> {
    fn new(truth: &'f Frame, test: &'f Frame) -> Result<Self, MetricsError> {
        let missing = |which, layer| MetricsError::MissingLayer { which, layer };
        let size = truth.color.size();
        let of = |frame: &'f Frame, which| {
            let motion = frame.motion.as_ref().ok_or(missing(which, "motion"))?;
            MetricsError::same_size("motion", size, motion.vector.size())?;
            Ok(motion)
        };
        let primary = truth.primary.as_ref();
        let reflected = truth.reflected.as_ref();
        Ok(Self {
            truth: of(truth, "reference")?,
            test: of(test, "technique")?,
            ids: &primary.ok_or(missing("reference", "primary"))?.id,
            reflected: reflected.ok_or(missing("reference", "reflected"))?,
        })
    }

    /// Whether the true motion is known.
    fn known(&self, index: usize) -> bool {
        self.truth.valid.pixels()[index]
    }

    /// Distance between answer and truth; `None` without an answer.
    fn error(&self, index: usize) -> Option<f64> {
        let [answer, truth] =
            [self.test, self.truth].map(|motion| motion.vector.pixels()[index].as_dvec2());
        let error = answer.distance(truth);
        (self.test.valid.pixels()[index] && error.is_finite()).then_some(error)
    }
}

impl MotionSamples {
    /// Adds a pair of frames: the later one's truth and the technique's picture of it, both with a layer
    /// of motion, and the true colours of the earlier one, if they are to be looked at.
    ///
    /// # Errors
    /// Missing layers, pictures of different sizes.
    pub fn add(
        &mut self,
        truth: &Frame,
        test: &Frame,
        before: Option<&Image<Vec3>>,
    ) -> Result<(), MetricsError> {
        let layers = Layers::new(truth, test)?;
        let status = &layers.reflected.status;
        let at_rim = rim(&status.map(|status| is_reflecting(*status)));
        for index in 0..status.pixels().len() {
            if !layers.known(index) {
                continue;
            }
            let error = layers.error(index);
            self.all.add(error);
            let length = layers.truth.vector.pixels()[index].as_dvec2().length();
            self.lengths.push(length);
            match at_rim.pixels()[index] {
                true => self.rim.add(error),
                false => self.interior.add(error),
            }
            let id = layers.ids.pixels()[index];
            let mirror = self.mirrors.entry(id).or_insert_with(|| {
                let known = truth.names.iter().find(|name| name.id == id);
                let name = known.map_or_else(|| id.to_string(), |name| name.name.clone());
                (name, Part::default())
            });
            mirror.1.add(error);
        }
        if let Some(before) = before {
            self.look(&layers, &truth.color, before)?;
        }
        self.pairs += 1;
        Ok(())
    }

    fn look(
        &mut self,
        layers: &Layers<'_>,
        now: &Image<Vec3>,
        before: &Image<Vec3>,
    ) -> Result<(), MetricsError> {
        MetricsError::same_size("color of the frame before", now.size(), before.size())?;
        let hidden = layers.truth.disoccluded.as_ref();
        let looked_at = |index: usize| {
            layers.known(index) && !hidden.is_some_and(|hidden| hidden.pixels()[index])
        };
        for (sum, motion) in self.flip.iter_mut().zip([layers.test, layers.truth]) {
            let picture = reprojected(now, before, motion, looked_at);
            let errors = flip(now, &picture, DEFAULT_PIXELS_PER_DEGREE)?;
            let errors = errors.pixels().iter().enumerate();
            let errors = errors.filter(|(index, _)| looked_at(*index));
            *sum += errors.map(|(_, error)| f64::from(*error)).sum::<f64>();
        }
        let pixels = now.pixels().len();
        self.seen += (0..pixels).filter(|index| looked_at(*index)).count() as u64;
        Ok(())
    }

    /// The summary; `None` where no pair was added.
    pub fn report(&self) -> Option<MotionError> {
        if self.pairs == 0 {
            return None;
        }
        let MotionPart {
            pixels,
            missing,
            error_px,
        } = self.all.report();
        let lengths = Summary::of(self.lengths.iter().copied());
        let mirrors = self.mirrors.values().map(|(name, part)| {
            let part = part.report();
            MirrorMotion {
                name: name.clone(),
                pixels: part.pixels,
                missing: part.missing,
                error_px: part.error_px,
            }
        });
        let picture = (self.seen > 0).then(|| {
            let [flip, flip_true] = self.flip.map(|sum| sum / self.seen as f64);
            MotionPicture {
                flip,
                flip_true,
                excess: flip - flip_true,
            }
        });
        Some(MotionError {
            pairs: self.pairs,
            pixels,
            missing,
            error_px,
            true_px: lengths.map(|Summary { p50, p99, .. }| TrueMotion { p50, p99 }),
            rim: self.rim.report(),
            interior: self.interior.report(),
            mirrors: mirrors.collect(),
            picture,
        })
    }
}

/// How far a picture's vectors are off the true ones.
///
/// # Errors
/// Missing layers, pictures of different sizes.
pub fn motion_error(truth: &Frame, test: &Frame) -> Result<MotionError, MetricsError> {
    let mut samples = MotionSamples::default();
    samples.add(truth, test, None)?;
    Ok(samples.report().expect("a pair was added"))
}

/// This frame's picture with the colours of the frame before in the pixels that `fetches` names, each
/// from where its vector points to, blended between the four nearest; a pixel without a vector takes
/// the colour that was there.
pub fn reprojected(
    now: &Image<Vec3>,
    before: &Image<Vec3>,
    motion: &Motion,
    fetches: impl Fn(usize) -> bool,
) -> Image<Vec3> {
    let [width, height] = now.size();
    let pixel = |index: usize| {
        if !fetches(index) {
            return now.pixels()[index];
        }
        let (x, y) = (index as u32 % width, index as u32 / width);
        let vector = motion.vector.pixels()[index];
        let vector = match motion.valid.pixels()[index] && vector.is_finite() {
            true => vector,
            false => Vec2::ZERO,
        };
        // Places between the centres of pixels; the image's edge goes on.
        let last = Vec2::new((width - 1) as f32, (height - 1) as f32);
        let place = (Vec2::new(x as f32, y as f32) + vector).clamp(Vec2::ZERO, last);
        let low = place.floor();
        let share = place - low;
        let color = |dx: u32, dy: u32| {
            let (x, y) = (low.x as u32 + dx, low.y as u32 + dy);
            *before.at(x.min(width - 1), y.min(height - 1))
        };
        let row = |dy| color(0, dy).lerp(color(1, dy), share.x);
        row(0).lerp(row(1), share.y)
    };
    let pixels = (0..now.pixels().len()).map(pixel);
    Image::from_vec(now.size(), pixels.collect())
}

/// Distance in pixels between a picture's vectors and the true ones: NaN where the true one is not
/// known, infinite where there is no answer.
///
/// # Errors
/// Missing layers, pictures of different sizes.
pub fn motion_map(truth: &Frame, test: &Frame) -> Result<Image<f32>, MetricsError> {
    let layers = Layers::new(truth, test)?;
    let error = |index: usize| match (layers.known(index), layers.error(index)) {
        (false, _) => f32::NAN,
        (true, None) => f32::INFINITY,
        (true, Some(error)) => error as f32,
    };
    let pixels = (0..truth.color.pixels().len()).map(error);
    Ok(Image::from_vec(truth.color.size(), pixels.collect()))
}

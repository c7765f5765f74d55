//! The pieces of a record that image comparison fills. Field names are those of the record's JSON;
//! a value that does not apply is `None` (`null`), never a made-up 0.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::more::More;
use crate::stats::Summary;

/// Everything that comparing two pictures yields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Which mirror pixels show a surface, and where that differs.
    pub coverage: Coverage,
    /// Share of mirror pixels where both see the same; the background counts as an object, an
    /// unresolved pixel agrees with nothing but an unresolved one. `None` without mirror pixels.
    pub object_agreement: Option<f64>,
    /// The rest of `object_agreement`, split by place.
    pub mismatch: Option<Mismatch>,
    /// At mirror pixels where both see the same object: the angle at the reference's mirror point
    /// between the directions to the two hit positions, in degrees. `None` without such pixels.
    pub angular_error_deg: Option<Summary>,
    /// Distance in pixels from the reference's edges of reflected objects to the nearest that the
    /// technique shows, and from the technique's to the reference's. `None` where either shows no
    /// edge.
    pub edge_offset_px: Option<Summary>,
    /// Colour on the mirror mask. `None` without pixels to compare.
    pub color: Option<ColorError>,
    /// Mirror pixels with NaN or infinity in either picture; left out of the means.
    pub non_finite: NonFinite,
    /// The same by region.
    pub regions: Regions,
    /// Metrics that are one number each.
    pub more: More,
}

/// Coverage of the mirror pixels. Shares are of `mirror_pixels` and `None` if that is 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Coverage {
    /// Pixels that reference and technique both see as reflecting mirror.
    pub mirror_pixels: u64,
    /// The reference sees an object, the technique none (unresolved pixels included).
    pub missing: Option<f64>,
    /// The technique sees an object where the reference sees the background.
    pub extra: Option<f64>,
    /// The technique says that it found no answer; `None` for one that always answers.
    pub unresolved: Option<f64>,
    /// Cracks: see [`crate::coverage::find_cracks`].
    pub cracks: Option<u64>,
    /// Pixels in cracks.
    pub crack_pixels: Option<u64>,
    /// Width of the widest crack in pixels; 0 without cracks.
    pub widest_crack_px: Option<u32>,
    /// Enclosed gaps too wide for a crack: a triangle was dropped.
    pub holes: Option<u64>,
    /// T-junctions as the technique counts them; `None` if it does not.
    pub t_junctions: Option<u64>,
    /// Pixels left out because either sees the ray sent below the mirror's surface.
    pub below: u64,
    /// Reflecting mirror for the reference only.
    pub mirror_only_reference: u64,
    /// Reflecting mirror for the technique only.
    pub mirror_only_test: u64,
    /// Intersection over union of the pixels showing a reflected surface; `None` if neither has
    /// any.
    pub iou: Option<f64>,
}

/// Pixels that disagree, as shares of the mirror pixels; the two add up to 1 − `object_agreement`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Mismatch {
    /// Next to (8 neighbours) a mirror pixel with another id in the reference.
    pub boundary: f64,
    /// Elsewhere: not to be excused by half a pixel.
    pub interior: f64,
}

/// Colour error, linear RGB unless said otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct ColorError {
    /// Mean absolute error over pixels and channels.
    pub mae: f64,
    /// Root of the mean squared error.
    pub rmse: f64,
    /// Against a peak of 1, in dB; `None` where there is no difference, which would be infinitely
    /// good: see `equal`.
    pub psnr: Option<f64>,
    /// No pixel differs and none was left out: the best that `psnr` can say.
    #[serde(default)]
    pub equal: bool,
    /// Structural similarity of the luma, 11 × 11 Gaussian, σ 1.5; 1 when equal.
    pub ssim: f64,
    /// Mean FLIP-LDR error, 0 to 1.
    pub flip: f64,
    /// Mean of `(t − f)² / (f² + 0.01)`.
    pub rel_mse: f64,
    /// Mean of `(t − f)² / (f + 0.01)²`, the form that pbrt prints.
    pub mrse: f64,
    /// Pixels left out of all these, since NaN or infinity stands in either picture.
    #[serde(default)]
    pub left_out: u64,
}

/// Counts of pixels that hold NaN or infinity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct NonFinite {
    /// Colour of the reference.
    pub reference: u64,
    /// Colour of the technique.
    pub test: u64,
    /// Pixels without an angle: a position is not finite or lies on the mirror point.
    pub angles: u64,
}

impl NonFinite {
    /// What was left out of the means and why, in a sentence; `None` where nothing was.
    pub fn reason(&self) -> Option<String> {
        let parts = [
            (
                self.reference,
                "whose colour in the reference is NaN or infinite",
            ),
            (
                self.test,
                "whose colour in the tested picture is NaN or infinite",
            ),
            (
                self.angles,
                "where a position is not finite or lies on the mirror point",
            ),
        ];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} mirror pixels {what}"))
            .collect();
        (!parts.is_empty()).then(|| format!("left out of the means: {}", parts.join("; ")))
    }
}

/// The picture in regions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Regions {
    /// Colour over the whole picture.
    pub image: Option<ColorError>,
    /// Mirror pixels within 3 pixels of the mask's border.
    pub rim: Region,
    /// All other mirror pixels.
    pub interior: Region,
}

/// A part of the mirror pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Region {
    /// Mirror pixels in this part.
    pub mirror_pixels: u64,
    /// As in [`Comparison`].
    pub object_agreement: Option<f64>,
    /// As in [`Comparison`].
    pub angular_error_deg: Option<Summary>,
    /// As in [`Comparison`].
    pub color: Option<ColorError>,
}

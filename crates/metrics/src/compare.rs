//! Two frames in, one [`Comparison`] out.

use catoptric_frame::{Frame, Image, Status};
use glam::Vec3;

use crate::MetricsError;
use crate::color::ColorMaps;
use crate::coverage::{Layers, is_reflecting, rim};
use crate::edges::edge_offset;
use crate::flip::DEFAULT_PIXELS_PER_DEGREE;
use crate::more::More;
use crate::record::{ColorError, Comparison, Coverage, Mismatch, NonFinite, Region, Regions};
use crate::stats::Summary;

/// What a comparison cannot see in the pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompareOptions {
    /// The technique can leave pixels unresolved, so that a count of 0 means something; for other
    /// techniques the record has `null` unless some pixel is unresolved.
    pub may_be_unresolved: bool,
    /// T-junctions that the technique counted.
    pub t_junctions: Option<u64>,
    /// Pixels that a degree of the viewer's visual angle takes, for FLIP.
    pub pixels_per_degree: f32,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self {
            may_be_unresolved: false,
            t_junctions: None,
            pixels_per_degree: DEFAULT_PIXELS_PER_DEGREE,
        }
    }
}

/// Compares with the default options.
pub fn compare(reference: &Frame, test: &Frame) -> Result<Comparison, MetricsError> {
    compare_with(reference, test, &CompareOptions::default())
}

/// Compares a technique's frame with the reference's.
pub fn compare_with(
    reference: &Frame,
    test: &Frame,
    options: &CompareOptions,
) -> Result<Comparison, MetricsError> {
    let layers = Layers::new(reference, test)?;
    let colors = ColorMaps::new(&reference.color, &test.color, options.pixels_per_degree)?;
    let rim = rim(&layers.mask);
    let in_mask = |index: usize| layers.mask.pixels()[index];
    let in_rim = |index: usize| rim.pixels()[index];

    let whole = region(&layers, &colors, in_mask);
    Ok(Comparison {
        coverage: coverage(&layers, options),
        object_agreement: whole.object_agreement,
        mismatch: mismatch(&layers),
        angular_error_deg: whole.angular_error_deg,
        edge_offset_px: edge_offset(&layers),
        color: whole.color,
        non_finite: non_finite(&layers, &reference.color, &test.color),
        regions: Regions {
            image: colors.over(|_| true),
            rim: region(&layers, &colors, in_rim),
            interior: region(&layers, &colors, |index| in_mask(index) && !in_rim(index)),
        },
        more: More::of(&layers),
    })
}

/// Share of the mirror pixels where both frames show the same object; `None` without mirror pixels.
///
/// # Errors
/// Frames of different sizes, or without layers.
pub fn object_agreement(reference: &Frame, test: &Frame) -> Result<Option<f64>, MetricsError> {
    let layers = Layers::new(reference, test)?;
    Ok(agreement(&layers, |_| true).1)
}

/// Pixels in cracks of the technique's reflected surface; `None` without mirror pixels.
///
/// # Errors
/// Frames of different sizes, or without layers.
pub fn crack_pixels(reference: &Frame, test: &Frame) -> Result<Option<u64>, MetricsError> {
    let layers = Layers::new(reference, test)?;
    let has_pixels = layers.mirror_pixels().next().is_some();
    Ok(has_pixels.then(|| layers.gaps().crack_pixels))
}

/// Colour error on the pixels where `mask` is true; `None` if it has no pixel to compare.
pub fn compare_color(
    reference: &Image<Vec3>,
    test: &Image<Vec3>,
    mask: &Image<bool>,
    pixels_per_degree: f32,
) -> Result<Option<ColorError>, MetricsError> {
    MetricsError::same_size("color", reference.size(), test.size())?;
    MetricsError::same_size("mask", reference.size(), mask.size())?;
    let colors = ColorMaps::new(reference, test, pixels_per_degree)?;
    Ok(colors.over(|index| mask.pixels()[index]))
}

fn region(layers: &Layers, colors: &ColorMaps, includes: impl Fn(usize) -> bool) -> Region {
    let pixels = layers.mirror_pixels().filter(|&index| includes(index));
    let angles = pixels.filter_map(|index| layers.angular_error_deg(index));
    let (mirror_pixels, object_agreement) = agreement(layers, &includes);
    Region {
        mirror_pixels,
        object_agreement,
        angular_error_deg: Summary::of(angles.filter(|angle| angle.is_finite())),
        color: colors.over(&includes),
    }
}

/// How many mirror pixels a part has, and the share of them that agrees.
fn agreement(layers: &Layers, includes: impl Fn(usize) -> bool) -> (u64, Option<f64>) {
    let pixels = || layers.mirror_pixels().filter(|&index| includes(index));
    let count = pixels().count() as u64;
    let agreeing = pixels().filter(|&index| layers.agree(index)).count() as u64;
    (count, share(agreeing, count))
}

fn coverage(layers: &Layers, options: &CompareOptions) -> Coverage {
    let (reference, test) = (
        layers.reference.status.pixels(),
        layers.test.status.pixels(),
    );
    let count_all = |holds: &dyn Fn(Status, Status) -> bool| {
        reference
            .iter()
            .zip(test)
            .filter(|&(&r, &t)| holds(r, t))
            .count() as u64
    };
    let count = |holds: &dyn Fn(usize) -> bool| {
        layers.mirror_pixels().filter(|&index| holds(index)).count() as u64
    };

    let mirror_pixels = count(&|_| true);
    let missing = count(&|index| layers.show(index) == [true, false]);
    let extra =
        count(&|index| layers.show(index) == [false, true] && reference[index] == Status::Resolved);
    let both = count(&|index| layers.show(index) == [true, true]);
    let either = count(&|index| layers.show(index) != [false, false]);
    let unresolved = count(&|index| test[index] == Status::Unresolved);
    let gaps = (mirror_pixels > 0).then(|| layers.gaps());
    let below = |status| status == Status::Below;

    Coverage {
        mirror_pixels,
        missing: share(missing, mirror_pixels),
        extra: share(extra, mirror_pixels),
        unresolved: share(unresolved, mirror_pixels)
            .filter(|_| options.may_be_unresolved || unresolved > 0),
        cracks: gaps.as_ref().map(|gaps| gaps.cracks),
        crack_pixels: gaps.as_ref().map(|gaps| gaps.crack_pixels),
        widest_crack_px: gaps.as_ref().map(|gaps| gaps.widest_crack),
        holes: gaps.as_ref().map(|gaps| gaps.holes),
        t_junctions: options.t_junctions,
        below: count_all(&|r, t| below(r) || below(t)),
        mirror_only_reference: count_all(&|r, t| {
            is_reflecting(r) && !is_reflecting(t) && !below(t)
        }),
        mirror_only_test: count_all(&|r, t| is_reflecting(t) && !is_reflecting(r) && !below(r)),
        iou: share(both, either),
    }
}

fn mismatch(layers: &Layers) -> Option<Mismatch> {
    let [mut boundary, mut interior, mut all] = [0_u64; 3];
    for index in layers.mirror_pixels() {
        all += 1;
        if !layers.agree(index) {
            let place = if layers.on_id_edge(index) {
                &mut boundary
            } else {
                &mut interior
            };
            *place += 1;
        }
    }
    Some(Mismatch {
        boundary: share(boundary, all)?,
        interior: share(interior, all)?,
    })
}

fn non_finite(layers: &Layers, reference: &Image<Vec3>, test: &Image<Vec3>) -> NonFinite {
    let count = |image: &Image<Vec3>| {
        layers
            .mirror_pixels()
            .filter(|&index| !image.pixels()[index].is_finite())
            .count() as u64
    };
    let angles = layers
        .mirror_pixels()
        .filter_map(|index| layers.angular_error_deg(index));
    NonFinite {
        reference: count(reference),
        test: count(test),
        angles: angles.filter(|angle| !angle.is_finite()).count() as u64,
    }
}

/// `None` instead of a division by zero.
fn share(part: u64, whole: u64) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

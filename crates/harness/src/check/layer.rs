//! How one layer of a picture compares.

use std::collections::BTreeMap;

use catoptric_frame::Image;
use catoptric_metrics::stats::percentile;
use serde::Serialize;

use super::limits::{self, Distance};

/// How one layer compares.
#[derive(Clone, Debug, Serialize)]
pub struct Layer {
    /// As in the picture; `2+` is added for paths of two reflections and more.
    pub layer: &'static str,
    /// Pixels compared.
    pub pixels: usize,
    /// Share of them that agree; for layers of ids, counts and colours.
    pub agree: Option<f64>,
    /// Median difference, for other layers and colours.
    pub p50: Option<f64>,
    /// 99.9th percentile.
    pub p999: Option<f64>,
    /// Largest.
    pub max: Option<f64>,
    /// Pixels whose difference is not a number: NaN or infinity stands in the picture.
    pub not_numbers: usize,
    /// In words.
    pub limit: String,
    /// Whether it is kept.
    pub passed: bool,
    /// Differences, NaN where nothing was compared, and the one that is painted brightest.
    #[serde(skip)]
    pub map: (Image<f32>, f32),
}

impl Layer {
    /// A layer of ids, codes or counts. If no pixel is compared, it passes: where that is wrong, the
    /// layers that select the pixels fail.
    pub fn agreement<T: PartialEq>(
        layer: &'static str,
        mask: &[bool],
        theirs: &Image<T>,
        ours: &Image<T>,
        least: f64,
    ) -> Self {
        let pairs = theirs.pixels().iter().zip(ours.pixels());
        let differs = pairs.map(|(theirs, ours)| f32::from(u8::from(theirs != ours)));
        let differs = Image::from_vec(theirs.size(), differs.collect());
        let values = sorted(&differs, mask);
        let agreeing = count(&values, 0.0);
        Self {
            layer,
            pixels: values.len(),
            agree: share(agreeing, values.len()),
            p50: None,
            p999: None,
            max: None,
            not_numbers: 0,
            limit: format!("≥ {} %", hundredths(least)),
            passed: enough(agreeing, values.len(), least),
            map: (masked(&differs, mask), 1.0),
        }
    }

    /// A layer of points, directions or lengths; one that is not a number falls short.
    pub fn distance(layer: &'static str, mask: &[bool], off: &Image<f32>, limit: Distance) -> Self {
        let values = sorted(off, mask);
        let (p50, p999) = (percentile(&values, 0.5), percentile(&values, 0.999));
        let numbers = not_numbers(&values) == 0;
        let near = half(count(&values, limit.p50), values.len());
        let few_far = enough(count(&values, limit.p999), values.len(), 0.999);
        Self {
            layer,
            pixels: values.len(),
            agree: None,
            p50,
            p999,
            max: values.last().copied(),
            not_numbers: not_numbers(&values),
            limit: format!("p50 ≤ {:.1e}, p99.9 ≤ {:.1e}", limit.p50, limit.p999),
            passed: numbers && near && few_far,
            map: (masked(off, mask), limit.p999 as f32),
        }
    }

    /// A layer of colours that are `off` ours, and `beyond` what they may be: at least a share of
    /// them by no more than `within`.
    pub fn color(
        layer: &'static str,
        mask: &[bool],
        off: &Image<f32>,
        beyond: &Image<f32>,
        within: f64,
        least: f64,
    ) -> Self {
        let differences = sorted(off, mask);
        let pixels = differences.len();
        let agreeing = count(&sorted(beyond, mask), within);
        Self {
            layer,
            pixels,
            agree: share(agreeing, pixels),
            p50: percentile(&differences, 0.5),
            p999: percentile(&differences, 0.999),
            max: differences.last().copied(),
            not_numbers: not_numbers(&differences),
            limit: format!("≥ {} % within {within:.1e}", hundredths(least)),
            passed: enough(agreeing, pixels, least) && not_numbers(&differences) == 0,
            map: (masked(beyond, mask), 100.0 * within as f32),
        }
    }
}

impl Layer {
    /// Colours again, surface by surface: the share that agrees is that of the worst one.
    pub fn surfaces(
        layer: &'static str,
        mask: &[bool],
        seen: &Image<u32>,
        beyond: &Image<f32>,
        within: f64,
    ) -> Self {
        let mut surfaces: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
        let pixels = seen.pixels().iter().zip(beyond.pixels()).zip(mask);
        for ((id, beyond), _) in pixels.filter(|(_, kept)| **kept) {
            let (agreeing, pixels) = surfaces.entry(*id).or_default();
            *agreeing += usize::from(f64::from(*beyond) <= within);
            *pixels += 1;
        }
        surfaces.retain(|_, (_, pixels)| *pixels >= limits::FEWEST);
        let shares = surfaces
            .values()
            .map(|(agreeing, pixels)| *agreeing as f64 / *pixels as f64);
        let worst = shares.min_by(f64::total_cmp);
        Self {
            layer,
            pixels: surfaces.values().map(|(_, pixels)| pixels).sum(),
            agree: worst,
            p50: None,
            p999: None,
            max: None,
            not_numbers: 0,
            limit: format!("≥ {} % of each", limits::AGREE_SURFACE * 100.0),
            passed: worst.is_none_or(|worst| worst >= limits::AGREE_SURFACE),
            map: (masked(beyond, mask), 100.0 * within as f32),
        }
    }
}

fn not_numbers(values: &[f64]) -> usize {
    values.iter().filter(|value| !value.is_finite()).count()
}

/// A share in per cent, to a hundredth.
fn hundredths(share: f64) -> f64 {
    (1e4 * share).round() / 100.0
}

/// Values within a mask, ascending, NaN last.
fn sorted(image: &Image<f32>, mask: &[bool]) -> Vec<f64> {
    let kept = image.pixels().iter().zip(mask).filter(|(_, kept)| **kept);
    let mut values: Vec<f64> = kept.map(|(value, _)| f64::from(*value)).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// An image with NaN outside a mask.
fn masked(image: &Image<f32>, mask: &[bool]) -> Image<f32> {
    let pairs = image.pixels().iter().zip(mask);
    let pixels = pairs.map(|(value, kept)| if *kept { *value } else { f32::NAN });
    Image::from_vec(image.size(), pixels.collect())
}

/// How many values are up to a limit; NaN is not.
fn count(values: &[f64], limit: f64) -> usize {
    values.iter().filter(|value| **value <= limit).count()
}

fn share(agreeing: usize, pixels: usize) -> Option<f64> {
    (pixels > 0).then(|| agreeing as f64 / pixels as f64)
}

/// Whether half of the pixels keep a limit, within what chance allows: if each pixel keeps it with
/// probability ½, the number that do not exceeds half by more than √n only once in forty times.
fn half(keeping: usize, pixels: usize) -> bool {
    let (off, pixels) = ((pixels - keeping) as f64, pixels as f64);
    off <= pixels / 2.0 + pixels.sqrt()
}

fn enough(agreeing: usize, pixels: usize, least: f64) -> bool {
    let off = pixels - agreeing;
    off <= limits::ALWAYS || agreeing as f64 >= least * pixels as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    const MASK: [bool; 4] = [true, true, true, false];
    const AGREE: f64 = 0.9;

    fn row<T>(values: [T; 4]) -> Image<T> {
        Image::from_vec([4, 1], values.into())
    }

    #[test]
    fn two_pixels_may_always_disagree_and_no_more() {
        let ours = row([1, 2, 3, 4]);
        let layer = |theirs| Layer::agreement("id", &MASK, &row(theirs), &ours, AGREE);
        assert!(layer([1, 2, 3, 9]).passed);
        let two = layer([1, 9, 9, 4]);
        assert!(two.passed);
        assert_eq!((two.pixels, two.agree), (3, Some(1.0 / 3.0)));
        assert!(two.map.0.pixels()[3].is_nan());
        assert!(!layer([9, 9, 9, 4]).passed);
    }

    #[test]
    fn a_surface_of_another_colour_is_not_outvoted() {
        let seen = Image::from_vec([100, 1], (0..100).map(|at| u32::from(at < 9)).collect());
        let surfaces = |wrong: usize| {
            let beyond = (0..100).map(|at| f32::from(u8::from(at < wrong))).collect();
            let beyond = Image::from_vec([100, 1], beyond);
            Layer::surfaces("R G B", &[true; 100], &seen, &beyond, 0.5)
        };
        assert!(surfaces(0).passed);
        assert!(!surfaces(1).passed);
        assert_eq!(surfaces(9).agree, Some(0.0));
    }

    #[test]
    fn two_pixels_may_be_further_off_and_no_more() {
        let limit = Distance {
            p50: 0.5,
            p999: 1.0,
        };
        let layer = |far: usize, off: f32| {
            let values = (0..9).map(|at| if at < far { off } else { 0.0 }).collect();
            Layer::distance(
                "position",
                &[true; 9],
                &Image::from_vec([9, 1], values),
                limit,
            )
        };
        assert!(layer(2, 1.5).passed);
        assert!(!layer(3, 1.5).passed);
        assert!(layer(4, 1.0).passed);
    }

    #[test]
    fn half_of_the_pixels_are_half_as_far_as_so_many_can_tell() {
        let limit = Distance {
            p50: 0.5,
            p999: 1.0,
        };
        let passed = |far: usize, all: usize| {
            let values = (0..all)
                .map(|at| if at < far { 0.75 } else { 0.0 })
                .collect();
            let off = Image::from_vec([all as u32, 1], values);
            Layer::distance("position", &vec![true; all], &off, limit).passed
        };
        assert!(passed(4, 4), "four pixels have no median to speak of");
        assert!(!passed(9, 9));
        assert!(passed(60, 100) && !passed(61, 100));
        assert!(passed(5_100, 10_000) && !passed(5_101, 10_000));
    }

    #[test]
    fn what_is_not_a_number_falls_short() {
        let limit = Distance {
            p50: 1.0,
            p999: 1.0,
        };
        let layer = |off| Layer::distance("position", &MASK, &row(off), limit);
        assert!(layer([1.0, 0.5, 0.0, f32::NAN]).passed);
        assert!(!layer([0.0, 0.0, f32::NAN, 0.0]).passed);
        let beyond = row([f32::NAN, f32::NAN, f32::NAN, 0.0]);
        assert!(!Layer::color("R G B", &MASK, &beyond, &beyond, 1.0, AGREE).passed);
    }
}

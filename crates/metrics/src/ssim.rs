//! Structural similarity (Wang et al. 2004) of the luma: 11 × 11 Gaussian window with σ 1.5,
//! K1 = 0.01, K2 = 0.03, L = 1.
//!
//! Own code, since the maintained crates compare 8-bit pictures, with windows that are not the
//! published one; here the pictures are linear and have no upper bound. So variances are sums of
//! squares about the mean, never differences of large numbers: windows are merged row by row and
//! then column by column, by the law of total variance, and every value is taken relative to a pixel
//! of its window.

use catoptric_frame::Image;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::filter::gaussian;

const RADIUS: usize = 5;
const SIDE: usize = 2 * RADIUS + 1;
const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Rec. 709 luma weights, on linear values.
const LUMA: DVec3 = DVec3::new(0.2126, 0.7152, 0.0722);

/// Per-pixel similarity; 1 where the windows are equal. Colours that are not finite count as black;
/// beyond the border the nearest pixel counts. Both images have the same size.
pub(crate) fn ssim(reference: &Image<Vec3>, test: &Image<Vec3>) -> Image<f64> {
    let [width, height] = reference.size();
    let [columns, rows] = [width as usize, height as usize];
    if columns == 0 || rows == 0 {
        return Image::from_vec([width, height], Vec::new());
    }
    let kernel = kernel();
    let pixels: Vec<Window> = reference
        .pixels()
        .par_iter()
        .zip(test.pixels())
        .map(|(&reference, &test)| Window::of_pixel(luma(reference), luma(test)))
        .collect();
    let near = |at: usize, offset: usize, count: usize| {
        (at + offset).saturating_sub(RADIUS).min(count - 1)
    };
    let in_rows: Vec<Window> = (0..pixels.len())
        .into_par_iter()
        .map(|index| {
            let (row, x) = (&pixels[index - index % columns..], index % columns);
            Window::merged(&kernel, |offset| &row[near(x, offset, columns)])
        })
        .collect();
    let similarity = (0..pixels.len())
        .into_par_iter()
        .map(|index| {
            let (y, x) = (index / columns, index % columns);
            let row = |offset| near(y, offset, rows);
            Window::merged(&kernel, |offset| &in_rows[row(offset) * columns + x]).similarity()
        })
        .collect();
    Image::from_vec([width, height], similarity)
}

/// Weights of a window's rows or columns; their sum is 1.
fn kernel() -> [f64; SIDE] {
    let mut kernel = [0.0; SIDE];
    for (weight, (_, gaussian)) in kernel.iter_mut().zip(gaussian(SIGMA, RADIUS)) {
        *weight = gaussian;
    }
    let sum: f64 = kernel.iter().sum();
    kernel.map(|weight| weight / sum)
}

/// Weighted statistics of the luma in a window, of the reference (`x`) and the tested picture (`y`).
#[derive(Clone, Copy)]
struct Window {
    /// Of the pixel in the middle.
    middle: DVec2,
    /// Mean, less that of the middle: exactly 0 in a flat window, however bright it is.
    mean: DVec2,
    /// Variance of the one and of the other, added up.
    variances: f64,
    /// Variance of the difference of the two: `variances` less twice the covariance.
    difference: f64,
}

impl Window {
    fn of_pixel(reference: f64, test: f64) -> Self {
        Self {
            middle: DVec2::new(reference, test),
            mean: DVec2::ZERO,
            variances: 0.0,
            difference: 0.0,
        }
    }

    /// The windows in a row, or in a column, as one.
    fn merged<'windows>(kernel: &[f64; SIDE], part: impl Fn(usize) -> &'windows Window) -> Self {
        let center = part(RADIUS);
        let offsets: [DVec2; SIDE] = std::array::from_fn(|index| {
            let part = part(index);
            (part.middle - center.middle) + (part.mean - center.mean)
        });
        let weighted = kernel.iter().zip(&offsets);
        let shift: DVec2 = weighted.map(|(&weight, &offset)| weight * offset).sum();
        let mut merged = Self {
            middle: center.middle,
            mean: center.mean + shift,
            variances: 0.0,
            difference: 0.0,
        };
        for (index, (&weight, &offset)) in kernel.iter().zip(&offsets).enumerate() {
            let (part, offset) = (part(index), offset - shift);
            let difference = offset.x - offset.y;
            merged.variances += weight * (part.variances + offset.length_squared());
            merged.difference += weight * (part.difference + difference * difference);
        }
        merged
    }

    /// `(2 µx µy + C1) / (µx² + µy² + C1)` times `(2 σxy + C2) / (σx² + σy² + C2)`. Each factor is
    /// computed as 1 minus its distance from 1, so that neither exceeds 1 and no digit is lost near
    /// 1.
    fn similarity(&self) -> f64 {
        let mean = self.middle + self.mean;
        let apart = (self.middle.x - self.middle.y) + (self.mean.x - self.mean.y);
        let luminance = 1.0 - apart * apart / (mean.length_squared() + C1);
        luminance * (1.0 - self.difference / (self.variances + C2))
    }
}

fn luma(color: Vec3) -> f64 {
    if color.is_finite() {
        color.as_dvec3().dot(LUMA)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: f32) -> Image<Vec3> {
        Image::filled([20, 20], Vec3::splat(value))
    }

    /// Closed form: on constant images only the luminance term is left, whatever the brightness.
    #[test]
    fn constant_images() {
        for (a, b) in [
            (0.5, 0.7),
            (100.0, 100.1),
            (1e20, 1.000_000_1e20),
            (0.0, 1e-30),
        ] {
            let map = ssim(&flat(a), &flat(b));
            let [x, y] = [a, b].map(f64::from);
            let expected = (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4);
            for similarity in map.pixels() {
                assert!(
                    (similarity - expected).abs() < 1e-12,
                    "{a} {b}: {similarity}"
                );
                assert!(*similarity <= 1.0, "{a} {b}");
            }
            assert!(
                ssim(&flat(a), &flat(a))
                    .pixels()
                    .iter()
                    .all(|&same| same == 1.0)
            );
        }
    }

    #[test]
    fn an_inverted_pattern_is_dissimilar() {
        let stripes = |offset: u32| {
            let pixels = (0..400).map(|i| Vec3::splat(((i / 2 + offset) % 2) as f32));
            Image::from_vec([20, 20], pixels.collect())
        };
        let map = ssim(&stripes(0), &stripes(1));
        assert!(*map.at(10, 10) < -0.8, "{}", map.at(10, 10));
    }
}

//! Colour error over any mask, from maps that are computed once.

use catoptric_frame::Image;
use glam::Vec3;

use crate::MetricsError;
use crate::flip::flip;
use crate::record::ColorError;
use crate::ssim::ssim;

/// Keeps the relative errors finite in the dark.
const RELATIVE_EPSILON: f64 = 0.01;

/// Two pictures and their per-pixel similarity.
pub(crate) struct ColorMaps<'images> {
    reference: &'images [Vec3],
    test: &'images [Vec3],
    ssim: Image<f64>,
    flip: Image<f32>,
}

impl<'images> ColorMaps<'images> {
    pub fn new(
        reference: &'images Image<Vec3>,
        test: &'images Image<Vec3>,
        pixels_per_degree: f32,
    ) -> Result<Self, MetricsError> {
        let (flip, ssim) = rayon::join(
            || flip(reference, test, pixels_per_degree),
            || ssim(reference, test),
        );
        let (reference, test) = (reference.pixels(), test.pixels());
        Ok(Self {
            reference,
            test,
            flip: flip?,
            ssim,
        })
    }

    /// Error over the pixels for which `includes` holds and both colours are finite; `None` if
    /// there are none.
    pub fn over(&self, includes: impl Fn(usize) -> bool) -> Option<ColorError> {
        let mut sums = Sums::default();
        let pairs = self.reference.iter().zip(self.test).enumerate();
        for (index, (&reference, &test)) in pairs.filter(|&(index, _)| includes(index)) {
            if !reference.is_finite() || !test.is_finite() {
                sums.left_out += 1;
            } else {
                sums.pixels += 1;
                sums.ssim += self.ssim.pixels()[index];
                sums.flip += f64::from(self.flip.pixels()[index]);
                for (f, t) in reference.to_array().into_iter().zip(test.to_array()) {
                    sums.add_channel(f64::from(f), f64::from(t));
                }
            }
        }
        sums.error()
    }
}

#[derive(Default)]
struct Sums {
    pixels: u64,
    left_out: u64,
    absolute: f64,
    squared: f64,
    relative: f64,
    relative_pbrt: f64,
    ssim: f64,
    flip: f64,
}

impl Sums {
    fn add_channel(&mut self, reference: f64, test: f64) {
        let squared = (test - reference).powi(2);
        self.absolute += (test - reference).abs();
        self.squared += squared;
        self.relative += squared / (reference * reference + RELATIVE_EPSILON);
        // Radiance is not negative; should a file say so, the divisor stays positive.
        self.relative_pbrt += squared / (reference.max(0.0) + RELATIVE_EPSILON).powi(2);
    }

    fn error(&self) -> Option<ColorError> {
        if self.pixels == 0 {
            return None;
        }
        let (pixels, channels) = (self.pixels as f64, 3.0 * self.pixels as f64);
        let mse = self.squared / channels;
        Some(ColorError {
            mae: self.absolute / channels,
            rmse: mse.sqrt(),
            psnr: (mse > 0.0).then(|| -10.0 * mse.log10()),
            equal: mse == 0.0 && self.left_out == 0,
            ssim: self.ssim / pixels,
            flip: self.flip / pixels,
            rel_mse: self.relative / channels,
            mrse: self.relative_pbrt / channels,
            left_out: self.left_out,
        })
    }
}

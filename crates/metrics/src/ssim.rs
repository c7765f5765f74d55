//! Structural similarity (Wang et al. 2004) of the luma: 11 × 11 Gaussian window with σ 1.5,
//! K1 = 0.01, K2 = 0.03, L = 1.

use catoptric_frame::Image;
use glam::{Vec3, Vec4};

use crate::filter::{along_x, along_y, gaussian};

const RADIUS: usize = 5;
const SIGMA: f32 = 1.5;
const C1: f32 = 0.01 * 0.01;
const C2: f32 = 0.03 * 0.03;

/// Rec. 709 luma weights, on linear values.
const LUMA: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Per-pixel similarity; 1 where the windows are equal. Values that are not finite count as 0.
/// Both images have the same size.
pub(crate) fn ssim(reference: &Image<Vec3>, test: &Image<Vec3>) -> Image<f32> {
    let pairs = reference
        .pixels()
        .iter()
        .zip(test.pixels())
        .map(|(&r, &t)| [luma(r), luma(t)]);
    let moments = pairs.clone().map(|[r, t]| Vec4::new(r, t, r * r, t * t));
    let products = pairs.map(|[r, t]| Vec4::splat(r * t));

    let norm: f32 = gaussian(SIGMA, RADIUS).map(|(_, weight)| weight).sum();
    let kernel: Vec<Vec4> = gaussian(SIGMA, RADIUS)
        .map(|(_, weight)| Vec4::splat(weight / norm))
        .collect();
    let size = reference.size();
    let blur = |image: Image<Vec4>| along_y(&along_x(&image, &kernel), &kernel);
    let moments = blur(Image::from_vec(size, moments.collect()));
    let products = blur(Image::from_vec(size, products.collect()));

    let similarity = moments
        .pixels()
        .iter()
        .zip(products.pixels())
        .map(|(m, product)| {
            let [mean_r, mean_t, square_r, square_t] = m.to_array();
            let (variance_r, variance_t) = (square_r - mean_r * mean_r, square_t - mean_t * mean_t);
            let covariance = product.x - mean_r * mean_t;
            let luminance =
                (2.0 * (mean_r * mean_t) + C1) / (mean_r * mean_r + mean_t * mean_t + C1);
            luminance * ((2.0 * covariance + C2) / (variance_r + variance_t + C2))
        });
    Image::from_vec(size, similarity.collect())
}

fn luma(color: Vec3) -> f32 {
    let luma = color.dot(LUMA);
    if luma.is_finite() { luma } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: on constant images only the luminance term is left.
    #[test]
    fn constant_images() {
        let flat = |value| Image::filled([20, 20], Vec3::splat(value));
        let map = ssim(&flat(0.5), &flat(0.7));
        let expected = (2.0 * 0.35 + 1e-4) / (0.25 + 0.49 + 1e-4);
        assert!(
            map.pixels()
                .iter()
                .all(|similarity| (similarity - expected).abs() < 1e-4)
        );
        assert!(
            ssim(&flat(0.5), &flat(0.5))
                .pixels()
                .iter()
                .all(|&similarity| similarity == 1.0)
        );
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

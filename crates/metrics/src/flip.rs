//! FLIP-LDR: the difference a viewer sees when two pictures alternate in the same place
//! (Andersson et al., *FLIP: A Difference Evaluator for Alternating Images*, HPG 2020), written
//! from the paper's formulas, with the separated filters of its authors' later note.
//!
//! Input is linear RGB, clamped to 0…1 as a display would; NaN counts as 0.
//!
//! Own code, since the authors' library takes 8-bit pictures, works in f32 and needs a C++ compiler;
//! the tests compare with it. It computes in f64, because the powers of 0.7 and ½ amplify the
//! rounding error of a small difference.

use catoptric_frame::Image;
use glam::{DMat3, DVec3, DVec4, Vec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::MetricsError;
use crate::filter::{along_x, along_y, gaussian, offsets};

/// Pixels per degree of visual angle of a display 0.7 m wide with 3840 pixels seen from 0.7 m.
pub const DEFAULT_PIXELS_PER_DEGREE: f32 = 67.020_645;

/// Exponent of the colour difference.
const COLOR_EXPONENT: f64 = 0.7;
/// Share of the largest colour difference that is mapped to the share [`KNEE_ERROR`] of errors.
const KNEE_DIFFERENCE: f64 = 0.4;
const KNEE_ERROR: f64 = 0.95;
/// Width of the feature detectors in degrees.
const FEATURE_WIDTH: f64 = 0.082;
const FEATURE_EXPONENT: f64 = 0.5;

/// One Gaussian of a contrast-sensitivity function: `a √(π/b) exp(−π² x²/b)`, x in degrees.
#[derive(Clone, Copy)]
struct Sensitivity {
    a: f64,
    b: f64,
}

const ACHROMATIC: Sensitivity = Sensitivity { a: 1.0, b: 0.0047 };
const RED_GREEN: Sensitivity = Sensitivity { a: 1.0, b: 0.0053 };
const BLUE_YELLOW: [Sensitivity; 2] = [
    Sensitivity { a: 34.1, b: 0.04 },
    Sensitivity { a: 13.5, b: 0.025 },
];

/// Per-pixel FLIP-LDR error, 0 to 1. `pixels_per_degree` is positive.
pub fn flip(
    reference: &Image<Vec3>,
    test: &Image<Vec3>,
    pixels_per_degree: f32,
) -> Result<Image<f32>, MetricsError> {
    MetricsError::same_size("color", reference.size(), test.size())?;

    let pixels_per_degree = f64::from(pixels_per_degree);
    let opponent =
        [reference, test].map(|image| image.map(|&linear| opponent_from_linear(linear.as_dvec3())));
    let [seen_reference, seen_test] = opponent
        .each_ref()
        .map(|image| seen_lab(image, pixels_per_degree));
    let [features_reference, features_test] = opponent
        .each_ref()
        .map(|image| features(image, pixels_per_degree));

    let largest = largest_color_difference();
    let color = seen_reference.into_par_iter().zip(seen_test);
    let feature = features_reference.into_par_iter().zip(features_test);
    let errors = color
        .zip(feature)
        .map(|((reference, test), (features_reference, features_test))| {
            let color = color_error(reference, test, largest);
            let feature = feature_error(features_reference, features_test);
            color.powf(1.0 - feature) as f32
        })
        .collect();
    Ok(Image::from_vec(reference.size(), errors))
}

/// The opponent image after contrast-sensitivity filtering, as L*a*b* with Hunt's adjustment.
fn seen_lab(opponent: &Image<DVec3>, pixels_per_degree: f64) -> Vec<DVec3> {
    let kernel = sensitivity_kernel(pixels_per_degree);
    let channels = opponent.map(|color| DVec4::new(color.x, color.y, color.z, color.z));
    let filtered = along_y(&along_x(&channels, &kernel), &kernel);
    let linear_from_xyz = XYZ_FROM_LINEAR.inverse();
    let lab = |filtered: &DVec4| {
        let opponent = DVec3::new(filtered.x, filtered.y, filtered.z + filtered.w);
        let linear = linear_from_xyz * xyz_from_opponent(opponent);
        hunt(lab_from_linear(linear.clamp(DVec3::ZERO, DVec3::ONE)))
    };
    filtered.pixels().par_iter().map(lab).collect()
}

/// Kernel over Y, Cx and the two Gaussians of Cz. Only the sum of those two has a unit integral,
/// so each takes the root of its amplitude in either direction.
fn sensitivity_kernel(pixels_per_degree: f64) -> Vec<DVec4> {
    let all = [ACHROMATIC, RED_GREEN, BLUE_YELLOW[0], BLUE_YELLOW[1]];
    let pi_squared = std::f64::consts::PI.powi(2);
    let widest = all.iter().map(|gaussian| gaussian.b).fold(0.0, f64::max);
    let radius = (3.0 * (widest / (2.0 * pi_squared)).sqrt() * pixels_per_degree).ceil();
    let mut kernel: Vec<DVec4> = offsets(radius as usize)
        .map(|offset| {
            let x = offset / pixels_per_degree;
            DVec4::from(all.map(|Sensitivity { a, b }| {
                let amplitude = (a * (std::f64::consts::PI / b).sqrt()).sqrt();
                amplitude * (-pi_squared * x * x / b).exp()
            }))
        })
        .collect();
    let sums: DVec4 = kernel.iter().sum();
    let blue_yellow = sums.z.hypot(sums.w);
    let norm = DVec4::new(sums.x, sums.y, blue_yellow, blue_yellow);
    kernel.iter_mut().for_each(|weight| *weight /= norm);
    kernel
}

/// Strength of edges and of points in the achromatic channel.
fn features(opponent: &Image<DVec3>, pixels_per_degree: f64) -> Vec<[f64; 2]> {
    let kernel = feature_kernel(pixels_per_degree);
    let rearranged = |choose: fn(DVec3) -> DVec4| kernel.iter().copied().map(choose).collect();
    // Kernel entries are (Gaussian, first derivative, second derivative).
    let in_x: Vec<DVec4> = rearranged(|k| DVec4::new(k.y, k.z, k.x, k.x));
    let in_y: Vec<DVec4> = rearranged(|k| DVec4::new(k.x, k.x, k.y, k.z));

    let achromatic = opponent.map(|color| DVec4::splat(color.x));
    let derivatives = along_y(&along_x(&achromatic, &in_x), &in_y);
    derivatives
        .pixels()
        .par_iter()
        .map(|d| [d.x.hypot(d.z), d.y.hypot(d.w)])
        .collect()
}

/// A Gaussian and its first two derivatives. The Gaussian sums to 1; of each derivative, the
/// positive weights sum to 1 and the negative ones to −1.
fn feature_kernel(pixels_per_degree: f64) -> Vec<DVec3> {
    let sigma = 0.5 * FEATURE_WIDTH * pixels_per_degree;
    let radius = (3.0 * sigma).ceil() as usize;
    let mut kernel: Vec<DVec3> = gaussian(sigma, radius)
        .map(|(x, g)| DVec3::new(g, -x * g, (x * x / (sigma * sigma) - 1.0) * g))
        .collect();
    let positive: DVec3 = kernel.iter().map(|weights| weights.max(DVec3::ZERO)).sum();
    let negative: DVec3 = kernel
        .iter()
        .map(|weights| (-*weights).max(DVec3::ZERO))
        .sum();
    for weights in &mut kernel {
        for part in 0..3 {
            let sum = if weights[part] > 0.0 {
                positive[part]
            } else {
                negative[part]
            };
            if sum > 0.0 {
                weights[part] /= sum;
            }
        }
    }
    kernel
}

/// HyAB distance with its range compressed so that the largest errors do not crowd out the rest.
fn color_error(reference: DVec3, test: DVec3, largest: f64) -> f64 {
    let difference = hyab(reference, test).powf(COLOR_EXPONENT);
    let knee = KNEE_DIFFERENCE * largest;
    if difference < knee {
        difference * KNEE_ERROR / knee
    } else {
        KNEE_ERROR + (difference - knee) / (largest - knee) * (1.0 - KNEE_ERROR)
    }
}

fn feature_error(reference: [f64; 2], test: [f64; 2]) -> f64 {
    let edge = (reference[0] - test[0]).abs();
    let point = (reference[1] - test[1]).abs();
    (edge.max(point) / std::f64::consts::SQRT_2).powf(FEATURE_EXPONENT)
}

/// Between the primaries that lie farthest apart, green and blue.
fn largest_color_difference() -> f64 {
    let [green, blue] = [DVec3::Y, DVec3::Z].map(|linear| hunt(lab_from_linear(linear)));
    hyab(green, blue).powf(COLOR_EXPONENT)
}

/// City-block distance in lightness plus Euclidean distance in chroma.
fn hyab(a: DVec3, b: DVec3) -> f64 {
    let difference = a - b;
    difference.x.abs() + difference.y.hypot(difference.z)
}

/// Colours look less colourful in the dark.
fn hunt(lab: DVec3) -> DVec3 {
    DVec3::new(lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z)
}

/// Linear sRGB primaries under D65 to CIE XYZ; columns are the primaries.
const XYZ_FROM_LINEAR: DMat3 = DMat3::from_cols(
    DVec3::new(
        10_135_552.0 / 24_577_794.0,
        871_024.0 / 4_096_299.0,
        79_184.0 / 4_096_299.0,
    ),
    DVec3::new(
        8_788_810.0 / 24_577_794.0,
        8_788_810.0 / 12_288_897.0,
        4_394_405.0 / 36_866_691.0,
    ),
    DVec3::new(
        4_435_075.0 / 24_577_794.0,
        887_015.0 / 12_288_897.0,
        70_074_185.0 / 73_733_382.0,
    ),
);

/// XYZ of the display's white.
fn white() -> DVec3 {
    XYZ_FROM_LINEAR * DVec3::ONE
}

/// Opponent space: achromatic, red–green, blue–yellow. These are the paper's 116 Y − 16, 500 (X − Y)
/// and 200 (Y − Z), with X, Y, Z relative to white, without the factors and the offset. The filters'
/// weights sum to 1, so they do not change either, and −16 would drown dark values in rounding.
fn opponent_from_linear(linear: DVec3) -> DVec3 {
    // `max` before `min`: NaN becomes 0.
    let displayed = linear.max(DVec3::ZERO).min(DVec3::ONE);
    let xyz = XYZ_FROM_LINEAR * displayed / white();
    DVec3::new(xyz.y, xyz.x - xyz.y, xyz.y - xyz.z)
}

fn xyz_from_opponent(color: DVec3) -> DVec3 {
    DVec3::new(color.x + color.y, color.x, color.x - color.z) * white()
}

fn lab_from_linear(linear: DVec3) -> DVec3 {
    const DELTA: f64 = 6.0 / 29.0;
    // CIE's function less its value at 0, 4/29, which cancels out of all three: L* is 116 times that
    // of Y, less 16. So the dark keeps its digits.
    let root = |t: f64| {
        if t > DELTA * DELTA * DELTA {
            t.cbrt() - 4.0 / 29.0
        } else {
            t / (3.0 * DELTA * DELTA)
        }
    };
    let xyz = XYZ_FROM_LINEAR * linear / white();
    let [x, y, z] = xyz.to_array().map(root);
    DVec3::new(116.0 * y, 500.0 * (x - y), 200.0 * (y - z))
}

/// Statistics of a FLIP map. The weighted ones weigh every pixel by its error: half of all *error*
/// lies below the weighted median.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlipStats {
    /// Arithmetic mean.
    pub mean: f64,
    /// Weighted median.
    pub weighted_median: f64,
    /// First weighted quartile.
    pub weighted_q1: f64,
    /// Third weighted quartile.
    pub weighted_q3: f64,
    /// Smallest error.
    pub min: f64,
    /// Largest error.
    pub max: f64,
}

impl FlipStats {
    /// `None` if there are no errors to look at.
    pub fn of(errors: impl IntoIterator<Item = f32>) -> Option<Self> {
        let mut sorted: Vec<f64> = errors.into_iter().map(f64::from).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let (&min, &max) = (sorted.first()?, sorted.last()?);
        let sum: f64 = sorted.iter().sum();
        let weighted = |share: f64| {
            let mut below = 0.0;
            let reached = sorted.iter().find(|&&error| {
                below += error;
                below >= share * sum
            });
            reached.copied().unwrap_or(max)
        };
        Some(Self {
            mean: sum / sorted.len() as f64,
            weighted_median: weighted(0.5),
            weighted_q1: weighted(0.25),
            weighted_q3: weighted(0.75),
            min,
            max,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_spaces_invert_and_know_white() {
        for linear in [
            DVec3::new(0.2, 0.7, 0.05),
            DVec3::ONE,
            DVec3::ZERO,
            DVec3::Z,
        ] {
            let back = XYZ_FROM_LINEAR.inverse() * xyz_from_opponent(opponent_from_linear(linear));
            assert!(back.abs_diff_eq(linear, 1e-14), "{linear} {back}");
        }
        assert!(lab_from_linear(DVec3::ONE).abs_diff_eq(DVec3::new(100.0, 0.0, 0.0), 1e-12));
    }

    #[test]
    fn kernels_have_the_stated_sums() {
        let sums: DVec4 = sensitivity_kernel(f64::from(DEFAULT_PIXELS_PER_DEGREE))
            .iter()
            .sum();
        assert!((sums.x - 1.0).abs() < 1e-14 && (sums.y - 1.0).abs() < 1e-14);
        assert!((sums.z * sums.z + sums.w * sums.w - 1.0).abs() < 1e-14);
        let sums: DVec3 = feature_kernel(f64::from(DEFAULT_PIXELS_PER_DEGREE))
            .iter()
            .sum();
        assert!(sums.abs_diff_eq(DVec3::X, 1e-14), "{sums}");
    }

    #[test]
    fn weighted_median_weighs_by_error() {
        let stats = FlipStats::of([0.0, 0.0, 0.0, 0.1, 0.1, 0.2, 0.4]).unwrap();
        assert_eq!(stats.weighted_median, f64::from(0.2_f32));
        assert_eq!(stats.weighted_q1, f64::from(0.1_f32));
        assert_eq!((stats.min, stats.max), (0.0, f64::from(0.4_f32)));
        assert_eq!(FlipStats::of([]), None);
        assert_eq!(FlipStats::of([0.0; 3]).unwrap().weighted_median, 0.0);
    }
}

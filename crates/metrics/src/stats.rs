//! Summaries of samples: errors, times, paired differences. Everything accumulates in `f64`.
//!
//! Percentiles interpolate linearly between the two nearest order statistics. Samples that are not
//! finite are the caller's to count and leave out; here they propagate into the result.

use fastrand::Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Distribution of an error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Summary {
    /// Arithmetic mean.
    pub mean: f64,
    /// Median.
    pub p50: f64,
    /// 95th percentile.
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest sample.
    pub max: f64,
}

impl Summary {
    /// `None` if there are no samples.
    pub fn of(samples: impl IntoIterator<Item = f64>) -> Option<Self> {
        let sorted = sorted(samples);
        Some(Self {
            mean: mean(&sorted)?,
            p50: percentile(&sorted, 0.50)?,
            p95: percentile(&sorted, 0.95)?,
            p99: percentile(&sorted, 0.99)?,
            max: *sorted.last()?,
        })
    }
}

/// Distribution of a duration, in the unit of its samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Timing {
    /// Median.
    pub median: f64,
    /// Median absolute deviation from the median, unscaled.
    pub mad: f64,
    /// 5th percentile.
    pub p5: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Number of samples.
    pub samples: u64,
    /// Smallest sample.
    pub min: f64,
    /// Arithmetic mean.
    pub mean: f64,
    /// Sample standard deviation (n − 1); 0 for a single sample.
    pub sigma: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest sample.
    pub max: f64,
    /// Lower end of the median's 95 % bootstrap interval; `None` with fewer than
    /// [`FEWEST_FOR_INTERVAL`] samples.
    pub median_low: Option<f64>,
    /// Upper end of the median's 95 % bootstrap interval.
    pub median_high: Option<f64>,
}

impl Timing {
    /// `None` if there are no samples. The bootstrap has a fixed seed: same samples, same interval.
    pub fn of(samples: &[f64]) -> Option<Self> {
        let sorted = sorted(samples.iter().copied());
        let mean = mean(&sorted)?;
        let median = percentile(&sorted, 0.5)?;
        let squares: f64 = sorted.iter().map(|sample| (sample - mean).powi(2)).sum();
        let deviations = self::sorted(sorted.iter().map(|sample| (sample - median).abs()));
        let (median_low, median_high) = bootstrap_median(&sorted).unzip();
        Some(Self {
            median,
            mad: percentile(&deviations, 0.5)?,
            p5: percentile(&sorted, 0.05)?,
            p95: percentile(&sorted, 0.95)?,
            samples: sorted.len() as u64,
            min: *sorted.first()?,
            mean,
            sigma: (squares / (sorted.len() - 1).max(1) as f64).sqrt(),
            p99: percentile(&sorted, 0.99)?,
            max: *sorted.last()?,
            median_low,
            median_high,
        })
    }
}

/// Median of `b − a` over pairs measured together, with its 95 % bootstrap interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct PairedDifference {
    /// Median difference; negative if `b` is smaller.
    pub median: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// The interval excludes zero.
    pub significant: bool,
}

/// Compares two series whose samples were taken in turn (a, b, a, b, …); what one has more is left
/// out. `None` with fewer than [`FEWEST_FOR_INTERVAL`] pairs.
pub fn paired(a: &[f64], b: &[f64]) -> Option<PairedDifference> {
    let differences = sorted(a.iter().zip(b).map(|(a, b)| b - a));
    let median = percentile(&differences, 0.5)?;
    let (low, high) = bootstrap_median(&differences)?;
    Some(PairedDifference {
        median,
        low,
        high,
        significant: low > 0.0 || high < 0.0,
    })
}

/// Value below which the share `share` (0 to 1) of the ascending samples lies; `None` if empty.
pub fn percentile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share.clamp(0.0, 1.0) * last as f64;
    let (below, above) = (
        sorted[place.floor() as usize],
        sorted[place.ceil() as usize],
    );
    // Not a difference when equal: infinities would give NaN.
    Some(if below == above {
        below
    } else {
        below + (above - below) * place.fract()
    })
}

fn sorted(samples: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut samples: Vec<f64> = samples.into_iter().collect();
    samples.sort_unstable_by(f64::total_cmp);
    samples
}

fn mean(samples: &[f64]) -> Option<f64> {
    (!samples.is_empty()).then(|| samples.iter().sum::<f64>() / samples.len() as f64)
}

/// With fewer samples not even the range from the smallest to the largest is a 95 % interval of the
/// median: all n samples lie on one side of it with probability 1 / 2ⁿ⁻¹.
pub const FEWEST_FOR_INTERVAL: usize = 6;

/// Resamples per interval: beyond each end of a 95 % interval lie 50 of them.
const RESAMPLES: usize = 2000;
const SEED: u64 = 0x6361_746f_7074_7269;

/// 95 % percentile-bootstrap interval of the median of ascending samples; `None` of fewer than
/// [`FEWEST_FOR_INTERVAL`].
fn bootstrap_median(sorted_samples: &[f64]) -> Option<(f64, f64)> {
    let count = sorted_samples.len();
    if count < FEWEST_FOR_INTERVAL {
        return None;
    }
    let mut random = Rng::with_seed(SEED);
    let mut picked = vec![0; count];
    let medians = sorted((0..RESAMPLES).map(|_| {
        // Picking places instead of values keeps the selection free of comparisons of floats.
        picked.fill_with(|| random.usize(..count));
        let (_, &mut upper, _) = picked.select_nth_unstable(count / 2);
        let lower = if count % 2 == 1 {
            upper
        } else {
            *picked[..count / 2].iter().max().expect("there are samples")
        };
        (sorted_samples[lower] + sorted_samples[upper]) / 2.0
    }));
    Some((percentile(&medians, 0.025)?, percentile(&medians, 0.975)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summary_of_one_to_a_hundred() {
        let summary = Summary::of((1..=100).rev().map(f64::from)).unwrap();
        assert_eq!(summary.mean, 50.5);
        assert_eq!(summary.p50, 50.5);
        assert!((summary.p95 - 95.05).abs() < 1e-12);
        assert!((summary.p99 - 99.01).abs() < 1e-12);
        assert_eq!(summary.max, 100.0);
    }

    #[test]
    fn no_samples_no_numbers() {
        assert_eq!(Summary::of([]), None);
        assert_eq!(Timing::of(&[]), None);
        assert_eq!(paired(&[], &[1.0]), None);
        assert_eq!(paired(&[1.0; 5], &[2.0; 5]), None);
        assert!(paired(&[1.0; 6], &[2.0; 6]).is_some());
    }

    #[test]
    fn not_a_number_is_not_hidden() {
        let summary = Summary::of([1.0, f64::NAN]).unwrap();
        assert!(summary.mean.is_nan() && summary.max.is_nan());
    }

    #[test]
    fn timing_of_a_known_series() {
        let timing = Timing::of(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]).unwrap();
        assert_eq!((timing.min, timing.max, timing.samples), (2.0, 9.0, 8));
        assert_eq!((timing.mean, timing.median, timing.mad), (5.0, 4.5, 0.5));
        assert!((timing.sigma - (32.0_f64 / 7.0).sqrt()).abs() < 1e-12);
        let (low, high) = (timing.median_low.unwrap(), timing.median_high.unwrap());
        assert!((2.0..=4.5).contains(&low) && (4.5..=9.0).contains(&high));
    }

    #[test]
    fn a_single_sample_is_its_own_everything() {
        let timing = Timing::of(&[3.0]).unwrap();
        assert_eq!((timing.median, timing.sigma, timing.mad), (3.0, 0.0, 0.0));
        assert_eq!((timing.median_low, timing.median_high), (None, None));
    }

    #[test]
    fn the_interval_of_the_median_covers_it_as_often_as_it_says() {
        let mut random = Rng::with_seed(7);
        let covered = (0..400)
            .filter(|_| {
                let sample: Vec<f64> = (0..51)
                    .map(|_| random.usize(..1_000_000) as f64 / 1e6)
                    .collect();
                let timing = Timing::of(&sample).unwrap();
                timing.median_low <= Some(0.5) && Some(0.5) <= timing.median_high
            })
            .count();
        // 95 % of 400 is 380, sigma 4.4; the percentile bootstrap is a little off.
        assert!((360..=396).contains(&covered), "{covered} of 400");
    }

    #[test]
    fn paired_finds_a_shift_under_a_shared_drift_and_nothing_in_noise() {
        let drift = |i: usize| 10.0 + (i as f64 * 0.3).sin() * 5.0;
        let mut random = Rng::with_seed(3);
        let mut noise = || random.usize(..1000) as f64 / 1e4 - 0.05;
        let a: Vec<f64> = (0..40).map(|i| drift(i) + noise()).collect();
        let shifted: Vec<f64> = (0..40).map(|i| drift(i) + 0.2 + noise()).collect();
        let same: Vec<f64> = (0..40).map(|i| drift(i) + noise()).collect();

        let difference = paired(&a, &shifted).unwrap();
        assert!(difference.significant && (difference.median - 0.2).abs() < 0.05);
        assert!(!paired(&a, &same).unwrap().significant);
        assert!(!paired(&a, &a).unwrap().significant);
    }
}

//! Curves through measured places.

/// The power by which a curve grows: the slope of the least-squares line through the logarithms.
/// `None` with fewer than two places or a number that is not positive.
pub fn power(curve: &[(f64, f64)]) -> Option<f64> {
    let logs = curve.iter().map(|(x, y)| (x.ln(), y.ln()));
    let logs: Vec<(f64, f64)> = logs.collect();
    if logs.iter().any(|(x, y)| !x.is_finite() || !y.is_finite()) {
        return None;
    }
    let n = logs.len() as f64;
    let mean = logs
        .iter()
        .fold((0.0, 0.0), |sum, (x, y)| (sum.0 + x / n, sum.1 + y / n));
    let (mut above, mut below) = (0.0, 0.0);
    for (x, y) in &logs {
        above += (x - mean.0) * (y - mean.1);
        below += (x - mean.0) * (x - mean.0);
    }
    (below > 0.0).then(|| above / below)
}

/// The standard error of [`power`]: how far the places scatter about the line. `None` with fewer than
/// three places.
pub fn power_error(curve: &[(f64, f64)]) -> Option<f64> {
    let slope = power(curve)?;
    let n = curve.len() as f64;
    let logs = curve.iter().map(|(x, y)| (x.ln(), y.ln()));
    let sums = logs
        .clone()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    let (mean_x, mean_y) = (sums.0 / n, sums.1 / n);
    let (mut off, mut spread) = (0.0, 0.0);
    for (x, y) in logs {
        let residual = y - mean_y - slope * (x - mean_x);
        off += residual * residual;
        spread += (x - mean_x) * (x - mean_x);
    }
    (curve.len() > 2).then(|| (off / (n - 2.0) / spread).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_exact_curves() {
        let square: Vec<_> = [1.0, 2.0, 5.0].map(|x: f64| (x, 3.0 * x * x)).to_vec();
        assert!((power(&square).unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(power(&square[..1]), None);
        assert_eq!(power(&[(1.0, 0.0), (2.0, 1.0)]), None);
    }

    #[test]
    fn a_power_is_as_sure_as_its_places_are_in_line() {
        let square: Vec<_> = [1.0, 2.0, 5.0].map(|x: f64| (x, 3.0 * x * x)).to_vec();
        assert!(power_error(&square).unwrap() < 1e-12);
        assert_eq!(power_error(&square[..2]), None);
        // In logarithms 0, 1, 2 against 0, 3, 0: slope 0, residuals −1, 2, −1, spread 2.
        let scattered = [(0.0_f64, 0.0_f64), (1.0, 3.0), (2.0, 0.0)];
        let scattered = scattered.map(|(x, y)| (x.exp(), y.exp()));
        assert!((power_error(&scattered).unwrap() - 3.0_f64.sqrt()).abs() < 1e-12);
    }
}

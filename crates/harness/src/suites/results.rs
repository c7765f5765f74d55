//! A figure's measurements, to be read by its analysis.

use serde_json::Value;

use crate::record::path::lookup;
use crate::record::{Record, Status};

use super::series::{Ask, Point, Series};

/// The rows of one figure.
pub struct Results<'r> {
    series: &'r [Series],
    rows: &'r [(Record, Value)],
}

impl<'r> Results<'r> {
    /// `rows` are all rows of the suite, each with its JSON.
    pub fn new(series: &'r [Series], rows: &'r [(Record, Value)]) -> Self {
        Self { series, rows }
    }

    /// All series of the figure.
    pub fn series(&self) -> &'r [Series] {
        self.series
    }

    /// The row of a point; `None` where it is not measured (yet).
    pub fn row(&self, point: &Point) -> Option<&'r Record> {
        self.find(point).map(|(row, _)| row)
    }

    fn find(&self, point: &Point) -> Option<&'r (Record, Value)> {
        self.rows.iter().find(|(row, _)| point.is_of(row))
    }

    /// The row of the last measured point of a series.
    pub fn last(&self, series: &str) -> Option<&'r Record> {
        let mut all = self.series.iter();
        let series = all.find(|found| found.label == series)?;
        series.points.iter().rev().find_map(|point| self.row(point))
    }

    /// A number of a point's row; `None` where it is `null` or not measured.
    pub fn value(&self, point: &Point, path: &str) -> Option<f64> {
        let (row, value) = self.find(point)?;
        let value = (row.status == Status::Ok).then_some(value)?;
        lookup(value, path)?.as_f64()
    }

    /// Where a point stands on the axis; `None` where that is measured and is not known.
    pub fn place(&self, point: &Point) -> Option<f64> {
        point
            .along
            .map_or(Some(point.x), |path| self.value(point, path))
    }

    /// Place on the axis and number of all points of a series that have it.
    pub fn curve(&self, series: &str, path: &str) -> Vec<(f64, f64)> {
        let found = self.series.iter().find(|found| found.label == series);
        let points = found.into_iter().flat_map(|series| &series.points);
        points
            .filter_map(|point| Some((self.place(point)?, self.value(point, path)?)))
            .collect()
    }

    /// The number of a series at the point that stands at `x`; `None` where that one has none.
    pub fn at(&self, series: &str, x: f64, path: &str) -> Option<f64> {
        let series = (self.series.iter()).find(|found| found.label == series)?;
        let mut points = series.points.iter();
        let point = points.find(|point| self.place(point) == Some(x))?;
        self.value(point, path)
    }

    /// Our number for a quotation.
    pub fn answer(&self, ask: &Ask) -> Option<f64> {
        self.at(ask.series, ask.x, ask.path)
    }

    /// How often the one series' number is the other's, at every place where both have it.
    pub fn ratios(&self, one: &str, other: &str, path: &str) -> Vec<(f64, f64)> {
        let other = self.curve(other, path);
        let one = self.curve(one, path).into_iter();
        one.filter_map(|(x, value)| {
            let (_, divisor) = other.iter().find(|(place, _)| *place == x)?;
            (*divisor != 0.0).then_some((x, value / divisor))
        })
        .collect()
    }
}

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

/// The constant and growing part of a cost: the least-squares line through the values, as its
/// value at 0 and its slope, each place weighted by the inverse square of its value so that small
/// and large places count alike. `None` with fewer than two places.
pub fn line(curve: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (mut w, mut wx, mut wy, mut wxx, mut wxy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for &(x, y) in curve.iter().filter(|(_, y)| *y > 0.0) {
        let weight = 1.0 / (y * y);
        w += weight;
        wx += weight * x;
        wy += weight * y;
        wxx += weight * x * x;
        wxy += weight * x * y;
    }
    let below = w * wxx - wx * wx;
    (below > 0.0).then(|| {
        let slope = (w * wxy - wx * wy) / below;
        ((wy - slope * wx) / w, slope)
    })
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

    #[test]
    fn lines_through_exact_costs() {
        let cost: Vec<_> = [100.0, 1e3, 1e5].map(|x: f64| (x, 5.0 + 0.25 * x)).to_vec();
        let (constant, slope) = line(&cost).unwrap();
        assert!((constant - 5.0).abs() < 1e-6 && (slope - 0.25).abs() < 1e-9);
        assert_eq!(line(&cost[..1]), None);
    }
}

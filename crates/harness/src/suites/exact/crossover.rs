//! Where one series begins to cost less than another.

use crate::suites::claims::{Case, Interval, Noise, Numbers, Term};

/// The place from which on the first of two series costs no more than the second, with the interval in which it
/// may lie; the first place where it never costs more. None where it still costs more at the last place, or where the
/// two have fewer than two places in common.
///
/// Between two places both are taken for powers of the place; the ends of the interval are where the ratio would
/// cross 1 if it were as large, and as small, as its noise allows.
pub fn crossover(from: &dyn Numbers, [one, other]: [&str; 2], term: Term) -> Option<Interval> {
    let places = from.places(one).into_iter();
    let ratios = places.filter_map(|x| {
        let [one, other] = [one, other].map(|series| term.read(from, series, x, Noise::Clock));
        Some((x, one?.over(other?)?))
    });
    let ratios: Vec<(f64, Interval)> = ratios.collect();
    if ratios.len() < 2 {
        return None;
    }
    let along = |end: fn(&Interval) -> f64| -> Vec<(f64, f64)> {
        ratios.iter().map(|(x, ratio)| (*x, end(ratio))).collect()
    };
    let value = last_crossing(&along(|ratio| ratio.value))?;
    let low = last_crossing(&along(|ratio| ratio.low)).unwrap_or(value);
    let high = last_crossing(&along(|ratio| ratio.high)).unwrap_or(f64::INFINITY);
    Some(Interval {
        value,
        low: low.min(value),
        high: high.max(value),
    })
}

/// Where a curve of ratios comes down to 1 for the last time; the first place where it is never above.
fn last_crossing(ratios: &[(f64, f64)]) -> Option<f64> {
    let above = ratios.iter().rposition(|(_, ratio)| *ratio > 1.0);
    let Some(above) = above else {
        return ratios.first().map(|(x, _)| *x);
    };
    let (x, ratio) = ratios[above];
    let (next, below) = *ratios.get(above + 1)?;
    let share = ratio.ln() / (ratio.ln() - below.ln());
    Some((x.ln() + share * (next.ln() - x.ln())).exp())
}

/// As a claim's only case.
pub fn case(from: &dyn Numbers, series: [&str; 2], term: Term) -> Vec<Case> {
    let found = crossover(from, series, term).into_iter();
    let case = |number| Case {
        label: String::new(),
        number,
    };
    found.map(case).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_cross_where_powers_do() {
        // 100/x over 1: at 100.
        let falling = [(10.0, 10.0), (1000.0, 0.1)];
        let crossing = last_crossing(&falling).unwrap();
        assert!((crossing - 100.0).abs() < 1e-9);
        // The last of several.
        let twice = [(1.0, 2.0), (2.0, 0.5), (4.0, 2.0), (8.0, 0.5)];
        assert!((last_crossing(&twice).unwrap() - 4.0 * 2.0_f64.sqrt()).abs() < 1e-9);
        assert_eq!(last_crossing(&[(3.0, 0.5), (6.0, 0.4)]), Some(3.0));
        assert_eq!(last_crossing(&[(3.0, 0.5), (6.0, 1.4)]), None);
    }
}

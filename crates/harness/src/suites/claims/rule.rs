//! Rules: a measure, the noise of what it reads, and a limit. From them follows one of four verdicts,
//! always with the number.

use crate::show::number::{percent, short};
use crate::suites::fit::{power, power_error};

use super::numbers::{Interval, Noise, Numbers, Pick, Term, Which};

/// What decides about a claim.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The number, or one for each case.
    pub of: Measure,
    /// Where it lies if the claim holds.
    pub is: Limit,
    /// By how much what is read may be off.
    pub noise: Noise,
    /// How the number is written.
    pub shown: Shown,
}

/// A number that is made of a figure's.
#[derive(Clone, Copy, Debug)]
pub enum Measure {
    /// The number itself.
    Value(Pick, Term),
    /// The first over the second.
    Ratio(Pick, Pick, Term),
    /// The first less the second.
    Difference(Pick, Pick, Term),
    /// The power of the place by which a series grows; its noise is twice the standard error of the fit.
    Power(Which, Term),
    /// The least ratio of a series' number to the one before.
    LeastStep(Which, Term),
    /// The greatest ratio of a series' number to the one before.
    GreatestStep(Which, Term),
    /// A function of its own, with the paths that it reads.
    Own(fn(&dyn Numbers) -> Vec<Case>, &'static [&'static str]),
}

/// Where a number lies if a claim holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// Above.
    Above(f64),
    /// Below.
    Below(f64),
    /// From the one to the other.
    Between(f64, f64),
    /// Below the one or above the other.
    Outside(f64, f64),
}

/// How a number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// A ratio.
    Times,
    /// A share.
    Percent,
    /// A power.
    Power,
    /// With this unit; none if empty.
    In(&'static str),
}

/// One of the things that a claim speaks of.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// What tells it apart; empty where there is only one.
    pub label: String,
    /// Its number.
    pub number: Interval,
}

/// What became of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// In each case.
    Holds,
    /// In no case.
    DoesNotHold,
    /// The limit lies within the noise.
    Undecided,
    /// In these cases alone.
    OnlyIf(Vec<String>),
}

/// A verdict and its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What became of the claim.
    pub verdict: Verdict,
    /// What it rests on.
    pub cases: Vec<Case>,
    /// The number in words: from the least to the greatest where there are several cases, with its interval
    /// where there is one.
    pub number: String,
}

impl Limit {
    /// Whether a number lies there; `None` where its interval does not say.
    pub fn admits(self, number: Interval) -> Option<bool> {
        let Interval { low, high, .. } = number;
        match self {
            Self::Above(limit) if low > limit => Some(true),
            Self::Above(limit) if high < limit => Some(false),
            Self::Below(limit) if high < limit => Some(true),
            Self::Below(limit) if low > limit => Some(false),
            Self::Between(from, to) if low >= from && high <= to => Some(true),
            Self::Between(from, to) if high < from || low > to => Some(false),
            Self::Outside(from, to) if high < from || low > to => Some(true),
            Self::Outside(from, to) if low >= from && high <= to => Some(false),
            Self::Above(_) | Self::Below(_) | Self::Between(..) | Self::Outside(..) => None,
        }
    }

    /// The limit in words.
    pub fn words(self, shown: Shown) -> String {
        // A ratio is above 1, not above 1 times.
        let shown = match shown {
            Shown::Times => Shown::In(""),
            other => other,
        };
        match self {
            Self::Above(limit) => format!("above {}", shown.write(limit)),
            Self::Below(limit) => format!("below {}", shown.write(limit)),
            Self::Between(from, to) if from == to => format!("at {}", shown.write(to)),
            Self::Between(from, to) => format!("from {} to {}", shown.bare(from), shown.write(to)),
            Self::Outside(from, to) => {
                format!("below {} or above {}", shown.bare(from), shown.write(to))
            }
        }
    }
}

impl Shown {
    fn bare(self, value: f64) -> String {
        match self {
            Self::Percent => percent(value).trim_end_matches(" %").to_owned(),
            Self::Times | Self::Power | Self::In(_) => short(value),
        }
    }

    /// A number with its unit.
    pub fn write(self, value: f64) -> String {
        match self {
            Self::Percent => percent(value),
            Self::Times => format!("{} times", short(value)),
            Self::Power => format!("the power {}", short(value)),
            Self::In("") => short(value),
            Self::In("°") => format!("{}°", short(value)),
            Self::In(unit) => {
                let number = short(value);
                let unit = match number.as_str() {
                    "1" if !unit.contains(' ') => unit.trim_end_matches('s'),
                    _ => unit,
                };
                format!("{number} {unit}")
            }
        }
    }

    /// From the least to the greatest number; a single one with its interval.
    pub(super) fn range(self, cases: &[Case]) -> String {
        let values = || cases.iter().map(|case| case.number.value);
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        match cases {
            [only] => self.write(most) + &self.interval(only.number),
            _ if self.bare(least) == self.bare(most) => self.write(most),
            _ => format!("{} to {}", self.bare(least), self.write(most)),
        }
    }

    /// The interval in which a number may lie, in brackets; empty where rounding leaves nothing of it.
    fn interval(self, number: Interval) -> String {
        let [value, low, high] = [number.value, number.low, number.high].map(|end| self.bare(end));
        if low == value && high == value {
            String::new()
        } else if number.high.is_finite() {
            format!(" ({low} to {high})")
        } else {
            format!(" (at least {low})")
        }
    }
}

impl Rule {
    /// The verdict; `None` where nothing that the rule reads is known.
    pub fn judge(&self, from: &dyn Numbers) -> Option<Finding> {
        let cases = self.of.cases(from, self.noise);
        let cases: Vec<Case> = cases
            .into_iter()
            .filter(|case| !case.number.value.is_nan())
            .collect();
        if cases.is_empty() {
            return None;
        }
        let answers = cases.iter().map(|case| self.is.admits(case.number));
        let answers: Vec<Option<bool>> = answers.collect();
        let yes = answers
            .iter()
            .filter(|answer| **answer == Some(true))
            .count();
        let no = answers
            .iter()
            .filter(|answer| **answer == Some(false))
            .count();
        let verdict = match (yes, no) {
            (yes, _) if yes == cases.len() => Verdict::Holds,
            (_, no) if no == cases.len() => Verdict::DoesNotHold,
            (0, _) => Verdict::Undecided,
            _ => {
                let holding = cases.iter().zip(&answers);
                let holding = holding.filter(|(_, answer)| **answer == Some(true));
                Verdict::OnlyIf(holding.map(|(case, _)| case.label.clone()).collect())
            }
        };
        Some(Finding {
            verdict,
            number: self.shown.range(&cases),
            cases,
        })
    }
}

impl Measure {
    /// The numbers, a case each.
    pub fn cases(&self, from: &dyn Numbers, noise: Noise) -> Vec<Case> {
        match *self {
            Self::Value(pick, term) => {
                let series = pick.series.of(from).into_iter();
                let cases = series.flat_map(|(series, start)| {
                    let numbers = pick.read(from, &series, term, noise).into_iter();
                    let cases = numbers.map(move |(x, number)| case(from, &start, x, number));
                    cases.collect::<Vec<_>>()
                });
                cases.collect()
            }
            Self::Ratio(one, other, term) => {
                pairs(from, [one, other], term, noise, |one, other| {
                    one.over(other)
                })
            }
            Self::Difference(one, other, term) => {
                pairs(from, [one, other], term, noise, |one, other| {
                    Some(one.minus(other))
                })
            }
            Self::Power(which, term) => along(from, which, term, Noise::Exact, |curve| {
                let curve: Vec<_> = curve.iter().map(|(x, y)| (*x, y.value)).collect();
                let value = power(&curve)?;
                let radius = 2.0 * power_error(&curve)?;
                Some(Interval {
                    value,
                    low: value - radius,
                    high: value + radius,
                })
            }),
            Self::LeastStep(which, term) => along(from, which, term, noise, |curve| {
                steps(curve).min_by(|a, b| a.value.total_cmp(&b.value))
            }),
            Self::GreatestStep(which, term) => along(from, which, term, noise, |curve| {
                steps(curve).max_by(|a, b| a.value.total_cmp(&b.value))
            }),
            Self::Own(cases, _) => cases(from),
        }
    }

    /// Every path that is read.
    pub fn paths(&self) -> Vec<&'static str> {
        match *self {
            Self::Value(_, term)
            | Self::Ratio(_, _, term)
            | Self::Difference(_, _, term)
            | Self::Power(_, term)
            | Self::LeastStep(_, term)
            | Self::GreatestStep(_, term) => term.paths(),
            Self::Own(_, paths) => paths.to_vec(),
        }
    }
}

fn case(from: &dyn Numbers, start: &str, x: Option<f64>, number: Interval) -> Case {
    let start = start.trim_end_matches([',', ' ']);
    let place = x.map(|x| from.place_name(x));
    let label = match (start.is_empty(), place) {
        (true, place) => place.unwrap_or_default(),
        (false, None) => start.to_owned(),
        (false, Some(place)) => format!("{start}, {place}"),
    };
    Case { label, number }
}

/// What follows from the numbers of two picks: place by place where the first names each.
fn pairs(
    from: &dyn Numbers,
    [one, other]: [Pick; 2],
    term: Term,
    noise: Noise,
    follows: impl Fn(Interval, Interval) -> Option<Interval>,
) -> Vec<Case> {
    let mut cases = Vec::new();
    for (series, start) in one.series.of(from) {
        let beside = other.series.beside(&start);
        let others = other.read(from, &beside, term, noise);
        for (x, number) in one.read(from, &series, term, noise) {
            let same = |(place, _): &&(Option<f64>, Interval)| place.is_none() || *place == x;
            let number = others
                .iter()
                .find(same)
                .and_then(|(_, other)| follows(number, *other));
            cases.extend(number.map(|number| case(from, &start, x, number)));
        }
    }
    cases
}

/// What follows from the whole of each series.
fn along(
    from: &dyn Numbers,
    which: Which,
    term: Term,
    noise: Noise,
    follows: impl Fn(&[(f64, Interval)]) -> Option<Interval>,
) -> Vec<Case> {
    let series = which.of(from).into_iter();
    let cases = series.filter_map(|(series, start)| {
        let places = from.places(&series).into_iter();
        let curve = places.filter_map(|x| Some((x, term.read(from, &series, x, noise)?)));
        let curve: Vec<(f64, Interval)> = curve.collect();
        Some(case(from, &start, None, follows(&curve)?))
    });
    cases.collect()
}

fn steps(curve: &[(f64, Interval)]) -> impl Iterator<Item = Interval> {
    curve
        .windows(2)
        .filter_map(|pair| pair[1].1.over(pair[0].1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_a_kind_is_no_plural() {
        let shown = |unit, value| Shown::In(unit).write(value);
        assert_eq!(shown("steps", 1.0), "1 step");
        assert_eq!(shown("steps", 2.0), "2 steps");
        assert_eq!(shown("px", 1.0), "1 px");
    }
}

//! Every rule of every suite comes out either way, and undecided in the noise.

use std::collections::BTreeMap;

use crate::suites::figure::Figure;
use crate::suites::series::Series;
use crate::suites::suite::Asked;
use crate::suites::{SUITES, results};

use super::rule::{Case, Limit, Measure, Rule, Shown, Verdict};
use super::{Claim, EVERY, Interval, Noise, Numbers, Place, Term, Which, at, each, of};

/// Made-up numbers: of a series at a place, what a path's number is.
struct Made<'f> {
    series: &'f [Series],
    names: &'f dyn Fn(f64) -> String,
    value: &'f dyn Fn(usize, f64, &str) -> Option<f64>,
}

impl Numbers for Made<'_> {
    fn labels(&self) -> Vec<String> {
        self.series
            .iter()
            .map(|series| series.label.clone())
            .collect()
    }

    fn places(&self, series: &str) -> Vec<f64> {
        let found = self.series.iter().find(|found| found.label == series);
        let points = found.map_or(&[][..], |series| &series.points);
        points.iter().map(|point| point.x).collect()
    }

    fn at(&self, series: &str, x: f64, path: &str) -> Option<f64> {
        let place = self.series.iter().position(|found| found.label == series)?;
        self.places(series)
            .contains(&x)
            .then(|| (self.value)(place, x, path))
            .flatten()
    }

    fn place_name(&self, x: f64) -> String {
        (self.names)(x)
    }
}

/// A sequence of numbers that is the same at every run (splitmix64).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.next() % all.len() as u64) as usize]
    }
}

/// Numbers that bring a rule's measure to either side of its limit and onto it.
fn candidates(limit: Limit) -> Vec<f64> {
    let ends = match limit {
        Limit::Above(limit) | Limit::Below(limit) => vec![limit],
        Limit::Between(from, to) | Limit::Outside(from, to) => vec![from, to, 0.5 * (from + to)],
    };
    let mut all = vec![0.0, 1.0, 1e-3, 0.1, 0.5, 0.9, 1.1, 2.0, 10.0, 1e3];
    for end in ends {
        all.extend([
            end,
            end.abs() + 1.0,
            end * 0.99,
            end * 1.01,
            1.0 + end,
            1.0 - end,
        ]);
        if end != 0.0 {
            all.push(1.0 / end);
        }
    }
    all.retain(|value| value.is_finite() && *value >= 0.0);
    all
}

/// How often numbers are made up for a claim at most.
const TRIES: u64 = 100_000;

/// The verdicts, by their keys, that made-up numbers bring about: numbers of a series that go as a power
/// of the place, and here and there one place that is other.
fn verdicts(
    claim: &Claim,
    figure: &Figure,
    wanted: &[&'static str],
) -> BTreeMap<&'static str, u64> {
    let candidates = candidates(claim.rule.is);
    let paths = claim.rule.of.paths();
    let mut powers = vec![0.0, 0.0, 0.0, 1.0, -1.0, 3.9, -3.9];
    powers.extend(
        candidates
            .iter()
            .flat_map(|power| [*power, -*power])
            .filter(|power| power.abs() < 4.0),
    );
    let names = |x: f64| results::place_name(&figure.axis, x);
    let mut found = BTreeMap::new();
    let mut dice = Dice(1);
    for _ in 0..TRIES {
        if wanted.iter().all(|key| found.contains_key(key)) {
            break;
        }
        let shared = dice.of(&candidates);
        let all: Vec<Vec<[f64; 4]>> = (figure.series.iter())
            .map(|series| {
                let places: Vec<f64> = series.points.iter().map(|point| point.x).collect();
                // Models that are not here leave a series without places.
                let places = if places.is_empty() { vec![0.0] } else { places };
                let mut one = |_: &&'static str| {
                    let factor = if dice.next().is_multiple_of(3) {
                        shared
                    } else {
                        dice.of(&candidates)
                    };
                    let other = if dice.next().is_multiple_of(2) {
                        1.0
                    } else {
                        dice.of(&candidates)
                    };
                    [factor, dice.of(&powers), dice.of(&places), other]
                };
                paths.iter().map(&mut one).collect()
            })
            .collect();
        // Often all series share what they are, so that claims about all of them hold or fail.
        let alike = dice.next().is_multiple_of(2);
        let value = |series: usize, x: f64, path: &str| {
            // A recorded interval of a median is a narrow one here.
            let path = path
                .replace(".median_low", ".median")
                .replace(".median_high", ".median");
            let place = paths.iter().position(|other| *other == path)?;
            let [factor, power, odd, other] = all[if alike { 0 } else { series }][place];
            let x_power = if x > 0.0 { x.powf(power) } else { 1.0 };
            Some(factor * x_power * if x == odd { other } else { 1.0 })
        };
        let made = Made {
            series: &figure.series,
            names: &names,
            value: &value,
        };
        if let Some(finding) = claim.rule.judge(&made) {
            *found.entry(finding.verdict.key()).or_default() += 1;
        }
    }
    found
}

/// Gives the points that stand where a measurement puts them a place each.
fn place_points(figure: &mut Figure) {
    for series in &mut figure.series {
        for (point, place) in series.points.iter_mut().zip(1..) {
            if point.along.is_some() {
                point.x = 4.0_f64.powi(place);
            }
        }
    }
}

#[test]
fn every_claim_can_come_out_either_way() {
    let mut wanting = Vec::new();
    let mut claims = 0;
    for suite in SUITES {
        if suite.name.ends_with("-full") {
            continue;
        }
        for mut figure in (suite.figures)(&Asked::default()) {
            place_points(&mut figure);
            for claim in figure.claims {
                claims += 1;
                let noisy =
                    claim.rule.noise != Noise::Exact || matches!(claim.rule.of, Measure::Power(..));
                let wanted = ["holds", "does-not-hold", "undecided"];
                let wanted = &wanted[..if noisy { 3 } else { 2 }];
                let found = verdicts(claim, &figure, wanted);
                for key in wanted {
                    if !found.contains_key(key) {
                        wanting.push(format!(
                            "{}, {}: {}: never {key}: {found:?}",
                            suite.name, figure.anchor, claim.says
                        ));
                    }
                }
            }
        }
    }
    assert!(wanting.is_empty(), "{}", wanting.join("\n"));
    assert!(claims > 100, "{claims}");
}

#[test]
fn claims_are_whole_sentences_with_a_reason_and_a_place() {
    for suite in SUITES {
        for figure in (suite.figures)(&Asked::default()) {
            for claim in figure.claims {
                assert!(
                    claim.says.ends_with('.') && claim.why.ends_with('.'),
                    "{}",
                    claim.says
                );
                assert_eq!(
                    claim.section.is_empty(),
                    claim.paper == super::Paper::Ours,
                    "{}",
                    claim.says
                );
            }
        }
    }
    for open in super::UNJUDGED {
        assert!(
            open.says.ends_with('.') && open.reason.ends_with('.'),
            "{}",
            open.says
        );
    }
}

/// Two series at places 1, 2 and 3.
fn judged(rule: &Rule, one: [f64; 3], other: [f64; 3]) -> Verdict {
    let points = || [1.0, 2.0, 3.0].map(|x| crate::suites::series::Point::new(x, "bowl", "linear"));
    let series = [Series::new("one", points()), Series::new("other", points())];
    let value = |place: usize, x: f64, path: &str| {
        (path == "a").then(|| [one, other][place][x as usize - 1])
    };
    let made = Made {
        series: &series,
        names: &|x| format!("{x}"),
        value: &value,
    };
    rule.judge(&made).expect("all is known").verdict
}

const A: Term = Term::Path("a");

fn rule(of: Measure, is: Limit, noise: Noise) -> Rule {
    Rule {
        of,
        is,
        noise,
        shown: Shown::Times,
    }
}

#[test]
fn a_ratio_is_decided_outside_the_noise() {
    let pick = Measure::Ratio(at("one", 1.0), at("other", 1.0), A);
    let rule = rule(pick, Limit::Above(1.0), Noise::Share(0.1));
    let verdict = |value: f64| judged(&rule, [value; 3], [1.0; 3]);
    assert_eq!(verdict(1.5), Verdict::Holds);
    assert_eq!(verdict(0.7), Verdict::DoesNotHold);
    assert_eq!(verdict(1.1), Verdict::Undecided);
    assert_eq!(verdict(0.9), Verdict::Undecided);
}

#[test]
fn what_holds_here_and_there_holds_only_there() {
    let rule = rule(
        Measure::Value(each("one"), A),
        Limit::Below(5.0),
        Noise::Plus(1.0),
    );
    let verdict = |values| judged(&rule, values, [0.0; 3]);
    assert_eq!(verdict([1.0, 2.0, 3.0]), Verdict::Holds);
    assert_eq!(verdict([7.0, 8.0, 9.0]), Verdict::DoesNotHold);
    assert_eq!(
        verdict([1.0, 5.0, 9.0]),
        Verdict::OnlyIf(vec!["1".to_owned()])
    );
    // Where it holds nowhere for certain and fails not everywhere for certain, it is open.
    assert_eq!(verdict([5.0, 9.0, 9.0]), Verdict::Undecided);
}

#[test]
fn a_power_is_undecided_where_its_places_scatter() {
    let rule = rule(
        Measure::Power(Which::Named("one"), A),
        Limit::Between(-0.05, 0.05),
        Noise::Exact,
    );
    let verdict = |values| judged(&rule, values, [1.0; 3]);
    assert_eq!(verdict([4.0, 4.0, 4.0]), Verdict::Holds);
    assert_eq!(verdict([1.0, 2.0, 3.0]), Verdict::DoesNotHold);
    assert_eq!(verdict([4.0, 5.0, 4.0]), Verdict::Undecided);
}

#[test]
fn steps_are_from_place_to_place() {
    let rule = rule(
        Measure::LeastStep(EVERY, A),
        Limit::Above(1.0),
        Noise::Share(0.01),
    );
    let verdict = |one, other| judged(&rule, one, other);
    assert_eq!(verdict([1.0, 2.0, 4.0], [1.0, 3.0, 9.0]), Verdict::Holds);
    assert_eq!(
        verdict([4.0, 2.0, 1.0], [4.0, 2.0, 1.0]),
        Verdict::DoesNotHold
    );
    assert_eq!(
        verdict([1.0, 2.0, 4.0], [4.0, 2.0, 1.0]),
        Verdict::OnlyIf(vec!["one".to_owned()])
    );
}

#[test]
fn limits_admit_what_lies_in_them() {
    let span = |low: f64, high: f64| Interval {
        value: 0.5 * (low + high),
        low,
        high,
    };
    let outside = Limit::Outside(0.5, 2.0);
    assert_eq!(outside.admits(span(0.1, 0.2)), Some(true));
    assert_eq!(outside.admits(span(3.0, 4.0)), Some(true));
    assert_eq!(outside.admits(span(0.6, 1.9)), Some(false));
    assert_eq!(outside.admits(span(1.9, 2.1)), None);
    let between = Limit::Between(0.0, 0.0);
    assert_eq!(between.admits(span(0.0, 0.0)), Some(true));
    assert_eq!(between.admits(span(1.0, 1.0)), Some(false));
}

#[test]
fn a_time_is_as_sure_as_its_recorded_interval() {
    let points = [crate::suites::series::Point::new(1.0, "bowl", "linear")];
    let series = [Series::new("one", points)];
    let read = |low: Option<f64>| {
        let value = move |_: usize, _: f64, path: &str| match path {
            "t.median" => Some(10.0),
            "t.median_low" => low,
            "t.median_high" => Some(11.0),
            _ => None,
        };
        let made = Made {
            series: &series,
            names: &|_| String::new(),
            value: &value,
        };
        let time = Term::Path("t.median")
            .read(&made, "one", 1.0, Noise::Clock)
            .unwrap();
        [time.low, time.high]
    };
    assert_eq!(read(Some(8.0)), [8.0, 11.0]);
    assert_eq!(read(None), [9.0, 11.0]);
    assert_eq!(read(Some(9.99))[0], 9.7);
}

#[test]
fn series_belong_together_by_their_beginnings() {
    let points = || [crate::suites::series::Point::new(1.0, "bowl", "linear")];
    let labels = ["a, ours", "a, theirs", "b, ours", "b, theirs"];
    let series = labels.map(|label| Series::new(label, points()));
    let value = |place: usize, _: f64, _: &str| Some([4.0, 2.0, 1.0, 2.0][place]);
    let made = Made {
        series: &series,
        names: &|_| String::new(),
        value: &value,
    };
    let [ours, theirs] = ["ours", "theirs"].map(|ending| of(Which::Ending(ending), Place::First));
    let rule = rule(
        Measure::Ratio(ours, theirs, A),
        Limit::Above(1.0),
        Noise::Exact,
    );
    let finding = rule.judge(&made).unwrap();
    assert_eq!(finding.verdict, Verdict::OnlyIf(vec!["a".to_owned()]));
    assert_eq!(finding.number, "0.5 to 2 times");
}

#[test]
fn a_single_number_has_its_interval() {
    let written = |value: f64, low: f64, high: f64| {
        let number = Interval { value, low, high };
        let label = String::new();
        Shown::Times.range(&[Case { label, number }])
    };
    assert_eq!(written(2.0, 2.0, 2.0), "2 times");
    assert_eq!(written(2.0, 1.5, 3.0), "2 times (1.5 to 3)");
    assert_eq!(written(2.0, 1.5, f64::INFINITY), "2 times (at least 1.5)");
}

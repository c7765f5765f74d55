//! Per-vertex answers of a search against the exact reflection points.

use catoptric_frame::{TrueVertex, VertexClass, VertexResult, VertexState};
use glam::DVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::MetricsError;
use crate::stats::Summary;

/// The record's `vertices`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct VertexReport {
    /// (object vertex, mirror) pairs.
    pub searched: u64,
    /// Of those, with a true reflection point in view. `None`, as all that follows from the truth,
    /// where that is not known.
    pub reflected: Option<u64>,
    /// Of those, behind the mirror's silhouette cone: without any reflection point.
    pub hidden: Option<u64>,
    /// Of `reflected`, those for which the search says that it has no answer, or a stand-in only.
    pub failed: Option<u64>,
    /// Answers that are NaN or infinite though the search reports none as failed; they count as
    /// not found.
    pub non_finite: u64,
    /// Found true solutions ÷ true solutions in view; found is within 0.75 px. `None` without any.
    pub recall: Option<f64>,
    /// True and found points, counted.
    pub solutions: Option<SolutionCount>,
    /// Parts of mirrors of which it stays undecided whether they hold a true point, of all vertices
    /// together.
    pub undecided: Option<u64>,
    /// Searches that met a gap in a hierarchy; `None` for searches without one.
    pub hole: Option<u64>,
    /// Searches that used the enlargement repair; `None` for searches without one.
    pub enlarged: Option<u64>,
    /// Distance between the found and the nearest true reflection point in pixels, over `reflected`
    /// without those that have no answer; stand-ins count. `None` without any.
    pub offset_px: Option<Summary>,
    /// How many of those offsets are large, as shares.
    pub offset_share: Option<OffsetShare>,
    /// How the rule that drops vertices behind the mirror's tangent plane fared.
    pub discard: Option<Discard>,
}

impl VertexReport {
    /// What is to be said of a search where the exact reflection points are not known.
    pub fn without_truth(results: &[VertexResult]) -> Self {
        Self {
            searched: results.chunk_by(same_pair).count() as u64,
            reflected: None,
            hidden: None,
            failed: None,
            non_finite: results.iter().filter(|it| is_non_finite(it)).count() as u64,
            recall: None,
            solutions: None,
            undecided: None,
            hole: count_flags(results.iter().map(|result| result.hole)),
            enlarged: count_flags(results.iter().map(|result| result.enlarged)),
            offset_px: None,
            offset_share: None,
            discard: None,
        }
    }
}

/// How many reflection points there are and were found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct SolutionCount {
    /// True points in view.
    #[serde(rename = "true")]
    pub existing: u64,
    /// Of those, with an answer within 0.75 px.
    pub found: u64,
    /// Answers, stand-ins aside, without a true point within 0.75 px, in view or not; those of vertices
    /// whose truth is not known do not count.
    pub spurious: u64,
    /// True points by the number k of focal points before the vertex; null where k is known of none.
    pub by_k: Option<SolutionsByK>,
}

/// True points by the number k of focal points of the reflected beam before the vertex: 0 the upright image, 2
/// the inverted one, 1 the one between, which is turned over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct SolutionsByK {
    /// Before any.
    pub k0: FoundCount,
    /// Between the two.
    pub k1: FoundCount,
    /// Behind both.
    pub k2: FoundCount,
}

/// How many true points there are and were found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct FoundCount {
    /// True points in view.
    #[serde(rename = "true")]
    pub existing: u64,
    /// Of those, with an answer within 0.75 px.
    pub found: u64,
}

impl SolutionCount {
    /// One more true point.
    fn add(&mut self, is_found: bool, focal: Option<u8>) {
        self.existing += 1;
        self.found += u64::from(is_found);
        let Some(k) = focal else { return };
        let by_k = self.by_k.get_or_insert_default();
        let of = match k {
            0 => &mut by_k.k0,
            1 => &mut by_k.k1,
            _ => &mut by_k.k2,
        };
        of.existing += 1;
        of.found += u64::from(is_found);
    }
}

/// Shares of offsets above a limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct OffsetShare {
    /// Above 0.71 px: not the nearest pixel.
    pub over_0_71: f64,
    /// Above 2 px.
    pub over_2: f64,
    /// Above 5 px.
    pub over_5: f64,
}

/// Wrong decisions of the discard rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Discard {
    /// Truly hidden, but kept.
    pub false_keep: u64,
    /// Truly reflected in view, but called hidden.
    pub false_drop: u64,
}

/// How near a found point must be to count as that solution, in pixels: a little over half a
/// pixel's diagonal, so that the nearest pixel centre always counts.
pub const MATCH_RADIUS_PX: f64 = 0.75;

/// Judges a search.
///
/// `results` are in search order (mirrors outer, objects, vertices inner), `truth` likewise with
/// one entry per (object vertex, mirror) pair. A search that returns several solutions gives
/// several results in a row with the same object, vertex and mirror. `in_view(pair, q)` says
/// whether image point `q` of entry `pair` lies inside the image on a pixel of that mirror.
pub fn vertex_report(
    results: &[VertexResult],
    truth: &[TrueVertex],
    in_view: impl Fn(usize, DVec2) -> bool,
) -> Result<VertexReport, MetricsError> {
    let groups: Vec<&[VertexResult]> = results.chunk_by(same_pair).collect();
    if groups.len() != truth.len() {
        return Err(MetricsError::Length {
            results: groups.len(),
            truth: truth.len(),
        });
    }

    let [mut reflected, mut failed] = [0_u64; 2];
    let mut solutions = SolutionCount::default();
    let mut discard = Discard::default();
    let mut offsets = Vec::new();
    for (pair, (group, truth)) in groups.iter().zip(truth).enumerate() {
        let is_in_view = |q: &DVec2| in_view(pair, *q);
        let points = truth.points.iter().zip(&truth.focal);
        let in_view: Vec<(DVec2, Option<u8>)> = points
            .filter_map(|((_, q), focal)| Some(((*q)?, *focal)))
            .filter(|(q, _)| is_in_view(q))
            .collect();
        let states = || group.iter().map(|result| result.state);
        if truth.class == VertexClass::Hidden && states().any(|state| state == VertexState::Found) {
            discard.false_keep += 1;
        }
        // All projected solutions, not only those in view: the nearest one is what was found.
        let projected: Vec<DVec2> = truth.points.iter().filter_map(|(_, q)| *q).collect();
        let is_near = |q: DVec2, points: &[DVec2]| {
            nearest(q, points).is_some_and(|offset| offset <= MATCH_RADIUS_PX)
        };
        if truth.class != VertexClass::Unknown {
            let answers = group.iter().filter(|result| {
                result.state == VertexState::Found && !result.stand_in && result.at.is_finite()
            });
            let spurious = answers.filter(|result| !is_near(result.at.as_dvec2(), &projected));
            solutions.spurious += spurious.count() as u64;
        }
        if in_view.is_empty() {
            continue;
        }
        reflected += 1;
        if group.iter().all(has_failed) {
            failed += 1;
        } else if !states().any(|state| state == VertexState::Found) {
            discard.false_drop += 1;
        }

        let found = found(group);
        for (q, focal) in &in_view {
            solutions.add(is_near(*q, &found), *focal);
        }
        offsets.extend(found.iter().filter_map(|&q| nearest(q, &projected)));
    }

    let hidden = (truth.iter()).filter(|truth| truth.class == VertexClass::Hidden);
    Ok(VertexReport {
        reflected: Some(reflected),
        hidden: Some(hidden.count() as u64),
        failed: Some(failed),
        recall: (solutions.existing > 0)
            .then(|| solutions.found as f64 / solutions.existing as f64),
        solutions: Some(solutions),
        undecided: Some(truth.iter().map(|truth| truth.undecided).sum()),
        offset_share: offset_share(&offsets),
        offset_px: Summary::of(offsets),
        discard: Some(discard),
        ..VertexReport::without_truth(results)
    })
}

/// Found − true in pixels for every (object vertex, mirror) pair, to be followed over frames by
/// [`temporal`](crate::temporal()); `None` where no true point is in view or nothing was found. If there are
/// several solutions, the found point and the true point that are nearest to each other count.
///
/// Arguments as for [`vertex_report`].
pub fn vertex_errors(
    results: &[VertexResult],
    truth: &[TrueVertex],
    in_view: impl Fn(usize, DVec2) -> bool,
) -> Result<Vec<Option<DVec2>>, MetricsError> {
    let groups: Vec<&[VertexResult]> = results.chunk_by(same_pair).collect();
    if groups.len() != truth.len() {
        return Err(MetricsError::Length {
            results: groups.len(),
            truth: truth.len(),
        });
    }
    let pairs = groups.into_iter().zip(truth).enumerate();
    Ok(pairs
        .map(|(pair, (group, truth))| {
            let projected = || truth.points.iter().filter_map(|(_, q)| *q);
            if !projected().any(|q| in_view(pair, q)) {
                return None;
            }
            found(group)
                .into_iter()
                .flat_map(|found| projected().map(move |q| found - q))
                .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        })
        .collect())
}

/// The image points at which a search says that a vertex is reflected. If it says so of none of its answers,
/// those that it calls hidden or unreflected are taken instead.
fn found(group: &[VertexResult]) -> Vec<DVec2> {
    let is_found = |result: &VertexResult| result.state == VertexState::Found;
    let any_found = group.iter().any(is_found);
    let answers = group
        .iter()
        .filter(|result| is_found(result) || !any_found && result.state != VertexState::Failed);
    let places = answers.map(|result| result.at.as_dvec2());
    places.filter(|at| at.is_finite()).collect()
}

fn has_failed(result: &VertexResult) -> bool {
    result.state == VertexState::Failed || result.stand_in
}

fn is_non_finite(result: &VertexResult) -> bool {
    result.state != VertexState::Failed && !result.at.is_finite()
}

/// Solutions of one pair follow each other.
fn same_pair(a: &VertexResult, b: &VertexResult) -> bool {
    (a.object, a.vertex, a.mirror) == (b.object, b.vertex, b.mirror)
}

fn nearest(to: DVec2, points: &[DVec2]) -> Option<f64> {
    points
        .iter()
        .map(|point| point.distance(to))
        .min_by(f64::total_cmp)
}

/// `None` if no result carries the flag.
fn count_flags(flags: impl Iterator<Item = Option<bool>>) -> Option<u64> {
    flags.flatten().fold(None, |count, flag| {
        Some(count.unwrap_or(0) + u64::from(flag))
    })
}

fn offset_share(offsets: &[f64]) -> Option<OffsetShare> {
    let over = |limit: f64| {
        offsets.iter().filter(|&&offset| offset > limit).count() as f64 / offsets.len() as f64
    };
    (!offsets.is_empty()).then(|| OffsetShare {
        over_0_71: over(0.71),
        over_2: over(2.0),
        over_5: over(5.0),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec2};

    fn result(vertex: u32, state: VertexState, at: [f32; 2]) -> VertexResult {
        VertexResult {
            object: 1,
            vertex,
            mirror: 2,
            state,
            at: Vec2::from(at),
            steps: 3,
            evaluations: 13,
            node_tests: 0,
            hole: None,
            enlarged: None,
            stand_in: false,
        }
    }

    fn truth(class: VertexClass, points: &[[f64; 2]]) -> TrueVertex {
        let points: Vec<_> = points
            .iter()
            .map(|&q| (DVec3::ZERO, Some(DVec2::from(q))))
            .collect();
        TrueVertex {
            class,
            focal: vec![None; points.len()],
            points,
            undecided: 0,
        }
    }

    const REFLECTED: VertexClass = VertexClass::Reflected;

    fn report(results: &[VertexResult], truth: &[TrueVertex]) -> VertexReport {
        vertex_report(results, truth, |_, q| q.x >= 0.0 && q.x < 100.0).unwrap()
    }

    #[test]
    fn exact_answers_have_no_error() {
        let results = [0, 1].map(|v| result(v, VertexState::Found, [10.5, 20.5]));
        let truth = [0, 1].map(|_| truth(REFLECTED, &[[10.5, 20.5]]));
        let report = report(&results, &truth);
        assert_eq!(
            (report.searched, report.reflected, report.failed),
            (2, Some(2), Some(0))
        );
        assert_eq!(report.recall, Some(1.0));
        assert_eq!(report.offset_px.unwrap().max, 0.0);
        assert_eq!(report.discard, Some(Discard::default()));
        assert_eq!((report.hole, report.enlarged), (None, None));
    }

    #[test]
    fn every_kind_of_mistake_is_counted() {
        let results = [
            result(0, VertexState::Found, [13.5, 24.5]),
            result(1, VertexState::Failed, [0.0, 0.0]),
            result(2, VertexState::Hidden, [10.5, 20.5]),
            result(3, VertexState::Found, [50.0, 50.0]),
            result(4, VertexState::Found, [50.0, 50.0]),
        ];
        let truth = [
            truth(REFLECTED, &[[10.5, 20.5]]),
            truth(REFLECTED, &[[10.5, 20.5]]),
            truth(REFLECTED, &[[10.5, 20.5]]),
            truth(VertexClass::Hidden, &[]),
            truth(REFLECTED, &[[-5.0, 20.5]]),
        ];
        let report = report(&results, &truth);
        assert_eq!(
            (report.searched, report.reflected, report.hidden),
            (5, Some(3), Some(1))
        );
        assert_eq!(report.failed, Some(1));
        let discard = Discard {
            false_keep: 1,
            false_drop: 1,
        };
        assert_eq!(report.discard, Some(discard));
        assert_eq!(report.recall, Some(1.0 / 3.0));
        let offset = report.offset_px.unwrap();
        assert_eq!((offset.mean, offset.max), (2.5, 5.0));
        let share = report.offset_share.unwrap();
        assert_eq!(
            (share.over_0_71, share.over_2, share.over_5),
            (0.5, 0.5, 0.0)
        );
    }

    #[test]
    fn several_solutions_are_matched_one_by_one() {
        let truth = [truth(
            REFLECTED,
            &[[10.0, 10.0], [30.0, 10.0], [-20.0, 10.0]],
        )];
        let one = [result(0, VertexState::Found, [30.0, 10.5])];
        assert_eq!(report(&one, &truth).recall, Some(0.5));
        assert_eq!(report(&one, &truth).offset_px.unwrap().max, 0.5);
        let two = [one[0], result(0, VertexState::Found, [10.0, 10.0])];
        assert_eq!(report(&two, &truth).recall, Some(1.0));
        assert_eq!(report(&two, &truth).searched, 1);
    }

    #[test]
    fn a_stand_in_is_a_failure_with_an_offset() {
        let mut results = [0, 1].map(|v| result(v, VertexState::Found, [10.5, 20.5]));
        results[1] = VertexResult {
            stand_in: true,
            ..result(1, VertexState::Hidden, [13.5, 24.5])
        };
        let truth = [0, 1].map(|_| truth(REFLECTED, &[[10.5, 20.5]]));
        let report = report(&results, &truth);
        let dropped = report.discard.unwrap().false_drop;
        assert_eq!((report.failed, dropped), (Some(1), 0));
        assert_eq!(report.offset_px.unwrap().max, 5.0);
    }

    #[test]
    fn an_answer_that_is_no_number_is_counted_and_not_found() {
        let results = [result(0, VertexState::Found, [f32::NAN, 1.0])];
        let report = report(&results, &[truth(REFLECTED, &[[1.0, 1.0]])]);
        assert_eq!((report.non_finite, report.failed), (1, Some(0)));
        assert_eq!((report.recall, report.offset_px), (Some(0.0), None));
    }

    #[test]
    fn searches_are_counted_where_the_truth_is_not_known() {
        let results = [0, 1].map(|v| result(v, VertexState::Found, [1.0, 1.0]));
        let report = VertexReport::without_truth(&results);
        assert_eq!((report.searched, report.reflected), (2, None));
        assert_eq!((report.failed, report.discard), (None, None));
    }

    #[test]
    fn flags_are_counted_only_where_they_exist() {
        let mut results = [0, 1].map(|v| result(v, VertexState::Found, [1.0, 1.0]));
        results[0].hole = Some(false);
        results[1].hole = Some(true);
        let truth = [0, 1].map(|_| truth(REFLECTED, &[[1.0, 1.0]]));
        assert_eq!(
            (
                report(&results, &truth).hole,
                report(&results, &truth).enlarged
            ),
            (Some(1), None)
        );
    }

    #[test]
    fn nothing_searched_gives_no_numbers() {
        let report = report(&[], &[]);
        assert_eq!((report.recall, report.offset_px), (None, None));
        let truth = [truth(REFLECTED, &[[1.0, 1.0]])];
        assert!(matches!(
            vertex_report(&[], &truth, |_, _| true),
            Err(MetricsError::Length {
                results: 0,
                truth: 1
            })
        ));
    }
}

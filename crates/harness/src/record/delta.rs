//! Two runs side by side: which rows appeared, vanished, got better or worse, and which of their times
//! differ.
//!
//! Errors and work counters repeat exactly from run to run, so each of their changes is reported.
//! Times do not: a difference is reported only if its interval excludes zero.

use catoptric_metrics::Timing;
use serde_json::Value;

use super::against::{What, change};
use super::metric::Unit;
use super::metrics;
use super::path::{lookup, number};

/// What became of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct RowDelta {
    /// Index among the earlier rows.
    pub before: Option<usize>,
    /// Index among the rows now.
    pub now: Option<usize>,
    /// Something that is no number.
    pub remark: Option<String>,
    /// Metrics that moved, appeared or vanished; none of them a time.
    pub moved: Vec<What>,
}

impl RowDelta {
    /// Whether anything of the row is to be told.
    pub fn is_news(&self) -> bool {
        self.before.is_none()
            || self.now.is_none()
            || self.remark.is_some()
            || !self.moved.is_empty()
    }
}

/// A time of a frame that differs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeDelta {
    /// Index among the rows now.
    pub now: usize,
    /// Earlier median, milliseconds.
    pub before_ms: f64,
    /// Median now, milliseconds.
    pub now_ms: f64,
    /// Ends of the interval of the difference now − before, milliseconds; it excludes zero.
    pub interval_ms: [f64; 2],
    /// Wall time, where the adapter has no usable clock.
    pub wall: bool,
}

/// All that two runs differ in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Delta {
    /// In the order of the rows now, then those that vanished.
    pub rows: Vec<RowDelta>,
    /// In the order of the rows now.
    pub times: Vec<TimeDelta>,
    /// Whether a row is compared with one of another adapter, whose times are not.
    pub other_adapter: bool,
}

/// Compares two runs. A row belongs to the earlier one of its scene, technique and resolution, on the
/// same adapter where there is one.
pub fn delta(before: &[Value], now: &[Value]) -> Delta {
    let mut taken = vec![false; before.len()];
    let mut pairs: Vec<Option<usize>> = vec![None; now.len()];
    for same_adapter in [true, false] {
        for (row, pair) in now
            .iter()
            .zip(&mut pairs)
            .filter(|(_, pair)| pair.is_none())
        {
            let found = before.iter().enumerate().position(|(index, then)| {
                !taken[index]
                    && same_row(then, row)
                    && (!same_adapter || then["adapter"] == row["adapter"])
            });
            if let Some(index) = found {
                taken[index] = true;
                *pair = Some(index);
            }
        }
    }
    let mut delta = Delta::default();
    for (index, (row, pair)) in now.iter().zip(&pairs).enumerate() {
        let then = pair.map(|at| &before[at]);
        let (remark, moved) = then.map_or((None, Vec::new()), |then| differences(then, row));
        delta.rows.push(RowDelta {
            before: *pair,
            now: Some(index),
            remark,
            moved,
        });
        let Some(then) = then else { continue };
        if then["adapter"] != row["adapter"] {
            delta.other_adapter = true;
        } else if same_scene(then, row) {
            delta.times.extend(time_difference(index, then, row));
        }
    }
    let gone = taken.iter().enumerate().filter(|(_, taken)| !**taken);
    delta.rows.extend(gone.map(|(index, _)| RowDelta {
        before: Some(index),
        now: None,
        remark: None,
        moved: Vec::new(),
    }));
    delta
}

fn same_row(then: &Value, now: &Value) -> bool {
    let keys = ["scene", "technique", "resolution"];
    keys.iter().all(|key| then[*key] == now[*key])
}

fn same_scene(then: &Value, now: &Value) -> bool {
    lookup(then, "meta.scene_hash") == lookup(now, "meta.scene_hash")
}

/// What is to be said of a row, and its metrics that moved.
fn differences(then: &Value, now: &Value) -> (Option<String>, Vec<What>) {
    let status = |row: &Value| row["status"].as_str().unwrap_or("–").to_owned();
    if then["status"] != now["status"] {
        let reason = now["reason"].as_str().map(|reason| format!(" ({reason})"));
        let remark = format!(
            "was {}, is {}{}",
            status(then),
            status(now),
            reason.unwrap_or_default()
        );
        return (Some(remark), Vec::new());
    }
    if !same_scene(then, now) {
        let remark = "the scene is not what it was: not comparable";
        return (Some(remark.to_owned()), Vec::new());
    }
    let judged = metrics::all()
        .iter()
        .filter(|metric| metric.judged && metric.unit != Unit::Milliseconds);
    let moved = judged.filter_map(|metric| change(then, now, metric));
    (None, moved.collect())
}

/// A difference below this share of the earlier time is not reported.
const LEAST_SHARE: f64 = 0.05;

/// The difference of a row's times, where its interval excludes zero.
fn time_difference(index: usize, then: &Value, now: &Value) -> Option<TimeDelta> {
    let (before, after, wall) = match (gpu_time(then), gpu_time(now)) {
        (Some(before), Some(after)) => (before, after, false),
        _ => (wall_time(then)?, wall_time(now)?, true),
    };
    // Both medians at the ends of their own 95 % intervals: wider than 95 % for the difference.
    let spread = before.drift + after.drift;
    let interval = [
        after.low - before.high - spread,
        after.high - before.low + spread,
    ];
    let excludes_zero = interval[0] > 0.0 || interval[1] < 0.0;
    let worth = (after.median - before.median).abs() > LEAST_SHARE * before.median;
    (excludes_zero && worth).then_some(TimeDelta {
        now: index,
        before_ms: before.median,
        now_ms: after.median,
        interval_ms: interval,
        wall,
    })
}

/// A median with its 95 % interval, milliseconds.
struct Median {
    median: f64,
    low: f64,
    high: f64,
    /// Difference between the medians of the first and the second half of the samples. What disturbs
    /// longer than a frame, such as other work on the machine, does not show in the interval.
    drift: f64,
}

/// Of the GPU's clock.
fn gpu_time(row: &Value) -> Option<Median> {
    let at = |name: &str| number(row, &format!("time_ms.frame.{name}"));
    Some(Median {
        median: at("median")?,
        low: at("median_low")?,
        high: at("median_high")?,
        drift: drift(&samples(row, "raw.frame_ms")),
    })
}

/// Of the wall clock; only records in files have its samples.
fn wall_time(row: &Value) -> Option<Median> {
    let samples = samples(row, "raw.wall_ms");
    let timing = Timing::of(&samples)?;
    Some(Median {
        median: timing.median,
        low: timing.median_low?,
        high: timing.median_high?,
        drift: drift(&samples),
    })
}

fn samples(row: &Value, path: &str) -> Vec<f64> {
    let all = lookup(row, path).and_then(Value::as_array);
    let all = all.into_iter().flatten();
    all.filter_map(Value::as_f64).collect()
}

fn drift(samples: &[f64]) -> f64 {
    let (first, second) = samples.split_at(samples.len() / 2);
    let median = |samples: &[f64]| Timing::of(samples).map(|timing| timing.median);
    match (median(first), median(second)) {
        (Some(first), Some(second)) => (second - first).abs(),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::record::against::Verdict;

    fn row(technique: &str, agreement: f64, ms: f64) -> Value {
        json!({ "scene": "s", "technique": technique, "resolution": [4, 4], "status": "ok",
                "adapter": { "name": "a" }, "object_agreement": agreement,
                "time_ms": { "frame": { "median": ms, "median_low": ms - 0.1, "median_high": ms + 0.1 } },
                "meta": { "scene_hash": "h" } })
    }

    fn news(delta: &Delta) -> Vec<(Option<usize>, Option<usize>)> {
        let rows = delta.rows.iter().filter(|row| row.is_news());
        rows.map(|row| (row.before, row.now)).collect()
    }

    #[test]
    fn a_changed_option_is_named_and_nothing_else() {
        let before = [row("a", 0.9, 5.0), row("b(x=1)", 0.8, 6.0)];
        let now = [row("a", 0.9, 5.05), row("b(x=2)", 0.7, 6.0)];
        let delta = delta(&before, &now);
        assert_eq!(news(&delta), [(None, Some(1)), (Some(1), None)]);
        assert_eq!(delta.times, []);
    }

    #[test]
    fn better_and_worse_are_told_apart() {
        let delta = delta(
            &[row("a", 0.9, 5.0), row("b", 0.8, 5.0)],
            &[row("a", 0.8, 5.0), row("b", 0.9, 5.0)],
        );
        let verdict = |row: usize| match &delta.rows[row].moved[..] {
            [What::Moved { verdict, .. }] => *verdict,
            other => panic!("{other:?}"),
        };
        assert_eq!((verdict(0), verdict(1)), (Verdict::Worse, Verdict::Better));
    }

    #[test]
    fn a_time_differs_only_where_its_interval_excludes_zero() {
        let times = |ms: f64| delta(&[row("a", 0.9, 5.0)], &[row("a", 0.9, ms)]).times;
        assert_eq!(times(5.15), []);
        let slower = times(5.5);
        assert!(
            slower[0].interval_ms[0] > 0.0 && !slower[0].wall,
            "{slower:?}"
        );
        // A run that was slower in its second half than in its first says less.
        let mut drifting = row("a", 0.9, 5.5);
        drifting["raw"] = json!({ "frame_ms": [5.0, 5.0, 6.0, 6.0] });
        let compared = delta(&[row("a", 0.9, 5.0)], &[drifting]);
        assert_eq!(compared.times, []);
        // Without a clock of the GPU the wall clock's samples count.
        let walled = |ms: f64| {
            let mut row = row("a", 0.9, 5.0);
            row["time_ms"] = json!({ "frame": null });
            row["raw"] = json!({ "wall_ms": vec![ms; 8] });
            row
        };
        let compared = delta(&[walled(5.0)], &[walled(6.0)]);
        assert!(compared.times[0].wall);
    }

    #[test]
    fn rows_of_another_adapter_are_compared_but_for_their_times() {
        let mut other = row("a", 0.9, 50.0);
        other["adapter"] = json!({ "name": "b" });
        let compared = delta(&[row("a", 0.9, 5.0)], std::slice::from_ref(&other));
        assert!(compared.other_adapter && compared.times.is_empty());
        assert_eq!(news(&compared), []);
        // The same adapter's row goes first.
        let compared = delta(&[row("a", 0.5, 5.0), other.clone()], &[other]);
        assert_eq!(news(&compared), [(Some(0), None)]);
    }
}

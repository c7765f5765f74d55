//! What got better or worse since an earlier record.

use serde_json::Value;

use super::metric::{Better, Metric, Unit};
use super::metrics;
use super::path::{lookup, number};

/// Adapters round differently by about this share; less than that is no change.
const ROUNDING: f64 = 1e-3;
/// Times differ by this share between two runs of the same program.
const TIME_NOISE: f64 = 0.05;
/// Median absolute deviations in one standard deviation of normal noise.
const SIGMA_PER_MAD: f64 = 1.4826;

/// Something to say about a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The row's scene.
    pub scene: String,
    /// The row's technique.
    pub technique: String,
    /// What is to be said.
    pub what: What,
}

/// What became of a row, or of one of its metrics.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// No earlier row has its scene, technique and resolution.
    New,
    /// It has another status.
    Status {
        /// The earlier one.
        before: String,
        /// The one it has now.
        now: String,
    },
    /// The scene's file says something else: nothing can be compared.
    OtherScene,
    /// No metric moved by more than noise.
    Unchanged,
    /// A metric moved.
    Moved {
        /// Where it stands in the record.
        metric: &'static str,
        /// The earlier value.
        before: Option<f64>,
        /// The value now.
        now: Option<f64>,
        /// What that is.
        verdict: Verdict,
    },
    /// Another adapter rendered: times are not compared.
    OtherAdapter,
}

/// How a metric moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It was `null`.
    Appeared,
    /// It is `null`.
    Vanished,
    /// It is nearer to what one wants.
    Better,
    /// It is further from it.
    Worse,
}

/// What changed, a metric each, and why where a row has no change or cannot be compared.
pub fn changes(before: &[Value], after: &[Value]) -> Vec<Change> {
    let mut found = Vec::new();
    for now in after {
        let mut say = |what| {
            found.push(Change {
                scene: text(now, "scene"),
                technique: text(now, "technique"),
                what,
            });
        };
        let same = |then: &&Value| {
            ["scene", "technique", "resolution"]
                .iter()
                .all(|key| then[*key] == now[*key])
        };
        let Some(then) = before.iter().find(same) else {
            say(What::New);
            continue;
        };
        let same_status = then["status"] == now["status"];
        if !same_status {
            say(What::Status {
                before: text(then, "status"),
                now: text(now, "status"),
            });
        }
        if lookup(then, "meta.scene_hash") != lookup(now, "meta.scene_hash") {
            say(What::OtherScene);
            continue;
        }
        let judged = metrics::all().iter().filter(|metric| metric.judged);
        let moved: Vec<What> = judged
            .filter_map(|metric| change(then, now, metric))
            .collect();
        if moved.is_empty() && same_status {
            say(What::Unchanged);
        }
        moved.into_iter().for_each(&mut say);
        if then["adapter"] != now["adapter"] {
            say(What::OtherAdapter);
        }
    }
    found
}

fn text(row: &Value, key: &str) -> String {
    row[key].as_str().unwrap_or("–").to_owned()
}

/// How a metric moved; `None` within noise or where neither row has it.
pub(super) fn change(then: &Value, now: &Value, metric: &'static Metric) -> Option<What> {
    let value = |row: &Value| number(row, &metric.path);
    let (before, after) = (value(then), value(now));
    let timed = metric.unit == Unit::Milliseconds;
    if timed && then["adapter"] != now["adapter"] {
        return None;
    }
    let verdict = match (before, after) {
        (None, None) => return None,
        (None, Some(_)) => Verdict::Appeared,
        (Some(_), None) => Verdict::Vanished,
        (Some(a), Some(b)) if a == b => return None,
        (Some(a), Some(b)) => {
            let mad = |row: &Value| {
                lookup(row, "time_ms.frame.mad")
                    .and_then(Value::as_f64)
                    .unwrap_or(0.0)
            };
            let noise = if !a.is_finite() {
                0.0
            } else if timed {
                (3.0 * SIGMA_PER_MAD * mad(then).hypot(mad(now))).max(TIME_NOISE * a.abs())
            } else {
                ROUNDING * a.abs()
            };
            if (b - a).abs() <= noise {
                return None;
            }
            match (b < a) == (metric.better == Better::Low) {
                true => Verdict::Better,
                false => Verdict::Worse,
            }
        }
    };
    Some(What::Moved {
        metric: &metric.path,
        before,
        now: after,
        verdict,
    })
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn row(agreement: f64, ms: f64) -> Value {
        json!({ "scene": "s", "technique": "t", "resolution": [4, 4], "status": "ok", "adapter": null,
                "object_agreement": agreement, "time_ms": { "frame": { "median": ms, "mad": 0.1 } },
                "meta": { "scene_hash": "h" } })
    }

    fn moved(before: &Value, after: &Value) -> Vec<(&'static str, Verdict)> {
        let found = changes(std::slice::from_ref(before), std::slice::from_ref(after));
        let moved = |change: Change| match change.what {
            What::Moved {
                metric, verdict, ..
            } => Some((metric, verdict)),
            _ => None,
        };
        found.into_iter().filter_map(moved).collect()
    }

    fn first(before: &Value, after: &Value) -> What {
        let found = changes(std::slice::from_ref(before), std::slice::from_ref(after));
        found[0].what.clone()
    }

    #[test]
    fn noise_is_no_change() {
        assert_eq!(first(&row(0.9, 10.0), &row(0.9002, 10.4)), What::Unchanged);
    }

    #[test]
    fn better_and_worse_know_their_direction() {
        let found = moved(&row(0.9, 10.0), &row(0.8, 5.0));
        assert_eq!(
            found,
            [
                ("object_agreement", Verdict::Worse),
                ("time_ms.frame.median", Verdict::Better)
            ]
        );
    }

    #[test]
    fn a_picture_that_becomes_equal_is_better() {
        let row = |color: Value| {
            let mut row = row(1.0, 10.0);
            row["color"] = color;
            row
        };
        let near = row(json!({ "psnr": 30.0, "equal": false }));
        let equal = row(json!({ "psnr": null, "equal": true }));
        assert_eq!(moved(&near, &equal), [("color.psnr", Verdict::Better)]);
        assert_eq!(moved(&equal, &near), [("color.psnr", Verdict::Worse)]);
        assert_eq!(moved(&equal, &equal), []);
    }

    #[test]
    fn a_vanished_metric_and_a_new_row_are_said() {
        let mut without = row(0.9, 10.0);
        without["object_agreement"] = Value::Null;
        assert_eq!(
            moved(&row(0.9, 10.0), &without),
            [("object_agreement", Verdict::Vanished)]
        );
        let mut other = row(0.9, 10.0);
        other["resolution"] = json!([8, 8]);
        assert_eq!(first(&row(0.9, 10.0), &other), What::New);
    }
}

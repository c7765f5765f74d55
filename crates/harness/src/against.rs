//! What got better or worse since an earlier record.

use serde_json::Value;

use crate::gate::lookup;
use crate::print::significant;
use crate::table::Table;

/// Which way a metric is good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Good {
    Low,
    High,
}

/// Metrics that can get better or worse. What is not listed (sizes, counts of what was there to
/// do, times that were taken once) is judged by nobody.
const JUDGED: [(&str, Good); 27] = [
    ("object_agreement", Good::High),
    ("coverage.missing", Good::Low),
    ("coverage.extra", Good::Low),
    ("coverage.unresolved", Good::Low),
    ("coverage.cracks", Good::Low),
    ("coverage.t_junctions", Good::Low),
    ("angular_error_deg.mean", Good::Low),
    ("angular_error_deg.p50", Good::Low),
    ("angular_error_deg.p95", Good::Low),
    ("angular_error_deg.p99", Good::Low),
    ("angular_error_deg.max", Good::Low),
    ("edge_offset_px.p50", Good::Low),
    ("color.mae", Good::Low),
    ("color.rmse", Good::Low),
    ("color.psnr", Good::High),
    ("color.ssim", Good::High),
    ("color.flip", Good::Low),
    ("vertices.failed", Good::Low),
    ("vertices.recall", Good::High),
    ("vertices.offset_px.mean", Good::Low),
    ("vertices.offset_px.p99", Good::Low),
    ("work.evaluations", Good::Low),
    ("work.node_tests", Good::Low),
    ("work.samples", Good::Low),
    ("temporal.jitter_px.mean", Good::Low),
    ("temporal.jumps", Good::Low),
    ("time_ms.frame.median", Good::Low),
];

/// Adapters round differently by about this share; less than that is no change.
const ROUNDING: f64 = 1e-3;
/// Times differ by this share between two runs of the same program.
const TIME_NOISE: f64 = 0.05;
/// Median absolute deviations in one standard deviation of normal noise.
const SIGMA_PER_MAD: f64 = 1.4826;

/// A table of what changed, one line a metric, and one line for every row that has no change or
/// cannot be compared.
pub fn changes(before: &[Value], after: &[Value]) -> Table {
    let mut table = Table::new([
        "scene",
        "technique",
        "metric",
        "before",
        "now",
        "change",
        "verdict",
    ]);
    for now in after {
        let name = [text(now, "scene"), text(now, "technique")];
        let mut say = |metric: &str, cells: [String; 3], verdict: &str| {
            let line = name
                .iter()
                .cloned()
                .chain([metric.to_owned()])
                .chain(cells)
                .chain([verdict.to_owned()]);
            table.row(line);
        };
        let none = || ["–", "–", "–"].map(str::to_owned);
        let same = |then: &&Value| {
            ["scene", "technique", "resolution"]
                .iter()
                .all(|key| then[*key] == now[*key])
        };
        let Some(then) = before.iter().find(same) else {
            say(
                "–",
                none(),
                "new: no earlier row with this scene, technique and resolution",
            );
            continue;
        };
        if then["status"] != now["status"] {
            say(
                "status",
                [text(then, "status"), text(now, "status"), "–".to_owned()],
                "changed",
            );
        }
        if lookup(then, "meta.scene_hash") != lookup(now, "meta.scene_hash") {
            say("–", none(), "the scene is not what it was: not comparable");
            continue;
        }
        let found: Vec<_> = JUDGED
            .iter()
            .filter_map(|(path, good)| change(then, now, path, *good))
            .collect();
        if found.is_empty() && then["status"] == now["status"] {
            say("–", none(), "unchanged within noise");
        }
        for (path, cells, verdict) in found {
            say(path, cells, verdict);
        }
        if then["adapter"] != now["adapter"] {
            say("time_ms", none(), "another adapter: times are not compared");
        }
    }
    table
}

fn text(row: &Value, key: &str) -> String {
    row[key].as_str().unwrap_or("–").to_owned()
}

type Change<'p> = (&'p str, [String; 3], &'static str);

/// How a metric moved; `None` within noise or where neither row has it.
fn change<'p>(then: &Value, now: &Value, path: &'p str, good: Good) -> Option<Change<'p>> {
    let value = |row: &Value| lookup(row, path).and_then(Value::as_f64);
    let show = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), significant);
    let (old, new) = (value(then), value(now));
    let timed = path.starts_with("time_ms");
    if timed && then["adapter"] != now["adapter"] {
        return None;
    }
    let (Some(a), Some(b)) = (old, new) else {
        let verdict = if new.is_some() {
            "appeared"
        } else {
            "vanished"
        };
        return (old.is_some() || new.is_some())
            .then(|| (path, [show(old), show(new), "–".to_owned()], verdict));
    };
    let mad = |row: &Value| {
        lookup(row, "time_ms.frame.mad")
            .and_then(Value::as_f64)
            .unwrap_or(0.0)
    };
    let noise = if timed {
        (3.0 * SIGMA_PER_MAD * mad(then).hypot(mad(now))).max(TIME_NOISE * a.abs())
    } else {
        ROUNDING * a.abs()
    };
    if (b - a).abs() <= noise {
        return None;
    }
    let share = if a == 0.0 {
        "–".to_owned()
    } else {
        format!("{:+.1}%", 100.0 * (b / a - 1.0))
    };
    let verdict = if (b < a) == (good == Good::Low) {
        "better"
    } else {
        "worse"
    };
    Some((path, [show(old), show(new), share], verdict))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::schema;

    fn row(agreement: f64, ms: f64) -> Value {
        json!({ "scene": "s", "technique": "t", "resolution": [4, 4], "status": "ok", "adapter": null,
                "object_agreement": agreement, "time_ms": { "frame": { "median": ms, "mad": 0.1 } },
                "meta": { "scene_hash": "h" } })
    }

    fn verdicts(before: &Value, after: &Value) -> Vec<String> {
        let table = changes(std::slice::from_ref(before), std::slice::from_ref(after));
        table
            .rows
            .into_iter()
            .map(|row| format!("{} {}", row[2], row[6]))
            .collect()
    }

    #[test]
    fn noise_is_no_change() {
        assert_eq!(
            verdicts(&row(0.9, 10.0), &row(0.9002, 10.4)),
            ["– unchanged within noise"]
        );
    }

    #[test]
    fn better_and_worse_know_their_direction() {
        let found = verdicts(&row(0.9, 10.0), &row(0.8, 5.0));
        assert_eq!(
            found,
            ["object_agreement worse", "time_ms.frame.median better"]
        );
    }

    #[test]
    fn a_vanished_metric_and_a_new_row_are_said() {
        let mut without = row(0.9, 10.0);
        without["object_agreement"] = Value::Null;
        assert_eq!(
            verdicts(&row(0.9, 10.0), &without),
            ["object_agreement vanished"]
        );
        let mut other = row(0.9, 10.0);
        other["resolution"] = json!([8, 8]);
        assert!(verdicts(&row(0.9, 10.0), &other)[0].contains("new"));
    }

    #[test]
    fn judged_metrics_exist() {
        let known = schema::metrics();
        for (path, _) in JUDGED {
            assert!(known.iter().any(|metric| metric == path), "{path}");
        }
    }
}

//! What got better or worse, as a table.

use crate::record::against::{Change, Verdict, What};

use super::number::significant;
use super::table::Table;

/// A line a change.
pub fn table(changes: &[Change]) -> Table {
    let mut table = Table::new([
        "scene",
        "technique",
        "metric",
        "before",
        "now",
        "change",
        "verdict",
    ]);
    for change in changes {
        let [metric, before, now, share, verdict] = cells(&change.what);
        let (scene, technique) = (change.scene.clone(), change.technique.clone());
        table.row([scene, technique, metric, before, now, share, verdict]);
    }
    table
}

const NONE: &str = "–";

/// Metric, before, now, change and verdict.
pub(super) fn cells(what: &What) -> [String; 5] {
    let plain = |cells: [&str; 5]| cells.map(str::to_owned);
    let remark = |metric, verdict| plain([metric, NONE, NONE, NONE, verdict]);
    match what {
        What::New => remark(
            NONE,
            "new: no earlier row with this scene, technique and resolution",
        ),
        What::OtherScene => remark(NONE, "the scene is not what it was: not comparable"),
        What::Unchanged => remark(NONE, "unchanged within noise"),
        What::OtherAdapter => remark("time_ms", "another adapter: times are not compared"),
        What::Status { before, now } => plain(["status", before, now, NONE, "changed"]),
        What::Moved {
            metric,
            before,
            now,
            verdict,
        } => {
            let show = |value: Option<f64>| value.map_or_else(|| NONE.to_owned(), significant);
            let share = match (before, now) {
                (Some(a), Some(b)) if *a != 0.0 => format!("{:+.1}%", 100.0 * (b / a - 1.0)),
                _ => NONE.to_owned(),
            };
            let verdict = match verdict {
                Verdict::Appeared => "appeared",
                Verdict::Vanished => "vanished",
                Verdict::Better => "better",
                Verdict::Worse => "worse",
            };
            let metric = (*metric).to_owned();
            [metric, show(*before), show(*now), share, verdict.to_owned()]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_how_a_metric_moved() {
        let moved = |before, now, verdict| Change {
            scene: "s".to_owned(),
            technique: "t".to_owned(),
            what: What::Moved {
                metric: "object_agreement",
                before,
                now,
                verdict,
            },
        };
        let table = table(&[
            moved(Some(0.5), Some(0.6), Verdict::Better),
            moved(Some(0.5), None, Verdict::Vanished),
        ]);
        assert_eq!(
            table.rows[0][2..],
            ["object_agreement", "0.5000", "0.6000", "+20.0%", "better"]
        );
        assert_eq!(table.rows[1][4..], ["–", "–", "vanished"]);
    }
}

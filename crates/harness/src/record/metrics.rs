//! The numbers of a record by their paths: the rows of `table.rs`, looked up.

use std::sync::LazyLock;

use super::metric::Metric;
use super::table::{ENTRIES, Entry};

static METRICS: LazyLock<Vec<Metric>> =
    LazyLock::new(|| ENTRIES.iter().flat_map(Entry::metrics).collect());

/// Every number of the record.
pub fn all() -> &'static [Metric] {
    &METRICS
}

/// The metric at a path. A path may name what `*` stands for: `time_ms.passes.search`.
pub fn at(path: &str) -> Option<&'static Metric> {
    all().iter().find(|metric| matches(&metric.path, path))
}

/// The metric at a path that the program itself names.
///
/// # Panics
/// Where there is none: a bug.
pub fn known(path: &str) -> &'static Metric {
    at(path).unwrap_or_else(|| panic!("no metric {path}"))
}

fn matches(pattern: &str, path: &str) -> bool {
    pattern == path
        || pattern.strip_suffix('*').is_some_and(|start| {
            path.strip_prefix(start)
                .is_some_and(|rest| !rest.is_empty())
        })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::super::metric::Better;
    use super::super::schema;
    use super::*;

    #[test]
    fn every_number_of_the_record_has_a_row_and_every_row_a_number() {
        let rows: Vec<&str> = all().iter().map(|metric| metric.path.as_str()).collect();
        let unique: BTreeSet<&str> = rows.iter().copied().collect();
        assert_eq!(unique.len(), rows.len(), "a path has two rows");
        let fields = schema::numbers(&schema::records());
        let fields: BTreeSet<&str> = fields.iter().map(String::as_str).collect();
        let without: Vec<_> = fields.difference(&unique).collect();
        assert!(without.is_empty(), "fields without a row: {without:?}");
        let gone: Vec<_> = unique.difference(&fields).collect();
        assert!(gone.is_empty(), "rows without a field: {gone:?}");
    }

    #[test]
    fn a_member_of_a_family_is_described_by_both() {
        let median = known("angular_error_deg.p50");
        assert_eq!(median.column(), "angle p50 °");
        assert_eq!(median.label(), "median angular error (°)");
        assert!(median.what.starts_with("Median of the angle"), "{median:?}");
        assert_eq!((median.better, median.judged), (Better::Low, true));
        assert!(!known("edge_offset_px.p99").judged && known("edge_offset_px.p50").judged);
        assert_eq!(known("regions.rim.color.flip").column(), "rim FLIP");
    }

    #[test]
    fn what_is_judged_has_a_direction() {
        for metric in all() {
            assert!(
                !metric.what.is_empty() && metric.what.ends_with('.'),
                "{metric:?}"
            );
            assert!(
                !metric.judged || metric.better != Better::Neither,
                "{metric:?}"
            );
        }
    }

    #[test]
    fn passes_have_any_name() {
        assert_eq!(known("time_ms.passes.search").path, "time_ms.passes.*");
        assert_eq!(at("time_ms.passes."), None);
        assert_eq!(at("scene"), None);
    }
}

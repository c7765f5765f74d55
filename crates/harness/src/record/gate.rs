//! Gates: `--require METRIC<=X`, checked on every measured row.

use std::fmt;

use catoptric_scene::suggest;
use serde_json::Value;

use crate::exit::bad_input;

use super::metrics;
use super::path::number;

/// A bound on one metric.
#[derive(Clone, Debug, PartialEq)]
pub struct Gate {
    path: String,
    at_most: bool,
    bound: f64,
}

impl fmt::Display for Gate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.at_most { "<=" } else { ">=" };
        write!(f, "{}{sign}{}", self.path, self.bound)
    }
}

impl Gate {
    /// Parses `angular_error_deg.p99<=0.05` or `object_agreement>=0.97`.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let found = ["<=", ">="]
            .iter()
            .find_map(|sign| Some((text.split_once(sign)?, *sign == "<=")));
        let Some(((path, bound), at_most)) = found else {
            return Err(bad_input(format!(
                "--require {text}: expected METRIC<=X or METRIC>=X"
            )));
        };
        let (path, bound) = (path.trim(), bound.trim());
        if metrics::at(path).is_none() {
            let hint = hint(path);
            return Err(bad_input(format!(
                "--require {text}: no metric `{path}`{hint}"
            )));
        }
        match bound.parse::<f64>() {
            Ok(bound) if !bound.is_nan() => Ok(Self {
                path: path.to_owned(),
                at_most,
                bound,
            }),
            _ => Err(bad_input(format!(
                "--require {text}: `{bound}` is not a number"
            ))),
        }
    }

    /// What trips the gate in a row, or `None` where the row is within the bound.
    pub fn trips(&self, row: &Value) -> Option<String> {
        let sign = if self.at_most { "<=" } else { ">=" };
        let (path, bound) = (&self.path, self.bound);
        match number(row, path) {
            None => Some(format!(
                "{path} {sign} {bound}: the metric is null here, so nothing is shown to hold"
            )),
            Some(value) => {
                let holds = if self.at_most {
                    value <= bound
                } else {
                    value >= bound
                };
                (!holds).then(|| format!("{path} {sign} {bound}: it is {value}"))
            }
        }
    }
}

/// The metric that is likely meant: one that ends in the path given, else a similar one; else
/// where all metrics are named.
fn hint(path: &str) -> String {
    let known = || metrics::all().iter().map(|metric| metric.path.as_str());
    let end = format!(".{path}");
    let nearest = match known().find(|name| name.ends_with(&end)) {
        Some(name) if !path.is_empty() => format!(" (did you mean `{name}`?)"),
        _ => suggest(path, known()),
    };
    if nearest.is_empty() {
        return "; the heading of `compare --format csv` names them all".to_owned();
    }
    nearest
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_gate_trips_above_and_on_null() {
        let gate = Gate::parse("angular_error_deg.p99 <= 0.05").unwrap();
        assert_eq!(
            gate.trips(&json!({ "angular_error_deg": { "p99": 0.05 } })),
            None
        );
        let above = gate
            .trips(&json!({ "angular_error_deg": { "p99": 0.06 } }))
            .unwrap();
        assert!(above.contains("it is 0.06"), "{above}");
        assert!(
            gate.trips(&json!({ "angular_error_deg": null }))
                .unwrap()
                .contains("null")
        );
    }

    #[test]
    fn a_lower_bound_trips_below() {
        let gate = Gate::parse("object_agreement>=0.97").unwrap();
        assert_eq!(gate.trips(&json!({ "object_agreement": 0.98 })), None);
        assert!(gate.trips(&json!({ "object_agreement": 0.9 })).is_some());
    }

    #[test]
    fn equal_pictures_are_the_best_there_is() {
        let gate = Gate::parse("color.psnr>=60").unwrap();
        let row = |equal: bool| json!({ "color": { "psnr": null, "equal": equal } });
        assert_eq!(gate.trips(&row(true)), None);
        assert!(gate.trips(&row(false)).is_some());
        let wrong_way = Gate::parse("color.psnr<=60").unwrap();
        assert!(wrong_way.trips(&row(true)).is_some());
    }

    #[test]
    fn passes_have_any_name() {
        let gate = Gate::parse("time_ms.passes.search<=5").unwrap();
        assert!(
            gate.trips(&json!({ "time_ms": { "passes": { "search": 6.0 } } }))
                .is_some()
        );
    }

    #[test]
    fn bad_gates_are_refused() {
        for text in [
            "angular<=1",
            "scene<=1",
            "object_agreement",
            "object_agreement<=x",
            "time_ms.passes.<=1",
            "<=1",
        ] {
            let error = Gate::parse(text).unwrap_err();
            assert!(error.to_string().contains(text), "{error}");
        }
        let message = |text: &str| Gate::parse(text).unwrap_err().to_string();
        assert!(message("angular_error_deg.p9<=1").contains("`angular_error_deg.p99`?"));
        assert!(message("offset_px.mean<=1").contains("`vertices.offset_px.mean`?"));
        let nonsense = message("foo<=1");
        assert!(!nonsense.contains("did you mean"), "{nonsense}");
        assert!(nonsense.contains("--format csv"), "{nonsense}");
    }
}

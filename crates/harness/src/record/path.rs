//! Dotted paths into a record, such as `time_ms.frame.median`.

use serde_json::Value;

/// The value at a dotted path.
pub fn lookup<'v>(row: &'v Value, path: &str) -> Option<&'v Value> {
    path.split('.').try_fold(row, |value, name| value.get(name))
}

/// The number at a path. The signal-to-noise ratio of equal pictures, which is null in the record
/// with `equal` beside it, is read as infinity.
pub fn number(row: &Value, path: &str) -> Option<f64> {
    let value = lookup(row, path)?;
    let beside = path
        .rsplit_once('.')
        .map(|(place, _)| format!("{place}.equal"));
    let is_equal = || beside.and_then(|beside| lookup(row, &beside)?.as_bool());
    match value.is_null() && is_equal() == Some(true) {
        true => Some(f64::INFINITY),
        false => value.as_f64(),
    }
}

/// Dotted path and value of everything in an object that is not itself an object.
pub fn leaves(value: &Value) -> Vec<(String, Value)> {
    let Some(object) = value.as_object() else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (name, member) in object {
        if member.is_object() {
            found.extend(
                leaves(member)
                    .into_iter()
                    .map(|(path, leaf)| (format!("{name}.{path}"), leaf)),
            );
        } else {
            found.push((name.clone(), member.clone()));
        }
    }
    found
}

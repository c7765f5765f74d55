//! Dotted paths into a record, such as `time_ms.frame.median`.

use serde_json::Value;

/// The value at a dotted path.
pub fn lookup<'v>(row: &'v Value, path: &str) -> Option<&'v Value> {
    path.split('.').try_fold(row, |value, name| value.get(name))
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

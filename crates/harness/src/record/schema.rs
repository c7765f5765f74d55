//! The record's JSON schema: checking values against it, and the metrics it knows.
//!
//! Covers the part of JSON Schema that `schema/record.schema.json` uses: `type`, `properties`,
//! `required`, `additionalProperties`, `items`, `enum`, `minimum`, and `$ref` to `$defs`.

use serde_json::Value;

/// The schema of an array of records.
pub const RECORDS: &str = include_str!("../../schema/record.schema.json");

/// The parsed schema.
///
/// # Panics
/// If the schema in the repository is not JSON: a bug.
pub fn records() -> Value {
    serde_json::from_str(RECORDS).expect("schema/record.schema.json is JSON")
}

/// Everything in which `value` breaks `schema`, each as `path: what`.
pub fn violations(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, schema, value, "", &mut found);
    found
}

/// The schema itself, or the one that its `$ref` names.
fn resolve<'s>(root: &'s Value, schema: &'s Value) -> &'s Value {
    let target = schema["$ref"]
        .as_str()
        .and_then(|name| root.pointer(name.trim_start_matches('#')));
    target.unwrap_or(schema)
}

fn check(root: &Value, schema: &Value, value: &Value, path: &str, found: &mut Vec<String>) {
    let schema = resolve(root, schema);
    let at = if path.is_empty() { "the whole" } else { path };
    let types: Vec<&str> = match &schema["type"] {
        Value::String(name) => vec![name.as_str()],
        Value::Array(names) => names.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    if !types.is_empty() && !types.iter().any(|name| is(value, name)) {
        let value = brief(value);
        found.push(format!(
            "{at}: {value} is not of type {}",
            types.join(" or ")
        ));
        return;
    }
    if let Some(allowed) = schema["enum"].as_array()
        && !allowed.contains(value)
    {
        let value = brief(value);
        found.push(format!("{at}: {value} is not one of {}", schema["enum"]));
    }
    if let (Some(minimum), Some(number)) = (schema["minimum"].as_f64(), value.as_f64())
        && number < minimum
    {
        found.push(format!("{at}: {number} is below {minimum}"));
    }
    if let Some(items) = value.as_array() {
        for (index, item) in items.iter().enumerate() {
            check(
                root,
                &schema["items"],
                item,
                &format!("{path}[{index}]"),
                found,
            );
        }
    }
    if let Some(object) = value.as_object() {
        for name in schema["required"]
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_str)
        {
            if !object.contains_key(name) {
                found.push(format!("{at}: `{name}` is missing"));
            }
        }
        for (name, member) in object {
            let inner = if path.is_empty() {
                name.clone()
            } else {
                format!("{path}.{name}")
            };
            match (
                schema["properties"].get(name),
                &schema["additionalProperties"],
            ) {
                (Some(property), _) => check(root, property, member, &inner, found),
                (None, Value::Bool(false)) => found.push(format!("{inner}: unknown field")),
                (None, additional) => check(root, additional, member, &inner, found),
            }
        }
    }
}

/// A value for messages: itself where it is short, else what it is.
pub fn brief(value: &Value) -> String {
    const LONGEST: usize = 40;
    match value {
        Value::Object(_) => "an object".to_owned(),
        Value::Array(_) => "an array".to_owned(),
        Value::String(text) if text.chars().count() > LONGEST => "a long text".to_owned(),
        value => value.to_string(),
    }
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        _ => false,
    }
}

/// Dotted paths of all numbers in a record, in the schema's order; the passes, whose names the
/// schema does not know, are `time_ms.passes.*`.
pub fn metrics() -> Vec<String> {
    let mut paths = Vec::new();
    let root = records();
    numbers(&root, &root["items"], "", &mut paths);
    paths.retain(|path| path != "schema_version" && !path.starts_with("meta."));
    paths
}

fn numbers(root: &Value, schema: &Value, path: &str, paths: &mut Vec<String>) {
    let schema = resolve(root, schema);
    let allows = |name: &str| {
        schema["type"] == name
            || schema["type"]
                .as_array()
                .is_some_and(|types| types.contains(&name.into()))
    };
    if allows("number") || allows("integer") {
        paths.push(path.to_owned());
    }
    let dot = if path.is_empty() { "" } else { "." };
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        numbers(root, property, &format!("{path}{dot}{name}"), paths);
    }
    if schema["additionalProperties"].is_object() {
        numbers(
            root,
            &schema["additionalProperties"],
            &format!("{path}{dot}*"),
            paths,
        );
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn violations_are_found() {
        let schema = json!({ "type": "object", "required": ["a"], "additionalProperties": false,
            "properties": { "a": { "type": ["integer", "null"], "minimum": 0 },
                            "b": { "type": "array", "items": { "enum": ["x"] } } } });
        assert_eq!(
            violations(&schema, &json!({ "a": null, "b": ["x"] })),
            Vec::<String>::new()
        );
        let broken = [
            json!([]),
            json!({}),
            json!({ "a": -1 }),
            json!({ "a": 0.5 }),
            json!({ "a": 0, "b": ["y"] }),
            json!({ "a": 0, "c": 1 }),
        ];
        for value in broken {
            assert_eq!(violations(&schema, &value).len(), 1, "{value}");
        }
    }

    #[test]
    fn metrics_are_listed_by_path() {
        let metrics = metrics();
        for path in [
            "object_agreement",
            "angular_error_deg.p99",
            "vertices.offset_px.mean",
            "time_ms.passes.*",
        ] {
            assert!(metrics.iter().any(|known| known == path), "{path}");
        }
        assert!(
            !metrics
                .iter()
                .any(|known| known == "scene" || known == "reason")
        );
    }
}

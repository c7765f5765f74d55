//! The record's JSON schema: derived from the record's types, each number described by its row in
//! the table of metrics, and what breaks it.

use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use crate::input::brief;

use super::metrics;
use super::row::Record;

/// Fields that this version of the record has not had from the start, wherever they stand: earlier
/// ones lack them. So do the members of [`GROWING`].
const LATER: [&str; 22] = [
    "resolved_by",
    "equal",
    "left_out",
    "more",
    "total",
    "object_agreement_min",
    "added_ms",
    "solutions",
    "by_k",
    "undecided",
    "exact_points",
    "cluster_tests",
    "pairs",
    "longest_list",
    "part",
    "bytes",
    "motion",
    "own",
    "moved_node_tests",
    "crack_pixels_max",
    "t_junctions_max",
    "triangles_changed",
];
/// The field whose members are more from version to version.
const GROWING: &str = "more";

/// The schema of an array of records.
pub fn records() -> Value {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let settings = settings.with(|settings| settings.inline_subschemas = true);
    let schema = settings
        .into_generator()
        .into_root_schema_for::<Vec<Record>>();
    let mut schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "catoptric records",
        "description": "One object a (scene, technique), scenes outer, in command-line order. \
                        Null: does not apply or was not measured.",
        "type": "array",
        "items": Value::from(schema)["items"],
    });
    let is_later = |name: &Value| LATER.iter().any(|later| name == later);
    each_object(&mut schema["items"], &mut |object| {
        if let Some(required) = object.get_mut("required").and_then(Value::as_array_mut) {
            required.retain(|name| !is_later(name));
        }
    });
    if let Some(growing) = schema["items"]["properties"][GROWING].as_object_mut() {
        growing.remove("required");
    }
    each_number(&mut schema["items"], "", &mut |path, number| {
        if let Some(metric) = metrics::at(path) {
            number["description"] = metric.what.clone().into();
        }
    });
    schema
}

/// Dotted paths of all numbers in an array of records but those that say where they come from; the
/// passes, whose names the schema does not know, are `time_ms.passes.*`.
pub fn numbers(records: &Value) -> Vec<String> {
    let mut paths = Vec::new();
    each_number(&mut records["items"].clone(), "", &mut |path, _| {
        if path != "schema_version" && !path.starts_with("meta.") {
            paths.push(path.to_owned());
        }
    });
    paths
}

/// Calls `then` with the schema of every object.
fn each_object(schema: &mut Value, then: &mut impl FnMut(&mut Value)) {
    then(schema);
    let properties = schema.get_mut("properties").and_then(Value::as_object_mut);
    for property in properties.into_iter().flat_map(|all| all.values_mut()) {
        each_object(property, then);
    }
}

/// Calls `then` with the path and the schema of every number.
fn each_number(schema: &mut Value, path: &str, then: &mut impl FnMut(&str, &mut Value)) {
    if allows(schema, "number") || allows(schema, "integer") {
        then(path, schema);
    }
    let inside = |name: &str| match path {
        "" => name.to_owned(),
        _ => format!("{path}.{name}"),
    };
    if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        for (name, property) in properties {
            each_number(property, &inside(name), then);
        }
    }
    if let Some(any) = schema.get_mut("additionalProperties") {
        each_number(any, &inside("*"), then);
    }
}

fn allows(schema: &Value, name: &str) -> bool {
    match &schema["type"] {
        Value::String(only) => only == name,
        Value::Array(types) => types.contains(&name.into()),
        _ => false,
    }
}

/// Everything in which `value` breaks `schema`, each as `path: what`.
pub fn violations(schema: &Value, value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    check(schema, value, "", &mut found);
    found
}

fn check(schema: &Value, value: &Value, path: &str, found: &mut Vec<String>) {
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
    if let Some(branches) = schema["oneOf"].as_array() {
        let kept = |branch: &&Value| violations(branch, value).is_empty();
        if branches.iter().filter(kept).count() != 1 {
            let value = brief(value);
            found.push(format!("{at}: {value} is not one of {}", schema["oneOf"]));
        }
    }
    if let Some(only) = schema.get("const")
        && only != value
    {
        found.push(format!("{at}: {} is not {only}", brief(value)));
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
            check(&schema["items"], item, &format!("{path}[{index}]"), found);
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
                (Some(property), _) => check(property, member, &inner, found),
                (None, Value::Bool(false)) => found.push(format!("{inner}: unknown field")),
                (None, additional) => check(additional, member, &inner, found),
            }
        }
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn violations_are_found() {
        let schema = json!({ "type": "object", "required": ["a"], "additionalProperties": false,
            "properties": { "a": { "type": ["integer", "null"], "minimum": 0 },
                            "b": { "type": "array", "items": { "enum": ["x"] } },
                            "d": { "oneOf": [{ "const": "x" }, { "const": "y" }] } } });
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
            json!({ "a": 0, "d": "z" }),
        ];
        for value in broken {
            assert_eq!(violations(&schema, &value).len(), 1, "{value}");
        }
    }

    #[test]
    fn the_stored_schema_is_what_the_types_say() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/record.schema.json");
        let derived = format!("{:#}\n", records());
        if std::env::var("CATOPTRIC_ACCEPT").is_ok_and(|value| value == "1") {
            std::fs::write(&path, &derived).unwrap();
        }
        let stored = std::fs::read_to_string(&path).unwrap();
        assert!(
            stored == derived,
            "schema/record.schema.json is not what the types say: CATOPTRIC_ACCEPT=1 stores it anew"
        );
    }

    #[test]
    fn nothing_in_the_schema_goes_unchecked() {
        const CHECKED: [&str; 9] = [
            "additionalProperties",
            "const",
            "enum",
            "items",
            "minimum",
            "oneOf",
            "properties",
            "required",
            "type",
        ];
        /// What says how a value is written, or nothing at all; sizes of arrays.
        const IGNORED: [&str; 7] = [
            "$schema",
            "default",
            "description",
            "format",
            "maxItems",
            "minItems",
            "title",
        ];
        fn look(schema: &Value) {
            for (keyword, value) in schema.as_object().into_iter().flatten() {
                let known = [&CHECKED[..], &IGNORED[..]].concat();
                assert!(known.contains(&keyword.as_str()), "{keyword}: {value}");
                match keyword.as_str() {
                    "properties" => value.as_object().unwrap().values().for_each(look),
                    "oneOf" => value.as_array().unwrap().iter().for_each(look),
                    "items" | "additionalProperties" => look(value),
                    _ => {}
                }
            }
        }
        look(&records());
    }

    #[test]
    fn recorded_runs_keep_to_the_schema() {
        let results = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results");
        let mut found = 0;
        for entry in std::fs::read_dir(results).unwrap() {
            let path = entry.unwrap().path().join("record.json");
            if !path.is_file() {
                continue;
            }
            found += 1;
            let text = std::fs::read_to_string(&path).unwrap();
            let rows: Value = serde_json::from_str(&text).unwrap();
            let broken = violations(&records(), &rows);
            assert!(broken.is_empty(), "{}: {broken:#?}", path.display());
        }
        assert!(found > 0, "no recorded run");
    }
}

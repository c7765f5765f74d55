//! Records in files: written whole or not at all, and read again to be compared with.

use std::path::Path;

use serde_json::Value;

use crate::exit::bad_input;
use crate::input;

use super::row::{Record, SCHEMA_VERSION};
use super::schema;

/// All rows with their raw samples, as a file has them.
pub fn text(rows: &[Record]) -> anyhow::Result<Vec<u8>> {
    let mut text = serde_json::to_vec_pretty(rows)?;
    text.push(b'\n');
    Ok(text)
}

/// Replaces the file at `path` by all rows with their raw samples: it is there whole or not at all.
pub fn write(rows: &[Record], path: &Path) -> anyhow::Result<()> {
    Ok(catoptric_frame::write_whole(path, &text(rows)?)?)
}

/// What earlier rows must have, so that a record stays readable when fields are added to it.
fn earlier() -> Value {
    serde_json::json!({ "type": "array", "items": {
        "type": "object",
        "required": ["schema_version", "scene", "technique", "resolution", "status", "meta"],
        "properties": { "schema_version": { "enum": [SCHEMA_VERSION] },
                        "scene": { "type": "string" }, "technique": { "type": "string" },
                        "resolution": { "type": "array" }, "status": { "type": "string" },
                        "meta": { "type": "object" } } } })
}

/// Reads earlier rows, to be compared with.
pub fn read(path: &Path) -> anyhow::Result<Vec<Value>> {
    let value = input::json(path)?;
    if let Some(violation) = schema::violations(&earlier(), &value).first() {
        return Err(bad_input(format!(
            "{}: not a record: {violation}; a record is what `compare -o FILE.json` writes, or \
             `record.json` beside a page",
            path.display()
        )));
    }
    match value {
        Value::Array(rows) => Ok(rows),
        _ => Err(bad_input(format!(
            "{}: not an array of records",
            path.display()
        ))),
    }
}

//! Values as messages show them: on one line, and short.

use std::borrow::Cow;

use toml::de::DeValue;

/// Control characters, such as line breaks in a name, as they are escaped in code.
pub(super) fn in_a_line(message: &str) -> String {
    let mut line = String::with_capacity(message.len());
    for character in message.chars() {
        if character.is_control() {
            line.extend(character.escape_default());
        } else {
            line.push(character);
        }
    }
    line
}

/// A number for messages, never long.
pub(crate) fn short(value: f64) -> String {
    let plain = value.to_string();
    if plain.len() <= 12 {
        plain
    } else {
        format!("{value:.4e}")
    }
}

/// What a value is, for messages: a number itself, of all else the kind.
pub(super) fn found(value: &DeValue<'_>) -> Cow<'static, str> {
    let number = match value {
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.as_str().replace('_', ""),
        DeValue::String(_) => return "a string".into(),
        DeValue::Boolean(_) => return "true or false".into(),
        DeValue::Datetime(_) => return "a date".into(),
        DeValue::Array(_) => return "an array".into(),
        DeValue::Table(_) => return "a table".into(),
    };
    match number.parse() {
        Ok(value) if number.len() > 12 => short(value).into(),
        _ => number.into(),
    }
}

//! Text of scene files.

use glam::{DVec3, Vec3};

/// Text in quotation marks.
pub fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted += "\\\"",
            '\\' => quoted += "\\\\",
            c if c.is_control() => quoted += &format!("\\u{:04x}", u32::from(c)),
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// A number that reads back as it is, with a point.
pub fn number(value: f64) -> String {
    format!("{:?}", value + 0.0)
}

/// Three numbers.
pub fn vector(vector: DVec3) -> String {
    let [x, y, z] = vector.to_array().map(number);
    format!("[{x}, {y}, {z}]")
}

/// A colour: each channel in the digits of a 32-bit float.
pub fn color(color: Vec3) -> String {
    let [r, g, b] = color
        .to_array()
        .map(|channel| format!("{:?}", channel + 0.0));
    format!("[{r}, {g}, {b}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        assert_eq!(vector(DVec3::new(1.0, -0.0, 1e-30)), "[1.0, 0.0, 1e-30]");
        assert_eq!(color(Vec3::new(0.1, 2.0, 0.0)), "[0.1, 2.0, 0.0]");
        assert_eq!(quoted("a \"b\" \\c\n"), r#""a \"b\" \\c\u000a""#);
    }
}

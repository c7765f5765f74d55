//! Colours of other renderers as linear RGB.

use glam::Vec3;

/// The linear value of an sRGB one, both 0 to 1 (IEC 61966-2-1).
fn linear(value: f64) -> f64 {
    match value <= 0.04045 {
        true => value / 12.92,
        false => ((value + 0.055) / 1.055).powf(2.4),
    }
}

/// sRGB values as a linear colour.
pub fn of_srgb(color: Vec3) -> Vec3 {
    color.map(|channel| linear(f64::from(channel)) as f32)
}

/// `#rrggbb`, in sRGB.
pub fn of_hex(text: &str) -> Option<Vec3> {
    let digits = text.trim().strip_prefix('#')?;
    let number = u32::from_str_radix(digits, 16).ok()?;
    let channel = |shift: u32| (number >> shift & 0xff) as f32 / 255.0;
    (digits.len() == 6).then(|| of_srgb(Vec3::new(channel(16), channel(8), channel(0))))
}

/// Finite and not negative, as a scene file wants colours.
pub fn usable(color: Vec3) -> Vec3 {
    let channel = |value: f32| {
        if value.is_finite() {
            value.max(0.0)
        } else {
            0.0
        }
    };
    color.map(channel)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_colors_are_srgb() {
        assert_eq!(
            of_hex("#ff0080").map(|c| (c * 1000.0).round()),
            Some(Vec3::new(1000.0, 0.0, 216.0))
        );
        assert_eq!(
            (of_hex("ff0080"), of_hex("#ff00"), of_hex("#gg0000")),
            (None, None, None)
        );
        assert_eq!(
            usable(Vec3::new(-1.0, f32::NAN, 2.0)),
            Vec3::new(0.0, 0.0, 2.0)
        );
    }
}

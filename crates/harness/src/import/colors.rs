//! Colours of other renderers as linear RGB.

use catoptric_scene::linear_from_srgb;
use glam::{DMat3, DVec3, Vec3};

/// sRGB values as a linear colour.
pub fn of_srgb(color: Vec3) -> Vec3 {
    color.map(|channel| linear_from_srgb(f64::from(channel)) as f32)
}

/// `#rrggbb`, in sRGB.
pub fn of_hex(text: &str) -> Option<Vec3> {
    let digits = text.trim().strip_prefix('#')?;
    let number = u32::from_str_radix(digits, 16).ok()?;
    let channel = |shift: u32| (number >> shift & 0xff) as f32 / 255.0;
    (digits.len() == 6).then(|| of_srgb(Vec3::new(channel(16), channel(8), channel(0))))
}

/// A spectrum as a colour: `samples` are wavelengths in nanometres, ascending, and values there. A flat
/// spectrum of 1 is white.
pub fn of_spectrum(samples: &[(f64, f64)]) -> Option<Vec3> {
    let (first, last) = (samples.first()?, samples.last()?);
    let at = |wavelength: f64| {
        let next = samples.iter().position(|(known, _)| *known >= wavelength);
        match next {
            Some(0) => first.1,
            None => last.1,
            Some(next) => {
                let (a, b) = (samples[next - 1], samples[next]);
                let share = (wavelength - a.0) / (b.0 - a.0).max(f64::MIN_POSITIVE);
                a.1 + share * (b.1 - a.1)
            }
        }
    };
    let wavelengths = (0..=90).map(|step| 380.0 + 4.0 * f64::from(step));
    let mut sums = [DVec3::ZERO; 2];
    for wavelength in wavelengths {
        let matching = matching(wavelength);
        sums[0] += at(wavelength) * matching;
        sums[1] += matching;
    }
    let [color, white] = sums.map(|sum| XYZ_TO_RGB * sum);
    Some((color / white).as_vec3())
}

/// Linear sRGB of CIE XYZ (IEC 61966-2-1), by columns.
const XYZ_TO_RGB: DMat3 = DMat3::from_cols_array(&[
    3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570,
]);

/// The CIE 1931 colour matching functions by sums of Gaussians (Wyman, Sloan and Shirley, JCGT 2(2),
/// 2013, eq. 4).
fn matching(wavelength: f64) -> DVec3 {
    let lobe = |middle: f64, below: f64, above: f64| {
        let scale = if wavelength < middle { below } else { above };
        let t = (wavelength - middle) * scale;
        (-0.5 * t * t).exp()
    };
    DVec3::new(
        0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323)
            - 0.065 * lobe(501.1, 0.0490, 0.0382),
        0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
        1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725),
    )
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
    fn spectra_have_the_color_of_their_light() {
        let white = of_spectrum(&[(400.0, 1.0), (700.0, 1.0)]).unwrap();
        assert!((white - Vec3::ONE).abs().max_element() < 1e-6, "{white}");
        let red = of_spectrum(&[(400.0, 0.05), (580.0, 0.05), (620.0, 0.7), (700.0, 0.7)]).unwrap();
        assert!(red.x > 0.4 && red.y < 0.2 && red.z < 0.2, "{red}");
        assert_eq!(of_spectrum(&[]), None);
    }

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

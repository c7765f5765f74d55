//! How the page's inspector paints: the colours of the maps, as JSON for its script.

use catoptric_frame::Status;
use catoptric_metrics::{Colormap, CoverageClass};
use serde_json::json;

use super::pictures::{ANGLES, COVERAGE, PALE};

/// What a status of a pixel is called, by its code.
const STATUSES: [(Status, &str); 5] = [
    (Status::NotMirror, "no mirror"),
    (Status::Resolved, "resolved"),
    (Status::Unresolved, "unresolved"),
    (Status::Below, "below the surface"),
    (Status::Back, "back of the mirror"),
];

/// JSON that may stand in a script element: it holds nothing that users name.
pub fn json() -> String {
    let hex = |color: [u8; 3]| color.map(|part| format!("{part:02x}")).concat();
    let magma = (0..256).map(|place| hex(Colormap::Magma.color(place as f32 / 255.0)));
    let coverage = CoverageClass::ALL.map(|class| {
        let painted = COVERAGE.iter().find(|(painted, _)| *painted == class);
        match painted {
            Some((class, name)) => json!({"name": name, "color": hex(class.color())}),
            None => json!({"name": class.label()}),
        }
    });
    let look = json!({
        "angles": ANGLES,
        "pale": PALE,
        "magma": magma.collect::<String>(),
        "coverage": coverage,
        "statuses": STATUSES.map(|(_, name)| name),
        "none": Status::NotMirror as u8,
        "resolved": Status::Resolved as u8,
        "unresolved": Status::Unresolved as u8,
    });
    look.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_in_the_order_of_their_codes() {
        for (code, (status, _)) in STATUSES.iter().enumerate() {
            assert_eq!(*status as usize, code);
        }
        for (code, class) in CoverageClass::ALL.iter().enumerate() {
            assert_eq!(*class as usize, code);
        }
        let look: serde_json::Value = serde_json::from_str(&json()).unwrap();
        assert_eq!(look["magma"].as_str().map(str::len), Some(256 * 6));
        assert_eq!(look["coverage"][1]["color"], "d55e00");
        assert!(!json().contains('<'));
    }
}

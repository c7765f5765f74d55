//! Pictures of errors, and the names by which pages find them.

use catoptric_frame::png::srgb_from_linear;
use catoptric_frame::{Frame, Image};
use catoptric_metrics::{
    Colormap, CoverageClass, MapKind, color_bar, colorize, colorize_coverage, error_map,
};
use glam::Vec3;

use crate::output::PICTURES as FOLDER;
use crate::record::Record;

/// The scale of all maps of angular error.
pub const SCALE: &str = "pictures/angle-scale.png";

/// Angles, in degrees, at the ends of the logarithmic scale that all maps share.
pub const ANGLES: [f32; 2] = [0.01, 100.0];
/// Labels from end to end of that scale.
pub const ANGLE_LABELS: [&str; 5] = ["0.01°", "0.1°", "1°", "10°", "100°"];

/// The classes that a coverage map paints, and what they are called.
pub const COVERAGE: [(CoverageClass, &str); 5] = [
    (CoverageClass::Missing, "missing"),
    (CoverageClass::Extra, "extra"),
    (CoverageClass::WrongId, "wrong object"),
    (CoverageClass::Crack, "missing in a crack"),
    (CoverageClass::Unresolved, "unresolved"),
];

/// Paths relative to the report's folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    /// The truth `first-bounce`.
    pub reference: String,
    /// The truth `full`.
    pub full: String,
    /// What the technique shows.
    pub technique: String,
    /// Angular error.
    pub angle: String,
    /// Missing, extra, wrong.
    pub coverage: String,
    /// The virtual triangles by how often each was split, where a refinement splits any.
    pub levels: Option<String>,
    /// What vectors of motion fetch from the frame before, and how far they are off, where a technique has
    /// some.
    pub motion: Option<[String; 2]>,
    /// The truth's values, as a script.
    pub truth_layers: String,
    /// The technique's values, as a script.
    pub layers: String,
}

/// Names of a row's pictures. One folder a scene and size, so that a sweep over sizes keeps all.
pub fn names(row: &Record) -> Names {
    let all = names_of(&row.scene, &row.technique, row.resolution);
    let splits = row.triangles.as_ref().map(|all| all.by_level.len()) > Some(1);
    Names {
        levels: all.levels.filter(|_| splits),
        motion: all.motion.filter(|_| row.motion.is_some()),
        ..all
    }
}

/// Names of the pictures of a technique on a scene, of which some may not be there.
pub fn names_of(scene: &str, technique: &str, [width, height]: [u32; 2]) -> Names {
    let folder = format!("{FOLDER}/{}-{width}x{height}", slug(scene));
    let technique = slug(technique);
    let motion = ["fetched", "motion"].map(|kind| format!("{folder}/{technique}.{kind}.png"));
    Names {
        levels: Some(format!("{folder}/{technique}.levels.png")),
        reference: format!("{folder}/reference.png"),
        full: format!("{folder}/reference-full.png"),
        technique: format!("{folder}/{technique}.png"),
        angle: format!("{folder}/{technique}.angle.png"),
        coverage: format!("{folder}/{technique}.coverage.png"),
        motion: Some(motion),
        truth_layers: format!("{folder}/reference.layers.js"),
        layers: format!("{folder}/{technique}.layers.js"),
    }
}

/// A name as a file name or an anchor: `linear(residual=cross)` → `linear-residual-cross`.
pub fn slug(name: &str) -> String {
    let words = name.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.'));
    words
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join("-")
}

/// The scale itself, with as many ticks as [`ANGLE_LABELS`].
pub fn angle_scale() -> Image<[u8; 3]> {
    color_bar(Colormap::Magma, [256, 12], ANGLE_LABELS.len() as u32)
}

/// Angular error on the logarithmic scale, on a pale picture where there is none.
pub fn angle_map(reference: &Frame, test: &Frame) -> anyhow::Result<Image<[u8; 3]>> {
    let map = error_map(MapKind::Angular, reference, test)?;
    // An angle of 0 is painted as the smallest; NaN (nothing to compare) stays NaN.
    let decades = map.map(|&angle| {
        if angle < ANGLES[0] {
            ANGLES[0].log10()
        } else {
            angle.log10()
        }
    });
    let painted = colorize(&decades, ANGLES.map(f32::log10), Colormap::Magma);
    Ok(on_pale(painted, &map, reference, |angle| angle.is_nan()))
}

/// Missing, extra and wrong pixels, on a pale picture where all is right.
pub fn coverage_map(reference: &Frame, test: &Frame) -> anyhow::Result<Image<[u8; 3]>> {
    let map = error_map(MapKind::Coverage, reference, test)?;
    let right = CoverageClass::Agree as u8;
    let pale = |code: f32| code.is_nan() || code == f32::from(right);
    Ok(on_pale(colorize_coverage(&map), &map, reference, pale))
}

/// Errors of the motion of reflections, in pixels, at the ends of the logarithmic scale that all maps
/// share.
pub const MOTION_PX: [f32; 2] = [0.001, 10.0];

/// Error of the motion on that scale, grey where there is no true one; what has no answer is painted as the
/// largest.
pub fn motion_map(pixels: &Image<f32>) -> Image<[u8; 3]> {
    let decades = pixels.map(|&px| {
        if px < MOTION_PX[0] {
            MOTION_PX[0].log10()
        } else {
            px.log10()
        }
    });
    colorize(&decades, MOTION_PX.map(f32::log10), Colormap::Magma)
}

/// Range of grey of the pale picture: neither the dark nor the light end of a map's colours.
pub const PALE: [f32; 2] = [150.0, 225.0];

/// Replaces a map, where `pale` says so of its value, by the reference without colour or contrast,
/// so that one sees where on the picture the errors are.
fn on_pale(
    painted: Image<[u8; 3]>,
    map: &Image<f32>,
    reference: &Frame,
    pale: impl Fn(f32) -> bool,
) -> Image<[u8; 3]> {
    let pixels = painted.pixels().iter().zip(map.pixels());
    let pixels = pixels.zip(reference.color.pixels());
    let pixels = pixels.map(|((painted, value), color)| {
        if !pale(*value) {
            return *painted;
        }
        let luma = srgb_from_linear(color.dot(LUMA).clamp(0.0, 1.0));
        [(PALE[0] + luma * (PALE[1] - PALE[0])).round() as u8; 3]
    });
    Image::from_vec(painted.size(), pixels.collect())
}

/// Weights of linear red, green and blue in what looks bright (Rec. 709).
const LUMA: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slugs_are_file_names() {
        assert_eq!(
            slug("linear(residual=cross,neighbours=8)"),
            "linear-residual-cross-neighbours-8"
        );
        assert_eq!(
            slug("linear+adaptive(threshold=0.001)"),
            "linear-adaptive-threshold-0.001"
        );
        assert_eq!(slug("../x"), "..-x");
    }

    #[test]
    fn maps_are_pale_where_they_have_nothing_to_say() {
        let color = Image::filled([2, 1], Vec3::splat(0.5));
        let reference = Frame {
            color,
            primary: None,
            reflected: None,
            motion: None,
            names: Vec::new(),
        };
        let painted = Image::filled([2, 1], [255, 0, 0]);
        let map = Image::from_vec([2, 1], vec![f32::NAN, 1.0]);
        let picture = on_pale(painted, &map, &reference, f32::is_nan);
        let [red, green, blue] = *picture.at(0, 0);
        assert!(red == green && green == blue && f32::from(red) > PALE[0]);
        assert_eq!(*picture.at(1, 0), [255, 0, 0]);
    }
}

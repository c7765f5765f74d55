//! The report's pictures, and the names by which the page finds them.

use std::path::Path;

use anyhow::Context;
use catoptric_frame::{Frame, Image, write_png, write_png_rgb8};
use catoptric_metrics::{Colormap, MapKind, color_bar, colorize, colorize_coverage, error_map};

use crate::Measured;
use crate::record::Record;

/// Folder of all pictures, inside the report's.
pub const FOLDER: &str = "pictures";
/// The scale of all maps of angular error.
pub const SCALE: &str = "pictures/angle-scale.png";

/// Angles, in degrees, at the ends of the logarithmic scale that all maps share.
pub const ANGLES: [f32; 2] = [0.01, 100.0];
/// Labels from end to end of that scale.
pub const ANGLE_LABELS: [&str; 5] = ["0.01°", "0.1°", "1°", "10°", "100°"];

/// What the colours of a coverage map mean, by class.
pub const COVERAGE_LABELS: [&str; 6] = [
    "right object",
    "missing",
    "extra",
    "wrong object",
    "missing in a crack",
    "unresolved",
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
}

/// Names of a row's pictures. One folder a scene and size, so that a sweep over sizes keeps all.
pub fn names(row: &Record) -> Names {
    let [width, height] = row.resolution;
    let folder = format!("{FOLDER}/{}-{width}x{height}", slug(&row.scene));
    let technique = slug(&row.technique);
    Names {
        reference: format!("{folder}/reference.png"),
        full: format!("{folder}/reference-full.png"),
        technique: format!("{folder}/{technique}.png"),
        angle: format!("{folder}/{technique}.angle.png"),
        coverage: format!("{folder}/{technique}.coverage.png"),
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

/// Writes the pictures of those rows of one scene that are to be shown.
pub fn write(
    measured: &Measured<'_, '_>,
    folder: &Path,
    shown: impl Fn(&Record) -> bool,
) -> anyhow::Result<()> {
    let at = |name: &str| folder.join(name);
    let rows = measured.rendered.iter().zip(measured.rows);
    for (rendered, row) in rows.filter(|(_, row)| shown(row)) {
        let Ok(rendered) = rendered else { continue };
        let names = names(row);
        if let Some(parent) = at(&names.reference).parent() {
            std::fs::create_dir_all(parent)
                .with_context(|| format!("cannot make {}", parent.display()))?;
        }
        write_png(&measured.truth.first.color, at(&names.reference))?;
        write_png(&measured.truth.full.color, at(&names.full))?;
        write_png_rgb8(
            &color_bar(Colormap::Magma, [256, 12], ANGLE_LABELS.len() as u32),
            at(SCALE),
        )?;
        let frame = &rendered.output.frame;
        write_png(&frame.color, at(&names.technique))?;
        write_png_rgb8(&angle_map(&measured.truth.first, frame)?, at(&names.angle))?;
        let coverage = error_map(MapKind::Coverage, &measured.truth.first, frame)?;
        write_png_rgb8(&colorize_coverage(&coverage), at(&names.coverage))?;
    }
    Ok(())
}

/// Angular error on the logarithmic scale.
fn angle_map(reference: &Frame, test: &Frame) -> anyhow::Result<Image<[u8; 3]>> {
    let map = error_map(MapKind::Angular, reference, test)?;
    // An angle of 0 is painted as the smallest; NaN (nothing to compare) stays NaN.
    let decades = map.map(|&angle| {
        if angle < ANGLES[0] {
            ANGLES[0].log10()
        } else {
            angle.log10()
        }
    });
    Ok(colorize(&decades, ANGLES.map(f32::log10), Colormap::Magma))
}

/// Colours of the coverage classes as the maps have them, in the order of [`COVERAGE_LABELS`].
pub fn coverage_colors() -> Vec<[u8; 3]> {
    let codes = (0..COVERAGE_LABELS.len()).map(|code| code as f32).collect();
    colorize_coverage(&Image::from_vec([COVERAGE_LABELS.len() as u32, 1], codes))
        .pixels()
        .to_vec()
}

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
    fn classes_have_colours_of_their_own() {
        let colors = coverage_colors();
        let mut distinct = colors.clone();
        distinct.sort_unstable();
        distinct.dedup();
        assert_eq!(distinct.len(), COVERAGE_LABELS.len());
    }
}

//! One picture, written to a file.

use std::path::{Path, PathBuf};

use catoptric_frame::{Frame, Status as Pixel};
use catoptric_scene::Scene;

use crate::exit::{Outcome, bad_input};
use crate::options::Common;
use crate::output::check_writable;
use crate::run::load::load_options;
use crate::terminal::say;

/// A scene by its name.
pub fn open(name: &str, common: &Common) -> anyhow::Result<Scene> {
    let scene = catoptric_scene::open(name, &load_options(common))?;
    crate::exit::warn(&scene);
    Ok(scene)
}

/// Refuses a frame that a scene's motion does not have. A scene that stands still has any.
pub fn check_frame(scene: &Scene, frame: u32) -> anyhow::Result<()> {
    let frames = scene.frames();
    if scene.motion.is_some() && frame >= frames {
        return Err(bad_input(format!(
            "--frame {frame}: the motion of `{}` has {frames} frames, 0 to {}",
            scene.name,
            frames - 1
        )));
    }
    Ok(())
}

/// The file asked for, known to be of a kind that can be written, in a place that can be.
pub fn target(common: &Common) -> anyhow::Result<PathBuf> {
    let path = common
        .output
        .as_ref()
        .ok_or_else(|| bad_input("say where to: -o FILE.exr or -o FILE.png"))?;
    check_writable(path)?;
    kind(path)?;
    Ok(path.clone())
}

/// What a file's name says it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// All layers, linear.
    Exr,
    /// Colour, for showing.
    Png,
}

fn kind(path: &Path) -> anyhow::Result<Kind> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some(extension) if extension.eq_ignore_ascii_case("exr") => Ok(Kind::Exr),
        Some(extension) if extension.eq_ignore_ascii_case("png") => Ok(Kind::Png),
        _ => Err(bad_input(format!(
            "{}: pictures are written as .exr (all layers) or .png",
            path.display()
        ))),
    }
}

/// Writes a frame as its file is called, and says what is in it.
pub fn write(frame: &Frame, path: &Path, common: &Common) -> anyhow::Result<Outcome> {
    match kind(path)? {
        Kind::Exr => frame.write_exr(path)?,
        Kind::Png => catoptric_frame::write_png(&frame.color, path)?,
    }
    if !common.quiet {
        let [width, height] = frame.color.size();
        let mirror = frame.reflected.as_ref().map_or(0, |layers| {
            layers
                .status
                .pixels()
                .iter()
                .filter(|status| **status != Pixel::NotMirror)
                .count()
        });
        let remark = if mirror == 0 {
            " (no mirror is in view)"
        } else {
            ""
        };
        say(&format!(
            "{}: {width}x{height} pixels, {mirror} of them mirror{remark}",
            path.display()
        ));
    }
    Ok(Outcome::Done)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_by_name() {
        assert_eq!(kind(Path::new("a.EXR")).unwrap(), Kind::Exr);
        assert_eq!(kind(Path::new("a.b.png")).unwrap(), Kind::Png);
        assert!(kind(Path::new("a.jpg")).is_err() && kind(Path::new("exr")).is_err());
    }
}

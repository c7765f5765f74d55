//! `catoptric reference` and `catoptric render`: one picture, written to a file.

use std::path::{Path, PathBuf};

use catoptric_frame::{Frame, Status as Pixel};
use catoptric_reference::{RenderOptions, Tracer, Truth};
use catoptric_scene::Scene;

use crate::cli::{Common, TruthArg};
use crate::exit::{Outcome, bad_input};
use crate::pipeline::{self, check_size};
use crate::progress::Progress;
use crate::setup;

/// Longest side of a picture that only the CPU makes.
const LONGEST_SIDE: u32 = 16_384;

/// Ray-traces a scene into a file.
pub fn reference(
    name: &str,
    truth: TruthArg,
    samples: u32,
    common: &Common,
) -> anyhow::Result<Outcome> {
    let path = target(common)?;
    let side = samples.isqrt();
    if side * side != samples {
        return Err(bad_input(format!(
            "--samples {samples} is no regular grid in a pixel: give a square number, such as {}",
            (side + 1) * (side + 1)
        )));
    }
    let scene = open(name, common)?;
    let size = pipeline::size(&scene);
    check_size(size, LONGEST_SIDE, "the reference")?;
    let tracer = Tracer::new(&scene)?;
    let progress = Progress::new(size[1] as usize, common.quiet);
    progress.doing(format!("{name}: tracing"));
    let step = |_, _| progress.step();
    let truth = match truth {
        TruthArg::FirstBounce => Truth::FirstBounce,
        TruthArg::Full => Truth::Full {
            bounces: common.bounces,
        },
    };
    let frame = tracer.render(&RenderOptions {
        size,
        truth,
        samples: side,
        progress: Some(&step),
    });
    progress.finish();
    write(&frame, &path, common)
}

/// Renders a scene by a technique into a file.
pub fn render(name: &str, technique: &str, common: &Common) -> anyhow::Result<Outcome> {
    let path = target(common)?;
    let spec = setup::parse(technique)?;
    let scene = open(name, common)?;
    let gpu = setup::open_gpu(common)?;
    check_size(pipeline::size(&scene), gpu.info().max_image, "this adapter")?;
    match pipeline::render(&gpu, &spec, &scene) {
        Ok(rendered) => write(&rendered.output.frame, &path, common),
        Err((crate::record::Status::NotApplicable, reason)) => Err(bad_input(format!(
            "{spec} does not apply to {name}: {reason}"
        ))),
        Err((_, reason)) => {
            eprintln!("catoptric: {spec} on {name}: {reason}");
            Ok(Outcome::FellShort)
        }
    }
}

fn open(name: &str, common: &Common) -> anyhow::Result<Scene> {
    Ok(catoptric_scene::open(name, &setup::load_options(common))?)
}

/// The file asked for, known to be of a kind that can be written, in a place that can be.
fn target(common: &Common) -> anyhow::Result<PathBuf> {
    let path = common
        .output
        .as_ref()
        .ok_or_else(|| bad_input("say where to: -o FILE.exr or -o FILE.png"))?;
    kind(path)?;
    setup::check_writable(path)?;
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

fn write(frame: &Frame, path: &Path, common: &Common) -> anyhow::Result<Outcome> {
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
        eprintln!(
            "{}: {width}x{height} pixels, {mirror} of them mirror{remark}",
            path.display()
        );
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

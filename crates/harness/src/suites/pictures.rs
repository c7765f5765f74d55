//! The pictures of measured rows, written into the page's folder.

use anyhow::anyhow;
use catoptric_frame::{Image, write_png, write_png_rgb8, write_whole};
use catoptric_reflect::Gpu;
use catoptric_scene::Scene;
use glam::Vec3;

use crate::output::Draft;
use crate::record::Record;
use crate::run::Measured;
use crate::run::load::parse;
use crate::run::render::render;
use crate::show::layers::{self, Extent};
use crate::show::pictures;

/// Writes the pictures of those rows of one scene that are to be shown, and their values.
pub fn write(
    measured: &Measured<'_, '_>,
    draft: &Draft,
    extent: Extent,
    shown: impl Fn(&Record) -> bool,
) -> anyhow::Result<()> {
    let truth = &measured.truth.first;
    let mut shared = false;
    let rows = measured.rendered.iter().zip(measured.rows);
    for (rendered, row) in rows.filter(|(_, row)| shown(row)) {
        let Ok(rendered) = rendered else { continue };
        let names = pictures::names(row);
        let frame = &rendered.output.frame;
        if !shared {
            write_png(&truth.color, draft.file(&names.reference)?)?;
            write_png(&measured.truth.full.color, draft.file(&names.full)?)?;
            write_png_rgb8(&pictures::angle_scale(), draft.file(pictures::SCALE)?)?;
            let values = layers::reference(truth, extent)?;
            write_whole(draft.file(&names.truth_layers)?, values.as_bytes())?;
            shared = true;
        }
        write_png(&frame.color, draft.file(&names.technique)?)?;
        let angle = pictures::angle_map(truth, frame)?;
        write_png_rgb8(&angle, draft.file(&names.angle)?)?;
        let coverage = pictures::coverage_map(truth, frame)?;
        write_png_rgb8(&coverage, draft.file(&names.coverage)?)?;
        if let (Some([picture, error]), Some(fetched)) = (&names.motion, &rendered.fetched) {
            write_png(&fetched.picture, draft.file(picture)?)?;
            write_png_rgb8(&pictures::motion_map(&fetched.error), draft.file(error)?)?;
        }
        let values = layers::technique(truth, frame, extent)?;
        write_whole(draft.file(&names.layers)?, values.as_bytes())?;
        if let Some(levels) = &names.levels {
            let geometry = geometry(measured.gpu, measured.scene, &row.technique, "levels")?;
            write_png(&geometry, draft.file(levels)?)?;
        }
    }
    Ok(())
}

/// The virtual geometry itself, as the option `show` of every search says: `wireframe`, `levels`.
pub fn geometry(
    gpu: &Gpu,
    scene: &Scene,
    technique: &str,
    show: &str,
) -> anyhow::Result<Image<Vec3>> {
    let spec = parse(technique)?.with("show", show)?;
    let rendered = render(gpu, &spec, scene);
    let rendered = rendered.map_err(|(_, reason)| anyhow!("{spec} on {}: {reason}", scene.name))?;
    Ok(rendered.output.frame.color)
}

//! What a viewer sees: the last frame's true picture fetched by each estimator's vectors, beside this
//! frame's, and where the vectors are off.

use anyhow::Context;
use catoptric_frame::png::srgb8_from_linear;
use catoptric_frame::{Frame, Image, write_png_rgb8};
use catoptric_metrics::reprojected;
use catoptric_reference::{Follow, RenderOptions, Truth};
use glam::Vec3;

use crate::output::PICTURES as FOLDER;
use crate::run::load::{load_options, parse, size};
use crate::run::render::render_frame;
use crate::show::pictures::{MOTION_PX, motion_map, slug};
use crate::suites::suite::{Picture, Studio};

use super::labels::{ESTIMATORS, LENS, NEWTON, SURFACE};

/// Scenes of the pictures where the user names none: steps long enough to be seen.
const SCENES: [&str; 2] = ["moving-ball-all-step-10", "moving-bowl-all-step-10"];

/// What is fetched by whom: those that are shown.
const SHOWN: [(&str, &str); 3] = [SURFACE, LENS, NEWTON];

/// Under the first figure: this frame, then for each estimator what it fetches and where it is off.
pub fn make(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let scenes = match studio.scene {
        Some(scene) => vec![scene],
        None => SCENES.to_vec(),
    };
    let mut pictures = Vec::new();
    for name in scenes {
        pictures.extend(of_scene(studio, name)?);
    }
    Ok(pictures)
}

fn of_scene(studio: &Studio<'_>, name: &str) -> anyhow::Result<Vec<Picture>> {
    let scene = catoptric_scene::open(name, &load_options(studio.common))?;
    let size = size(&scene);
    let follow = Follow::new(&scene, [1, 0], size)?;
    let options = RenderOptions::new(size, Truth::FirstBounce);
    let [now, before] = follow.tracers().map(|tracer| tracer.render(&options));
    let truth = Frame {
        motion: Some(follow.layer(None)),
        ..now
    };
    let save = |kind: &str, image: &Image<[u8; 3]>, caption: String| {
        let path = format!("{FOLDER}/{}.{kind}.png", slug(&scene.name));
        let file = studio.draft.file(&path)?;
        write_png_rgb8(image, &file).with_context(|| format!("cannot write {}", file.display()))?;
        anyhow::Ok(Picture {
            figure: "mirrors",
            path,
            size: image.size(),
            alt: caption.clone(),
            caption,
        })
    };
    let shown = |color: &Image<Vec3>| color.map(|color| srgb8_from_linear(*color));
    let mut pictures = vec![save(
        "now",
        &shown(&truth.color),
        format!("{name}: this frame, traced."),
    )?];
    let known = |frame: &Frame, index: usize| {
        let motion = frame.motion.as_ref();
        motion.is_some_and(|motion| motion.valid.pixels()[index])
    };
    for (label, technique) in ESTIMATORS.iter().filter(|one| SHOWN.contains(one)) {
        let spec = parse(technique)?;
        // The rows of an estimator that does not apply say why.
        let Ok(frame) = render_frame(&studio.setup.gpu, &spec, &scene, 1) else {
            continue;
        };
        let Some(motion) = &frame.motion else {
            continue;
        };
        let fetched = reprojected(&truth.color, &before.color, motion, |index| {
            known(&truth, index)
        });
        pictures.push(save(
            &format!("{}.fetched", slug(label)),
            &shown(&fetched),
            format!("{name}: the last frame's picture in the mirror, fetched by {technique}."),
        )?);
        let [low, high] = MOTION_PX;
        let map = motion_map(&catoptric_metrics::motion_map(&truth, &frame)?);
        pictures.push(save(
            &format!("{}.error", slug(label)),
            &map,
            format!(
                "{name}: how far {technique} is off, on a logarithmic scale from {low} px (black) to \
                 {high} px and no answer (light); grey: no true motion."
            ),
        )?);
    }
    Ok(pictures)
}

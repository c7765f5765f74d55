//! Which pixels skipping gets wrong: those that show another object than without skipping, all else
//! being equal.

use anyhow::Context;
use catoptric_frame::{Frame, Image, Status, write_png_rgb8};
use catoptric_scene::Scene;

use crate::output::PICTURES as FOLDER;
use crate::show::number::percent;
use crate::show::pictures::slug;
use crate::suites::suite::{Picture, Studio};

use super::data::{SCENES, SIZE};

/// Label and options of what is rendered without skipping, with the published and with the sound
/// test.
const SAMPLED: [(&str, &str); 3] = [
    ("distance", "criterion=distance"),
    ("analytic", "criterion=analytic,accept=any"),
    (
        "analytic, texel by texel",
        "criterion=analytic,accept=any,sampling=texel",
    ),
];

/// What a pixel of the picture says.
const NO_MIRROR: [u8; 3] = [24, 24, 28];
const SAME: [u8; 3] = [150, 150, 155];
const PUBLISHED_WRONG: [u8; 3] = [221, 106, 19];
const SOUND_WRONG: [u8; 3] = [40, 150, 220];
const BOTH_WRONG: [u8; 3] = [255, 255, 255];

/// Draws a picture for each scene, criterion and sampling; the shares stand in its caption.
pub fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let own = studio.scene.map(|scene| [scene]);
    let scenes = own.as_ref().map_or(SCENES.as_slice(), |scene| scene);
    let mut pictures = Vec::new();
    for name in scenes {
        let mut options = crate::run::load::load_options(studio.common);
        options.resolution = options.resolution.or(Some(SIZE));
        let scene = Scene::load(name, &options)?;
        for (label, options) in SAMPLED {
            pictures.extend(picture(studio, &scene, label, options)?);
        }
    }
    Ok(pictures)
}

/// `None` where the technique does not apply.
fn picture(
    studio: &Studio<'_>,
    scene: &Scene,
    label: &str,
    options: &str,
) -> anyhow::Result<Option<Picture>> {
    let mut frames = Vec::new();
    for pyramid in ["off", "published", "sound"] {
        let spec = crate::run::load::parse(&format!("cubemap-trace({options},pyramid={pyramid})"))?;
        match crate::run::render::render(&studio.setup.gpu, &spec, scene) {
            Ok(rendered) => frames.push(rendered.output.frame),
            Err(_) => return Ok(None),
        }
    }
    let [published, sound] = [1, 2].map(|which| wrong(&frames[0], &frames[which]));
    let size = published.size();
    let pixels = published.pixels().iter().zip(sound.pixels());
    let colors = pixels.map(|pixel| match pixel {
        (None, _) | (_, None) => NO_MIRROR,
        (Some(false), Some(false)) => SAME,
        (Some(true), Some(false)) => PUBLISHED_WRONG,
        (Some(false), Some(true)) => SOUND_WRONG,
        (Some(true), Some(true)) => BOTH_WRONG,
    });
    let path = format!("{FOLDER}/{}.skipped-{}.png", slug(&scene.name), slug(label));
    let file = studio.draft.file(&path)?;
    write_png_rgb8(&Image::from_vec(size, colors.collect()), &file)
        .with_context(|| format!("cannot write {}", file.display()))?;
    Ok(Some(Picture {
        figure: "pyramids",
        path,
        size,
        caption: format!(
            "{}, {label}: mirror pixels that show another object than without skipping are {} with the \
             published test (orange) and {} with the sound one (blue; white: with both).",
            scene.name,
            percent(share(&published)),
            percent(share(&sound)),
        ),
        alt: format!("Mirror pixels that the skip tests get wrong, {label}"),
    }))
}

/// Whether a pixel shows another object, or nothing in place of one; `None` beside the mirrors.
fn wrong(every: &Frame, skipping: &Frame) -> Image<Option<bool>> {
    let [every, skipping] =
        [every, skipping].map(|frame| frame.reflected.as_ref().expect("all layers are rendered"));
    let states = every.status.pixels().iter().zip(skipping.status.pixels());
    let ids = every.id.pixels().iter().zip(skipping.id.pixels());
    let pixels = states.zip(ids).map(|((state, other), (id, other_id))| {
        (*state != Status::NotMirror).then_some(state != other || id != other_id)
    });
    Image::from_vec(every.status.size(), pixels.collect())
}

/// Of the mirror pixels.
fn share(wrong: &Image<Option<bool>>) -> f64 {
    let mirror = wrong.pixels().iter().flatten();
    let all = mirror.clone().count().max(1);
    mirror.filter(|wrong| **wrong).count() as f64 / all as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_of_mirror_pixels() {
        let pixels = vec![
            None,
            Some(true),
            Some(false),
            Some(false),
            Some(false),
            None,
        ];
        assert_eq!(share(&Image::from_vec([3, 2], pixels)), 0.25);
        assert_eq!(share(&Image::from_vec([1, 1], vec![None])), 0.0);
    }
}

//! Fig. 5.1: how many samples each pixel's ray takes, without and with acceleration, by both
//! criteria.

use anyhow::Context;
use catoptric_frame::{Image, write_png_rgb8};
use catoptric_metrics::maps::{Colormap, colorize};
use catoptric_scene::Scene;

use crate::output::PICTURES as FOLDER;
use crate::show::pictures::slug;
use crate::suites::suite::{Picture, Studio};

use super::data::SIZE;

/// Label and options.
const SHOWN: [(&str, &str); 4] = [
    ("distance", "criterion=distance"),
    (
        "distance, accelerated",
        "criterion=distance,pyramid=published",
    ),
    ("analytic", "criterion=analytic,accept=any"),
    (
        "analytic, accelerated",
        "criterion=analytic,accept=any,pyramid=published",
    ),
];

/// Draws the maps on one scale.
pub fn pictures(studio: &Studio<'_>) -> anyhow::Result<Vec<Picture>> {
    let name = studio.scene.unwrap_or("box");
    let mut options = crate::run::load::load_options(studio.common);
    options.resolution = options.resolution.or(Some(SIZE));
    let scene = Scene::load(name, &options)?;
    let mut maps = Vec::new();
    for (label, options) in SHOWN {
        let spec = crate::run::load::parse(&format!("cubemap-trace({options})"))?;
        let rendered = crate::run::render::render(&studio.setup.gpu, &spec, &scene);
        let traced = rendered.ok().and_then(|rendered| rendered.traced);
        maps.extend(traced.map(|traced| (label, traced)));
    }
    let counts = maps.iter().flat_map(|(_, traced)| traced.samples.pixels());
    let most = counts.max().copied().unwrap_or(0).max(1) as f32;
    let pictures = maps.iter().map(|(label, traced)| {
        let path = format!("{FOLDER}/{}.samples-{}.png", slug(&scene.name), slug(label));
        let file = studio.draft.file(&path)?;
        let pixels = traced.samples.pixels().iter().zip(traced.rays.pixels());
        let shares = pixels.map(|(samples, rays)| match rays {
            0 => f32::NAN,
            _ => (*samples as f32).max(1.0).ln() / most.ln(),
        });
        let map = Image::from_vec(traced.samples.size(), shares.collect());
        write_png_rgb8(&colorize(&map, [0.0, 1.0], Colormap::Magma), &file)
            .with_context(|| format!("cannot write {}", file.display()))?;
        let mirror = traced.pixels().max(1) as f64;
        let mean = traced.samples.pixels().iter().map(|n| f64::from(*n)).sum::<f64>() / mirror;
        Ok(Picture {
            figure: "pyramids",
            path,
            size: traced.samples.size(),
            caption: format!(
                "{}, {label}: samples of each ray, black 1, light {most} (logarithmic); mean {mean:.0} \
                 (Fig. 5.1).",
                scene.name
            ),
            alt: format!("Heat map of the samples taken at each mirror pixel, {label}"),
        })
    });
    pictures.collect()
}

//! The page of two pictures that are compared: both, their maps of error, and the numbers.

use anyhow::Context;
use askama::Template;
use catoptric_frame::{Frame, Image, write_png, write_png_rgb8, write_whole};
use catoptric_metrics::{Colormap, MapKind, colorize, error_map};
use serde_json::Value;

use crate::output::{Draft, PICTURES};
use crate::record::path::leaves;

use super::facts::{self, Fact};
use super::layers::{self, Extent};
use super::look;
use super::pictures::{self, Names};
use super::table::cell;

#[derive(Template)]
#[template(path = "pair.html")]
struct Page {
    reference: String,
    test: String,
    /// The maps of layers; `None` where a picture has none.
    layers: Option<Names>,
    names: Names,
    color: String,
    wide: u32,
    high: u32,
    note: String,
    numbers: Vec<Fact>,
    scale: &'static str,
    angle_labels: &'static [&'static str],
    coverage: Vec<Fact>,
    look: String,
}

/// The page as text; pictures are written into the draft. `result` is what `diff` prints.
pub fn page(
    reference: &Frame,
    test: &Frame,
    result: &Value,
    draft: &Draft,
) -> anyhow::Result<String> {
    let name = |name: &str| format!("{PICTURES}/{name}.png");
    let names = Names {
        reference: name("reference"),
        full: name("reference"),
        technique: name("test"),
        angle: name("angle"),
        coverage: name("coverage"),
        levels: None,
        motion: None,
        truth_layers: format!("{PICTURES}/reference.layers.js"),
        layers: format!("{PICTURES}/test.layers.js"),
    };
    write_png(&reference.color, draft.file(&names.reference)?)?;
    write_png(&test.color, draft.file(&names.technique)?)?;
    let color = name("color");
    write_png_rgb8(&color_map(reference, test), draft.file(&color)?)?;
    let has_layers = |frame: &Frame| frame.primary.is_some() && frame.reflected.is_some();
    let layers = match has_layers(reference) && has_layers(test) {
        false => None,
        true => {
            let angle = pictures::angle_map(reference, test)?;
            write_png_rgb8(&angle, draft.file(&names.angle)?)?;
            let coverage = pictures::coverage_map(reference, test)?;
            write_png_rgb8(&coverage, draft.file(&names.coverage)?)?;
            write_png_rgb8(&pictures::angle_scale(), draft.file(pictures::SCALE)?)?;
            let values = layers::reference(reference, Extent::All)?;
            write_whole(draft.file(&names.truth_layers)?, values.as_bytes())?;
            let values = layers::technique(reference, test, Extent::All)?;
            write_whole(draft.file(&names.layers)?, values.as_bytes())?;
            Some(names.clone())
        }
    };
    let text = |key: &str| result[key].as_str().unwrap_or_default().to_owned();
    let numbers = leaves(result).into_iter();
    let numbers =
        numbers.filter(|(path, _)| !["reference", "test", "note"].contains(&path.as_str()));
    let [wide, high] = reference.color.size();
    let page = Page {
        reference: text("reference"),
        test: text("test"),
        layers,
        names,
        color,
        wide,
        high,
        note: text("note"),
        numbers: numbers
            .map(|(name, value)| Fact {
                name,
                value: cell(Some(&value)),
            })
            .collect(),
        scale: pictures::SCALE,
        angle_labels: &pictures::ANGLE_LABELS,
        coverage: facts::coverage_legend(),
        look: look::json(),
    };
    page.render()
        .context("filling the template of two pictures")
}

/// The colour error, from 0 to 1, in colours.
pub fn color_map(reference: &Frame, test: &Frame) -> Image<[u8; 3]> {
    colorize(&color_error(reference, test), [0.0, 1.0], Colormap::Magma)
}

/// Mean absolute difference over the channels: on the mirrors where both have layers, else
/// everywhere.
fn color_error(a: &Frame, b: &Frame) -> Image<f32> {
    error_map(MapKind::AbsColor, a, b).unwrap_or_else(|_| {
        let pairs = a.color.pixels().iter().zip(b.color.pixels());
        let errors = pairs
            .map(|(a, b)| (*a - *b).abs().element_sum() / 3.0)
            .collect();
        Image::from_vec(a.color.size(), errors)
    })
}

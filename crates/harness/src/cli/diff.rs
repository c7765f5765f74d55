//! `catoptric diff`: our metrics on any two pictures.

use std::path::PathBuf;

use anyhow::Context;
use catoptric_frame::{Frame, Image};
use catoptric_metrics::{Colormap, MapKind, flip::DEFAULT_PIXELS_PER_DEGREE};
use serde_json::{Value, json};

use crate::exit::{Outcome, bad_input};
use crate::options::Common;
use crate::output::check_writable;
use crate::show::print;

/// What `diff` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// The truth
    pub reference: PathBuf,
    /// What is judged
    pub test: PathBuf,
}

/// Compares two EXR pictures: all metrics where both have the layers, colour alone and why
/// otherwise. `-o FILE.png` writes a map of the colour error.
pub fn run(Args { reference, test }: &Args, common: &Common) -> anyhow::Result<Outcome> {
    if let Some(path) = &common.output {
        check_writable(path)?;
    }
    let (a, b) = (Frame::read_exr(reference)?, Frame::read_exr(test)?);
    if a.color.size() != b.color.size() {
        let ([aw, ah], [bw, bh]) = (a.color.size(), b.color.size());
        let names = (reference.display(), test.display());
        return Err(bad_input(format!(
            "{} is {aw}x{ah} pixels, {} is {bw}x{bh}",
            names.0, names.1
        )));
    }
    let layered = |frame: &Frame| frame.primary.is_some() && frame.reflected.is_some();
    let metrics = if layered(&a) && layered(&b) {
        let compared = catoptric_metrics::compare(&a, &b);
        serde_json::to_value(compared.map_err(|error| bad_input(error.to_string()))?)?
    } else {
        let everywhere = Image::filled(a.color.size(), true);
        let color = catoptric_metrics::compare_color(
            &a.color,
            &b.color,
            &everywhere,
            DEFAULT_PIXELS_PER_DEGREE,
        )
        .map_err(|error| bad_input(error.to_string()))?;
        let non_finite = |frame: &Frame| {
            let pixels = frame.color.pixels().iter();
            pixels.filter(|color| !color.is_finite()).count()
        };
        let without = [(reference, &a), (test, &b)]
            .into_iter()
            .find(|(_, frame)| !layered(frame));
        let (path, _) = without.expect("one has no layers");
        json!({
            "color": color,
            "non_finite": { "reference": non_finite(&a), "test": non_finite(&b) },
            "note": format!("colour alone, over the whole picture: {} has no layers of mirrors", path.display()),
        })
    };
    if let Some(path) = &common.output {
        let map = color_error(&a, &b);
        catoptric_frame::write_png_rgb8(
            &catoptric_metrics::colorize(&map, [0.0, 1.0], Colormap::Magma),
            path,
        )
        .context("the error map")?;
    }
    let mut result =
        json!({ "reference": reference.display().to_string(), "test": test.display().to_string() });
    if let (Value::Object(result), Value::Object(metrics)) = (&mut result, metrics) {
        result.extend(metrics);
    }
    print::text(&print::facts(&result, common.format))?;
    Ok(Outcome::Done)
}

/// Mean absolute difference over the channels: on the mirrors where both have layers, else
/// everywhere.
fn color_error(a: &Frame, b: &Frame) -> Image<f32> {
    catoptric_metrics::error_map(MapKind::AbsColor, a, b).unwrap_or_else(|_| {
        let pairs = a.color.pixels().iter().zip(b.color.pixels());
        let errors = pairs
            .map(|(a, b)| (*a - *b).abs().element_sum() / 3.0)
            .collect();
        Image::from_vec(a.color.size(), errors)
    })
}

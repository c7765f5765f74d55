//! `catoptric diff`: our metrics on any two pictures.

use std::path::{Path, PathBuf};

use anyhow::Context;
use catoptric_frame::{Channels, Frame, Image, Name};
use catoptric_metrics::{Comparison, MotionError, flip::DEFAULT_PIXELS_PER_DEGREE};
use serde_json::{Value, json};

use crate::exit::{Outcome, bad_input};
use crate::options::Common;
use crate::output::{Draft, PICTURES, check_writable};
use crate::show::pair::{self, color_map};
use crate::show::{pictures, print};
use crate::suites::runner::refuse_file_name;

/// What `diff` is asked.
#[derive(Clone, Debug, clap::Args)]
pub struct Args {
    /// The truth
    pub reference: PathBuf,
    /// What is judged
    pub test: PathBuf,
    /// What the map of -o shows
    #[arg(long, value_enum, default_value_t)]
    pub map: Map,
}

/// What a map shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Map {
    /// Error of colour, 0 to 1
    #[default]
    Color,
    /// Error of the motion of reflections, 0.001 to 10 pixels on a logarithmic scale
    Motion,
}

/// Compares two EXR pictures: all metrics where both have the layers and show a mirror, colour alone
/// and why otherwise. `-o FILE.png` writes a map of the error, `-o DIR` a page with all maps.
pub fn run(
    Args {
        reference,
        test,
        map,
    }: &Args,
    common: &Common,
) -> anyhow::Result<Outcome> {
    match &common.output {
        Some(path) if is_map(path) => check_map(path, [reference, test])?,
        Some(path) => refuse_file_name(path).map_err(|_| {
            let path = path.display();
            bad_input(format!(
                "-o {path}: name a .png for one map, or a folder for a page with all of them"
            ))
        })?,
        None => {}
    }
    let mut notes = Vec::new();
    let [mut a, mut b] = [read(reference, &mut notes)?, read(test, &mut notes)?];
    if a.color.size() != b.color.size() {
        let ([aw, ah], [bw, bh]) = (a.color.size(), b.color.size());
        let names = (reference.display(), test.display());
        return Err(bad_input(format!(
            "{} is {aw}x{ah} pixels, {} is {bw}x{bh}",
            names.0, names.1
        )));
    }
    share_names(&mut a, &mut b, [reference, test], &mut notes);
    let mut metrics = match without_layers([(reference, &a), (test, &b)]) {
        None => of_layers(&a, &b, &mut notes)?,
        Some(path) => {
            notes.push(format!(
                "colour alone, over the whole picture: {} has no layers of mirrors",
                path.display()
            ));
            of_color(&a, &b, &mut notes)?
        }
    };
    let motion = motion(&a, &b, &mut notes);
    if let Some(motion) = &motion {
        metrics["motion"] = serde_json::to_value(motion)?;
    }
    if metrics["color"].is_null() && motion.is_none() {
        notes.push("no pixel's colour is a number in both pictures".to_owned());
        if metrics["object_agreement"].is_null() {
            return Err(bad_input(format!(
                "nothing of {} and {} can be compared: {}",
                reference.display(),
                test.display(),
                notes.join("; ")
            )));
        }
    }
    if let Some(path) = common.output.as_deref().filter(|path| is_map(path)) {
        let painted = match map {
            Map::Color => color_map(&a, &b),
            Map::Motion => {
                let map = catoptric_metrics::motion_map(&a, &b);
                pictures::motion_map(&map.map_err(|error| bad_input(error.to_string()))?)
            }
        };
        catoptric_frame::write_png_rgb8(&painted, path).context("the error map")?;
    }
    let mut result =
        json!({ "reference": reference.display().to_string(), "test": test.display().to_string() });
    if let (Value::Object(result), Value::Object(metrics)) = (&mut result, metrics) {
        result.extend(metrics);
        if !notes.is_empty() {
            result.insert("note".to_owned(), notes.join("; ").into());
        }
    }
    if let Some(folder) = common.output.as_deref().filter(|path| !is_map(path)) {
        let mut draft = Draft::begin(folder, &[PICTURES])?;
        let page = pair::page(&a, &b, &result, &draft)?;
        draft.put_alone(&page)?;
    }
    print::text(&print::facts(&result, common.format))?;
    Ok(Outcome::Done)
}

/// Whether a name is that of a single map.
fn is_map(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    !path.is_dir() && ending.is_some_and(|ending| ending.eq_ignore_ascii_case("png"))
}

/// Refuses a map that would replace either picture.
fn check_map(path: &Path, pictures: [&PathBuf; 2]) -> anyhow::Result<()> {
    let file = |path: &Path| std::fs::canonicalize(path).ok();
    let map = file(path);
    if map.is_some() && pictures.iter().any(|picture| file(picture) == map) {
        return Err(bad_input(format!(
            "-o {}: that is a picture to be compared; it would be overwritten",
            path.display()
        )));
    }
    check_writable(path)
}

/// A picture, and how it is known which of its pixels are mirrors where it does not say.
fn read(path: &Path, notes: &mut Vec<String>) -> anyhow::Result<Frame> {
    let channels = Channels::read(path)?;
    notes.extend(channels.status_note());
    Ok(Frame::from_channels(&channels)?)
}

/// A picture without names gets those of the other; where both have some, they must be the same for
/// ids to mean the same.
fn share_names(a: &mut Frame, b: &mut Frame, paths: [&PathBuf; 2], notes: &mut Vec<String>) {
    let [of_a, of_b] = paths.map(|path| path.display());
    let layered = |frame: &Frame| frame.reflected.is_some();
    match (a.names.is_empty(), b.names.is_empty()) {
        (false, true) if layered(b) => {
            b.assign_names(a.names.clone());
            notes.push(format!(
                "{of_b}: no `catoptric.ids`: ids are named as in {of_a}"
            ));
        }
        (true, false) if layered(a) => {
            a.assign_names(b.names.clone());
            notes.push(format!(
                "{of_a}: no `catoptric.ids`: ids are named as in {of_b}"
            ));
        }
        (false, false) if a.names != b.names => {
            let other = |name: &&Name| !b.names.contains(name);
            let id = a.names.iter().find(other).map_or_else(String::new, |name| {
                let theirs = b.names.iter().find(|other| other.id == name.id);
                let theirs = theirs.map_or("nothing", |name| &name.name);
                format!(": id {} is `{}` and `{theirs}`", name.id, name.name)
            });
            notes.push(format!("{of_a} and {of_b} name their ids differently{id}"));
        }
        _ => {}
    }
}

/// Which picture has no layers of mirrors.
fn without_layers<'p>(pictures: [(&'p PathBuf, &Frame); 2]) -> Option<&'p Path> {
    let layered = |frame: &Frame| frame.primary.is_some() && frame.reflected.is_some();
    let mut without = pictures.into_iter().filter(|(_, frame)| !layered(frame));
    without.next().map(|(path, _)| path.as_path())
}

/// How far the second picture's vectors of motion are off the first's, where both have some.
fn motion(a: &Frame, b: &Frame, notes: &mut Vec<String>) -> Option<MotionError> {
    let judged = match (&a.motion, &b.motion) {
        (None, None) => return None,
        (Some(_), Some(_)) => catoptric_metrics::motion_error(a, b).map_err(|e| e.to_string()),
        (Some(_), None) => Err("the second picture has no layers `motion`".to_owned()),
        (None, Some(_)) => Err("the first picture has no layers `motion`".to_owned()),
    };
    match judged {
        Ok(motion) => Some(motion),
        Err(reason) => {
            notes.push(format!("motion is not compared: {reason}"));
            None
        }
    }
}

/// All metrics. Where no pixel is a mirror's in both pictures, colour is that of the whole pictures.
fn of_layers(a: &Frame, b: &Frame, notes: &mut Vec<String>) -> anyhow::Result<Value> {
    let compared = catoptric_metrics::compare(a, b);
    let mut compared: Comparison = compared.map_err(|error| bad_input(error.to_string()))?;
    notes.extend(compared.non_finite.reason());
    let coverage = &compared.coverage;
    if coverage.mirror_pixels == 0 {
        let alone = match (coverage.mirror_only_reference, coverage.mirror_only_test) {
            (0, 0) => String::new(),
            (first, second) => {
                format!(" (only in the first: {first}, only in the second: {second})")
            }
        };
        notes.push(format!(
            "no pixel reflects in both pictures{alone}: colour alone, over the whole picture"
        ));
        compared.color = compared.regions.image;
        if let Some(color) = &compared.color {
            notes.extend(left_out(color.left_out));
        }
    }
    Ok(serde_json::to_value(compared)?)
}

/// Colour over the whole pictures.
fn of_color(a: &Frame, b: &Frame, notes: &mut Vec<String>) -> anyhow::Result<Value> {
    let everywhere = Image::filled(a.color.size(), true);
    let color = catoptric_metrics::compare_color(
        &a.color,
        &b.color,
        &everywhere,
        DEFAULT_PIXELS_PER_DEGREE,
    );
    let color = color.map_err(|error| bad_input(error.to_string()))?;
    notes.extend(left_out(color.map_or(0, |color| color.left_out)));
    let non_finite = |frame: &Frame| {
        let pixels = frame.color.pixels().iter();
        pixels.filter(|color| !color.is_finite()).count()
    };
    Ok(json!({
        "color": color,
        "non_finite": { "reference": non_finite(a), "test": non_finite(b) },
    }))
}

fn left_out(pixels: u64) -> Option<String> {
    (pixels > 0).then(|| {
        format!("left out of the means: {pixels} pixels whose colour is NaN or infinite in either picture")
    })
}

//! `catoptric report`: measure a suite of scenes and write one page about it.
//!
//! Measuring writes `record.json`, pictures and the page into the folder, after every scene; the
//! page is made from the others alone, so that the same record gives the same bytes.

mod diagrams;
pub mod page;
pub mod pictures;
mod views;
pub mod words;

use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::Context;

use crate::cli::{Common, SuiteArg};
use crate::exit::{Outcome, bad_input};
use crate::record::{self, Status};
use crate::setup::{self, Setup, Wanted};

/// Scenes of the quick suite: the first is the page's first picture.
const QUICK_SCENES: [&str; 8] = [
    "sphere-table",
    "sphere-objects-20k",
    "spheres",
    "ellipsoid",
    "bowl",
    "planar",
    "sphere-square",
    "sphere-touching",
];

/// Both published searches, what games use instead, the mirrored eye for flat mirrors, and the
/// control.
const TECHNIQUES: [&str; 5] = [
    "linear",
    "ray-hierarchy(repair=enlarge)",
    "environment-map",
    "planar",
    words::CONTROL,
];

/// Techniques on the scenes that show best what they are about: all of them on all scenes would take
/// the quick suite too long. They stand behind `linear`.
const FEATURED: [(&str, &[&str]); 5] = [
    // Few large triangles, and coarse models beside fine ones.
    ("linear+full(level=3)", &["sphere-square"]),
    (
        "linear+adaptive(level=3)",
        &["sphere-square", "sphere-table"],
    ),
    // The residual that 32 bits can resolve.
    (
        "linear(residual=cross,neighbours=8)",
        &["sphere-objects-20k", "spheres", "ellipsoid", "bowl"],
    ),
    // As its paper runs it: a triangle that the mirror hides in part is drawn.
    (
        "reflector-cubemap(depth=virtual,hidden=extend)",
        &["sphere-table", "ellipsoid", "sphere-touching"],
    ),
    (
        "cubemap-trace(pyramid=sound,sampling=texel)",
        &["sphere-table", "bowl", "sphere-touching"],
    ),
];

/// What is measured on a scene. `everywhere`: the featured techniques too, but for refinements, which
/// make of large scenes more triangles than time allows.
fn techniques(scene: &str, everywhere: bool) -> Vec<String> {
    let featured = FEATURED.iter().filter(|(technique, scenes)| {
        scenes.contains(&scene) || (everywhere && !technique.contains('+'))
    });
    let all = TECHNIQUES[..1].iter().copied();
    let all = all.chain(featured.map(|(technique, _)| *technique));
    let all = all.chain(TECHNIQUES[1..].iter().copied());
    all.map(str::to_owned).collect()
}

/// Seconds of timing in a whole quick suite: with all else it stays within three minutes.
const QUICK_TIMING: f64 = 40.0;
/// Seconds of timing for each scene of the full suite.
const FULL_TIMING: f64 = 6.0;
/// Picture size of the full suite.
const FULL_RESOLUTION: [u32; 2] = [640, 480];

/// Measures the suite and writes the page, by default into the folder `report`.
pub fn run(suite: SuiteArg, time_budget: Option<f64>, common: &Common) -> anyhow::Result<Outcome> {
    let folder = common
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from("report"));
    let (scenes, budget, common) = match suite {
        SuiteArg::Quick => (
            QUICK_SCENES.map(str::to_owned).to_vec(),
            QUICK_TIMING / QUICK_SCENES.len() as f64,
            common.clone(),
        ),
        SuiteArg::Full => {
            let resolution = common.resolution.or(Some(FULL_RESOLUTION));
            (
                available(common),
                FULL_TIMING,
                Common {
                    resolution,
                    ..common.clone()
                },
            )
        }
    };
    let timing = Duration::from_secs_f64(time_budget.unwrap_or(budget));
    let wanted: Vec<Wanted> = (scenes.iter())
        .flat_map(|scene| {
            setup::product(
                std::slice::from_ref(scene),
                &techniques(scene, suite == SuiteArg::Full),
                timing,
                None,
            )
        })
        .collect();
    let setup = Setup::new(&wanted, &common)?;
    make_folder(&folder)?;

    let record_path = folder.join("record.json");
    let rows = crate::measure(&setup, |measured, rows| {
        if let Some(measured) = measured {
            pictures::write(&measured, &folder, |_| true)?;
        }
        record::write(rows, &record_path)?;
        page::write(rows, setup.rows(), &folder).map(drop)
    })?;
    let index = page::write(&rows, setup.rows(), &folder)?;

    crate::print::text(&format!("{}\n", index.display()))?;
    let failed = rows
        .iter()
        .filter(|row| row.status == Status::Failed)
        .count();
    if failed > 0 {
        eprintln!(
            "catoptric: {failed} of {} rows failed; the report says why",
            rows.len()
        );
    }
    if rows.len() < setup.rows() {
        eprintln!(
            "catoptric: interrupted after {} of {} rows; the report says so",
            rows.len(),
            setup.rows()
        );
    }
    Ok(if failed > 0 || rows.len() < setup.rows() {
        Outcome::FellShort
    } else {
        Outcome::Done
    })
}

/// Names of the built-in scenes whose models are here.
fn available(common: &Common) -> Vec<String> {
    let infos = catoptric_scene::builtin::list(&setup::load_options(common));
    infos
        .into_iter()
        .filter(|info| info.available)
        .map(|info| info.name)
        .collect()
}

/// Makes the report's folder; where an earlier report is in it, without that one's pictures.
pub fn make_folder(folder: &Path) -> anyhow::Result<()> {
    if folder.is_file() {
        let text = format!("cannot write into {}: it is a file", folder.display());
        return Err(bad_input(text));
    }
    let unwritable = |error: std::io::Error| setup::unwritable(folder, &error);
    std::fs::create_dir_all(folder).map_err(unwritable)?;
    tempfile::NamedTempFile::new_in(folder).map_err(unwritable)?;
    let pictures = folder.join(pictures::FOLDER);
    let earlier = ["index.html", "record.json"]
        .iter()
        .all(|name| folder.join(name).is_file());
    if earlier && pictures.exists() {
        std::fs::remove_dir_all(&pictures)
            .with_context(|| format!("cannot empty {}", pictures.display()))?;
    }
    std::fs::create_dir_all(&pictures).map_err(unwritable)
}

//! What is checked: pictures, the scenes they show, and what is known about how they were made.

use std::path::{Path, PathBuf};

use anyhow::Context;
use catoptric_frame::Channels;
use catoptric_reference::{RayStart, Truth};
use catoptric_scene::{LoadOptions, Scene};
use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::exit::bad_input;
use crate::input;
use crate::options::{Common, MOST_BOUNCES, MOST_SAMPLES, TruthArg, samples};

/// What `check` is asked.
#[derive(Clone, Debug, Args)]
pub struct Request {
    /// One picture; without it, all that are stored
    pub file: Option<PathBuf>,
    /// The scene it shows: built-in name or scene file
    #[arg(long)]
    pub scene: Option<String>,
    /// Folder of the stored pictures, their sidecars and `scenes` [default: reference]
    #[arg(long, value_name = "DIR", conflicts_with = "file")]
    pub images: Option<PathBuf>,
    /// What its reflected rays see; default: as the picture or its sidecar says, else what fits
    #[arg(long, value_enum)]
    pub truth: Option<TruthArg>,
    /// Where our reflected rays start; default: both ways for Mitsuba's pictures with a sidecar
    #[arg(long, value_enum)]
    pub start: Option<StartArg>,
    /// Samples a pixel it was made with, in a regular grid; default: as its sidecar says, else 1
    #[arg(long, value_name = "N", value_parser = samples)]
    pub samples: Option<u32>,
    /// Write the comparisons as JUnit's XML
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
}

/// Where reflected rays start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StartArg {
    /// On the mirror
    Surface,
    /// Off the mirror, as far as Mitsuba moves them
    Mitsuba,
    /// Both: each picture is compared twice
    Both,
}

/// A picture by another renderer, and the scene it is to show.
pub struct Case {
    /// The picture's name, without folder and ending.
    pub name: String,
    /// The picture.
    pub channels: Channels,
    /// What it shows, as it is now.
    pub scene: Scene,
    /// Hash of the scene when the picture was made, if known and another one.
    pub stale: Option<String>,
    /// Rays along each side of a pixel.
    pub side: u32,
    /// What its reflected rays may see: the first of these that fits.
    pub truths: Vec<Truth>,
    /// Where our reflected rays start.
    pub starts: Vec<RayStart>,
}

/// The one picture that is asked for, or all stored ones by name.
pub fn cases(args: &Request, common: &Common) -> anyhow::Result<Vec<Case>> {
    match (&args.file, &args.scene) {
        (Some(file), _) if !file.exists() => Err(bad_input(format!(
            "cannot read {}: there is no such file; without a file all stored pictures are checked",
            file.display()
        ))),
        (Some(file), Some(scene)) => Ok(vec![case(file, scene, args, common)?]),
        (Some(file), None) => match Sidecar::of(file)?.and_then(|sidecar| sidecar.scene) {
            Some(name) => Ok(vec![case(file, &beside(file, &name), args, common)?]),
            None => Err(bad_input(format!(
                "{}: say which scene it shows: --scene SCENE",
                file.display()
            ))),
        },
        (None, Some(_)) => Err(bad_input(
            "--scene goes with a picture: check FILE.exr --scene SCENE",
        )),
        (None, None) => stored(args, common),
    }
}

/// Every picture in the folder of references.
fn stored(args: &Request, common: &Common) -> anyhow::Result<Vec<Case>> {
    let folder = folder(args)?;
    let entries = std::fs::read_dir(&folder)
        .with_context(|| format!("cannot read the folder {}", folder.display()))?;
    let mut files = entries
        .map(|entry| Ok(entry?.path()))
        .collect::<std::io::Result<Vec<_>>>()
        .with_context(|| format!("cannot read the folder {}", folder.display()))?;
    files.retain(|file| file.extension().is_some_and(|extension| extension == "exr"));
    files.sort();
    if files.is_empty() {
        return Err(bad_input(format!(
            "{}: holds no picture (*.exr)",
            folder.display()
        )));
    }
    let load = |file: &PathBuf| {
        let name = Sidecar::of(file)?.and_then(|sidecar| sidecar.scene);
        let name = name.ok_or_else(|| {
            bad_input(format!(
                "{}: no `scene` in {} beside it",
                file.display(),
                sidecar_path(file).display()
            ))
        })?;
        case(file, &beside(file, &name), args, common)
    };
    files.iter().map(load).collect()
}

/// `--images`, else `reference` here, else that of the checkout this program was built from.
fn folder(args: &Request) -> anyhow::Result<PathBuf> {
    if let Some(folder) = &args.images {
        return Ok(folder.clone());
    }
    let here = PathBuf::from("reference");
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference");
    [here, checkout]
        .into_iter()
        .find(|folder| folder.is_dir())
        .ok_or_else(|| {
            bad_input("no folder `reference` here: say where the pictures are, --images DIR")
        })
}

/// A scene file in the folder `scenes` beside a picture, else a built-in name.
fn beside(file: &Path, name: &str) -> String {
    let folder = file.parent().unwrap_or(Path::new(""));
    let scene = folder.join("scenes").join(format!("{name}.toml"));
    if scene.is_file() {
        scene.to_string_lossy().into_owned()
    } else {
        name.to_owned()
    }
}

fn case(file: &Path, scene: &str, args: &Request, common: &Common) -> anyhow::Result<Case> {
    let channels = Channels::read(file)?;
    let sidecar = Sidecar::of(file)?.unwrap_or_default();
    if let Some(asked) = common.resolution.filter(|asked| *asked != channels.size()) {
        let ([w, h], [width, height]) = (channels.size(), asked);
        return Err(bad_input(format!(
            "{} is {w}x{h} pixels, not {width}x{height}; without --resolution its own size is taken",
            file.display()
        )));
    }
    let scene = catoptric_scene::open(
        scene,
        &LoadOptions {
            models: common.models.clone(),
            resolution: Some(channels.size()),
        },
    )?;
    crate::exit::warn(&scene);
    let stale = sidecar.scene_hash.filter(|hash| *hash != scene.hash);
    let truths = truths(&channels, sidecar.bounces, args, common)?;
    let starts = match args.start {
        Some(StartArg::Surface) => vec![RayStart::Exact],
        Some(StartArg::Mitsuba) => vec![RayStart::Mitsuba],
        Some(StartArg::Both) => vec![RayStart::Exact, RayStart::Mitsuba],
        None if sidecar.renderer.as_deref() == Some("Mitsuba") => {
            vec![RayStart::Exact, RayStart::Mitsuba]
        }
        None => vec![RayStart::Exact],
    };
    let samples = args.samples.or(sidecar.samples).unwrap_or(1);
    let side = samples.isqrt();
    if side * side != samples {
        return Err(bad_input(format!(
            "{}: `settings.samples`, {samples} a pixel, is no regular grid: a square number is needed",
            sidecar_path(file).display()
        )));
    }
    Ok(Case {
        name: file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned(),
        channels,
        scene,
        stale,
        side,
        truths,
        starts,
    })
}

/// What a picture's reflected rays may see. The command line says, or the sidecar, or the layer
/// `bounces`, of which nothing exceeds the limit that it was made with. A picture that does not
/// say is tried as each of what it can be.
fn truths(
    channels: &Channels,
    from_sidecar: Option<u32>,
    args: &Request,
    common: &Common,
) -> anyhow::Result<Vec<Truth>> {
    let full = |bounces| Truth::Full { bounces };
    Ok(
        match (args.truth, from_sidecar, channels.integers("bounces")?) {
            (Some(TruthArg::FirstBounce), ..) => vec![Truth::FirstBounce],
            (Some(TruthArg::Full), ..) => vec![full(common.bounces)],
            (None, Some(bounces), _) => vec![full(bounces)],
            (None, None, Some(layer)) => {
                vec![full(layer.pixels().iter().copied().max().unwrap_or(1))]
            }
            (None, None, None) => vec![Truth::FirstBounce, full(common.bounces), full(1)],
        },
    )
}

/// The JSON file beside a picture, as far as it says something.
#[derive(Default)]
struct Sidecar {
    scene: Option<String>,
    scene_hash: Option<String>,
    renderer: Option<String>,
    samples: Option<u32>,
    bounces: Option<u32>,
}

fn sidecar_path(file: &Path) -> PathBuf {
    file.with_extension("json")
}

impl Sidecar {
    fn of(file: &Path) -> anyhow::Result<Option<Self>> {
        let path = sidecar_path(file);
        if !path.exists() {
            return Ok(None);
        }
        let value = input::json(&path)?;
        let refused = |key: &str, value: &Value, wanted: &str| {
            let found = input::brief(value);
            let path = path.display();
            bad_input(format!("{path}: `{key}` must be {wanted}, not {found}"))
        };
        let text = |key: &str| match value.get(key) {
            None | Some(Value::Null) => Ok(None),
            Some(Value::String(text)) => Ok(Some(text.clone())),
            Some(other) => Err(refused(key, other, "a text")),
        };
        let count = |key: &str, most: u32| {
            let value = &value["settings"][key];
            let counted = value.as_u64().and_then(|count| u32::try_from(count).ok());
            let counted = counted.filter(|count| (1..=most).contains(count));
            let wanted = || format!("a whole number from 1 to {most}");
            match counted {
                None if !value.is_null() => {
                    Err(refused(&format!("settings.{key}"), value, &wanted()))
                }
                counted => Ok(counted),
            }
        };
        Ok(Some(Self {
            scene: text("scene")?,
            scene_hash: text("scene_hash")?,
            renderer: text("renderer")?,
            samples: count("samples", MOST_SAMPLES)?,
            bounces: count("bounces", MOST_BOUNCES)?,
        }))
    }
}

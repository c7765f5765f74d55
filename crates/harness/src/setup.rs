//! Everything that measuring needs, checked before anything is rendered.

use std::path::Path;
use std::sync::atomic::Ordering;
use std::time::Duration;

use anyhow::Context;
use catoptric_reflect::{Gpu, Prefer, Spec, SpecError};
use catoptric_scene::{LoadOptions, Scene};

use crate::cli::Common;
use crate::exit::bad_input;
use crate::measure::Samples;
use crate::pipeline::{self, Blank, Compared, Rendered};
use crate::progress::Progress;
use crate::provenance;
use crate::record::{Adapter, Meta, Record, Status};

/// A scene that is asked for, and what to measure on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Built-in name or scene file.
    pub scene: String,
    /// Picture size; the command line's goes before it, the scene's own comes after it.
    pub resolution: Option<[u32; 2]>,
    /// Names of techniques, in the order of the rows.
    pub techniques: Vec<String>,
    /// Timing, shared by the techniques.
    pub timing: Duration,
    /// Frames of the scene's motion to follow; `None` for the first alone.
    pub frames: Option<u32>,
}

/// Every scene with every technique, each scene timed for `timing`.
pub fn product(
    scenes: &[String],
    techniques: &[String],
    timing: Duration,
    frames: Option<u32>,
) -> Vec<Wanted> {
    let wanted = |scene: &String| Wanted {
        scene: scene.clone(),
        resolution: None,
        techniques: techniques.to_vec(),
        timing,
        frames,
    };
    scenes.iter().map(wanted).collect()
}

/// A checked [`Wanted`].
pub struct Job {
    /// As asked for.
    pub name: String,
    /// The scene, or why it cannot be had here.
    pub scene: Result<Scene, String>,
    /// In the order of the rows.
    pub techniques: Vec<Spec>,
    /// Timing, shared by the techniques.
    pub timing: Duration,
    /// Frames of the scene's motion to follow; `None` for the first alone.
    pub frames: Option<u32>,
    /// Picture size asked for.
    resolution: Option<[u32; 2]>,
}

/// A checked request: scenes and techniques on an adapter.
pub struct Setup {
    /// In the order asked for.
    pub jobs: Vec<Job>,
    /// What renders.
    pub gpu: Gpu,
    /// Limit of the truth `full`.
    pub bounces: u32,
    /// What is said while working.
    pub progress: Progress,
    meta: Meta,
}

impl Setup {
    /// Loads scenes, parses techniques, opens the adapter: the input's faults first.
    pub fn new(wanted: &[Wanted], common: &Common) -> anyhow::Result<Self> {
        let techniques = wanted
            .iter()
            .map(|wanted| wanted.techniques.iter().map(|text| parse(text)).collect())
            .collect::<anyhow::Result<Vec<Vec<Spec>>>>()?;
        let jobs = wanted
            .iter()
            .zip(techniques)
            .map(|(wanted, techniques)| Job::load(wanted, techniques, common))
            .collect::<anyhow::Result<Vec<_>>>()?;
        let gpu = open_gpu(common)?;
        let limit = gpu.info().max_image;
        for scene in jobs.iter().filter_map(|job| job.scene.as_ref().ok()) {
            pipeline::check_size(pipeline::size(scene), limit, "this adapter")?;
        }
        let rows: usize = jobs.iter().map(|job| job.techniques.len()).sum();
        let progress = Progress::new(2 * rows, common.quiet);
        Ok(Self {
            jobs,
            gpu,
            bounces: common.bounces,
            progress,
            meta: provenance::meta(common.bounces),
        })
    }

    /// Says what one has to know beforehand, and from now on keeps what is finished when
    /// interrupted.
    pub fn begin(&self) {
        if self.gpu.info().software {
            let name = &self.gpu.info().name;
            self.progress.remark(&format!(
                "{name} renders on the CPU: its times say little about a GPU"
            ));
        }
        keep_what_is_finished(&self.progress);
    }

    /// How many rows were asked for.
    pub fn rows(&self) -> usize {
        self.jobs.iter().map(|job| job.techniques.len()).sum()
    }

    /// Rows of a scene that cannot be had.
    pub fn unavailable(&self, job: &Job, reason: &str) -> Vec<Record> {
        let row = |spec: &Spec| {
            let meta = self.meta.of_job(job, None);
            // A scene that could not be loaded has no picture size of its own to tell.
            let size = job.resolution.unwrap_or(DEFAULT_RESOLUTION);
            Record {
                adapter: Some(self.adapter()),
                ..Record::empty(&job.name, &spec.to_string(), size, meta)
            }
            .without(Status::NotApplicable, reason)
        };
        job.techniques.iter().map(row).collect()
    }

    /// The row of a technique, whatever became of it.
    pub fn record(
        &self,
        job: &Job,
        scene: &Scene,
        spec: &Spec,
        rendered: &Result<Rendered<'_>, Blank>,
        compared: Result<Compared, Blank>,
        samples: Option<Result<Samples, Blank>>,
    ) -> Record {
        let meta = self.meta.of_job(job, Some(scene));
        let row = Record::empty(&scene.name, &spec.to_string(), pipeline::size(scene), meta);
        let row = Record {
            adapter: Some(self.adapter()),
            ..row
        };
        let blank = |row: Record, (status, reason): Blank| row.without(status, reason);
        match (rendered, compared, samples.transpose()) {
            (Err(reason), ..) => blank(row, reason.clone()),
            (_, Err(reason), _) | (_, _, Err(reason)) => blank(row, reason),
            (Ok(rendered), Ok(compared), Ok(samples)) => {
                pipeline::record(row, rendered, compared, samples)
            }
        }
    }

    /// The adapter as records have it.
    pub fn adapter(&self) -> Adapter {
        let info = self.gpu.info();
        Adapter {
            name: info.name.clone(),
            driver: info.driver.clone(),
            backend: info.backend.clone(),
            software: info.software,
        }
    }
}

impl Job {
    fn load(wanted: &Wanted, techniques: Vec<Spec>, common: &Common) -> anyhow::Result<Self> {
        let resolution = common.resolution.or(wanted.resolution);
        let options = LoadOptions {
            resolution,
            ..load_options(common)
        };
        Ok(Self {
            name: wanted.scene.clone(),
            scene: pipeline::load(&wanted.scene, &options)?,
            techniques,
            timing: wanted.timing,
            frames: wanted.frames,
            resolution,
        })
    }
}

impl Meta {
    fn of_job(&self, job: &Job, scene: Option<&Scene>) -> Self {
        Self {
            scene_hash: scene.map(|scene| scene.hash.clone()),
            scene_why: scene.map(|scene| scene.why.clone()),
            time_budget_s: Some(job.timing.as_secs_f64()),
            ..self.clone()
        }
    }
}

/// Width and height where neither scene nor command line says.
const DEFAULT_RESOLUTION: [u32; 2] = [640, 480];

/// A technique by its name.
pub fn parse(text: &str) -> anyhow::Result<Spec> {
    match catoptric_reflect::parse(text) {
        // These name what is wrong themselves.
        Err(error @ (SpecError::Technique { .. } | SpecError::Unavailable { .. })) => {
            Err(error.into())
        }
        parsed => parsed.with_context(|| format!("technique `{text}`")),
    }
}

/// The common options, checked as far as every command can: an empty `--models` (or variable) is
/// none, any other must be a folder.
pub fn settled(mut common: Common) -> anyhow::Result<Common> {
    common.models = common
        .models
        .filter(|folder| !folder.as_os_str().is_empty());
    match &common.models {
        Some(folder) if !folder.is_dir() => Err(bad_input(format!(
            "--models (or the variable CATOPTRIC_MODELS): no folder {}",
            folder.display()
        ))),
        _ => Ok(common),
    }
}

/// Opens the adapter asked for; without a wish, hardware first.
pub fn open_gpu(common: &Common) -> anyhow::Result<Gpu> {
    Ok(Gpu::new(common.adapter.as_deref(), Prefer::Hardware)?)
}

/// How scenes are loaded under these options.
pub fn load_options(common: &Common) -> LoadOptions {
    LoadOptions {
        models: common.models.clone(),
        resolution: common.resolution,
    }
}

/// Refuses a file that could not be written, before any work is done.
pub fn check_writable(path: &Path) -> anyhow::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if path.is_dir() {
        return Err(bad_input(format!(
            "cannot write {}: it is a folder",
            path.display()
        )));
    }
    match tempfile::NamedTempFile::new_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => Err(unwritable(path, &error)),
    }
}

/// That nothing can be written there, without the name of the file that was tried.
pub fn unwritable(path: &Path, error: &std::io::Error) -> anyhow::Error {
    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    bad_input(format!("cannot write {}: {reason}", path.display()))
}

/// From now on Ctrl-C asks to stop after what is being done, a second one stops at once.
fn keep_what_is_finished(progress: &Progress) {
    let speaker = progress.clone();
    let handler = move || {
        if pipeline::INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        speaker.remark(
            "interrupted: finishing this scene, then keeping what there is (again to stop at once)",
        );
    };
    // Without the handler an interrupt ends the program at once, which is no reason to refuse work.
    let _ = ctrlc::set_handler(handler);
}

//! Everything that measuring needs, checked before anything is rendered.

use std::time::Duration;

use catoptric_reflect::{Gpu, Spec};
use catoptric_scene::{LoadOptions, Scene};

use crate::options::Common;
use crate::record::{Adapter, Meta, Record, Status};

use super::compare::Compared;
use super::interrupt::keep_what_is_finished;
use super::load::{self, check_size, load_options, open_gpu, parse, size};
use super::progress::Progress;
use super::render::{Rendered, RowError};
use super::sampling::Samples;
use super::{fill, provenance};

/// A scene that is asked for, and what to measure on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Built-in name or scene file.
    pub scene: String,
    /// Picture size; the command line's overrides it, and it overrides the scene's own.
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
            check_size(size(scene), limit, "this adapter")?;
        }
        let steps = jobs.iter().map(Job::steps).sum();
        let progress = Progress::new(steps, common.quiet);
        Ok(Self {
            jobs,
            gpu,
            bounces: common.bounces,
            progress,
            meta: provenance::meta(common.bounces),
        })
    }

    /// The same, for the part of a suite that is named so.
    pub fn of_part(mut self, part: Option<String>) -> Self {
        self.meta.part = part;
        self
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
        rendered: &Result<Rendered<'_>, RowError>,
        compared: Result<Compared, RowError>,
        samples: Option<Result<Samples, RowError>>,
    ) -> Record {
        let meta = self.meta.of_job(job, Some(scene));
        let row = Record::empty(&scene.name, &spec.to_string(), size(scene), meta);
        let row = Record {
            adapter: Some(self.adapter()),
            ..row
        };
        let blank = |row: Record, (status, reason): RowError| row.without(status, reason);
        match (rendered, compared, samples.transpose()) {
            (Err(reason), ..) => blank(row, reason.clone()),
            (_, Err(reason), _) | (_, _, Err(reason)) => blank(row, reason),
            (Ok(rendered), Ok(compared), Ok(samples)) => {
                fill::record(row, spec, rendered, compared, samples)
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
    /// Steps of progress: so many a row, and one for each frame that it is followed.
    pub fn steps(&self) -> usize {
        self.techniques.len() * (STEPS_A_ROW + self.followed().unwrap_or(0) as usize)
    }

    /// Frames of the scene's motion that its techniques are followed over; `None` where none are
    /// asked for, or nothing moves.
    pub fn followed(&self) -> Option<u32> {
        let scene = self.scene.as_ref().ok()?;
        self.frames.filter(|_| scene.motion.is_some())
    }

    fn load(wanted: &Wanted, techniques: Vec<Spec>, common: &Common) -> anyhow::Result<Self> {
        let resolution = common.resolution.or(wanted.resolution);
        let options = LoadOptions {
            resolution,
            ..load_options(common)
        };
        Ok(Self {
            name: wanted.scene.clone(),
            scene: load::load(&wanted.scene, &options)?,
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

/// Steps of progress a row: rendered, recorded.
const STEPS_A_ROW: usize = 2;

/// Width and height where neither scene nor command line says.
const DEFAULT_RESOLUTION: [u32; 2] = [640, 480];

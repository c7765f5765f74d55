//! The whole pipeline: load → trace the reference → render → compare → time → record.

use catoptric_reflect::Gpu;
use catoptric_scene::Scene;

use crate::record::Record;

use super::compare::compare;
use super::interrupt::interrupted;
use super::motion::follow;
use super::render::{Rendered, RowError, render};
use super::sampling::time;
use super::setup::Setup;
use super::truth::{Truth, trace_reference};
use super::vectors::judge;

/// What one scene gave: its rows in the order of the techniques, and what they were made from.
pub struct Measured<'a, 'g> {
    /// What rendered.
    pub gpu: &'g Gpu,
    /// What was looked at.
    pub scene: &'a Scene,
    /// What the techniques are judged by.
    pub truth: &'a Truth,
    /// By row: the technique and its picture, or why there is none.
    pub rendered: &'a [Result<Rendered<'g>, RowError>],
    /// In the order of the techniques.
    pub rows: &'a [Record],
}

/// Most techniques that are ready at once and timed in turn: all of them together would need too
/// much memory.
const IN_TURN: usize = 8;

/// Why a row has no `temporal` though frames were asked for.
const STILL: &str = "the scene has no [motion]: there are no frames to follow";

/// Load → trace the reference → render → compare → time → record, for every scene and technique.
/// `finished` is called after each scene, or each `IN_TURN` techniques of it, with the pictures
/// (`None` where the scene is not available) and with all rows so far.
pub fn measure(
    setup: &Setup,
    mut finished: impl FnMut(Option<Measured<'_, '_>>, &[Record]) -> anyhow::Result<()>,
) -> anyhow::Result<Vec<Record>> {
    setup.begin();
    let mut rows: Vec<Record> = Vec::new();
    for job in &setup.jobs {
        if interrupted() {
            break;
        }
        let scene = match &job.scene {
            Ok(scene) => scene,
            Err(reason) => {
                rows.extend(setup.unavailable(job, reason));
                setup.progress.steps(job.steps());
                finished(None, &rows)?;
                continue;
            }
        };
        let doing = |what: &str| setup.progress.doing(format!("{}: {what}", scene.name));
        let truth = trace_reference(scene, setup.bounces, &setup.progress)?;

        for techniques in job.techniques.chunks(IN_TURN) {
            if interrupted() && !rows.is_empty() {
                break;
            }
            let mut rendered = Vec::new();
            for spec in techniques {
                doing(&format!("rendering {spec}"));
                rendered.push(render(&setup.gpu, spec, scene));
                setup.progress.step();
            }

            let mut compared = Vec::new();
            for (spec, row) in techniques.iter().zip(&rendered) {
                doing(&format!("comparing {spec}"));
                let output = row.as_ref().map(|row| &row.output).map_err(Clone::clone);
                compared.push(output.and_then(|output| compare(scene, &truth, output)));
            }

            doing("following the motion of reflections");
            judge(&mut rendered, scene, job.frames)?;

            doing("timing");
            let share = techniques.len() as f64 / job.techniques.len() as f64;
            let timed = time(&mut rendered, job.timing.mul_f64(share));

            if let Some(frames) = job.followed() {
                let all = techniques.len();
                follow(&mut rendered, scene, frames, |frame| {
                    setup.progress.steps(if frame > 0 { all } else { 0 });
                    doing(&format!("following, frame {} of {frames}", frame + 1));
                })?;
                setup.progress.steps(all);
            }

            let first = rows.len();
            let parts = techniques.iter().zip(&rendered).zip(compared).zip(timed);
            for (((spec, rendered), compared), samples) in parts {
                let mut row = setup.record(job, scene, spec, rendered, compared, samples);
                if job.frames.is_some() && job.followed().is_none() {
                    row.meta.notes.push(STILL.to_owned());
                }
                rows.push(row);
                setup.progress.step();
            }
            let measured = Measured {
                gpu: &setup.gpu,
                scene,
                truth: &truth,
                rendered: &rendered,
                rows: &rows[first..],
            };
            finished(Some(measured), &rows)?;
        }
    }
    setup.progress.finish();
    Ok(rows)
}

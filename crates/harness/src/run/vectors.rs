//! Where reflections were a frame before: the answers of those techniques that say so, judged over
//! pairs of frames.

use catoptric_frame::{Frame, Image};
use catoptric_metrics::{MotionSamples, motion_map, reprojected};
use catoptric_reference::{Follow, RenderOptions, Truth};
use catoptric_scene::Scene;
use glam::Vec3;

use crate::record::Status;

use super::interrupt::interrupted;
use super::load::size;
use super::render::{Fetched, Rendered, RowError, one_line};

/// Frames that are looked at where nobody says how many: one pair.
const FRAMES: u32 = 2;

/// Judges the rows that estimate motion over the first `frames` frames of the scene's motion, each
/// against the one before. They stand at the last of them afterwards, so that what is timed next is a
/// moving frame. An interrupt ends the sequence early.
///
/// # Errors
/// A scene that cannot be traced. What breaks in one technique breaks its row alone.
pub fn judge(
    rows: &mut [Result<Rendered<'_>, RowError>],
    scene: &Scene,
    frames: Option<u32>,
) -> anyhow::Result<()> {
    let estimates = |row: &Result<Rendered<'_>, RowError>| matches!(row, Ok(rendered) if rendered.estimates_motion);
    if !rows.iter().any(estimates) {
        return Ok(());
    }
    let last = frames.unwrap_or(FRAMES).min(scene.frames().max(FRAMES));
    let size = size(scene);
    let mut samples: Vec<MotionSamples> = rows.iter().map(|_| MotionSamples::default()).collect();
    let mut before = None;
    for frame in 1..last {
        if interrupted() && frame > 1 {
            break;
        }
        let posed = [frame - 1, frame].map(|frame| scene.at(frame));
        let follow = Follow::new(scene, [frame, frame - 1], size)?;
        let [now, earlier] = follow.tracers();
        let options = RenderOptions::new(size, Truth::FirstBounce);
        let colors = before.unwrap_or_else(|| earlier.render(&options).color);
        let mut truth = now.render(&options);
        truth.motion = Some(follow.layer(None));
        for (row, samples) in rows.iter_mut().zip(&mut samples) {
            let Ok(rendered) = row else { continue };
            if !rendered.estimates_motion {
                continue;
            }
            let judged = (|| {
                let prepared = &mut rendered.prepared;
                if frame == 1 {
                    prepared.update(&posed[0]).map_err(|error| failed(&error))?;
                }
                prepared.update(&posed[1]).map_err(|error| failed(&error))?;
                let output = prepared.render().map_err(|error| failed(&error))?;
                rendered.output.work = output.work;
                let added = samples.add(&truth, &output.frame, Some(&colors));
                added.map_err(|error| failed(&error))?;
                rendered.fetched = fetched(&truth, &output.frame, &colors);
                Ok(())
            })();
            if let Err(broken) = judged {
                *row = Err(broken);
            }
        }
        before = Some(truth.color);
    }
    for (row, samples) in rows.iter_mut().zip(samples) {
        if let Ok(rendered) = row {
            rendered.motion = samples.report();
        }
    }
    Ok(())
}

/// What a viewer would see; `None` where a layer is missing.
fn fetched(truth: &Frame, frame: &Frame, before: &Image<Vec3>) -> Option<Fetched> {
    let (known, motion) = (&truth.motion.as_ref()?.valid, frame.motion.as_ref()?);
    Some(Fetched {
        picture: reprojected(&truth.color, before, motion, |index| known.pixels()[index]),
        error: motion_map(truth, frame).ok()?,
    })
}

fn failed(error: &dyn std::error::Error) -> RowError {
    (Status::Failed, one_line(error))
}

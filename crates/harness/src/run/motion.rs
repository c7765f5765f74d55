//! `--frames N`: a technique followed over the frames of a scene's motion.
//!
//! Frame 0 is the scene as written. Each technique walks through the frames twice: once with all
//! layers, where each vertex' error (found − true, in pixels) is followed from frame to frame, and
//! once as an application would draw, to be timed, between as many frames at rest. Where something is carried from one frame to
//! the next (`start=previous`), it is so in both.

use catoptric_frame::Frame;
use catoptric_metrics::{Timing, temporal, vertex_errors};
use catoptric_reference::true_vertices;
use catoptric_reflect::{Output, Prepared};
use catoptric_scene::Scene;

use crate::record::{Status, Steadiness};

use super::compare::in_view;
use super::interrupt::interrupted;
use super::load::size;
use super::render::{Rendered, RowError, one_line};

/// Follows a technique over `frames` frames of the scene's motion.
pub fn follow(
    rendered: &mut Result<Rendered<'_>, RowError>,
    scene: &Scene,
    frames: u32,
) -> Result<(), RowError> {
    if let Ok(rendered) = rendered {
        rendered.temporal = steadiness(&mut rendered.prepared, scene, frames)?;
    }
    Ok(())
}

/// Follows a technique over `frames` frames; an interrupt ends the sequence early. `None` where
/// the technique searches no vertices, or where their exact reflection points are not known.
fn steadiness(
    prepared: &mut Prepared<'_>,
    scene: &Scene,
    frames: u32,
) -> Result<Option<Steadiness>, RowError> {
    let failed = |error: &dyn std::error::Error| (Status::Failed, one_line(error));
    let mut errors = Vec::new();
    let (mut evaluations, mut steps) = (Vec::new(), Vec::new());
    for frame in 0..frames {
        if interrupted() && frame >= 2 {
            break;
        }
        let posed = scene.at(frame);
        prepared.update(&posed).map_err(|error| failed(&error))?;
        let output = prepared.render().map_err(|error| failed(&error))?;
        let Some(found) = frame_errors(&posed, &output).map_err(|error| failed(&error))? else {
            return Ok(None);
        };
        errors.push(found);
        if frame > 0 {
            evaluations.extend(output.work.evaluations);
            steps.extend(output.work.steps);
        }
    }
    let mut timed = |moving: bool, frames: usize| -> Result<Vec<Option<f64>>, RowError> {
        let mut times = Vec::new();
        for frame in 0..frames as u32 {
            let posed = scene.at(if moving { frame } else { 0 });
            prepared.update(&posed).map_err(|error| failed(&error))?;
            let time = prepared.time_frame().map_err(|error| failed(&error))?;
            times.push(time.gpu_ms);
        }
        Ok(times)
    };
    let before = errors.len() / 2;
    let mut still = timed(false, before)?;
    let moving = timed(true, errors.len())?;
    still.extend(timed(false, errors.len() - before)?);
    let median = |times: Vec<Option<f64>>| {
        let times: Option<Vec<f64>> = times.into_iter().collect();
        Some(Timing::of(&times?)?.median)
    };
    prepared.update(scene).map_err(|error| failed(&error))?;
    let mean = |values: &[f64]| {
        let sum: f64 = values.iter().sum();
        (!values.is_empty()).then(|| sum / values.len() as f64)
    };
    Ok(Some(Steadiness {
        points: temporal(&errors),
        frame_ms: median(moving),
        still_ms: median(still),
        evaluations: mean(&evaluations),
        steps: mean(&steps),
    }))
}

/// Found − true of every pair in one frame. The technique's own picture says where its mirrors
/// are: they are the reference's but for single pixels of their outline.
fn frame_errors(
    scene: &Scene,
    output: &Output,
) -> Result<Option<Vec<Option<glam::DVec2>>>, catoptric_metrics::MetricsError> {
    let frame: &Frame = &output.frame;
    let truth = true_vertices(scene, &scene.camera.view(size(scene)));
    let (Some(results), Ok(truth)) = (&output.vertices, truth) else {
        return Ok(None);
    };
    vertex_errors(results, &truth, |pair, at| in_view(scene, frame, pair, at)).map(Some)
}

//! `--frames N`: techniques followed over the frames of a scene's motion.
//!
//! Frame 0 is the scene as written. Each technique goes through the frames twice. Once it renders all layers: its
//! picture is judged by the reference of that frame, and each vertex' error (found − true, in pixels) is followed from
//! frame to frame. Once it draws as an application would, to be timed, alternating with as many frames at rest. Where
//! something is carried from one frame to the next (`start=previous`), it is carried both times.

use catoptric_frame::{Frame, TrueVertex};
use catoptric_metrics::{
    MetricsError, Timing, crack_pixels, object_agreement, paired, temporal, vertex_errors,
};
use catoptric_reference::{NotAvailable, RenderOptions, Tracer, Truth, true_vertices};
use catoptric_reflect::Output;
use catoptric_scene::Scene;
use glam::DVec2;

use crate::record::{Status, Steadiness};

use super::compare::in_view;
use super::interrupt::interrupted;
use super::load::size;
use super::render::{Rendered, RowError, one_line};

/// What was seen of a technique over the frames so far.
#[derive(Default)]
struct Seen {
    /// Found − true of every pair, by frame; empty where the technique searches no vertices, or
    /// where their exact reflection points are not known.
    errors: Vec<Vec<Option<DVec2>>>,
    frames: u64,
    object_agreement_min: Option<f64>,
    crack_pixels_max: Option<u64>,
    t_junctions_max: Option<u64>,
    /// How deep each triangle was split in the last frame.
    levels: Option<Vec<u8>>,
    /// Triangles whose depth changed, by frame from the second on.
    changed: Vec<f64>,
    /// From the second frame on.
    evaluations: Vec<f64>,
    steps: Vec<f64>,
    /// Of the last frame.
    node_tests: Option<f64>,
}

/// Follows techniques, except estimators of motion, over `frames` frames of the scene's motion. All of them render a
/// frame before any renders the next, so that each frame's truth is computed only once. An interrupt ends the sequence
/// early. `begin` is called before each frame.
///
/// # Errors
/// A scene that cannot be traced. What breaks in one technique breaks its row alone.
pub fn follow(
    rows: &mut [Result<Rendered<'_>, RowError>],
    scene: &Scene,
    frames: u32,
    begin: impl Fn(u32),
) -> anyhow::Result<()> {
    let followed = |row: &Result<Rendered<'_>, RowError>| matches!(row, Ok(rendered) if !rendered.estimates_motion);
    if !rows.iter().any(followed) {
        return Ok(());
    }
    let mut seen: Vec<Seen> = rows.iter().map(|_| Seen::default()).collect();
    for frame in 0..frames {
        if interrupted() && frame >= 2 {
            break;
        }
        begin(frame);
        let posed = scene.at(frame);
        let options = RenderOptions::new(size(&posed), Truth::FirstBounce);
        let reference = Tracer::new(&posed)?.render(&options);
        let exact = true_vertices(&posed, &posed.camera.view(size(&posed)));
        for (row, seen) in rows.iter_mut().zip(&mut seen) {
            let Ok(rendered) = row else { continue };
            if rendered.estimates_motion {
                continue;
            }
            if let Err(broken) = seen.look(rendered, &posed, &reference, &exact) {
                *row = Err(broken);
            }
        }
    }
    for (row, seen) in rows.iter_mut().zip(seen) {
        let Ok(rendered) = row else { continue };
        if rendered.estimates_motion {
            continue;
        }
        match seen.steadiness(rendered, scene) {
            Ok(steadiness) => rendered.temporal = Some(steadiness),
            Err(broken) => *row = Err(broken),
        }
    }
    Ok(())
}

fn failed(error: &dyn std::error::Error) -> RowError {
    (Status::Failed, one_line(error))
}

impl Seen {
    /// Renders a frame and judges it.
    fn look(
        &mut self,
        rendered: &mut Rendered<'_>,
        posed: &Scene,
        reference: &Frame,
        exact: &Result<Vec<TrueVertex>, NotAvailable>,
    ) -> Result<(), RowError> {
        let prepared = &mut rendered.prepared;
        prepared.update(posed).map_err(|error| failed(&error))?;
        let output = prepared.render().map_err(|error| failed(&error))?;
        let agreement = object_agreement(reference, &output.frame).map_err(|e| failed(&e))?;
        let least = self.object_agreement_min.into_iter().chain(agreement);
        self.object_agreement_min = least.reduce(f64::min);
        let cracks = crack_pixels(reference, &output.frame).map_err(|e| failed(&e))?;
        self.crack_pixels_max = self.crack_pixels_max.max(cracks);
        self.t_junctions_max = self.t_junctions_max.max(output.t_junctions);
        if let (Some(before), Some(now)) = (&self.levels, &output.levels) {
            self.changed.push(changed(before, now));
        }
        self.levels.clone_from(&output.levels);
        let errors = frame_errors(posed, &output, exact).map_err(|error| failed(&error))?;
        self.errors.extend(errors);
        if self.frames > 0 {
            self.evaluations.extend(output.work.evaluations);
            self.steps.extend(output.work.steps);
        }
        self.node_tests = output.work.node_tests;
        self.frames += 1;
        Ok(())
    }

    /// The summary, with the frames timed.
    fn steadiness(
        self,
        rendered: &mut Rendered<'_>,
        scene: &Scene,
    ) -> Result<Steadiness, RowError> {
        let prepared = &mut rendered.prepared;
        // A frame that has just moved and one that rests in the same pose, in turn: what else the
        // pose changes, and what else the machine does, both have.
        let (mut moving, mut still) = (Vec::new(), Vec::new());
        for frame in 0..self.frames as u32 {
            let posed = scene.at(frame);
            prepared.update(&posed).map_err(|error| failed(&error))?;
            for times in [&mut moving, &mut still] {
                let time = prepared.time_frame().map_err(|error| failed(&error))?;
                times.push(time.gpu_ms);
            }
        }
        let all = |times: Vec<Option<f64>>| times.into_iter().collect::<Option<Vec<f64>>>();
        let (moving, still) = (all(moving), all(still));
        let added = moving.as_deref().zip(still.as_deref());
        let median = |times: Option<Vec<f64>>| Some(Timing::of(&times?)?.median);
        prepared.update(scene).map_err(|error| failed(&error))?;
        let mean = |values: &[f64]| {
            let sum: f64 = values.iter().sum();
            (!values.is_empty()).then(|| sum / values.len() as f64)
        };
        let mut points = temporal(&self.errors);
        points.frames = self.frames;
        Ok(Steadiness {
            points,
            object_agreement_min: self.object_agreement_min,
            crack_pixels_max: self.crack_pixels_max,
            t_junctions_max: self.t_junctions_max,
            triangles_changed: mean(&self.changed),
            added_ms: added.and_then(|(moving, still)| paired(still, moving)),
            frame_ms: median(moving),
            still_ms: median(still),
            evaluations: mean(&self.evaluations),
            steps: mean(&self.steps),
            moved_node_tests: self.node_tests,
        })
    }
}

/// How many triangles are drawn in both of two frames, but split to another depth.
fn changed(before: &[u8], now: &[u8]) -> f64 {
    let pairs = before.iter().zip(now);
    let changed = pairs.filter(|(before, now)| **before > 0 && **now > 0 && before != now);
    changed.count() as f64
}

/// Found − true of every pair in one frame. The technique's own picture says where its mirrors
/// are: they are the reference's but for single pixels of their outline.
fn frame_errors(
    scene: &Scene,
    output: &Output,
    exact: &Result<Vec<TrueVertex>, NotAvailable>,
) -> Result<Option<Vec<Option<DVec2>>>, MetricsError> {
    let frame: &Frame = &output.frame;
    let (Some(results), Ok(exact)) = (&output.vertices, exact) else {
        return Ok(None);
    };
    vertex_errors(results, exact, |pair, at| in_view(scene, frame, pair, at)).map(Some)
}

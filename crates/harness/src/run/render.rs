//! Load → trace the reference → **render** → compare → time → record.

use std::time::Instant;

use catoptric_frame::{Frame, Image, Traced};
use catoptric_metrics::MotionError;
use catoptric_reflect::{
    Answer, FrameTime, Gpu, Output, Prepared, Question, ReflectError, Spec, Support,
};
use catoptric_scene::Scene;
use glam::Vec3;

use crate::record::{Status, Steadiness};

use super::load::size;

/// A technique that stands ready, and its picture with all layers.
pub struct Rendered<'g> {
    pub(super) prepared: Prepared<'g>,
    pub(super) prepare_ms: f64,
    /// Over the frames of the scene's motion, once it has been followed there.
    pub(super) temporal: Option<Steadiness>,
    /// Whether it says where reflections were a frame before.
    pub(super) estimates_motion: bool,
    /// How far off that is, once it has been judged.
    pub(super) motion: Option<MotionError>,
    /// What a viewer would see of that motion, in the last pair of frames that was judged.
    pub fetched: Option<Fetched>,
    /// Picture, vertices, triangles and work.
    pub output: Output,
    /// What the rays of that picture took, where they are followed step by step.
    pub traced: Option<Traced>,
}

/// What vectors of motion give.
pub struct Fetched {
    /// This frame's picture with, in the mirrors, the colours that the vectors fetch from the frame before.
    pub picture: Image<Vec3>,
    /// How far each vector is off, in pixels: NaN without a true one, infinite without an answer.
    pub error: Image<f32>,
}

impl Rendered<'_> {
    /// Asks what goes on inside the technique; `None` if there is no such thing in it.
    ///
    /// # Errors
    /// As when preparing.
    pub fn ask(&self, question: Question) -> Result<Option<Answer>, ReflectError> {
        self.prepared.ask(question)
    }

    /// Renders and times what an application would draw.
    ///
    /// # Errors
    /// Whatever fails on the device.
    pub fn time_frame(&mut self) -> Result<FrameTime, ReflectError> {
        self.prepared.time_frame()
    }
}

/// Why a row has no numbers: its status and a reason.
pub type RowError = (Status, String);

/// Prepares a technique and renders one frame with all layers: the first one, or, if a technique starts
/// from the frame before, the second, as when it is timed.
pub fn render<'g>(gpu: &'g Gpu, spec: &Spec, scene: &Scene) -> Result<Rendered<'g>, RowError> {
    if let Support::No(reason) = catoptric_reflect::supports(spec, scene) {
        return Err((Status::NotApplicable, reason));
    }
    let failed = |error: ReflectError| match error {
        ReflectError::Adapter(_) => (Status::NotApplicable, one_line(&error)),
        _ => (Status::Failed, one_line(&error)),
    };
    let start = Instant::now();
    let mut prepared = catoptric_reflect::prepare(gpu, spec, scene, size(scene)).map_err(failed)?;
    let prepare_ms = start.elapsed().as_secs_f64() * 1e3;
    prepared.settle().map_err(failed)?;
    let output = prepared.render().map_err(failed)?;
    let traced = match prepared.ask(Question::Traced).map_err(failed)? {
        Some(Answer::Traced(traced)) => Some(traced),
        _ => None,
    };
    Ok(Rendered {
        prepared,
        prepare_ms,
        temporal: None,
        estimates_motion: spec.properties().estimates_motion,
        motion: None,
        fetched: None,
        output,
        traced,
    })
}

/// A technique's picture of a frame of the scene's motion. One that says where reflections were a
/// frame before is shown that frame first.
pub fn render_frame(gpu: &Gpu, spec: &Spec, scene: &Scene, frame: u32) -> Result<Frame, RowError> {
    if frame == 0 || !spec.properties().estimates_motion {
        return Ok(render(gpu, spec, &scene.at(frame))?.output.frame);
    }
    let failed = |error: ReflectError| (Status::Failed, one_line(&error));
    let mut rendered = render(gpu, spec, &scene.at(frame - 1))?;
    let prepared = &mut rendered.prepared;
    prepared.update(&scene.at(frame)).map_err(failed)?;
    Ok(prepared.render().map_err(failed)?.frame)
}

/// An error and its causes in one line.
pub fn one_line(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(": ")
}

//! A technique at work: what a caller holds.

use std::time::Instant;

use catoptric_scene::Scene;

use crate::diagnostics::{Answer, Question};
use crate::error::ReflectError;
use crate::gpu::{FrameTime, Gpu, Timer};
use crate::stage::variant::Variant;
use crate::technique::{Built, Output, Technique};

/// A technique that stands ready to render one scene.
pub struct Prepared<'g> {
    gpu: &'g Gpu,
    technique: Box<dyn Technique>,
    timer: Timer,
}

impl<'g> Prepared<'g> {
    pub(crate) fn new(gpu: &'g Gpu, technique: Box<dyn Technique>) -> Self {
        Self {
            gpu,
            technique,
            timer: Timer::new(gpu),
        }
    }

    /// Renders a frame if the technique carries answers from frame to frame, so that the next frame
    /// is like the second one of a still scene; does nothing for others.
    ///
    /// # Errors
    /// As [`Prepared::render`].
    pub fn settle(&mut self) -> Result<(), ReflectError> {
        if self.technique.carries_over() {
            self.render()?;
        }
        Ok(())
    }

    /// Renders a frame with all layers and counts the work.
    ///
    /// # Errors
    /// As when preparing.
    pub fn render(&mut self) -> Result<Output, ReflectError> {
        self.gpu.begin();
        loop {
            self.technique.begin_frame(self.gpu)?;
            self.gpu.run(|frame| {
                self.technique.record(frame, Variant::AllLayers);
            });
            self.gpu.wait();
            self.gpu.check()?;
            if !self.technique.outgrown(self.gpu)? {
                break;
            }
        }
        let output = self.technique.output(self.gpu);
        self.gpu.check()?;
        Ok(output)
    }

    /// Renders a frame as an application would, colour and depth only, and times it.
    ///
    /// # Errors
    /// As [`Prepared::render`].
    pub fn time_frame(&mut self) -> Result<FrameTime, ReflectError> {
        self.gpu.begin();
        loop {
            let start = Instant::now();
            let built = self.technique.begin_frame(self.gpu)?;
            let build_ms = (built == Built::OnTheCpu).then(|| start.elapsed().as_secs_f64() * 1e3);
            let time = self.timer.time(self.gpu, |frame| {
                self.technique.record(frame, Variant::Color);
            });
            self.gpu.check()?;
            // A frame that was not drawn whole is no frame.
            if !self.technique.outgrown(self.gpu)? {
                return Ok(FrameTime { build_ms, ..time });
            }
        }
    }

    /// Asks what goes on inside the technique; `None` if there is no such thing in it.
    ///
    /// # Errors
    /// As when preparing.
    pub fn ask(&self, question: Question) -> Result<Option<Answer>, ReflectError> {
        self.gpu.begin();
        let answer = self.technique.answer(self.gpu, question)?;
        self.gpu.check()?;
        Ok(answer)
    }

    /// Takes over what moved since the last frame: eye, object vertices, mirrors. Only what the
    /// motion affects is prepared anew.
    ///
    /// # Errors
    /// A scene with other objects, triangles or mirrors than the one prepared for; whatever fails on
    /// the device.
    pub fn update(&mut self, scene: &Scene) -> Result<(), ReflectError> {
        self.gpu.begin();
        self.technique.update(self.gpu, scene)?;
        self.gpu.check()?;
        Ok(())
    }
}

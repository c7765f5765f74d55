//! A scene as it stands at a frame.

use crate::hash::hash;
use crate::motion::Subject;
use crate::scene::Scene;

impl Scene {
    /// Number of frames; 1 where nothing moves.
    pub fn frames(&self) -> u32 {
        self.motion.as_ref().map_or(1, |motion| motion.frames)
    }

    /// The scene as it stands at a frame, with nothing moving any more and the hash of what it
    /// shows. Frame 0 is the scene as written; past the last frame everything stays where it is.
    pub fn at(&self, frame: u32) -> Self {
        let mut posed = Self {
            motion: None,
            ..self.clone()
        };
        let Some(motion) = &self.motion else {
            return posed;
        };
        let time = motion.time(frame);
        if time == 0.0 {
            return posed;
        }
        posed.camera = motion.camera_at(&self.camera, time);
        for step in &motion.moves {
            let pose = step.pose(time);
            match step.subject {
                Subject::Object(index) => pose.carry(&mut posed.objects[index].mesh),
                Subject::Mirror(index) => {
                    let mirror = &mut posed.mirrors[index];
                    mirror.shape.carry(&pose);
                    for proxy in &mut mirror.proxies {
                        pose.carry(proxy);
                    }
                    mirror.pose = pose;
                }
            }
        }
        posed.hash = hash(
            &posed.camera,
            &posed.background,
            &posed.objects,
            &posed.mirrors,
        );
        posed
    }
}

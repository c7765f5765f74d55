//! Motion: where camera, objects and mirrors are from frame to frame.
//!
//! Time runs from 0 at the first frame, which is the scene as written, to 1 at the last: evenly, or
//! in steps that grow.
//! Everything that moves does so rigidly, and a moved mesh keeps its vertices in their order, so
//! that a vertex is the same one in all frames.

use glam::{DMat3, DVec3};

use crate::camera::Camera;
use crate::pose::Pose;

/// How a scene changes over its frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Frames of the whole sequence, at least 2.
    pub frames: u32,
    /// How many times as long each step of time is as the one before; 1: time runs evenly.
    pub growth: f64,
    /// Where the camera goes.
    pub camera: CameraPath,
    /// What else moves: at most one entry for each object and mirror.
    pub moves: Vec<Move>,
}

/// Where the camera goes.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraPath {
    /// Nowhere.
    Still,
    /// The eye turns around the axis through the target along the camera's `up`.
    Orbit {
        /// Angle by the last frame in radians, counter-clockwise seen from above.
        angle: f64,
    },
    /// Eye and target run through points that are evenly spaced in time, the first being where
    /// the camera starts: along a straight line if there are two, else along a Catmull–Rom spline.
    Keys {
        /// Eye positions, never empty.
        eye: Vec<DVec3>,
        /// Target positions, never empty.
        target: Vec<DVec3>,
    },
}

/// A rigid motion of one object or mirror.
#[derive(Clone, Debug, PartialEq)]
pub struct Move {
    /// What moves.
    pub subject: Subject,
    /// Angles in degrees of the rotation Rz·Ry·Rx by the last frame; each grows evenly.
    pub rotate_deg: DVec3,
    /// World-space point around which it rotates.
    pub about: DVec3,
    /// Translation by the last frame, world space, along a straight line at an even pace, after the
    /// rotation.
    pub translate: DVec3,
}

/// What a [`Move`] moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Index into the scene's objects.
    Object(usize),
    /// Index into the scene's mirrors.
    Mirror(usize),
}

impl Motion {
    /// Time in [0, 1] of a frame.
    pub fn time(&self, frame: u32) -> f64 {
        self.time_between(f64::from(frame))
    }

    /// Time in [0, 1] of a moment between frames, such as 1.5 between the second and the third.
    pub fn time_between(&self, frame: f64) -> f64 {
        let last = f64::from(self.frames.max(2) - 1);
        let frame = frame.clamp(0.0, last);
        if self.growth == 1.0 {
            return frame / last;
        }
        (self.growth.powf(frame) - 1.0) / (self.growth.powf(last) - 1.0)
    }

    /// The camera at a time, from where it starts.
    pub fn camera_at(&self, start: &Camera, time: f64) -> Camera {
        let mut camera = start.clone();
        match &self.camera {
            CameraPath::Still => {}
            CameraPath::Orbit { angle } => {
                let turn = DMat3::from_axis_angle(start.up.normalize(), angle * time);
                camera.eye = start.target + turn * (start.eye - start.target);
            }
            CameraPath::Keys { eye, target } => {
                camera.eye = spline(eye, time);
                camera.target = spline(target, time);
            }
        }
        camera
    }

    /// How something has moved by a time, from where it stands in the scene as written.
    pub fn pose(&self, subject: Subject, time: f64) -> Pose {
        let mut moves = self.moves.iter();
        let step = moves.find(|step| step.subject == subject);
        step.map_or(Pose::REST, |step| step.pose(time))
    }
}

impl Move {
    /// Where its subject is at a time in [0, 1].
    pub(crate) fn pose(&self, time: f64) -> Pose {
        Pose::new(self.rotate_deg * time, self.about, self.translate * time)
    }
}

/// A point of the Catmull–Rom spline through evenly spaced points, which goes on straight beyond
/// both ends; `time` in [0, 1].
fn spline(points: &[DVec3], time: f64) -> DVec3 {
    let [first, .., last] = points else {
        return points[0];
    };
    let pieces = points.len() - 1;
    let place = time * pieces as f64;
    let piece = (place as usize).min(pieces - 1);
    let share = place - piece as f64;
    let (from, to) = (points[piece], points[piece + 1]);
    let before = match piece {
        0 => 2.0 * first - to,
        _ => points[piece - 1],
    };
    let after = match points.get(piece + 2) {
        Some(after) => *after,
        None => 2.0 * last - from,
    };
    let (leaving, arriving) = ((to - before) / 2.0, (after - from) / 2.0);
    from.lerp(to, share)
        + share
            * (1.0 - share)
            * ((1.0 - share) * (leaving - (to - from)) - share * (arriving - (to - from)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_step_of_time_is_so_many_times_the_one_before() {
        for growth in [1.0, 1.8, 0.5] {
            let motion = Motion {
                frames: 12,
                growth,
                camera: CameraPath::Still,
                moves: Vec::new(),
            };
            assert_eq!(
                [motion.time(0), motion.time(11), motion.time(99)],
                [0.0, 1.0, 1.0]
            );
            let steps: Vec<_> = (1..12)
                .map(|frame| motion.time(frame) - motion.time(frame - 1))
                .collect();
            for pair in steps.windows(2) {
                assert!((pair[1] / pair[0] - growth).abs() < 1e-9, "{steps:?}");
            }
        }
    }

    #[test]
    fn a_spline_meets_its_points_and_is_straight_between_two() {
        let points = [
            DVec3::ZERO,
            DVec3::new(1.0, 2.0, 0.0),
            DVec3::new(4.0, 0.0, 1.0),
            DVec3::new(4.0, 1.0, 5.0),
        ];
        for (index, point) in points.iter().enumerate() {
            assert!(spline(&points, index as f64 / 3.0).distance(*point) < 1e-12);
        }
        for time in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let expected = points[0].lerp(points[1], time);
            assert!(spline(&points[..2], time).distance(expected) < 1e-15);
        }
        // The same velocity on both sides of a point: half the way between its neighbours.
        let step = 1e-6;
        let at = |time: f64| spline(&points, time);
        let before = (at(1.0 / 3.0) - at(1.0 / 3.0 - step)) / step;
        let after = (at(1.0 / 3.0 + step) - at(1.0 / 3.0)) / step;
        assert!(before.distance(after) < 1e-3, "{before} {after}");
        assert!(after.distance(1.5 * points[2]) < 1e-3, "{after}");
    }
}

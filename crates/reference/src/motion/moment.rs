//! Where everything stands between two frames.

use catoptric_scene::{Mesh, Pose, Scene, Subject, View};
use glam::{DVec2, DVec3};

use super::target::Target;

/// Moments that are kept; others are made when they are asked for.
const KEPT: u32 = 64;

/// The time between two frames, in parts.
pub(super) struct Moments {
    scene: Scene,
    frames: [u32; 2],
    size: [u32; 2],
    parts: u32,
    /// The scene at both frames.
    ends: [Scene; 2],
    /// At every so many parts.
    kept: Vec<Moment>,
}

/// Where the eye and the mirrors are at a moment.
#[derive(Clone)]
struct Moment {
    view: View,
    mirrors: Vec<Pose>,
    /// Where the scene's motion is at that moment; `None` without one.
    time: Option<f64>,
}

/// What is looked at at a moment, seen from a mirror at rest.
pub(super) struct Situation<'m> {
    /// The eye.
    pub eye: DVec3,
    /// The point that is reflected, or the unit direction.
    pub target: Result<DVec3, DVec3>,
    /// Angle across a pixel in the middle of the image, radians.
    pub pixel: f64,
    /// At a frame itself, a mesh mirror as it stands there.
    pub mesh: Option<(&'m Mesh, Pose)>,
    view: View,
    pose: Pose,
}

impl Situation<'_> {
    /// Image coordinates and depth of a point of the mirror at rest.
    pub(super) fn image_of(&self, point: DVec3) -> Option<(DVec2, f64)> {
        self.view.project(self.pose.point(point))
    }

    /// Where a point of the mirror at rest is.
    pub(super) fn in_world(&self, point: DVec3) -> DVec3 {
        self.pose.point(point)
    }

    /// The point that is reflected, or the unit direction.
    pub(super) fn target_in_world(&self) -> Result<DVec3, DVec3> {
        match self.target {
            Ok(point) => Ok(self.pose.point(point)),
            Err(direction) => Err(self.pose.turn(direction)),
        }
    }
}

impl Moments {
    pub(super) fn new(scene: &Scene, frames: [u32; 2], size: [u32; 2], parts: u32) -> Self {
        let mut moments = Self {
            ends: frames.map(|frame| scene.at(frame)),
            scene: scene.clone(),
            frames,
            size,
            parts,
            kept: Vec::new(),
        };
        let kept = (0..=KEPT).map(|index| moments.moment(index * (parts / KEPT)));
        moments.kept = kept.collect();
        moments
    }

    /// The scene at both frames.
    pub(super) fn ends(&self) -> [&Scene; 2] {
        self.ends.each_ref()
    }

    /// The cameras of both frames.
    pub(super) fn views(&self) -> [View; 2] {
        self.ends().map(|scene| scene.camera.view(self.size))
    }

    fn moment(&self, part: u32) -> Moment {
        let mirrors = 0..self.scene.mirrors.len();
        let Some(motion) = &self.scene.motion else {
            return Moment {
                view: self.scene.camera.view(self.size),
                mirrors: mirrors.map(|_| Pose::REST).collect(),
                time: None,
            };
        };
        let [from, to] = self.frames.map(f64::from);
        let share = f64::from(part) / f64::from(self.parts);
        // Exactly the frames at both ends.
        let time = motion.time_between((1.0 - share) * from + share * to);
        Moment {
            view: motion.camera_at(&self.scene.camera, time).view(self.size),
            mirrors: mirrors
                .map(|index| motion.pose(Subject::Mirror(index), time))
                .collect(),
            time: Some(time),
        }
    }

    /// Which of both ends a part is, if it is one.
    fn end(&self, part: u32) -> Option<&Scene> {
        match part {
            0 => Some(&self.ends[0]),
            part if part == self.parts => Some(&self.ends[1]),
            _ => None,
        }
    }

    /// A mirror's point in the mirror's rest frame.
    pub(super) fn at_rest(&self, part: u32, mirror: usize, point: DVec3) -> DVec3 {
        self.moment(part).mirrors[mirror].undone(point)
    }

    /// World-space corners of an object's triangle.
    pub(super) fn corners(&self, part: u32, object: usize, triangle: usize) -> [DVec3; 3] {
        let corners = |scene: &Scene| {
            let mesh = &scene.objects[object].mesh;
            mesh.triangles[triangle].map(|index| mesh.positions[index as usize].as_dvec3())
        };
        if let Some(scene) = self.end(part) {
            return corners(scene);
        }
        let rest = corners(&self.scene);
        match (&self.scene.motion, self.time(part)) {
            (Some(motion), Some(time)) => {
                let pose = motion.pose(Subject::Object(object), time);
                rest.map(|corner| pose.point(corner))
            }
            _ => rest,
        }
    }

    fn time(&self, part: u32) -> Option<f64> {
        match self.kept_at(part) {
            Some(moment) => moment.time,
            None => self.moment(part).time,
        }
    }

    fn kept_at(&self, part: u32) -> Option<&Moment> {
        let every = self.parts / KEPT;
        let index = part
            .is_multiple_of(every)
            .then_some((part / every) as usize)?;
        self.kept.get(index)
    }

    /// What a mirror and something that it reflects look like at a moment.
    pub(super) fn situation(&self, part: u32, mirror: usize, target: &Target) -> Situation<'_> {
        let made;
        let moment = match self.kept_at(part) {
            Some(moment) => moment,
            None => {
                made = self.moment(part);
                &made
            }
        };
        let pose = moment.mirrors[mirror];
        let target = match *target {
            Target::Point {
                object,
                triangle,
                weights,
            } => {
                let [a, b, c] = self.corners(part, object, triangle);
                Ok(pose.undone(weights.x * a + weights.y * b + weights.z * c))
            }
            Target::Direction(direction) => Err(pose.unturned(direction)),
        };
        let mesh = self
            .end(part)
            .and_then(|scene| scene.mirrors[mirror].shape.as_mesh())
            .map(|mesh| (mesh, pose));
        Situation {
            eye: pose.undone(moment.view.eye),
            target,
            pixel: 2.0 * moment.view.tan.y / f64::from(self.size[1]),
            mesh,
            view: moment.view,
            pose,
        }
    }
}

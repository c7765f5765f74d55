//! What is asked of a mirror shape, and what it answers.

use catoptric_frame::VertexClass;
use catoptric_scene::MirrorShape;
use glam::DVec3;

/// A shape whose reflection points are known exactly.
pub(super) trait ExactPoints: Sync {
    /// All points at which `eye` sees `vertex` reflected, whatever may stand in between.
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions;
}

impl<T: ExactPoints> ExactPoints for &T {
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        (*self).points(eye, vertex)
    }
}

/// All reflection points of a vertex, whatever may stand in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Solutions {
    /// Region the vertex lies in.
    pub class: VertexClass,
    /// World-space points; empty unless `class` is `Reflected`.
    pub points: Vec<DVec3>,
    /// Parts of the mirror of which it could not be decided whether they hold a point: two points are
    /// about to meet there.
    pub undecided: u64,
}

impl Solutions {
    pub(super) fn none(class: VertexClass) -> Self {
        Self {
            class,
            points: Vec::new(),
            undecided: 0,
        }
    }

    /// `Reflected` in these points.
    pub(super) fn at(points: Vec<DVec3>) -> Self {
        Self {
            class: VertexClass::Reflected,
            points,
            undecided: 0,
        }
    }

    /// Nothing is known, because of so many parts of the mirror.
    pub(super) fn undecided(parts: u64) -> Self {
        Self {
            undecided: parts,
            ..Self::none(VertexClass::Unknown)
        }
    }

    /// `Reflected` in the points of the whole surface that an open mirror keeps; else
    /// `Unreflected` if the whole surface has any, else `Hidden`.
    pub(super) fn within(whole: Vec<DVec3>, keep: impl Fn(&DVec3) -> bool) -> Self {
        if whole.is_empty() {
            return Self::none(VertexClass::Hidden);
        }
        let points: Vec<DVec3> = whole.into_iter().filter(keep).collect();
        if points.is_empty() {
            return Self::none(VertexClass::Unreflected);
        }
        Self::at(points)
    }
}

/// Tells whether the eye sees a point, because no other part of the mirror lies before it.
pub(super) fn seen(shape: &impl MirrorShape, eye: DVec3) -> impl Fn(DVec3) -> bool {
    /// How much nearer to the eye a hit must be to hide a point, as a share of the mirror's extent.
    const BEFORE: f64 = 1e-6;
    let (low, high) = shape.bounds();
    let margin = BEFORE * (high - low).length();
    move |point| {
        let offset = point - eye;
        let first = shape.intersect(eye, offset.normalize(), 0.0);
        first.is_none_or(|hit| hit.t > offset.length() - margin)
    }
}

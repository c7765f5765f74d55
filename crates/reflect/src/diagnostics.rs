//! Questions about the inside of a technique, for pictures that show it: the only access to it.

use catoptric_frame::Traced;
use glam::{Vec2, Vec3};

/// What a technique may be asked about the frame that it rendered last, with all layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// Where a search looks for a world-space point on a mirror (an index), step by step.
    Path {
        /// World space.
        point: Vec3,
        /// Index among the scene's mirrors.
        mirror: usize,
    },
    /// The work of following the reflected rays, pixel by pixel.
    Traced,
    /// The pyramid over the first mirror's cube maps of distance.
    DistanceLevels,
}

/// The answer to the [`Question`] of the same name.
#[derive(Clone, Debug)]
pub enum Answer {
    /// At most 4095 steps.
    Path(Vec<Visit>),
    /// Counts.
    Traced(Traced),
    /// From single texels up to one cell per face.
    DistanceLevels(Vec<DistanceLevel>),
}

/// A step of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visit {
    /// Image coordinates of the texel, or of the centre of the sphere that was looked at.
    pub at: Vec2,
    /// Level of a hierarchy, the pixels being level 0.
    pub level: u32,
}

/// A level of a pyramid over cube maps of world distance.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceLevel {
    /// Cells a side of a face.
    pub side: u32,
    /// Least and greatest distance in a cell, world units: by map, face (+x −x +y −y +z −z), row,
    /// column. The background counts as far as the scene's diagonal.
    pub ranges: Vec<[f32; 2]>,
}

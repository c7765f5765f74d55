//! Results that are not images: per-vertex answers, triangles, work.

use glam::{DVec2, DVec3, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Image;

/// A search's answer for one (object vertex, mirror) pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexResult {
    /// Id of the vertex' object.
    pub object: u32,
    /// Index into the object's unique positions.
    pub vertex: u32,
    /// Id of the mirror searched.
    pub mirror: u32,
    /// What the search says.
    pub state: VertexState,
    /// Found reflection point in image coordinates (pixel centres at +½); meaningless if
    /// `state` is `Failed`.
    pub at: Vec2,
    /// Moves made by an iterative search.
    pub steps: u32,
    /// Uses of the error function.
    pub evaluations: u32,
    /// Nodes tested by a hierarchical search.
    pub node_tests: u32,
    /// A hierarchy left a gap here; `None` for searches that have none.
    pub hole: Option<bool>,
    /// The enlargement repair was used; `None` for searches that have none.
    pub enlarged: Option<bool>,
    /// The search reports that it failed, but returns this point all the same, and the point is drawn.
    pub stand_in: bool,
}

/// What a search says of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexState {
    /// A point was found and the vertex is in front of the mirror there.
    Found,
    /// A point was found where the vertex is behind the mirror's tangent plane (`pv·N < 0`).
    Hidden,
    /// The search reports that it has no answer.
    Failed,
    /// The point lies beyond the rim of an open mirror, on the closed surface that it was cut from.
    Unreflected,
}

/// The exact answer for one (object vertex, mirror) pair; occlusion is not considered.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueVertex {
    /// Which region the vertex lies in.
    pub class: VertexClass,
    /// All reflection points: world position and image coordinates (`None` behind the eye's
    /// plane). Empty unless `class` is `Reflected`.
    pub points: Vec<(DVec3, Option<DVec2>)>,
    /// For each point, how many focal points of its reflected beam lie before the vertex; `None` where that
    /// is not known.
    pub focal: Vec<Option<u8>>,
    /// Parts of the mirror of which it could not be decided whether they hold a point.
    pub undecided: u64,
}

/// Region of space a vertex lies in, seen from the eye (Estalella et al. 2005, §6.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexClass {
    /// Has at least one reflection point.
    Reflected,
    /// Behind the mirror, seen from the eye: no point sees both eye and vertex.
    Hidden,
    /// In front, but the reflection would lie beyond an open mirror's rim.
    Unreflected,
    /// The exact answer could not be decided: the vertex counts nowhere.
    Unknown,
}

/// Triangles of one frame, all mirrors together.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Triangles {
    /// Object triangles × mirrors, before refinement.
    #[serde(rename = "in")]
    pub input: u64,
    /// After refinement, before discard.
    pub drawn: u64,
    /// Of `drawn`, how many stopped at each subdivision level (0 = not split).
    pub by_level: Vec<u64>,
    /// Still above the threshold at the level limit.
    pub unfinished: u64,
}

/// Work done to follow the reflected rays of one frame, pixel by pixel; all 0 where no mirror's front is
/// seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// As [`Work::samples`].
    pub samples: Image<u32>,
    /// As [`Work::node_tests`].
    pub node_tests: Image<u32>,
    /// Steps skipped by an acceleration structure.
    pub skips: Image<u32>,
    /// Rays followed: 1, and one more for each mirror that a ray met.
    pub rays: Image<u32>,
    /// Pixels resolved in each map of their mirror, in the order in which the maps are tried.
    pub resolved_by: Vec<u64>,
    /// Pixels that no map resolved, whatever was put in their place.
    pub unresolved: u64,
}

impl Traced {
    /// Number of mirror pixels.
    pub fn pixels(&self) -> u64 {
        self.resolved_by.iter().sum::<u64>() + self.unresolved
    }
}

/// Work counters, device-independent: means per searched vertex or per mirror pixel; `None` for
/// what a technique does not do, or does for none of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Work {
    /// Looks at all that is looked at, whatever for: evaluations, node tests and samples together, so
    /// that techniques of unlike kinds can be compared.
    pub total: Option<f64>,
    /// Uses of the error function; of traced rays, triangles tested.
    pub evaluations: Option<f64>,
    /// Moves of an iterative search.
    pub steps: Option<f64>,
    /// Hierarchy nodes tested; of cubemap tracing, cells of a pyramid of distances whose least and
    /// greatest distance is looked up.
    pub node_tests: Option<f64>,
    /// Places of cube maps looked up for a ray, whatever for: on its way, to narrow a hit down, to
    /// see whether a map is continuous, or to fill what no map resolves. A place looked up twice
    /// counts twice; what a map holds there beside the distance (colour, normal) comes with it, and so
    /// do the neighbours that it is blended from.
    pub samples: Option<f64>,
    /// Steps skipped by an acceleration structure.
    pub skips: Option<f64>,
    /// Those of the node tests that test the box of a cluster of triangles.
    pub cluster_tests: Option<f64>,
    /// Of a node over a few pixels and a triangle that their rays may meet.
    pub pairs: Option<f64>,
    /// Most triangles that one pixel has to test from one list; no mean.
    pub longest_list: Option<f64>,
    /// Bytes of the lists of a frame; no mean.
    pub bytes: Option<f64>,
}

impl Work {
    /// With the total of its parts.
    #[must_use]
    pub fn summed(self) -> Self {
        let parts = [self.evaluations, self.node_tests, self.samples];
        Self {
            total: parts.into_iter().flatten().reduce(|a, b| a + b),
            ..self
        }
    }
}

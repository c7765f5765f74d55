//! Which pixels a layer is compared at.

use catoptric_frame::{Image, Primary, Reflected, Status};

use super::theirs::Theirs;

/// Sets of pixels, row by row from the top.
pub struct Masks {
    /// All.
    pub everywhere: Vec<bool>,
    /// Both see the same first surface.
    pub same_primary: Vec<bool>,
    /// Both see the same mirror.
    pub same_mirror: Vec<bool>,
    /// And its front, and reflect into the scene.
    pub mirror: Vec<bool>,
    /// Those of `mirror` with one reflection.
    pub mirror_once: Vec<bool>,
    /// Those of `mirror` with more.
    pub mirror_more: Vec<bool>,
    /// Both meet the same surface after one reflection.
    pub after_one: Vec<bool>,
    /// Likewise after two.
    pub after_two: Vec<bool>,
    /// No reflection.
    pub direct: Vec<bool>,
    /// One reflection, and not counted apart.
    pub once: Vec<bool>,
    /// At most one reflection, and not counted apart.
    pub shallow: Vec<bool>,
    /// More reflections, and not counted apart.
    pub deep: Vec<bool>,
    /// Reflections on our path to what a pixel shows.
    pub bounces: Image<u32>,
    /// Mirror pixels that are counted apart: one renderer or both say that the shading normal sends
    /// the ray below the surface.
    pub apart: usize,
}

impl Masks {
    /// Of a picture and ours. A layer that the picture does not have is taken to be as ours.
    pub fn new(theirs: &Theirs, primary: &Primary, reflected: &Reflected) -> Self {
        let count = primary.id.pixels().len();
        let bounces = reflected.bounces.clone();
        let bounces = bounces.unwrap_or_else(|| {
            // Truth `first-bounce`: one reflection at most.
            let one = |status: &Status| u32::from(*status == Status::Resolved);
            reflected.status.map(one)
        });
        let of = |layer: &Option<Image<u32>>, ours: &Image<u32>, at: usize| {
            layer.as_ref().unwrap_or(ours).pixels()[at]
        };
        let status = |at: usize| reflected.status.pixels()[at];
        let below = |at: usize| {
            let theirs = theirs.status.as_ref().map(|status| status.pixels()[at]);
            status(at) == Status::Below || theirs == Some(Status::Below)
        };
        let same_primary = |at: usize| {
            let id = of(&theirs.primary_id, &primary.id, at);
            id != 0 && id == primary.id.pixels()[at]
        };
        let same_mirror = |at: usize| same_primary(at) && status(at) != Status::NotMirror;
        let mirror = |at: usize| same_mirror(at) && status(at) == Status::Resolved && !below(at);
        let reflections = |at: usize| bounces.pixels()[at];
        let same_reflected = |at: usize| {
            let id = of(&theirs.reflected_id, &reflected.id, at);
            mirror(at)
                && id != 0
                && id == reflected.id.pixels()[at]
                && of(&theirs.bounces, &bounces, at) == reflections(at)
        };
        let mask = |keeps: &dyn Fn(usize) -> bool| (0..count).map(keeps).collect();
        Self {
            everywhere: vec![true; count],
            same_primary: mask(&same_primary),
            same_mirror: mask(&same_mirror),
            mirror: mask(&mirror),
            mirror_once: mask(&|at| mirror(at) && reflections(at) <= 1),
            mirror_more: mask(&|at| mirror(at) && reflections(at) > 1),
            after_one: mask(&|at| same_reflected(at) && reflections(at) == 1),
            after_two: mask(&|at| same_reflected(at) && reflections(at) == 2),
            direct: mask(&|at| !below(at) && reflections(at) == 0),
            once: mask(&|at| !below(at) && reflections(at) == 1),
            shallow: mask(&|at| !below(at) && reflections(at) <= 1),
            deep: mask(&|at| !below(at) && reflections(at) > 1),
            apart: (0..count)
                .filter(|at| same_mirror(*at) && below(*at))
                .count(),
            bounces,
        }
    }
}

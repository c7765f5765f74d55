//! `motion-newton`: Newton's method on the mirror of the frame before, for the point that then reflected what the pixel
//! shows now. It starts where the mirror's point was then. Ours.

use catoptric_scene::Scene;

use super::{Derivatives, Recipe};
use crate::options::options;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct Newton {
        /// Newton's steps
        steps: u32 = 3 in 1..=16,
        /// the surface and its derivatives from the G-buffer's texels, or of the shape itself, where it is known exactly
        derivatives: Derivatives,
    }
}

impl Named for Newton {
    const INFO: Info = Info {
        name: "motion-newton",
        what: "motion of the true reflection point, by Newton's method",
        paper: "this project",
    };
}

impl Recipe for Newton {
    fn program(&self) -> &'static str {
        "motion/newton"
    }

    fn features(&self) -> &'static [&'static str] {
        self.derivatives.features()
    }

    fn steps(&self) -> u32 {
        self.steps
    }

    fn objection(&self, scene: &Scene) -> Option<String> {
        self.derivatives.objection(scene)
    }
}

//! `motion-lens`: the motion of the virtual image behind a thin lens of the mirror's local curvature, as denoisers
//! publish it (NVIDIA Real-Time Denoisers, without their attenuation towards the rim): `1/b' = 2κ cosθ + 1/b` in the
//! direction in which a flat mirror would show it. κ is the mean curvature, from differences of the G-buffer.

use catoptric_scene::Scene;

use super::{Derivatives, Recipe};
use crate::options::options;
use crate::technique::{Info, Named};

options! {
    pub(crate) struct Lens {
        /// curvature from differences between the G-buffer's texels, or of the shape itself, where it is known exactly
        derivatives: Derivatives,
    }
}

impl Named for Lens {
    const INFO: Info = Info {
        name: "motion-lens",
        what: "motion of the virtual image behind a thin lens",
        paper: "denoisers (NRD)",
    };
}

impl Recipe for Lens {
    fn program(&self) -> &'static str {
        "motion/lens"
    }

    fn features(&self) -> &'static [&'static str] {
        self.derivatives.features()
    }

    fn objection(&self, scene: &Scene) -> Option<String> {
        self.derivatives.objection(scene)
    }
}

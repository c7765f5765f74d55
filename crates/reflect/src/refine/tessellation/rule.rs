//! Which triangles a refinement splits.

use catoptric_scene::Scene;

use crate::technique::Properties;

/// Which triangles are split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rule {
    /// How often a triangle may be split.
    pub level: u32,
    /// Edge error in 0..=1 from which a triangle is split: 0 splits all, 1 none. `None` splits
    /// all without asking.
    pub threshold: Option<f32>,
}

impl Rule {
    /// Of refinements by a rule.
    pub(crate) const PROPERTIES: Properties = Properties {
        splits_triangles: true,
        ..Properties::NONE
    };

    /// Why it is not for a scene: more triangles than can be counted.
    pub(crate) fn objection(&self, scene: &Scene) -> Option<String> {
        let level = self.level;
        let triangles = scene.triangle_count() as u64 * scene.mirrors.len() as u64;
        let most = triangles.saturating_mul(4_u64.pow(level));
        (most > u64::from(u32::MAX)).then(|| {
            format!(
                "level {level} can make {most} triangles of {triangles}; a frame counts 32 bits"
            )
        })
    }
}

//! A patch of the surface `z = (kx x² + ky y²)/2` over a rectangle.

use glam::{DVec2, DVec3};

/// The patch in its own axes: x along its width, y along its height, z along its normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Half width and half height.
    pub half: DVec2,
    /// Curvatures along x and y at the middle.
    pub curvature: DVec2,
}

impl Patch {
    pub(crate) fn point(&self, at: DVec2) -> DVec3 {
        at.extend((self.curvature * at).dot(at) / 2.0)
    }

    /// Unit normal over a place, towards +z.
    pub(crate) fn normal(&self, at: DVec2) -> DVec3 {
        (-self.curvature * at).extend(1.0).normalize()
    }

    /// Least and greatest z.
    pub(crate) fn heights(&self) -> [f64; 2] {
        let ends = self.curvature * self.half * self.half / 2.0;
        let (low, high) = (ends.min(DVec2::ZERO), ends.max(DVec2::ZERO));
        [low.element_sum(), high.element_sum()]
    }

    /// Where the line `origin + t · dir` (`dir` of unit length) meets the patch, ascending.
    pub(crate) fn roots(&self, origin: DVec3, dir: DVec3) -> impl Iterator<Item = f64> {
        let start = -origin.dot(dir);
        let nearest = origin + start * dir;
        // Again, for what rounding leaves along the line when the origin is far away.
        let nearest = nearest - nearest.dot(dir) * dir;
        let (p, d) = (nearest.truncate(), dir.truncate());
        let a = (self.curvature * d).dot(d) / 2.0;
        let b = (self.curvature * p).dot(d) - dir.z;
        let c = (self.curvature * p).dot(p) / 2.0 - nearest.z;
        // −q/a and −c/q never cancel; without a bend along the line (a = 0) the first is infinite
        // and the second is the only root.
        let square = b * b - 4.0 * a * c;
        let q = (b + square.max(0.0).sqrt().copysign(b)) / 2.0;
        let pair = if square < 0.0 {
            [f64::NAN; 2]
        } else {
            [-q / a, -c / q]
        };
        let [first, second] = if pair[0] <= pair[1] {
            pair
        } else {
            [pair[1], pair[0]]
        };
        let half = self.half;
        [first, second]
            .into_iter()
            .filter(move |s| s.is_finite() && (p + *s * d).abs().cmple(half).all())
            .map(move |s| start + s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATCH: Patch = Patch {
        half: DVec2::new(1.0, 2.0),
        curvature: DVec2::new(0.5, -0.5),
    };

    #[test]
    fn straight_lines_in_the_surface_and_along_the_axis() {
        let hits = |origin: [f64; 3], dir: [f64; 3]| -> Vec<f64> {
            PATCH
                .roots(origin.into(), DVec3::from(dir).normalize())
                .collect()
        };
        // Straight down there is no square term.
        let down = hits([0.5, 1.5, 1e5], [0.0, 0.0, -1.0]);
        let height = 0.25 * (0.25 - 2.25);
        assert!(down.len() == 1 && (down[0] - 1e5 + height).abs() < 1e-9);
        // Across a valley, twice; the line at height z leaves the patch's width beyond x = 1.
        assert_eq!(hits([-5.0, 0.0, 0.2], [1.0, 0.0, 0.0]).len(), 2);
        assert_eq!(hits([-5.0, 0.0, 0.26], [1.0, 0.0, 0.0]).len(), 0);
        assert_eq!(hits([-5.0, 0.0, -0.1], [1.0, 0.0, 0.0]).len(), 0);
    }

    #[test]
    fn heights_are_those_of_the_edges() {
        assert_eq!(PATCH.heights(), [-1.0, 0.25]);
    }
}

//! A patch of the surface `z = (kx x² + ky y²)/2` over a rectangle: `shape = "saddle"` with `center`,
//! `normal`, `up`, `size` and `curvature`.

use glam::{DMat3, DVec2, DVec3};

use super::mirror_shape::{Facing, MirrorShape, OPEN, ShaderInput, SurfaceHit};
use super::{keys, proxy};
use crate::SceneError;
use crate::document::Table;
use crate::mesh::Mesh;
use crate::pose::Pose;

/// So many times as wide and high, the surface is looked at beyond its rim.
const BEYOND: f64 = 1.5;

/// The points `center + x · right + y · up + z · normal` over a rectangle, with
/// `right = up × normal` and `z = (curvature.x · x² + curvature.y · y²)/2`, reflecting on the side
/// its normals point to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saddle {
    /// Middle of the patch, world space.
    pub center: DVec3,
    /// Unit normal in the middle, on the reflecting side.
    pub normal: DVec3,
    /// Unit, perpendicular to `normal`.
    pub up: DVec3,
    /// Full extent along `right` and `up`, world units.
    pub size: DVec2,
    /// Curvatures (1 / world unit) in the middle along `right` and `up`, of opposite signs; positive ones bend
    /// towards the reflecting side.
    pub curvature: DVec2,
}

impl Saddle {
    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let center = keys::center(table)?;
        let curvature = table.numbers::<2>("curvature")?;
        let (normal, up, size) = keys::oriented(table)?;
        let curvature = DVec2::from(table.required("curvature", curvature)?);
        if curvature.x * curvature.y >= 0.0 {
            let message = "must be two numbers of opposite signs: along the width and along `up`";
            return Err(table.error("curvature", message));
        }
        Ok(Self {
            center,
            normal,
            up,
            size,
            curvature,
        })
    }

    /// World from the patch's axes: right, up, normal.
    fn frame(&self) -> DMat3 {
        DMat3::from_cols(self.up.cross(self.normal), self.up, self.normal)
    }

    fn patch(&self) -> Patch {
        Patch {
            half: self.size / 2.0,
            curvature: self.curvature,
        }
    }

    /// In `cells` × `cells` parts.
    fn sheet(&self, cells: u32) -> Mesh {
        let (center, frame, patch) = (self.center, self.frame(), self.patch());
        let mut points = Vec::new();
        for j in 0..=cells {
            for i in 0..=cells {
                let share = DVec2::new(f64::from(i), f64::from(j)) / f64::from(cells);
                let at = (2.0 * share - 1.0) * patch.half;
                points.push((center + frame * patch.point(at), frame * patch.normal(at)));
            }
        }
        let mut triangles = Vec::new();
        for j in 0..cells {
            for i in 0..cells {
                let a = j * (cells + 1) + i;
                let (b, c, d) = (a + 1, a + cells + 1, a + cells + 2);
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        proxy::assemble(&points, triangles)
    }

    /// A box around it, a little larger, with the normal in its middle.
    fn cuboid(&self) -> Mesh {
        let (center, frame, patch) = (self.center, self.frame(), self.patch());
        let [low, high] = patch.heights();
        let margin = 5e-4 * patch.half.max_element();
        let corner = |index: u32| {
            let pick = |bit: u32, low: f64, high: f64| if index & bit == 0 { low } else { high };
            let half = patch.half + margin;
            let local = DVec3::new(
                pick(1, -half.x, half.x),
                pick(2, -half.y, half.y),
                pick(4, low - margin, high + margin),
            );
            (center + frame * local, frame.z_axis)
        };
        let points: Vec<_> = (0..8).map(corner).collect();
        let faces = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let triangles = faces
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        proxy::assemble(&points, triangles.collect())
    }
}

impl MirrorShape for Saddle {
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit> {
        let (frame, patch) = (self.frame(), self.patch());
        let local = frame.transpose() * (origin - self.center);
        let local_dir = frame.transpose() * dir;
        let t = patch.roots(local, local_dir).find(|t| *t > t_min)?;
        let at = (local + t * local_dir).truncate();
        Some(SurfaceHit {
            t,
            position: self.center + frame * patch.point(at),
            normal: frame * patch.normal(at),
        })
    }

    fn normal_at(&self, point: DVec3) -> Option<DVec3> {
        let frame = self.frame();
        let at = (frame.transpose() * (point - self.center)).truncate();
        Some(frame * self.patch().normal(at))
    }

    fn center(&self) -> DVec3 {
        self.center
    }

    fn bounds(&self) -> (DVec3, DVec3) {
        let (frame, patch) = (self.frame(), self.patch());
        let [low, high] = patch.heights();
        let half = patch.half.extend((high - low) / 2.0);
        let half =
            frame.x_axis.abs() * half.x + frame.y_axis.abs() * half.y + frame.z_axis.abs() * half.z;
        let middle = self.center + self.normal * (low + high) / 2.0;
        (middle - half, middle + half)
    }

    fn tessellate(&self, segments: u32) -> Mesh {
        self.sheet(segments.max(4) / 2)
    }

    fn cover(&self, _segments: u32) -> Mesh {
        self.cuboid()
    }

    fn carry(&mut self, pose: &Pose) {
        self.center = pose.point(self.center);
        self.normal = pose.turn(self.normal);
        self.up = pose.turn(self.up);
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn facing(&self) -> Result<Facing, &'static str> {
        Err(OPEN)
    }

    fn numbers(&self) -> Vec<f64> {
        let vectors = [self.center, self.normal, self.up].map(|vector| vector.to_array());
        let pairs = [self.size, self.curvature].map(|pair| pair.to_array());
        [vectors.as_flattened(), pairs.as_flattened()].concat()
    }

    /// `more` are the curvatures along x and y.
    fn shader_input(&self) -> Option<ShaderInput> {
        Some(ShaderInput {
            module: "saddle",
            axes: self.frame(),
            sizes: (self.size / 2.0).extend(1.0),
            more: self.curvature.extend(0.0),
            beyond: Some(((BEYOND * self.size / 2.0).extend(1.0), self.curvature.x)),
        })
    }
}

/// The patch in its own axes: x along its width, y along its height, z along its normal.
#[derive(Clone, Copy, Debug)]
struct Patch {
    /// Half width and half height.
    half: DVec2,
    /// Curvatures along x and y at the middle.
    curvature: DVec2,
}

impl Patch {
    fn point(&self, at: DVec2) -> DVec3 {
        at.extend((self.curvature * at).dot(at) / 2.0)
    }

    /// Unit normal over a place, towards +z.
    fn normal(&self, at: DVec2) -> DVec3 {
        (-self.curvature * at).extend(1.0).normalize()
    }

    /// Least and greatest z.
    fn heights(&self) -> [f64; 2] {
        let ends = self.curvature * self.half * self.half / 2.0;
        let (low, high) = (ends.min(DVec2::ZERO), ends.max(DVec2::ZERO));
        [low.element_sum(), high.element_sum()]
    }

    /// Where the line `origin + t · dir` (`dir` of unit length) meets the patch, ascending.
    fn roots(&self, origin: DVec3, dir: DVec3) -> impl Iterator<Item = f64> {
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

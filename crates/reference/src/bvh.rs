//! Triangles in a bounding volume hierarchy, hit by a watertight test in f64.
//!
//! obvhs builds the hierarchy and walks it in f32; here its boxes are enlarged so that no f32
//! rounding can lose a triangle, and rays are moved up to the triangles' bounding sphere before
//! they are rounded, so that far origins cost no precision. Whether and where a triangle is hit
//! is then decided in f64, after Woop, Benthin and Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2(1), 2013: each vertex is projected along the ray by the same operations
//! whichever triangle it belongs to, and the sign of an edge function is exactly opposite for
//! the two triangles at an edge, so that no ray slips between them.

use glam::{DVec2, DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::{Ray, RayHit};

/// Boxes grow by this share of the triangles' extent: some 30 rounding steps of f32. (obvhs
/// divides by no component of a direction below f32's epsilon; this is also enough for rays that
/// run along an axis inside a flat box.)
const PADDING: f64 = 4e-6;

/// Triangles in the order of a hierarchy's leaves.
pub struct TriangleBvh {
    bvh: Bvh2,
    /// Corners, in leaf order.
    corners: Vec<[DVec3; 3]>,
    /// Index before sorting into leaf order.
    original: Vec<u32>,
    center: DVec3,
    radius: f64,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Index into the triangles the hierarchy was built from.
    pub triangle: u32,
    /// Distance along the (unit) ray.
    pub t: f64,
    /// Weights of the corners, summing to 1.
    pub barycentric: DVec3,
}

impl TriangleBvh {
    /// Builds a hierarchy over triangles with finite corners; none at all is fine.
    pub fn new(triangles: &[[DVec3; 3]]) -> Self {
        let mut low = DVec3::INFINITY;
        let mut high = DVec3::NEG_INFINITY;
        for corner in triangles.iter().flatten() {
            low = low.min(*corner);
            high = high.max(*corner);
        }
        if triangles.is_empty() {
            (low, high) = (DVec3::ZERO, DVec3::ZERO);
        }
        let center = (low + high) / 2.0;
        let radius = (high - low).length() / 2.0;
        // Boxes live relative to the centre, where f32 is finest.
        let padding = Vec3A::splat(((radius * PADDING) as f32).max(f32::MIN_POSITIVE));
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|corners| {
                let corners = corners.map(|corner| Vec3A::from((corner - center).as_vec3()));
                let tight = Aabb::from_points(&corners);
                Aabb::new(tight.min - padding, tight.max + padding)
            })
            .collect();
        let mut elapsed = std::time::Duration::ZERO;
        let bvh = if boxes.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut elapsed)
        };
        let original = bvh.primitive_indices.clone();
        let corners = original
            .iter()
            .map(|index| triangles[*index as usize])
            .collect();
        Self {
            bvh,
            corners,
            original,
            center,
            radius,
        }
    }

    /// Half the diagonal of the bounding box of all triangles.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Nearest triangle with `t_min < t < t_max` along the ray (`dir` of unit length), whichever
    /// way it faces.
    pub fn intersect(
        &self,
        origin: DVec3,
        dir: DVec3,
        t_min: f64,
        t_max: f64,
    ) -> Option<TriangleHit> {
        if self.original.is_empty() {
            return None;
        }
        let to_center = self.center - origin;
        let skip = (to_center.length() - self.radius * 1.001).max(0.0);
        let near = origin + skip * dir;
        let ray_space = RaySpace::new(origin, dir);
        let mut best: Option<(usize, f64, DVec3)> = None;
        let mut nearest = t_max;
        let mut walk = RayHit::none();
        let ray = Ray::new(
            Vec3A::from((near - self.center).as_vec3()),
            Vec3A::from(dir.as_vec3()),
            0.0,
            above(nearest - skip),
        );
        self.bvh.ray_traverse(ray, &mut walk, |_, leaf| {
            match ray_space.intersect(&self.corners[leaf]) {
                Some((t, barycentric)) if t > t_min && t < nearest => {
                    nearest = t;
                    best = Some((leaf, t, barycentric));
                    above(t - skip)
                }
                _ => f32::INFINITY,
            }
        });
        best.map(|(leaf, t, barycentric)| TriangleHit {
            triangle: self.original[leaf],
            t,
            barycentric,
        })
    }
}

impl std::fmt::Debug for TriangleBvh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TriangleBvh")
            .field("triangles", &self.original.len())
            .field("center", &self.center)
            .field("radius", &self.radius)
            .finish_non_exhaustive()
    }
}

/// An f32 not below `t`.
fn above(t: f64) -> f32 {
    (t as f32).next_up()
}

/// A ray with two axes across it.
struct RaySpace {
    origin: DVec3,
    dir: DVec3,
    x: DVec3,
    y: DVec3,
}

impl RaySpace {
    fn new(origin: DVec3, dir: DVec3) -> Self {
        let (x, y) = dir.any_orthonormal_pair();
        Self { origin, dir, x, y }
    }

    /// Distance along the ray, of either sign, and barycentric coordinates of the hit. Edges
    /// and corners belong to all their triangles; a triangle seen edge-on is not hit.
    fn intersect(&self, corners: &[DVec3; 3]) -> Option<(f64, DVec3)> {
        let [a, b, c] = corners.map(|corner| corner - self.origin);
        let [pa, pb, pc] = [a, b, c].map(|v| DVec2::new(v.dot(self.x), v.dot(self.y)));
        // Plain products and differences: a fused multiply-add would break the symmetry.
        let u = pc.x * pb.y - pc.y * pb.x;
        let v = pa.x * pc.y - pa.y * pc.x;
        let w = pb.x * pa.y - pb.y * pa.x;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let sum = u + v + w;
        if sum == 0.0 {
            return None;
        }
        let barycentric = DVec3::new(u, v, w) / sum;
        let depth = DVec3::new(a.dot(self.dir), b.dot(self.dir), c.dot(self.dir));
        Some((barycentric.dot(depth), barycentric))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    fn brute_force(triangles: &[[DVec3; 3]], origin: DVec3, dir: DVec3) -> Option<f64> {
        let ray = RaySpace::new(origin, dir);
        triangles
            .iter()
            .filter_map(|corners| ray.intersect(corners))
            .map(|(t, _)| t)
            .filter(|t| *t > 0.0)
            .min_by(f64::total_cmp)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn hierarchy_agrees_with_all_triangles(
            triangles in prop::collection::vec([point(), point(), point()], 1..60),
            origin in point(),
            dir in point(),
            far in prop::sample::select(vec![0.5, 3.0, 1e4, 1e7]),
        ) {
            prop_assume!(dir.length() > 1e-3);
            let dir = dir.normalize();
            let origin = origin - far * dir;
            let bvh = TriangleBvh::new(&triangles);
            let hit = bvh.intersect(origin, dir, 0.0, f64::INFINITY);
            prop_assert_eq!(hit.map(|hit| hit.t), brute_force(&triangles, origin, dir));
        }

        #[test]
        fn flat_scenes_are_seen_along_the_axes(axis in 0usize..3, x in -1.0..1.0, y in -1.0..1.0) {
            // A unit square, its plane through the origin, offset from it within the other axes.
            let at = |u: f64, v: f64, w: f64| {
                let mut p = [0.0; 3];
                p[axis] = w;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                DVec3::from_array(p)
            };
            let (a, b, c, d) =
                (at(-1.0, -1.0, 0.0), at(1.0, -1.0, 0.0), at(1.0, 1.0, 0.0), at(-1.0, 1.0, 0.0));
            let bvh = TriangleBvh::new(&[[a, b, c], [a, c, d]]);
            let hit = bvh.intersect(at(x, y, 10.0), at(0.0, 0.0, -1.0), 0.0, f64::INFINITY);
            prop_assert!(hit.is_some_and(|hit| (hit.t - 10.0).abs() < 1e-14));
        }
    }

    #[test]
    fn limits_are_respected() {
        let triangle = [
            DVec3::NEG_ONE,
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(0.0, 1.0, -1.0),
        ];
        let bvh = TriangleBvh::new(&[triangle]);
        let hit = |t_min, t_max| bvh.intersect(DVec3::ZERO, DVec3::NEG_Z, t_min, t_max);
        assert_eq!(hit(0.0, 2.0).map(|hit| hit.t), Some(1.0));
        assert!(hit(1.0, 2.0).is_none());
        assert!(hit(0.0, 1.0).is_none());
        assert!(hit(0.0, 0.5).is_none());
        assert!(bvh.intersect(DVec3::ZERO, DVec3::Z, 0.0, 2.0).is_none());
        assert!(
            TriangleBvh::new(&[])
                .intersect(DVec3::ZERO, DVec3::Z, 0.0, 2.0)
                .is_none()
        );
    }
}

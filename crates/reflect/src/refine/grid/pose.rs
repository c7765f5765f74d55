//! Where a rigid mesh is. World space.

use glam::{DAffine3, DMat3, DVec3, Vec3};

/// Where a rigid mesh is, told by three of its vertices.
#[derive(Clone, Debug)]
pub(crate) struct Pose {
    anchors: [usize; 3],
    /// Undoes the pose in which the anchors were chosen.
    rest: DAffine3,
}

impl Pose {
    /// The pose of a mesh as it stands; its anchors are far apart and far from one line. `None`
    /// for a mesh without positions.
    pub(crate) fn new(positions: &[Vec3]) -> Option<Self> {
        let first = positions.first()?.as_dvec3();
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            let measured = positions.iter().map(|p| measure(p.as_dvec3()));
            let best = measured.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
            best.map(|(index, _)| index)
        };
        let second = farthest(&|p| p.distance_squared(first))?;
        let along = (positions[second].as_dvec3() - first).normalize_or_zero();
        let third = farthest(&|p| (p - first).cross(along).length_squared())?;
        let anchors = [0, second, third];
        let rest = frame(positions, anchors).inverse();
        Some(Self { anchors, rest })
    }

    /// World space now from world space then.
    pub(crate) fn moved(&self, positions: &[Vec3]) -> DAffine3 {
        frame(positions, self.anchors) * self.rest
    }
}

fn frame(positions: &[Vec3], anchors: [usize; 3]) -> DAffine3 {
    let [a, b, c] = anchors.map(|anchor| positions[anchor].as_dvec3());
    let x = (b - a).try_normalize().unwrap_or(DVec3::X);
    let z = x.cross(c - a).try_normalize();
    let z = z.unwrap_or_else(|| x.any_orthonormal_vector());
    DAffine3::from_mat3_translation(DMat3::from_cols(x, z.cross(x), z), a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered() -> Vec<Vec3> {
        let at = |i: u32| Vec3::new((i % 7) as f32, (i % 5) as f32 * 0.3, (i / 7) as f32) / 10.0;
        (0..70).map(at).collect()
    }

    #[test]
    fn a_pose_follows_a_rigid_motion() {
        for rest in [scattered(), vec![Vec3::X, Vec3::Y, Vec3::Z]] {
            let pose = Pose::new(&rest).expect("has positions");
            let motion = DAffine3::from_rotation_translation(
                glam::DQuat::from_rotation_y(0.7) * glam::DQuat::from_rotation_x(-0.2),
                DVec3::new(1.0, -2.0, 0.3),
            );
            let now: Vec<_> = rest
                .iter()
                .map(|p| motion.transform_point3(p.as_dvec3()).as_vec3())
                .collect();
            let found = pose.moved(&now);
            for point in [DVec3::ZERO, DVec3::new(1.0, 2.0, -3.0)] {
                let gap = found
                    .transform_point3(point)
                    .distance(motion.transform_point3(point));
                // Rounding of the anchors to f32, at this distance from them.
                assert!(gap < 1e-5, "{gap}");
            }
        }
    }
}

//! Points whose reflection point is known, because they were made from it.

use glam::{DVec2, DVec3};

use crate::camera::Camera;
use crate::mirror::Mirror;
use crate::random::Random;
use crate::shape::SurfaceHit;

/// Tries that are made before there is any point,
const TRIES: usize = 100_000;
/// and for each point more.
const TRIES_A_POINT: usize = 1000;

/// How to construct points backwards from the image.
pub(crate) struct Inverse {
    pub count: u32,
    pub seed: u64,
    /// Least and largest distance from the mirror point, log-uniform between.
    pub distance: [f64; 2],
}

/// Points on reflected eye rays: a random image position on a pixel of mirror `which`, the mirror
/// point there, and a random distance along the reflected ray, short of its next meeting with the
/// same mirror. The image positions depend on the camera's resolution.
pub(crate) fn inverse_points(
    inverse: &Inverse,
    camera: &Camera,
    mirrors: &[Mirror],
    which: usize,
) -> Result<Vec<DVec3>, String> {
    let view = camera.view(camera.resolution);
    let first_hit = |at: DVec2| -> Option<(SurfaceHit, DVec3)> {
        let dir = view.ray(at);
        let hits = mirrors.iter().enumerate().filter_map(|(index, mirror)| {
            mirror
                .shape
                .intersect(view.eye, dir, 0.0)
                .map(|hit| (index, hit))
        });
        let (index, hit) = hits.min_by(|a, b| a.1.t.total_cmp(&b.1.t))?;
        (index == which && dir.dot(hit.normal) < 0.0).then_some((hit, dir))
    };

    let [width, height] = camera.resolution;
    let mut pixels = Vec::new();
    for j in 0..height {
        for i in 0..width {
            let corner = DVec2::new(f64::from(i), f64::from(j));
            if first_hit(corner + 0.5).is_some() {
                pixels.push(corner);
            }
        }
    }
    if pixels.is_empty() {
        return Err(format!(
            "mirror \"{}\" covers no pixel",
            mirrors[which].name
        ));
    }

    let mut random = Random::new(inverse.seed);
    let [least, largest] = inverse.distance.map(f64::ln);
    let mut points = Vec::new();
    let mut tries = 0;
    while points.len() < inverse.count as usize {
        // Near a rim or deep in a bowl most tries may fail, but not nearly all of them.
        if tries == TRIES + TRIES_A_POINT * points.len() {
            return Err(format!(
                "distances leave too little room before the mirror is met again: after {tries} \
                 tries there are {} of {} points",
                points.len(),
                inverse.count
            ));
        }
        tries += 1;
        let pixel = pixels[random.below(pixels.len())];
        let at = pixel + DVec2::new(random.unit(), random.unit());
        let t = (least + (largest - least) * random.unit()).exp();
        let Some((hit, dir)) = first_hit(at) else {
            continue;
        };
        let reflected = (dir - 2.0 * dir.dot(hit.normal) * hit.normal).normalize();
        let again = mirrors[which]
            .shape
            .intersect(hit.position, reflected, 1e-9 * hit.t);
        if again.is_none_or(|again| again.t > t) {
            points.push(hit.position + t * reflected);
        }
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fov;
    use crate::shape::{Bowl, Shape, Sphere};

    fn camera() -> Camera {
        Camera {
            eye: DVec3::new(0.5, 0.35, 4.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: Fov::Y(34.0),
            resolution: [64, 48],
        }
    }

    fn mirror(shape: Shape) -> [Mirror; 1] {
        [Mirror {
            name: "m".to_owned(),
            shape,
            tessellation: 128,
            cubemaps: Vec::new(),
            proxies: Vec::new(),
            pose: crate::Pose::REST,
        }]
    }

    #[test]
    fn the_same_seed_gives_the_same_points_at_the_distances_asked_for() {
        let mirrors = mirror(Shape::Sphere(Sphere {
            center: DVec3::ZERO,
            radius: 1.0,
        }));
        let make = |seed| {
            let inverse = Inverse {
                count: 200,
                seed,
                distance: [0.05, 8.0],
            };
            inverse_points(&inverse, &camera(), &mirrors, 0).unwrap()
        };
        let points = make(1);
        assert_eq!(points.len(), 200);
        assert_eq!(points, make(1));
        assert_ne!(points, make(2));
        assert!(points.iter().all(|p| p.length() > 1.0 && p.length() < 9.0));
        let near = points.iter().filter(|p| p.length() < 1.2).count();
        assert!(near > 40, "log-uniform: many are near, {near}");
    }

    #[test]
    fn in_a_bowl_points_lie_before_the_second_meeting() {
        let shape = Shape::Bowl(Bowl {
            center: DVec3::ZERO,
            radius: 1.5,
            axis: DVec3::NEG_Z,
            half_angle: 1.4,
        });
        let inverse = Inverse {
            count: 300,
            seed: 1,
            distance: [0.05, 8.0],
        };
        let points = inverse_points(&inverse, &camera(), &mirror(shape), 0).unwrap();
        let rim = 1.5 * 1.4f64.cos();
        assert!(
            points.iter().all(|p| p.length() < 1.5 || -p.z < rim),
            "none is behind the bowl"
        );
    }

    #[test]
    fn a_mirror_out_of_view_has_no_points() {
        let mirrors = mirror(Shape::Sphere(Sphere {
            center: DVec3::Z * 9.0,
            radius: 1.0,
        }));
        let inverse = Inverse {
            count: 1,
            seed: 1,
            distance: [1.0, 2.0],
        };
        assert!(inverse_points(&inverse, &camera(), &mirrors, 0).is_err());
    }

    #[test]
    fn hopeless_distances_are_given_up_soon() {
        let shape = Shape::Bowl(Bowl {
            center: DVec3::ZERO,
            radius: 2.0,
            axis: DVec3::NEG_Z,
            half_angle: 3.1,
        });
        let inverse = Inverse {
            count: 10_000_000,
            seed: 1,
            distance: [100.0, 1000.0],
        };
        let message = inverse_points(&inverse, &camera(), &mirror(shape), 0).unwrap_err();
        assert!(message.contains("too little room"), "{message}");
        assert!(message.contains("there are 0 of 10000000"), "{message}");
    }
}

//! Exact surfaces against points sampled on them, and their proxies.

use catoptric_scene::shape::{Bowl, Ellipsoid, Plane, Saddle, Sphere, Torus};
use catoptric_scene::{Mesh, Shape};
use glam::{DMat3, DVec2, DVec3, Vec3};
use proptest::prelude::*;

fn shapes() -> Vec<Shape> {
    let rotation = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(-0.7);
    let center = DVec3::new(0.3, -0.2, 0.1);
    vec![
        Shape::Sphere(Sphere {
            center,
            radius: 1.3,
        }),
        Shape::Ellipsoid(Ellipsoid {
            center,
            radii: DVec3::new(1.5, 0.3, 0.8),
            rotation,
        }),
        Shape::Plane(Plane {
            center,
            normal: rotation * DVec3::Z,
            up: rotation * DVec3::Y,
            size: DVec2::new(2.0, 1.0),
        }),
        Shape::Bowl(Bowl {
            center,
            radius: 1.5,
            axis: rotation * DVec3::NEG_Z,
            half_angle: 1.1,
        }),
        Shape::Bowl(Bowl {
            center,
            radius: 0.7,
            axis: DVec3::X,
            half_angle: 2.5,
        }),
        Shape::Torus(Torus {
            center,
            axis: rotation * DVec3::Y,
            major: 1.2,
            minor: 0.4,
        }),
        Shape::Torus(Torus {
            center,
            axis: DVec3::Z,
            major: 1.3,
            minor: 0.02,
        }),
        Shape::Saddle(Saddle {
            center,
            normal: rotation * DVec3::Z,
            up: rotation * DVec3::Y,
            size: DVec2::new(2.0, 1.4),
            curvature: DVec2::new(0.9, -0.5),
        }),
    ]
}

/// A point of the surface by two numbers in [0, 1).
fn sample(shape: &Shape, u: f64, v: f64) -> DVec3 {
    let around = std::f64::consts::TAU * u;
    let unit = |cos: f64| {
        let sin = (1.0 - cos * cos).sqrt();
        DVec3::new(sin * around.cos(), sin * around.sin(), cos)
    };
    match shape {
        Shape::Sphere(Sphere { center, radius }) => *center + *radius * unit(2.0 * v - 1.0),
        Shape::Ellipsoid(Ellipsoid {
            center,
            radii,
            rotation,
        }) => *center + *rotation * (unit(2.0 * v - 1.0) * *radii),
        Shape::Plane(Plane {
            center,
            normal,
            up,
            size,
        }) => *center + up.cross(*normal) * size.x * (u - 0.5) + *up * size.y * (v - 0.5),
        Shape::Bowl(Bowl {
            center,
            radius,
            axis,
            half_angle,
        }) => {
            let local = unit(1.0 - v * (1.0 - half_angle.cos()));
            let (x, y) = axis.any_orthonormal_pair();
            *center + *radius * (x * local.x + y * local.y + *axis * local.z)
        }
        Shape::Torus(Torus {
            center,
            axis,
            major,
            minor,
        }) => {
            let (x, y) = axis.any_orthonormal_pair();
            let outward = x * around.cos() + y * around.sin();
            let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
            *center + *major * outward + *minor * (outward * cos + *axis * sin)
        }
        Shape::Saddle(Saddle {
            center,
            normal,
            up,
            size,
            curvature,
        }) => {
            let (x, y) = (size.x * (u - 0.5), size.y * (v - 0.5));
            let z = (curvature.x * x * x + curvature.y * y * y) / 2.0;
            *center + up.cross(*normal) * x + *up * y + *normal * z
        }
        Shape::Mesh(_) => unreachable!("no mesh among them"),
    }
}

proptest! {
    #[test]
    fn rays_at_surface_points_hit_them_or_something_before(
        u in 0.0..1.0f64, v in 0.0..0.999f64,
        x in -5.0..5.0f64, y in -5.0..5.0f64, z in -5.0..5.0f64,
    ) {
        for shape in shapes() {
            let origin = DVec3::new(x, y, z);
            let point = sample(&shape, u, v);
            let distance = origin.distance(point);
            if distance < 0.1 {
                continue;
            }
            let dir = (point - origin) / distance;
            let hit = shape.intersect(origin, dir, 0.0);
            let normal = shape.normal_at(point).unwrap();
            prop_assert!((normal.length() - 1.0).abs() < 1e-12);
            // A grazing ray may pass by through rounding, or meet the surface twice close by.
            if normal.dot(dir).abs() < 0.2 {
                continue;
            }
            let hit = hit.expect("a ray to a point of the surface hits");
            prop_assert!(hit.t <= distance + 1e-9);
            prop_assert!((origin + hit.t * dir).distance(hit.position) < 1e-9);
            prop_assert!(shape.normal_at(hit.position).unwrap().distance(hit.normal) < 1e-9);
            // From just before the point it is the next.
            let near = shape.intersect(point - 0.01 * dir, dir, 0.009).unwrap();
            prop_assert!((near.t - 0.01).abs() < 1e-9, "{shape:?} {}", near.t);
            // And from the point itself, it is not met again at once.
            let next = shape.intersect(point, dir, 1e-6);
            prop_assert!(next.is_none_or(|next| next.position.distance(point) > 1e-5));
        }
    }

    #[test]
    fn rays_that_meet_the_surface_meet_its_cover(
        u in 0.0..1.0f64, v in 0.0..1.0f64,
        x in -5.0..5.0f64, y in -5.0..5.0f64, z in -5.0..5.0f64,
        segments in 4u32..40,
    ) {
        for shape in shapes() {
            let origin = DVec3::new(x, y, z);
            let dir = (sample(&shape, u, v) - origin).normalize();
            if shape.intersect(origin, dir, 0.0).is_some() {
                prop_assert!(meets(&shape.cover(segments), origin, dir), "{shape:?}");
            }
        }
    }
}

/// Möller and Trumbore's test against all triangles, both sides.
fn meets(mesh: &Mesh, origin: DVec3, dir: DVec3) -> bool {
    mesh.triangles.iter().any(|corners| {
        let [a, b, c] = corners.map(|index| mesh.positions[index as usize].as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = dir.cross(ac);
        let det = ab.dot(p);
        let u = (origin - a).dot(p) / det;
        let q = (origin - a).cross(ab);
        let v = dir.dot(q) / det;
        u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && ac.dot(q) / det > 0.0
    })
}

#[test]
fn proxies_lie_on_the_surface_with_its_normals_and_winding() {
    for shape in shapes() {
        for segments in [4, 5, 16, 33] {
            let mesh = shape.tessellate(segments);
            for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
                let [a, b, c] = corners.map(|index| mesh.positions[index as usize]);
                let mean: Vec3 = normals.iter().sum();
                assert!(
                    (b - a).cross(c - a).dot(mean) > 0.0,
                    "{shape:?} winds backwards"
                );
                for (index, normal) in corners.iter().zip(normals) {
                    let position = mesh.positions[*index as usize].as_dvec3();
                    let exact = shape.normal_at(position).unwrap();
                    assert!(exact.as_vec3().distance(*normal) < 1e-5);
                    let above = shape.intersect(position + exact, -exact, 0.5);
                    // The rim itself may be missed through rounding.
                    if let Some(hit) = above {
                        let off = hit.position.distance(position);
                        assert!(off < 1e-5, "{shape:?}: {off} at {position}");
                    }
                }
            }
            assert_eq!(mesh.is_closed(), shape.is_closed());
            assert_eq!(mesh.material.len(), mesh.triangles.len());
        }
    }
}

#[test]
fn a_segment_count_gives_half_as_many_rings() {
    let mesh = Shape::Sphere(Sphere {
        center: DVec3::ZERO,
        radius: 1.0,
    })
    .tessellate(128);
    assert_eq!(mesh.positions.len(), 2 + 63 * 128);
    assert_eq!(mesh.triangles.len(), 2 * 63 * 128);
}

#[test]
fn covers_of_closed_surfaces_contain_them() {
    for shape in shapes().iter().filter(|shape| shape.is_closed()) {
        for segments in [4, 16, 17, 128] {
            let cover = shape.cover(segments);
            for corners in &cover.triangles {
                let [a, b, c] = corners.map(|index| cover.positions[index as usize].as_dvec3());
                for weights in [
                    [1.0, 1.0, 1.0],
                    [1.0, 1.0, 0.0],
                    [0.0, 1.0, 1.0],
                    [1.0, 0.0, 1.0],
                    [2.0, 1.0, 2.0],
                ] {
                    let sum: f64 = weights.iter().sum();
                    let point = (a * weights[0] + b * weights[1] + c * weights[2]) / sum;
                    assert!(!shape.contains(point), "{shape:?} {segments}");
                }
            }
        }
    }
}

#[test]
fn far_and_tiny_spheres_are_hit_exactly() {
    let sphere = Shape::Sphere(Sphere {
        center: DVec3::ZERO,
        radius: 1e-3,
    });
    let hit = sphere
        .intersect(DVec3::new(0.0, 0.0, 1e6), DVec3::NEG_Z, 0.0)
        .unwrap();
    assert!((hit.t - (1e6 - 1e-3)).abs() < 1e-9);
    assert!(hit.position.distance(DVec3::new(0.0, 0.0, 1e-3)) < 1e-15);
    let inside = sphere.intersect(DVec3::ZERO, DVec3::X, 0.0).unwrap();
    assert!((inside.t - 1e-3).abs() < 1e-15 && inside.normal.dot(DVec3::X) > 0.0);
    assert!(sphere.intersect(DVec3::X, DVec3::X, 0.0).is_none());
}

#[test]
fn a_bowl_is_hit_on_its_cap_only() {
    let bowl = Shape::Bowl(Bowl {
        center: DVec3::ZERO,
        radius: 1.0,
        axis: DVec3::NEG_Z,
        half_angle: 1.0,
    });
    let front = bowl
        .intersect(DVec3::new(0.0, 0.0, 3.0), DVec3::NEG_Z, 0.0)
        .unwrap();
    assert!((front.t - 4.0).abs() < 1e-12 && front.normal.distance(DVec3::Z) < 1e-12);
    let back = bowl
        .intersect(DVec3::new(0.0, 0.0, -3.0), DVec3::Z, 0.0)
        .unwrap();
    assert!((back.t - 2.0).abs() < 1e-12 && back.normal.dot(DVec3::Z) > 0.0);
    assert!(!bowl.is_closed() && !bowl.is_convex() && !bowl.contains(DVec3::ZERO));
}

#[test]
fn boxes_hold_their_surfaces() {
    for shape in shapes() {
        let (low, high) = shape.bounds();
        for step in 0..400 {
            let point = sample(
                &shape,
                f64::from(step) * 0.618 % 1.0,
                f64::from(step) / 400.0,
            );
            assert!(
                point.cmpge(low - 1e-9).all() && point.cmple(high + 1e-9).all(),
                "{shape:?}"
            );
        }
    }
}

/// Exact hits against those of a fine proxy, which lies inside the surface by no more than
/// `sagitta`, or for a saddle on either side.
#[test]
fn tori_and_saddles_are_where_their_tessellations_are() {
    for shape in &shapes()[5..] {
        let proxy = shape.tessellate(256);
        let size = shape.bounds().1.distance(shape.bounds().0);
        let mut both = 0;
        for step in 0..600 {
            let share = |factor: f64| (f64::from(step) * factor).fract();
            let around = std::f64::consts::TAU * share(0.618_034);
            let height = 2.0 * share(0.414_214) - 1.0;
            let flat = (1.0 - height * height).sqrt();
            let away = DVec3::new(flat * around.cos(), flat * around.sin(), height);
            let origin = shape.center() + 2.0 * size * away;
            let target = sample(shape, share(0.732_051), share(0.236_068));
            let dir = (target - origin).normalize();
            let exact = shape.intersect(origin, dir, 0.0);
            let drawn = nearest(&proxy, origin, dir);
            // Where a ray grazes, one may be met and the other not, or far apart.
            let Some(hit) = exact.filter(|hit| hit.normal.dot(dir).abs() > 0.3) else {
                continue;
            };
            let Some(t) = drawn else {
                panic!("{shape:?}: the proxy is missed")
            };
            both += 1;
            assert!((hit.t - t).abs() < 3e-3 * size, "{shape:?}: {} {t}", hit.t);
        }
        assert!(both > 300, "{shape:?}: {both}");
    }
}

/// Distance along the ray to the nearest triangle.
fn nearest(mesh: &Mesh, origin: DVec3, dir: DVec3) -> Option<f64> {
    let hits = mesh.triangles.iter().filter_map(|corners| {
        let [a, b, c] = corners.map(|index| mesh.positions[index as usize].as_dvec3());
        let (ab, ac) = (b - a, c - a);
        let p = dir.cross(ac);
        let det = ab.dot(p);
        let u = (origin - a).dot(p) / det;
        let q = (origin - a).cross(ab);
        let v = dir.dot(q) / det;
        let t = ac.dot(q) / det;
        (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
    });
    hits.min_by(f64::total_cmp)
}

#[test]
fn a_torus_has_a_hole_and_an_inside() {
    let torus = Shape::Torus(Torus {
        center: DVec3::X,
        axis: DVec3::Z,
        major: 1.0,
        minor: 0.25,
    });
    assert!(
        torus
            .intersect(DVec3::new(1.1, 0.2, 9.0), DVec3::NEG_Z, 0.0)
            .is_none()
    );
    let hit = torus
        .intersect(DVec3::new(2.0, 0.0, 9.0), DVec3::NEG_Z, 0.0)
        .unwrap();
    assert!((hit.t - 8.75).abs() < 1e-12 && hit.normal.distance(DVec3::Z) < 1e-12);
    assert!(torus.contains(DVec3::new(2.1, 0.0, 0.1)) && !torus.contains(DVec3::X));
    assert!(torus.is_closed() && !torus.is_convex() && torus.is_analytic());
}

#[test]
fn a_saddle_rises_one_way_and_falls_the_other() {
    let saddle = Shape::Saddle(Saddle {
        center: DVec3::ZERO,
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::new(2.0, 2.0),
        curvature: DVec2::new(1.0, -0.5),
    });
    let height = |x: f64, y: f64| {
        let hit = saddle.intersect(DVec3::new(x, y, 5.0), DVec3::NEG_Z, 0.0)?;
        Some(5.0 - hit.t)
    };
    assert!((height(1.0, 0.0).unwrap() - 0.5).abs() < 1e-14);
    assert!((height(0.0, 1.0).unwrap() + 0.25).abs() < 1e-14);
    assert_eq!(height(1.1, 0.0), None);
    // Both sides are met, and the normal is always that of the reflecting one.
    let below = saddle.intersect(DVec3::NEG_Z, DVec3::Z, 0.0).unwrap();
    assert!(below.normal.distance(DVec3::Z) < 1e-14);
    assert!(!saddle.is_closed() && !saddle.is_convex() && saddle.is_analytic());
}

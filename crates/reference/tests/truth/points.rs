//! Exact reflection points against vertices whose reflection is known by construction.

use std::f64::consts::PI;

use crate::common::*;
use catoptric_frame::VertexClass;
use catoptric_reference::{
    RenderOptions, Solutions, Tracer, Truth, in_view, points_in_view, reflection_points,
    true_vertices,
};
use catoptric_scene::shape::{Bowl, Ellipsoid, Plane, Sphere};
use catoptric_scene::{Camera, Shape};
use glam::{DMat3, DVec2, DVec3, Vec3};

fn solve(shape: &Shape, eye: DVec3, vertex: DVec3) -> Solutions {
    reflection_points(shape, eye, vertex).unwrap()
}

/// A vertex that is reflected at a known point: traced through a random image position.
struct Constructed {
    at: DVec3,
    vertex: DVec3,
}

fn construct(random: &mut Random, camera: &Camera, shape: &Shape) -> Option<Constructed> {
    let view = camera.view(camera.resolution);
    let dir = view.ray(random.pixel(camera.resolution));
    let hit = shape.intersect(view.eye, dir, 0.0)?;
    let t = random.log_between(0.05, 8.0);
    let cosine = dir.dot(hit.normal);
    if cosine >= 0.0 {
        return None;
    }
    let reflected = dir - 2.0 * cosine * hit.normal;
    let blocked = !shape.is_convex()
        && shape
            .intersect(hit.position, reflected, 1e-9)
            .is_some_and(|second| second.t <= t);
    (!blocked).then(|| Constructed {
        at: hit.position,
        vertex: hit.position + t * reflected,
    })
}

fn nearest(solutions: &Solutions, at: DVec3) -> f64 {
    solutions
        .points
        .iter()
        .map(|point| point.distance(at))
        .fold(f64::INFINITY, f64::min)
}

/// Half the angle's sine between bisector and normal, and both sides' visibility.
fn is_reflection(shape: &Shape, eye: DVec3, vertex: DVec3, at: DVec3) -> bool {
    let normal = shape.normal_at(at).unwrap();
    let (po, pv) = ((eye - at).normalize(), (vertex - at).normalize());
    let bisector = (po + pv).normalize_or_zero();
    normal.dot(po) > 0.0 && normal.dot(pv) > 0.0 && bisector.cross(normal).length() < 1e-9
}

#[test]
fn convex_mirrors_have_exactly_the_constructed_point() {
    let cases = [
        (
            unit_sphere(),
            camera([0.6, 0.5, 4.0], 34.0, [512, 512]),
            1e-12,
        ),
        (
            prototype_ellipsoid(),
            camera([1.2, 0.8, 4.5], 42.0, [512, 512]),
            1e-10,
        ),
    ];
    for (shape, camera, limit) in cases {
        let mut random = Random::new(7);
        let (mut worst, mut count) = (0.0f64, 0);
        while count < 20_000 {
            let Some(known) = construct(&mut random, &camera, &shape) else {
                continue;
            };
            count += 1;
            let found = solve(&shape, camera.eye, known.vertex);
            assert_eq!(found.class, VertexClass::Reflected);
            assert_eq!(found.points.len(), 1, "vertex {}", known.vertex);
            worst = worst.max(nearest(&found, known.at));
        }
        println!("{shape:?}: worst {worst:e}");
        assert!(worst < limit, "{worst:e} off on {shape:?}");
    }
}

#[test]
fn mirrors_anywhere_of_any_size_are_solved() {
    let mut random = Random::new(3);
    for _ in 0..2_000 {
        let size = random.log_between(1e-3, 1e3);
        let center = size * 10.0 * random.direction();
        let radii = DVec3::new(
            random.log_between(0.05, 1.0),
            random.log_between(0.05, 1.0),
            random.log_between(0.05, 1.0),
        );
        for shape in [
            Shape::Sphere(Sphere {
                center,
                radius: size,
            }),
            Shape::Ellipsoid(Ellipsoid {
                center,
                radii: size * radii,
                rotation: random.rotation(),
            }),
        ] {
            let eye = center + size * random.between(1.5, 8.0) * random.direction();
            let target = center + size * 0.04 * random.direction();
            let dir = (target - eye).normalize();
            let hit = shape.intersect(eye, dir, 0.0).unwrap();
            let reflected = dir - 2.0 * dir.dot(hit.normal) * hit.normal;
            let vertex = hit.position + size * random.log_between(1e-2, 1e3) * reflected;
            let found = solve(&shape, eye, vertex);
            assert_eq!(found.points.len(), 1);
            let off = nearest(&found, hit.position) / size;
            assert!(
                off < 1e-9,
                "{off:e} sizes off on {shape:?} from {eye} to {vertex}"
            );
        }
    }
}

#[test]
fn sphere_hides_what_lies_behind_its_silhouette() {
    let mut random = Random::new(11);
    let ball = Shape::Ellipsoid(Ellipsoid {
        center: DVec3::ZERO,
        radii: DVec3::ONE,
        rotation: DMat3::IDENTITY,
    });
    for _ in 0..50_000 {
        let eye = random.log_between(1.001, 50.0) * random.direction();
        let vertex = random.log_between(1.001, 50.0) * random.direction();
        let limit = (1.0 / eye.length()).acos() + (1.0 / vertex.length()).acos();
        let angle = eye.angle_between(vertex);
        if (angle - limit).abs() < 1e-9 {
            continue;
        }
        let found = solve(&unit_sphere(), eye, vertex);
        let expected = if angle < limit {
            VertexClass::Reflected
        } else {
            VertexClass::Hidden
        };
        assert_eq!(found.class, expected, "{eye} {vertex}");
        assert_eq!(found.points.len(), usize::from(angle < limit));
        // A way that all but touches an ellipsoid counts as touching it.
        if (angle - limit).abs() > 1e-6 {
            let other = solve(&ball, eye, vertex);
            assert_eq!(other.class, expected);
            if let (Some(a), Some(b)) = (found.points.first(), other.points.first()) {
                assert!(a.distance(*b) < 1e-6, "{eye} {vertex}: {a} {b}");
            }
        }
    }
}

/// Next to the silhouette, and of vertices on the mirror, a point is found or none is there, but
/// no vertex takes the answers for others away.
#[test]
fn no_vertex_beside_an_ellipsoid_is_undecided() {
    let mut random = Random::new(17);
    for exponent in 0..16 {
        let off = 10f64.powi(-exponent);
        for _ in 0..500 {
            let radii = DVec3::new(
                random.log_between(0.05, 1.0),
                random.log_between(0.05, 1.0),
                1.0,
            );
            let unit = random.direction();
            let (point, normal) = (unit * radii, (unit / radii).normalize());
            let along = normal.cross(random.direction()).normalize();
            let shape = Shape::Ellipsoid(Ellipsoid {
                center: DVec3::ZERO,
                radii,
                rotation: DMat3::IDENTITY,
            });
            let lifted = point + off * normal;
            let grazing = [
                lifted + along * random.log_between(0.1, 10.0),
                lifted - along * random.log_between(0.01, 10.0),
            ];
            let above = point + random.log_between(0.1, 10.0) * (normal + along);
            for [eye, vertex] in [grazing, [above, lifted], [lifted, above]] {
                let found = solve(&shape, eye, vertex);
                assert_ne!(
                    found.class,
                    VertexClass::Unknown,
                    "{shape:?} {eye} {vertex}"
                );
                // Both of a distance of 1e-4 and more: solved like any other.
                if off >= 1e-4 {
                    let [at] = found.points[..] else { continue };
                    assert!(is_reflection(&shape, eye, vertex, at));
                }
            }
        }
    }
}

#[test]
fn inside_of_a_closed_mirror_nothing_is_reflected() {
    for shape in [unit_sphere(), prototype_ellipsoid()] {
        let eye = DVec3::new(0.0, 0.0, 4.0);
        for vertex in [
            DVec3::ZERO,
            DVec3::new(0.1, 0.2, 0.6),
            DVec3::new(0.0, 0.1, -3.0),
        ] {
            assert_eq!(solve(&shape, eye, vertex).class, VertexClass::Hidden);
            assert_eq!(solve(&shape, vertex, eye).class, VertexClass::Hidden);
        }
    }
}

#[test]
fn eye_and_vertex_on_one_line_with_the_centre() {
    for vertex in [
        DVec3::new(0.0, 0.0, 2.0),
        DVec3::new(0.0, 0.0, 4.0),
        DVec3::new(0.0, 0.0, 9.0),
    ] {
        let found = solve(&unit_sphere(), DVec3::new(0.0, 0.0, 4.0), vertex);
        assert_eq!(found.points.len(), 1);
        assert!(found.points[0].distance(DVec3::Z) < 1e-15);
    }
}

#[test]
fn bowl_has_all_solutions_and_the_known_shares() {
    let (bowl, camera) = (prototype_bowl(), camera([0.5, 0.35, 4.0], 34.0, [512, 512]));
    let mut random = Random::new(5);
    let (mut counts, mut total, mut worst) = ([0usize; 5], 0, 0.0f64);
    while total < 30_000 {
        let Some(known) = construct(&mut random, &camera, &bowl) else {
            continue;
        };
        total += 1;
        let found = solve(&bowl, camera.eye, known.vertex);
        worst = worst.max(nearest(&found, known.at));
        for point in &found.points {
            assert!(is_reflection(&bowl, camera.eye, known.vertex, *point));
        }
        counts[found.points.len()] += 1;
    }
    let shares = counts.map(|count| 100.0 * count as f64 / f64::from(total));
    println!("worst {worst:e}, shares {shares:?}");
    // Next to a caustic two solutions meet, and each is known only to the root of rounding.
    assert!(worst < 1e-6, "{worst:e}");
    for (share, expected) in shares.iter().zip([0.0, 44.0, 42.0, 14.0, 0.0]) {
        assert!((share - expected).abs() < 4.0, "{shares:?}");
    }
}

/// Counts sign changes of the residual around the circle, in the plane of eye and vertex.
#[test]
fn no_solution_on_a_sphere_is_missed() {
    let mut random = Random::new(13);
    let inside = Shape::Bowl(Bowl {
        center: DVec3::ZERO,
        radius: 1.0,
        axis: DVec3::X,
        half_angle: PI - 1e-9,
    });
    for _ in 0..300 {
        let flat = |random: &mut Random| {
            random.log_between(0.02, 20.0)
                * DVec2::from_angle(random.between(0.0, 2.0 * PI)).extend(0.0)
        };
        let (eye, vertex) = (flat(&mut random), flat(&mut random));
        let residual = |angle: f64| {
            let z = DVec2::from_angle(angle).extend(0.0);
            let (po, pv) = ((eye - z).normalize(), (vertex - z).normalize());
            let along = DVec3::new(-z.y, z.x, 0.0);
            (
                po.dot(along) + pv.dot(along),
                po.dot(z) < 0.0 && pv.dot(z) < 0.0,
            )
        };
        let steps = 100_000;
        let samples: Vec<_> = (0..=steps)
            .map(|i| residual(2.0 * PI * f64::from(i) / f64::from(steps)))
            .collect();
        let changes = samples
            .windows(2)
            .filter(|pair| pair[0].0 * pair[1].0 < 0.0 && pair[0].1 && pair[1].1)
            .count();
        let found = solve(&inside, eye, vertex).points.len();
        assert_eq!(found, changes, "{eye} {vertex}");
    }
}

#[test]
fn bowl_in_its_special_positions() {
    let (bowl, middle) = (prototype_bowl(), DVec3::new(0.0, 0.0, -1.5));
    let at = |z: f64| DVec3::new(0.0, 0.0, z);
    // Both in the centre.
    assert_eq!(solve(&bowl, DVec3::ZERO, DVec3::ZERO).points, [middle]);
    // One in the centre: the point of the bowl on the line through both.
    let vertex = DVec3::new(0.3, 0.2, -0.9);
    let expected = 1.5 * vertex.normalize();
    for (eye, vertex) in [(DVec3::ZERO, vertex), (vertex, DVec3::ZERO)] {
        let found = solve(&bowl, eye, vertex);
        assert_eq!(found.points.len(), 1);
        assert!(found.points[0].distance(expected) < 1e-14);
    }
    // On a line with the centre, mirrored in it: the middle, and a ring through (±1.5, 0) that
    // lies beyond the rim; closer to the bowl, a ring within it.
    let found = solve(&bowl, at(4.0), at(2.0));
    assert!(
        found
            .points
            .iter()
            .any(|point| point.distance(middle) < 1e-14)
    );
    let (eye, ring) = (at(0.6), 1.5 * DVec3::new(0.6, 0.0, -0.8));
    let dir = (ring - eye).normalize();
    let normal = -ring / 1.5;
    let reflected = dir - 2.0 * dir.dot(normal) * normal;
    let vertex = ring - ring.x / reflected.x * reflected;
    let found = solve(&bowl, eye, vertex);
    assert_eq!(found.points.len(), 3, "{found:?}");
    for point in &found.points {
        assert!(is_reflection(&bowl, eye, vertex, *point));
    }
}

#[test]
fn beyond_the_rim_is_unreflected() {
    let eye = DVec3::new(0.5, 0.35, 4.0);
    let narrow = Shape::Bowl(Bowl {
        center: DVec3::ZERO,
        radius: 1.5,
        axis: DVec3::NEG_Z,
        half_angle: 0.01,
    });
    let found = solve(&narrow, eye, DVec3::new(0.9, 0.0, -0.5));
    assert_eq!(found.class, VertexClass::Unreflected);
    assert!(found.points.is_empty());
}

#[test]
fn what_a_bowl_hides_from_the_eye_is_hidden() {
    let eye = DVec3::new(0.5, 0.35, 4.0);
    let bowl = Shape::Bowl(Bowl {
        center: DVec3::ZERO,
        radius: 1.5,
        axis: DVec3::NEG_Z,
        half_angle: 1.0,
    });
    let class = |vertex| solve(&bowl, eye, vertex).class;
    assert_eq!(class(DVec3::new(0.0, 0.0, -4.0)), VertexClass::Hidden);
    assert_eq!(class(DVec3::new(9.0, 0.0, -4.0)), VertexClass::Unreflected);
    assert_eq!(class(DVec3::new(0.0, 0.0, -1.0)), VertexClass::Reflected);
}

#[test]
fn plane_has_the_mirror_image() {
    let plane = Shape::Plane(Plane {
        center: DVec3::new(0.0, 1.0, 0.0),
        normal: DVec3::Y,
        up: DVec3::Z,
        size: DVec2::new(2.0, 4.0),
    });
    let eye = DVec3::new(0.0, 2.0, 0.0);
    let found = solve(&plane, eye, DVec3::new(1.0, 4.0, 3.0));
    assert_eq!(found.class, VertexClass::Reflected);
    assert!(found.points[0].distance(DVec3::new(0.25, 1.0, 0.75)) < 1e-15);
    // Width runs along x, height along z.
    assert_eq!(
        solve(&plane, eye, DVec3::new(0.0, 2.0, 3.9)).class,
        VertexClass::Reflected
    );
    assert_eq!(
        solve(&plane, eye, DVec3::new(2.1, 2.0, 0.0)).class,
        VertexClass::Unreflected
    );
    assert_eq!(
        solve(&plane, eye, DVec3::new(0.0, 0.5, 0.0)).class,
        VertexClass::Hidden
    );
    assert_eq!(
        solve(&plane, -eye, DVec3::new(0.0, 2.0, 0.0)).class,
        VertexClass::Hidden
    );
}

#[test]
fn vertices_come_in_order_and_know_what_is_in_view() {
    let camera = camera([0.0, 0.0, 4.0], 40.0, [64, 64]);
    let points = |name, positions| object(name, positions, vec![], Vec3::ONE);
    let (seen, behind) = (Vec3::new(0.6, 7.5, 1.2), Vec3::new(0.0, 0.0, -3.0));
    let objects = vec![
        points("a", vec![seen, behind]),
        points("b", vec![Vec3::new(0.0, 0.5, 2.0)]),
    ];
    let plane = Shape::Plane(Plane {
        center: DVec3::new(0.0, 0.0, -9.0),
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::splat(100.0),
    });
    let scene = scene(camera, objects, vec![unit_sphere(), plane]);
    let view = scene.camera.view([64, 64]);
    let truth = true_vertices(&scene, &view).unwrap();
    let classes: Vec<_> = truth.iter().map(|vertex| vertex.class).collect();
    let (reflected, hidden) = (VertexClass::Reflected, VertexClass::Hidden);
    assert_eq!(
        classes,
        [
            reflected, hidden, reflected, reflected, reflected, reflected
        ]
    );
    let frame = Tracer::new(&scene)
        .unwrap()
        .render(&RenderOptions::new([64, 64], Truth::FirstBounce));
    let mirrors = [scene.mirror_id(0), scene.mirror_id(1)];
    let visible: Vec<_> = truth
        .iter()
        .enumerate()
        .map(|(index, vertex)| in_view(vertex, &frame, mirrors[index / 3]))
        .collect();
    // What the plane reflects close to the axis is covered by the sphere.
    assert_eq!(visible, [true, false, true, true, false, false]);
    assert!(!in_view(&truth[0], &frame, mirrors[1]));
    let at = points_in_view(&truth[0], &frame, mirrors[0])
        .next()
        .unwrap();
    let (point, projected) = truth[0].points[0];
    assert_eq!(Some(at), projected);
    assert!(view.ray(at).angle_between(point - view.eye) < 1e-7);
}

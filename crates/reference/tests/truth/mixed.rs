//! Reflection points on surfaces of mixed curvature, where a vertex may have any number.

use std::f64::consts::{PI, TAU};

use crate::common::*;
use catoptric_frame::VertexClass;
use catoptric_reference::{Solutions, reflection_points};
use catoptric_scene::Shape;
use catoptric_scene::shape::{Plane, Saddle, Sphere, Torus};
use glam::{DVec2, DVec3};

fn torus() -> Shape {
    Shape::Torus(Torus {
        center: DVec3::new(0.1, 0.0, -0.2),
        axis: DVec3::new(0.2, 1.0, 0.6).normalize(),
        major: 1.0,
        minor: 0.45,
    })
}

fn saddle() -> Shape {
    Shape::Saddle(Saddle {
        center: DVec3::new(0.0, 0.1, 0.0),
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::new(2.4, 1.8),
        curvature: DVec2::new(0.9, -0.7),
    })
}

fn eye() -> DVec3 {
    DVec3::new(0.6, 0.5, 4.0)
}

fn solve(shape: &Shape, vertex: DVec3) -> Solutions {
    reflection_points(shape, eye(), vertex).unwrap()
}

/// A vertex reflected at a known point that the eye sees.
fn construct(random: &mut Random, shape: &Shape) -> Option<(DVec3, DVec3)> {
    let view = camera(eye().to_array(), 40.0, [512, 512]).view([512, 512]);
    let dir = view.ray(random.pixel([512, 512]));
    let hit = shape.intersect(view.eye, dir, 0.0)?;
    let cosine = dir.dot(hit.normal);
    if cosine >= 0.0 {
        return None;
    }
    let vertex = hit.position
        + random.log_between(0.05, 8.0) * (dir - 2.0 * cosine * hit.normal).normalize();
    Some((hit.position, vertex))
}

fn is_reflection(shape: &Shape, vertex: DVec3, at: DVec3) -> bool {
    let normal = shape.normal_at(at).unwrap();
    let (po, pv) = ((eye() - at).normalize(), (vertex - at).normalize());
    normal.dot(po) > 0.0 && normal.dot(pv) > 0.0 && (po + pv).cross(normal).length() < 1e-9
}

#[test]
fn constructed_points_are_found() {
    for (shape, most) in [(torus(), 8), (saddle(), 4)] {
        let mut random = Random::new(7);
        let (mut counts, mut unknown, mut total, mut worst) = ([0; 9], 0, 0, 0.0f64);
        while total < 3_000 {
            let Some((at, vertex)) = construct(&mut random, &shape) else {
                continue;
            };
            total += 1;
            let found = solve(&shape, vertex);
            if found.class == VertexClass::Unknown {
                unknown += 1;
                continue;
            }
            assert!((1..=most).contains(&found.points.len()), "{found:?}");
            counts[found.points.len()] += 1;
            let off = |point: &DVec3| point.distance(at);
            worst = worst.max(found.points.iter().map(off).fold(f64::INFINITY, f64::min));
            for point in &found.points {
                assert!(is_reflection(&shape, vertex, *point), "{vertex} {point}");
            }
        }
        println!("{shape:?}: worst {worst:e}, unknown {unknown}, counts {counts:?}");
        // Next to a caustic two solutions meet, and each is known only to the root of rounding.
        assert!(worst < 1e-6, "{worst:e} on {shape:?}");
        assert!(unknown * 500 <= total, "{unknown} of {total} undecided");
    }
}

/// Solutions that the eye sees, by brute force: around a simple zero the residual along the
/// surface winds once, so the cells of a grid around which it does are counted.
fn counted(
    shape: &Shape,
    vertex: DVec3,
    surface: impl Fn(DVec2) -> DVec3,
    size: [u32; 2],
) -> usize {
    let residual = |i: u32, j: u32| {
        let share = |index: u32, count: u32| f64::from(index) / f64::from(count);
        let at = |q: DVec2| surface(q);
        let q = DVec2::new(share(i, size[0]), share(j, size[1]));
        let step = 1e-6;
        let (point, normal) = (at(q), shape.normal_at(at(q)).unwrap());
        let (u, v) = (
            (at(q + DVec2::new(step, 0.0)) - at(q - DVec2::new(step, 0.0))).normalize(),
            (at(q + DVec2::new(0.0, step)) - at(q - DVec2::new(0.0, step))).normalize(),
        );
        let (po, pv) = ((eye() - point).normalize(), (vertex - point).normalize());
        let h = po + pv;
        let front = normal.dot(po) > 0.0 && normal.dot(pv) > 0.0;
        let first = shape.intersect(eye(), -po, 0.0);
        let front = front && first.is_some_and(|hit| hit.position.distance(point) < 1e-3);
        (DVec2::new(h.dot(u), h.dot(v)), front)
    };
    let row = |j: u32| (0..=size[0]).map(|i| residual(i, j)).collect::<Vec<_>>();
    let mut below = row(0);
    let mut count = 0;
    for j in 0..size[1] {
        let above = row(j + 1);
        for i in 0..size[0] as usize {
            let ring = [below[i], below[i + 1], above[i + 1], above[i]];
            if !ring.iter().all(|(_, front)| *front) {
                continue;
            }
            let turn: f64 = (0..4)
                .map(|k| ring[k].0.angle_to(ring[(k + 1) % 4].0))
                .sum();
            count += usize::from(turn.abs() > PI);
        }
        below = above;
    }
    count
}

#[test]
fn no_solution_is_missed() {
    let mut random = Random::new(5);
    let mut checked = 0;
    for _ in 0..24 {
        let vertex = DVec3::new(
            random.between(-2.5, 2.5),
            random.between(-2.5, 2.5),
            random.between(0.6, 3.0),
        );
        let (ring, patch) = (torus(), saddle());
        let Shape::Torus(Torus {
            center,
            axis,
            major,
            minor,
        }) = ring
        else {
            unreachable!()
        };
        let (x, y) = axis.any_orthonormal_pair();
        let on_torus = |q: DVec2| {
            let (sin, cos) = (TAU * q.x).sin_cos();
            let outward = x * cos + y * sin;
            let (sin, cos) = (TAU * q.y).sin_cos();
            center + major * outward + minor * (outward * cos + axis * sin)
        };
        let on_saddle = |q: DVec2| {
            let (x, y) = (2.4 * (q.x - 0.5), 1.8 * (q.y - 0.5));
            DVec3::new(x, 0.1 + y, (0.9 * x * x - 0.7 * y * y) / 2.0)
        };
        let cases: [(&Shape, usize); 2] = [
            (&ring, counted(&ring, vertex, on_torus, [240, 120])),
            (&patch, counted(&patch, vertex, on_saddle, [120, 90])),
        ];
        for (shape, expected) in cases {
            if shape.contains(vertex) {
                continue;
            }
            let found = solve(shape, vertex);
            assert_ne!(found.class, VertexClass::Unknown);
            assert_eq!(
                found.points.len(),
                expected,
                "{shape:?} {vertex}: {found:?}"
            );
            checked += found.points.len();
        }
    }
    assert!(checked > 40, "{checked}");
}

#[test]
fn an_almost_flat_saddle_is_a_plane() {
    let flat = Shape::Saddle(Saddle {
        center: DVec3::ZERO,
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::new(3.0, 2.0),
        curvature: DVec2::new(1e-9, -1e-9),
    });
    let plane = Shape::Plane(Plane {
        center: DVec3::ZERO,
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::new(3.0, 2.0),
    });
    let mut random = Random::new(3);
    for _ in 0..300 {
        let vertex = DVec3::new(
            random.between(-4.0, 4.0),
            random.between(-4.0, 4.0),
            random.between(-1.0, 4.0),
        );
        let (found, expected) = (solve(&flat, vertex), solve(&plane, vertex));
        assert_eq!(found.class, expected.class, "{vertex}");
        assert_eq!(found.points.len(), expected.points.len());
        for (a, b) in found.points.iter().zip(&expected.points) {
            assert!(a.distance(*b) < 1e-7, "{a} {b}");
        }
    }
}

/// In a plane through its axis a torus is two circles, whose reflection points are its own.
#[test]
fn in_a_plane_through_the_axis_a_torus_reflects_as_its_circle() {
    let torus = Shape::Torus(Torus {
        center: DVec3::ZERO,
        axis: DVec3::Y,
        major: 1.0,
        minor: 0.4,
    });
    let circle = Shape::Sphere(Sphere {
        center: DVec3::X,
        radius: 0.4,
    });
    let mut random = Random::new(9);
    let mut solved = 0;
    for _ in 0..200 {
        let flat = |random: &mut Random| {
            DVec3::new(random.between(1.6, 4.0), random.between(-2.0, 2.0), 0.0)
        };
        let (eye, vertex) = (flat(&mut random), flat(&mut random));
        let found = reflection_points(&torus, eye, vertex).unwrap();
        let expected = reflection_points(&circle, eye, vertex).unwrap();
        let Some(at) = expected.points.first() else {
            continue;
        };
        let off = |point: &DVec3| point.distance(*at);
        let nearest = found.points.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{eye} {vertex}: {nearest:e}, {found:?}");
        solved += 1;
    }
    assert!(solved > 150, "{solved}");
}

#[test]
fn what_lies_behind_is_hidden_and_beyond_the_rim_unreflected() {
    let class = |shape: &Shape, vertex| solve(shape, vertex).class;
    let shallow = Shape::Saddle(Saddle {
        center: DVec3::ZERO,
        normal: DVec3::Z,
        up: DVec3::Y,
        size: DVec2::new(2.0, 2.0),
        curvature: DVec2::new(0.1, -0.1),
    });
    let (behind, beside) = (DVec3::new(0.0, 0.0, -3.0), DVec3::new(9.0, 0.0, 1.0));
    assert_eq!(class(&shallow, behind), VertexClass::Hidden);
    assert_eq!(class(&shallow, beside), VertexClass::Unreflected);
}

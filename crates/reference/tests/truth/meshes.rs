//! Reflection points on mesh mirrors: against vertices made by following rays, against dense sampling,
//! against the closed forms that finer and finer meshes approach.

use std::path::Path;

use catoptric_reference::{Tracer, Truth, reflection_points, reflections};
use catoptric_scene::shape::Sphere;
use catoptric_scene::{LoadOptions, Mesh, Scene, Shape};
use glam::{DMat2, DVec2, DVec3, Vec3};

use crate::common::*;

/// A scene with one mirror, given by its lines.
fn with_mirror(lines: &str) -> Scene {
    let text = format!(
        "why = \"A test.\"\n[camera]\neye = [0.8, 0.9, 4.0]\ntarget = [0, 0, 0]\nfov_y = 40\n\
         [[object]]\nname = \"far\"\nshape = \"quad\"\ntransform = {{ scale = 0.01, translate = [0, -9, 0] }}\n\
         [[mirror]]\nname = \"mirror\"\n{lines}\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let pebble = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reference/scenes/pebble.obj");
    std::fs::copy(pebble, folder.path().join("pebble.obj")).unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let models = std::env::var_os("CATOPTRIC_MODELS").map(Into::into);
    let options = LoadOptions {
        models,
        ..LoadOptions::default()
    };
    Scene::load(path.to_str().unwrap(), &options).unwrap()
}

/// Vertices on reflected rays through random pixels, with the points that they leave the mirror at.
fn constructed(scene: &Scene, count: usize) -> Vec<(DVec3, DVec3)> {
    const SIZE: [u32; 2] = [640, 480];
    let tracer = Tracer::new(scene).unwrap();
    let view = scene.camera.view(SIZE);
    let mut random = Random::new(17);
    let mut vertices = Vec::new();
    let mut tries = 0;
    while vertices.len() < count {
        tries += 1;
        assert!(tries < 100 * count, "the mirror is hardly in view");
        let trace = tracer.reflect_pixel(&view, random.pixel(SIZE), Truth::FirstBounce);
        let Some((primary, reflection)) = trace.primary.zip(trace.reflection) else {
            continue;
        };
        let direction = reflection.direction;
        if direction == DVec3::ZERO {
            continue;
        }
        let far = random.log_between(0.05, 20.0);
        vertices.push((primary.position + far * direction, primary.position));
    }
    vertices
}

/// How many of the vertices do not have the point that they were made from among their answers, to
/// rounding.
fn missed(scene: &Scene, count: usize) -> usize {
    let shape = &scene.mirrors[0].shape;
    let (low, high) = shape.bounds();
    let solve = reflections(shape, scene.camera.eye).unwrap();
    let missed = constructed(scene, count)
        .into_iter()
        .filter(|(vertex, made_from)| {
            let found = solve(*vertex);
            let off = |point: &DVec3| point.distance(*made_from);
            let nearest = found.points.iter().map(off).fold(f64::INFINITY, f64::min);
            // Where two are about to meet they lose half of their digits.
            nearest > 1e-7 * (high - low).length()
        });
    missed.count()
}

const PEBBLE: &str = "mesh = \"pebble.obj\"";
const BOTTLE: &str = "shape = \"lathe\"
profile = [[0.0, -1.0], [0.8, -0.8], [0.3, -0.3], [0.3, 0.3], [0.8, 0.7], [0.0, 0.9]]
segments = 7";

#[test]
fn no_point_of_a_constructed_vertex_is_missed() {
    let teapot = "shape = \"teapot\"\nn = 6\ntransform = { scale = 0.4, translate = [0, -0.5, 0] }";
    for lines in [PEBBLE, teapot, BOTTLE] {
        assert_eq!(missed(&with_mirror(lines), 2000), 0, "{lines}");
    }
}

/// The same with more vertices and other people's models, in a folder that `CATOPTRIC_MODELS` names.
#[test]
#[ignore = "needs models that are not part of this project"]
fn no_point_is_missed_on_models() {
    let teapot = "mesh = \"teapot.obj\"\ntransform = { scale = 0.4, translate = [0, -0.5, 0] }";
    for lines in [PEBBLE, teapot, "mesh = \"suzanne.obj\""] {
        let scene = with_mirror(lines);
        let start = std::time::Instant::now();
        assert_eq!(missed(&scene, 10_000), 0, "{lines}");
        println!("{lines}: {:.1} s", start.elapsed().as_secs_f64());
    }
}

/// Points and normals of a mesh at the corners of its triangles.
fn triangles(mesh: &Mesh) -> impl Iterator<Item = ([DVec3; 3], [DVec3; 3])> + '_ {
    mesh.triangles
        .iter()
        .zip(&mesh.normals)
        .map(|(corners, normals)| {
            let corner = |index: u32| mesh.positions[index as usize].as_dvec3();
            (corners.map(corner), normals.map(Vec3::as_dvec3))
        })
}

fn mix([a, b, c]: &[DVec3; 3], q: DVec2) -> DVec3 {
    (1.0 - q.x - q.y) * a + q.x * b + q.y * c
}

/// Points found by looking at every triangle densely: where the reflected ray passes nearest to the
/// vertex, improved by Newton's method with differences.
fn sampled(mesh: &Mesh, eye: DVec3, vertex: DVec3) -> Vec<DVec3> {
    const CELLS: u32 = 24;
    let mut found = Vec::new();
    for (corners, normals) in triangles(mesh) {
        let facing = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let front = facing * facing.dot(normals[0] + normals[1] + normals[2]).signum();
        if (eye - corners[0]).dot(front) <= 0.0 {
            continue;
        }
        let miss = |q: DVec2| {
            let (point, normal) = (mix(&corners, q), mix(&normals, q).normalize());
            let view = (point - eye).normalize();
            let reflected = view - 2.0 * view.dot(normal) * normal;
            (reflected - (vertex - point).normalize(), reflected)
        };
        for cell in 0..CELLS * CELLS {
            let mut q = DVec2::new(f64::from(cell % CELLS), f64::from(cell / CELLS)) + 0.3;
            q /= f64::from(CELLS);
            if q.x + q.y > 1.0 || miss(q).0.length() > 0.3 {
                continue;
            }
            for _ in 0..12 {
                const STEP: f64 = 1e-7;
                let here = miss(q).0;
                let by = [DVec2::X, DVec2::Y].map(|along| (miss(q + STEP * along).0 - here) / STEP);
                // The least squares of three equations in two unknowns.
                let square = DMat2::from_cols(
                    DVec2::new(by[0].dot(by[0]), by[0].dot(by[1])),
                    DVec2::new(by[0].dot(by[1]), by[1].dot(by[1])),
                );
                q -= square.inverse() * DVec2::new(by[0].dot(here), by[1].dot(here));
            }
            let (off, reflected) = miss(q);
            // What lies on an edge may belong to the neighbour.
            let inside = q.x > 1e-6 && q.y > 1e-6 && q.x + q.y < 1.0 - 1e-6;
            if inside && off.length() < 1e-9 && reflected.dot(front) > 0.0 {
                found.push(mix(&corners, q));
            }
        }
    }
    found
}

#[test]
fn dense_sampling_finds_nothing_else() {
    let (mut sampled_points, mut several) = (0, 0);
    for lines in [PEBBLE, BOTTLE] {
        let scene = with_mirror(lines);
        let (shape, eye) = (&scene.mirrors[0].shape, scene.camera.eye);
        let tracer = Tracer::new(&scene).unwrap();
        let solve = reflections(shape, eye).unwrap();
        let mut random = Random::new(9);
        for _ in 0..100 {
            // On the eye's side, where the waist of the bottle shows a vertex twice and more.
            let vertex = (random.direction() + eye.normalize()) * random.log_between(0.8, 4.0);
            let found = solve(vertex);
            assert_eq!(found.undecided, 0);
            several += usize::from(found.points.len() > 1);
            for point in sampled(shape.as_mesh().unwrap(), eye, vertex) {
                let seen = tracer.trace(eye, (point - eye).normalize()).unwrap();
                if seen.position.distance(point) > 1e-5 {
                    continue;
                }
                sampled_points += 1;
                let near = |other: &DVec3| other.distance(point) < 1e-6;
                assert!(
                    found.points.iter().any(near),
                    "{vertex}: {point}, {found:?}"
                );
            }
        }
    }
    assert!(
        sampled_points > 20 && several > 5,
        "{sampled_points}, {several}"
    );
}

/// Of a plane the way to the mirror image of the eye passes through the reflection point.
#[test]
fn facets_have_the_planes_closed_form() {
    let scene = with_mirror(&format!("{BOTTLE}\nfacets = true"));
    let (shape, eye) = (&scene.mirrors[0].shape, scene.camera.eye);
    let tracer = Tracer::new(&scene).unwrap();
    let solve = reflections(shape, eye).unwrap();
    let mut random = Random::new(4);
    let mut checked = 0;
    for _ in 0..2000 {
        let vertex = random.direction() * random.log_between(1.2, 5.0);
        let mut expected = Vec::new();
        for ([a, b, c], normals) in triangles(shape.as_mesh().unwrap()) {
            let facing = (b - a).cross(c - a).normalize();
            let normal = facing * facing.dot(normals[0]).signum();
            let [before, also] = [eye, vertex].map(|point| (point - a).dot(normal));
            if before <= 0.0 || also <= 0.0 {
                continue;
            }
            let behind = eye - 2.0 * before * normal;
            let way = vertex - behind;
            let point = behind + (a - behind).dot(normal) / way.dot(normal) * way;
            let left = [(a, b), (b, c), (c, a)]
                .map(|(from, to)| (to - from).cross(point - from).dot(facing));
            let seen = tracer.trace(eye, (point - eye).normalize());
            let is_seen = seen.is_some_and(|hit| hit.position.distance(point) < 1e-5);
            if left.iter().all(|left| *left > 1e-9) && is_seen {
                expected.push(point);
            }
        }
        let found = solve(vertex).points;
        for point in &expected {
            let off = found
                .iter()
                .map(|other| other.distance(*point))
                .fold(f64::INFINITY, f64::min);
            assert!(off < 1e-9, "{vertex}: {off:e}");
        }
        assert!(found.len() >= expected.len());
        checked += expected.len();
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn finer_spheres_approach_the_closed_form() {
    let eye = DVec3::new(0.8, 0.9, 4.0);
    let sphere = Shape::Sphere(Sphere {
        center: DVec3::ZERO,
        radius: 1.0,
    });
    let mut random = Random::new(5);
    let vertices: Vec<DVec3> = (0..300)
        .map(|_| random.direction() * random.log_between(1.3, 6.0))
        .filter(|vertex| {
            let found = reflection_points(&sphere, eye, *vertex).unwrap();
            // Near the silhouette the mesh's outline decides.
            let to_eye = |point: &DVec3| (eye - point).normalize().dot(*point);
            found
                .points
                .first()
                .is_some_and(|point| to_eye(point) > 0.3)
        })
        .collect();
    assert!(vertices.len() > 100);
    let offset = |segments: u32| {
        let mesh = Shape::Mesh(sphere.tessellate(segments));
        let solve = reflections(&mesh, eye).unwrap();
        let off = vertices.iter().map(|vertex| {
            let exact = reflection_points(&sphere, eye, *vertex).unwrap().points[0];
            let found = solve(*vertex);
            assert_eq!(found.points.len(), 1, "{vertex}");
            found.points[0].distance(exact)
        });
        off.sum::<f64>() / vertices.len() as f64
    };
    let offsets = [32, 64, 128, 256].map(offset);
    for pair in offsets.windows(2) {
        let power = (pair[1] / pair[0]).log2();
        assert!((power + 2.0).abs() < 0.2, "{offsets:?}");
    }
}

//! Benchmarks of the reference: hierarchy, rays, pictures, exact reflection points.
//!
//! Two scenes: some 100 000 triangles in balls around a mirror ball, and, where the variable
//! `CATOPTRIC_MODELS` names a folder that has it, the Sponza atrium. Rays are those of a 256²
//! picture; times are of all of them, `thrpt` is rays (or pixels, vertices, triangles) a second.
//! `cargo xtask embree` puts the speed of the rays beside Embree's.

mod load;

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Duration;

use catoptric_reference::{RenderOptions, Tracer, Truth, reflections};
use catoptric_scene::shape::{Bowl, Ellipsoid, Sphere};
use catoptric_scene::{Scene, Shape};
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DMat3, DVec3};
use load::{Ray, Rays};
use rayon::prelude::*;

/// Width and height of the picture whose rays are traced.
const SIZE: [u32; 2] = [256, 256];

fn short<'a>(
    criterion: &'a mut Criterion,
    name: &str,
) -> BenchmarkGroup<'a, criterion::measurement::WallTime> {
    let mut group = criterion.benchmark_group(name);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    group
}

fn scenes() -> Vec<Scene> {
    let scenes = [Some(load::balls()), load::sponza()];
    scenes.into_iter().flatten().collect()
}

fn build(criterion: &mut Criterion) {
    let mut group = short(criterion, "hierarchy");
    for scene in scenes() {
        group.throughput(Throughput::Elements(scene.triangle_count() as u64));
        group.bench_function(format!("{}/build", scene.name), |bencher| {
            bencher.iter(|| Tracer::new(black_box(&scene)));
        });
    }
    group.finish();
}

fn rays(criterion: &mut Criterion) {
    let mut group = short(criterion, "rays");
    for scene in scenes() {
        let tracer = Tracer::new(&scene).expect("a sound scene");
        let Rays { primary, reflected } = Rays::new(&tracer, SIZE);
        for (kind, rays) in [("primary", &primary), ("reflected", &reflected)] {
            let sees = |(origin, dir): &Ray| match kind {
                "primary" => tracer.trace(*origin, *dir).is_some(),
                _ => tracer.trace_objects(*origin, *dir).is_some(),
            };
            let name = format!("{}/{kind}", scene.name);
            group.throughput(Throughput::Elements(rays.len() as u64));
            group.bench_function(format!("{name}/one thread"), |bencher| {
                bencher.iter(|| rays.iter().filter(|ray| sees(ray)).count());
            });
            group.bench_function(format!("{name}/all threads"), |bencher| {
                bencher.iter(|| rays.par_iter().filter(|ray| sees(ray)).count());
            });
        }
    }
    group.finish();
}

/// All layers at 640×480; the hierarchy is there already.
fn picture(criterion: &mut Criterion) {
    let mut group = short(criterion, "picture");
    for scene in scenes() {
        let tracer = Tracer::new(&scene).expect("a sound scene");
        let options = RenderOptions::new([640, 480], Truth::FirstBounce);
        group.throughput(Throughput::Elements(640 * 480));
        group.bench_function(&scene.name, |bencher| {
            bencher.iter(|| tracer.render(&options));
        });
    }
    group.finish();
}

fn vertices(criterion: &mut Criterion) {
    let scene = load::balls();
    let vertices: Vec<DVec3> = scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions)
        .step_by(10)
        .map(|position| position.as_dvec3())
        .collect();
    let center = DVec3::ZERO;
    let shapes = [
        (
            "sphere",
            Shape::Sphere(Sphere {
                center,
                radius: 1.5,
            }),
        ),
        (
            "bowl",
            Shape::Bowl(Bowl {
                center,
                radius: 5.0,
                axis: DVec3::NEG_Z,
                half_angle: PI / 3.0,
            }),
        ),
        (
            "ellipsoid",
            Shape::Ellipsoid(Ellipsoid {
                center,
                radii: DVec3::new(1.5, 0.7, 1.0),
                rotation: DMat3::IDENTITY,
            }),
        ),
    ];
    // The same sphere of some 20 000 triangles: what a mirror that is a mesh costs more.
    let mesh = Shape::Mesh(shapes[0].1.tessellate(200));
    let shapes: Vec<_> = shapes.into_iter().chain([("mesh", mesh)]).collect();
    let mut group = short(criterion, "reflection points");
    group.throughput(Throughput::Elements(vertices.len() as u64));
    for (name, shape) in &shapes {
        group.bench_function(*name, |bencher| {
            let solve = reflections(shape, scene.camera.eye).expect("exact points");
            bencher.iter(|| {
                let points = vertices.iter().map(|vertex| solve(*vertex).points.len());
                points.sum::<usize>()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, build, rays, picture, vertices);
criterion_main!(benches);

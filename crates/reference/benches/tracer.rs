//! Benchmarks of the reference: hierarchy, rays, exact reflection points.
//!
//! About 100 000 triangles in 25 balls around a mirror ball. Rays are those of a 256² picture;
//! times are of all of them, `thrpt` is rays (or vertices, or triangles) a second.

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Duration;

use catoptric_reference::{Tracer, Truth, reflection_points};
use catoptric_scene::{
    Background, Camera, Fov, Material, Mesh, Mirror, Object, Paint, Scene, Shape,
};
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DMat3, DVec2, DVec3, Vec3};
use rayon::prelude::*;

const SIZE: [u32; 2] = [256, 256];

fn balls() -> Scene {
    let objects = (0..25).map(|index| {
        let around = 2.0 * PI * f64::from(index) / 25.0;
        let height = f64::from(index % 5) - 2.0;
        let center = DVec3::new(2.6 * around.cos(), height, 2.6 * around.sin());
        let Mesh {
            positions,
            triangles,
            ..
        } = Shape::Sphere {
            center,
            radius: 0.45,
        }
        .tessellate(64);
        let name = format!("ball {index}");
        let materials = vec![Material {
            name: name.clone(),
            paint: Paint::Color(Vec3::ONE),
        }];
        let material = vec![0; triangles.len()];
        Object {
            name,
            mesh: Mesh {
                positions,
                triangles,
                material,
                materials,
                ..Mesh::default()
            },
        }
    });
    let shape = Shape::Sphere {
        center: DVec3::ZERO,
        radius: 1.5,
    };
    Scene {
        name: "balls".into(),
        why: "A load for benchmarks.".into(),
        camera: Camera {
            eye: DVec3::new(0.6, 1.5, 7.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: Fov::Y(40.0),
            resolution: SIZE,
        },
        background: Background::Color(Vec3::ZERO),
        objects: objects.collect(),
        mirrors: vec![Mirror {
            name: "mirror".into(),
            shape,
            tessellation: 64,
        }],
        motion: None,
        hash: String::new(),
    }
}

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

fn build(criterion: &mut Criterion) {
    let scene = balls();
    let mut group = short(criterion, "hierarchy");
    group.throughput(Throughput::Elements(scene.triangle_count() as u64));
    group.bench_function("build", |bencher| {
        bencher.iter(|| Tracer::new(black_box(&scene)))
    });
    group.finish();
}

fn rays(criterion: &mut Criterion) {
    let scene = balls();
    let tracer = Tracer::new(&scene).expect("a sound scene");
    let view = scene.camera.view(SIZE);
    let pixels = (0..SIZE[0] * SIZE[1]).map(|index| (index % SIZE[0], index / SIZE[0]));
    let traces: Vec<_> = pixels
        .map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)) + 0.5)
        .map(|at| tracer.reflect_pixel(&view, at, Truth::FirstBounce))
        .collect();
    let primary: Vec<_> = traces
        .iter()
        .map(|trace| (view.eye, trace.direction))
        .collect();
    let reflected: Vec<_> = traces
        .iter()
        .filter_map(|trace| Some((trace.primary?.position, trace.reflection?.direction)))
        .collect();
    let mut group = short(criterion, "rays");
    for (name, rays) in [("primary", &primary), ("reflected", &reflected)] {
        let sees = |(origin, dir): &(DVec3, DVec3)| match name {
            "primary" => tracer.trace(*origin, *dir).is_some(),
            _ => tracer.trace_objects(*origin, *dir).is_some(),
        };
        group.throughput(Throughput::Elements(rays.len() as u64));
        group.bench_function(format!("{name}/one thread"), |bencher| {
            bencher.iter(|| rays.iter().filter(|ray| sees(ray)).count());
        });
        group.bench_function(format!("{name}/all threads"), |bencher| {
            bencher.iter(|| rays.par_iter().filter(|ray| sees(ray)).count());
        });
    }
    group.finish();
}

fn vertices(criterion: &mut Criterion) {
    let scene = balls();
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
            Shape::Sphere {
                center,
                radius: 1.5,
            },
        ),
        (
            "bowl",
            Shape::Bowl {
                center,
                radius: 5.0,
                axis: DVec3::NEG_Z,
                half_angle: PI / 3.0,
            },
        ),
        (
            "ellipsoid",
            Shape::Ellipsoid {
                center,
                radii: DVec3::new(1.5, 0.7, 1.0),
                rotation: DMat3::IDENTITY,
            },
        ),
    ];
    let mut group = short(criterion, "reflection points");
    group.throughput(Throughput::Elements(vertices.len() as u64));
    for (name, shape) in &shapes {
        group.bench_function(*name, |bencher| {
            bencher.iter(|| {
                let solve = |vertex: &DVec3| reflection_points(shape, scene.camera.eye, *vertex);
                vertices.iter().map(solve).filter(Result::is_ok).count()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, build, rays, vertices);
criterion_main!(benches);

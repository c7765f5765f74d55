//! What judging a picture costs, at the default resolution.

use std::hint::black_box;

use catoptric_frame::{Frame, Image, Primary, Reflected, Status};
use catoptric_metrics::flip::{DEFAULT_PIXELS_PER_DEGREE, flip};
use catoptric_metrics::{Timing, compare};
use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;

const SIZE: [u32; 2] = [640, 480];

/// Stripes in a mirror that covers a third of the picture.
fn frame(shift: u32) -> Frame {
    let pixel = |index: u32| (index % SIZE[0], index / SIZE[0]);
    let pixels = || (0..SIZE[0] * SIZE[1]).map(pixel);
    let is_mirror = |x: u32, y: u32| x.abs_diff(320).pow(2) + y.abs_diff(240).pow(2) < 33_000;
    let stripe = |x: u32| (x + shift) / 16 % 3;
    let id = |x, y| if is_mirror(x, y) { stripe(x) } else { 0 };
    let color = |x, y| Vec3::new(0.2, 0.4, 0.7) * (1 + id(x, y)) as f32 / 3.0;
    let point = |x: u32, y: u32| Vec3::new(x as f32, y as f32, 0.0);
    let status = |x, y| {
        if is_mirror(x, y) {
            Status::Resolved
        } else {
            Status::NotMirror
        }
    };
    Frame {
        color: Image::from_vec(SIZE, pixels().map(|(x, y)| color(x, y)).collect()),
        primary: Some(Primary {
            id: Image::filled(SIZE, 0),
            position: Image::from_vec(SIZE, pixels().map(|(x, y)| point(x, y)).collect()),
            normal: Image::filled(SIZE, Vec3::Z),
        }),
        reflected: Some(Reflected {
            status: Image::from_vec(SIZE, pixels().map(|(x, y)| status(x, y)).collect()),
            id: Image::from_vec(SIZE, pixels().map(|(x, y)| id(x, y)).collect()),
            position: Image::filled(SIZE, Vec3::NEG_Z),
            distance: Image::filled(SIZE, 1.0),
            bounces: None,
        }),
        motion: None,
        names: Vec::new(),
    }
}

fn benchmark(criterion: &mut Criterion) {
    let (reference, test) = (frame(0), frame(1));
    let agreement = compare(&reference, &test).map(|comparison| comparison.object_agreement);
    assert!(
        matches!(agreement, Ok(Some(share)) if share > 0.9 && share < 1.0),
        "the pair that is timed differs a little: {agreement:?}"
    );

    let mut group = criterion.benchmark_group("metrics");
    group.sample_size(10);
    group.bench_function("compare/640x480", |bencher| {
        bencher.iter(|| compare(black_box(&reference), black_box(&test)));
    });
    group.bench_function("flip/640x480", |bencher| {
        bencher.iter(|| flip(&reference.color, &test.color, DEFAULT_PIXELS_PER_DEGREE));
    });
    let samples: Vec<f64> = (0..200).map(|i| f64::from(i * 37 % 101)).collect();
    group.bench_function("timing/200-samples", |bencher| {
        bencher.iter(|| Timing::of(black_box(&samples)));
    });
    group.finish();
}

criterion_group!(benches, benchmark);
criterion_main!(benches);

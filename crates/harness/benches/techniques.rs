//! Techniques by group: `linear-vs-hierarchy`, `adaptive-vs-full`, `image-order`.
//!
//! Each is timed as a whole frame and by the passes that are its own, on the GPU where the adapter
//! has a clock, else as waited for; `thrpt` is vertices searched or mirror pixels a second. Before
//! anything is timed its picture is compared with the truth: a wrong one ends the run.

use std::cell::{OnceCell, RefCell};
use std::time::Duration;

use catoptric::suites::benched::{Bench, Judged, Stand, benches, own_passes, whole_frame};
use catoptric_reflect::{Gpu, Prefer};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn techniques(criterion: &mut Criterion) {
    let gpu = match Gpu::new(None, Prefer::Hardware) {
        Ok(gpu) => gpu,
        Err(error) => {
            eprintln!("no benchmark without an adapter: {error}");
            return;
        }
    };
    if !gpu.info().timestamps {
        eprintln!("this adapter has no clock: frames are timed as waited for, passes not at all");
    }
    let all = benches();
    for of_scene in all.chunk_by(|one, next| (one.group, one.scene) == (next.group, next.scene)) {
        let Bench { group, scene, .. } = of_scene[0];
        let judged = Judged::new(scene).expect("a built-in scene");
        let mut criterion_group = criterion.benchmark_group(group);
        criterion_group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(100))
            .measurement_time(Duration::from_secs(1))
            .throughput(Throughput::Elements(judged.elements(group)));
        for bench in of_scene {
            if let Some(reason) = judged.left_out(bench, &gpu) {
                eprintln!("{} on {scene} is left out: {reason}", bench.technique);
                continue;
            }
            // Prepared and judged when the first of the two is asked for.
            let stand = OnceCell::new();
            let mut time = |what: &str, milliseconds: fn(&mut Stand<'_>) -> f64| {
                let id = BenchmarkId::new(format!("{scene}/{}", bench.technique), what);
                criterion_group.bench_function(id, |bencher| {
                    let stand = stand.get_or_init(|| RefCell::new(ready(&judged, bench, &gpu)));
                    let stand = &mut stand.borrow_mut();
                    bencher.iter_custom(|frames| {
                        let total: f64 = (0..frames).map(|_| milliseconds(stand)).sum();
                        Duration::from_secs_f64(total / 1e3)
                    });
                });
            };
            time("frame", |stand| whole_frame(&stand.time()));
            if gpu.info().timestamps {
                time("own passes", own_passes_of_a_frame);
            }
        }
        criterion_group.finish();
    }
}

/// The technique, with a picture that was found right.
///
/// # Panics
/// If its picture is wrong.
fn ready<'g>(judged: &Judged, bench: &Bench, gpu: &'g Gpu) -> Stand<'g> {
    let stand = judged.stand(bench, gpu);
    stand.unwrap_or_else(|reason| {
        panic!(
            "{} on {}: not timed: {reason}",
            bench.technique, bench.scene
        )
    })
}

/// Milliseconds of a frame's own passes. A frame whose passes do not add up to it is rendered again.
fn own_passes_of_a_frame(stand: &mut Stand<'_>) -> f64 {
    const TRIES: usize = 20;
    let mut frames = (0..TRIES).map(|_| stand.time());
    let own = frames.find_map(|frame| own_passes(&frame));
    own.expect("passes that add up to the frame")
}

criterion_group!(groups, techniques);
criterion_main!(groups);

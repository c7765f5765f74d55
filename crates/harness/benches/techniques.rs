//! A frame of each technique on a few scenes: GPU time where the adapter has a clock, else wall
//! time.

use std::time::Duration;

use catoptric_reflect::{Family, Gpu, Prefer, Prepared, Support};
use catoptric_scene::LoadOptions;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

const SCENES: [&str; 4] = ["sphere-table", "sphere-objects-1k", "ellipsoid", "planar"];
/// Two triangles, of which a refinement makes many.
const REFINED: &str = "sphere-square";
const RESOLUTION: [u32; 2] = [640, 480];

/// What is timed on a scene: every technique that is built, refinements on [`REFINED`] alone.
fn timed(scene: &str) -> Vec<String> {
    let all = catoptric_reflect::list();
    let built = all.iter().filter(|info| info.reason().is_none());
    let refines = |family: Family| family == Family::Refinement;
    let here = built.filter(|info| refines(info.family) == (scene == REFINED));
    here.map(|info| match refines(info.family) {
        true => format!("linear{}", info.name),
        false => info.name.to_owned(),
    })
    .collect()
}

fn techniques(criterion: &mut Criterion) {
    let gpu = match Gpu::new(None, Prefer::Hardware) {
        Ok(gpu) => gpu,
        Err(error) => {
            eprintln!("no benchmark without an adapter: {error}");
            return;
        }
    };
    let options = LoadOptions {
        resolution: Some(RESOLUTION),
        ..LoadOptions::default()
    };
    for name in SCENES.into_iter().chain([REFINED]) {
        let scene = catoptric_scene::open(name, &options).expect("a built-in scene");
        let mut group = criterion.benchmark_group(name);
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(500))
            .measurement_time(Duration::from_secs(2));
        for technique in timed(name) {
            let spec = catoptric_reflect::parse(&technique).expect("a technique that exists");
            if let Support::No(reason) = catoptric_reflect::supports(&spec, &scene) {
                eprintln!("{technique} does not apply to {name}: {reason}");
                continue;
            }
            let mut prepared = catoptric_reflect::prepare(&gpu, &spec, &scene, RESOLUTION)
                .expect("a supported scene");
            group.bench_function(BenchmarkId::from_parameter(&technique), |bencher| {
                bencher.iter_custom(|frames| time(&mut prepared, frames));
            });
        }
        group.finish();
    }
}

/// Time of that many frames.
fn time(prepared: &mut Prepared<'_>, frames: u64) -> Duration {
    let mut total = Duration::ZERO;
    for _ in 0..frames {
        let frame = prepared
            .time_frame()
            .expect("a frame that was rendered before");
        total += Duration::from_secs_f64(frame.gpu_ms.unwrap_or(frame.wall_ms) / 1e3);
    }
    total
}

criterion_group!(benches, techniques);
criterion_main!(benches);

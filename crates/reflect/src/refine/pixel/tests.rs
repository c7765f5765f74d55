//! What the refinement promises, on the software adapter.

use catoptric_scene::Scene;
use glam::{DVec3, Vec2, Vec3};

use super::*;
use crate::gpu::storage_bytes;
use crate::stage::points::{Found, Points, points_layout};
use crate::testing::{Searched, gpu_or_skip, scene};
use crate::{Output, parse, prepare};

const SIZE: [u32; 2] = [160, 120];

fn output(gpu: &Gpu, scene: &Scene, technique: &str) -> Output {
    let spec = parse(technique).expect("a technique");
    let mut prepared = prepare(gpu, &spec, scene, SIZE).expect("fits the device");
    prepared.render().expect("renders")
}

/// Pixels of the background that are enclosed by the reflected surface.
fn enclosed(output: &Output) -> usize {
    let reflected = output.frame.reflected.as_ref().expect("layers");
    let ids = reflected.id.pixels();
    let (width, height) = (SIZE[0] as usize, SIZE[1] as usize);
    let mut outside = vec![false; ids.len()];
    let mut todo: Vec<usize> = (0..ids.len())
        .filter(|index| {
            let (x, y) = (index % width, index / width);
            ids[*index] == 0 && (x == 0 || y == 0 || x + 1 == width || y + 1 == height)
        })
        .collect();
    while let Some(index) = todo.pop() {
        if std::mem::replace(&mut outside[index], true) {
            continue;
        }
        let (x, y) = (index % width, index / width);
        let next = [
            (x > 0).then(|| index - 1),
            (x + 1 < width).then(|| index + 1),
            (y > 0).then(|| index - width),
            (y + 1 < height).then(|| index + width),
        ];
        todo.extend(next.into_iter().flatten().filter(|next| ids[*next] == 0));
    }
    (0..ids.len())
        .filter(|index| ids[*index] == 0 && !outside[*index])
        .count()
}

#[test]
fn no_crack_opens_from_twenty_places() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("crack");
    let (eye, target) = (scene.camera.eye, scene.camera.target);
    let mut published = 0;
    let spec = parse("newton+pixel").expect("a technique");
    let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits the device");
    for place in 0..20 {
        let turn = f64::from(place);
        let aside = DVec3::new(
            turn.sin(),
            0.6 * (1.7 * turn).cos(),
            0.4 * (0.9 * turn).sin(),
        );
        scene.camera.eye = eye + 0.12 * (eye - target).length() * aside;
        prepared.update(&scene).expect("the same scene");
        let drawn = prepared.render().expect("renders");
        assert_eq!(drawn.t_junctions, Some(0), "place {place}");
        assert_eq!(enclosed(&drawn), 0, "place {place}");
        let triangles = drawn.triangles.expect("counted");
        assert!(triangles.drawn > 8, "place {place}: {triangles:?}");
        assert_eq!(triangles.unfinished, 0, "place {place}");
        if place < 3 {
            published += enclosed(&output(&gpu, &scene, "newton+adaptive"));
        }
    }
    assert!(published > 0, "the published rule tears this scene");
}

/// All drawn triangles of a scene's first sheet, and what searches for points that lie on their sides.
struct Made {
    searched: Searched,
    corners: Vec<[passes::Corner; 3]>,
}

fn made(gpu: &Gpu, name: &str, technique: &str, size: [u32; 2]) -> Made {
    let scene = scene(name);
    let spec = parse(technique).expect("a technique");
    let searched = Searched::new(gpu, &scene, technique, size);
    let options = spec.refinement().expect("a refinement").of();
    let (options, _): (Pixel, _) = options.expect("by pixels");
    let mut refinement = searched.make(gpu, technique, |context| ByPixels::new(context, options));
    let stage = &searched.stage;
    loop {
        refinement.begin_frame(gpu, stage, false);
        searched.on_sheets(gpu, |frame, sheet| {
            let (search, variant) = (searched.search.as_ref(), Variant::AllLayers);
            refinement.record(frame, stage, search, sheet, variant);
        });
        if !refinement.outgrown(gpu, stage).expect("fits") {
            break;
        }
    }
    let (search, sheet) = (searched.search.as_ref(), searched.sheets[0]);
    let drawn = (refinement.passes).drawn(gpu, &searched.stage, search, sheet);
    Made {
        corners: drawn.into_iter().map(|(_, corners)| corners).collect(),
        searched,
    }
}

/// Distance from a point to a line through several others.
fn distance_to(line: &[Vec2], point: Vec2) -> f32 {
    let pairs = line.windows(2).map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        let along = (point - a).dot(b - a) / (b - a).length_squared().max(1e-12);
        point.distance(a.lerp(b, along.clamp(0.0, 1.0)))
    });
    pairs.fold(f32::INFINITY, f32::min)
}

/// How far drawn edges are from their true curves, both ways, in pixels: the largest of each.
fn deviations(gpu: &Gpu, made: &Made) -> Vec<f32> {
    const PARTS: usize = 8;
    let sides = made
        .corners
        .iter()
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let seen = |corner: &passes::Corner| corner.found.state == Found::FOUND;
    let sides = sides.filter(|side| side.iter().all(|corner| seen(corner)));
    let sides: Vec<_> = sides.collect();
    let between = sides.iter().flat_map(|[a, b]| {
        (1..PARTS).map(|part| a.position.lerp(b.position, part as f32 / PARTS as f32))
    });
    let between: Vec<[f32; 4]> = between
        .map(|position: Vec3| position.extend(1.0).to_array())
        .collect();
    let Searched {
        stage,
        search,
        sheets,
        ..
    } = &made.searched;
    let positions = storage_bytes(gpu, bytemuck::cast_slice(&between));
    let points = Points::new(gpu, &points_layout(gpu), &positions, between.len() as u32);
    gpu.run(|frame| {
        stage.record_maps(frame, 0);
        search.record_build(frame, stage, 0);
        search.record_search(frame, stage, sheets[0], &points, Variant::AllLayers);
    });
    let found = points.read_found(gpu, between.len() as u32);
    let curves = sides.iter().zip(found.chunks_exact(PARTS - 1));
    let off = curves.filter_map(|([a, b], between)| {
        let ends = [a.found.at, b.found.at];
        let all_found = between.iter().all(|found| found.state == Found::FOUND);
        let curve: Vec<_> = std::iter::once(ends[0])
            .chain(between.iter().map(|found| found.at))
            .chain([ends[1]])
            .collect();
        let there = curve.iter().map(|point| distance_to(&ends, *point));
        let back = (1..PARTS).map(|part| {
            let point = ends[0].lerp(ends[1], part as f32 / PARTS as f32);
            distance_to(&curve, point)
        });
        all_found.then(|| there.chain(back).fold(0.0, f32::max))
    });
    off.collect()
}

#[test]
fn no_edge_is_farther_from_its_true_curve_than_was_asked_for() {
    let Some(gpu) = gpu_or_skip() else { return };
    let (coarse, fine) = ((0.5, 0.75, 0.5), (0.1, 0.2, 0.1));
    // At a tenth of a pixel some of the table's edges are farther off: see the README's limits.
    for (scene, asked) in [
        ("sphere-square", &[coarse, fine][..]),
        ("ellipsoid-square", &[coarse, fine]),
        ("sphere-table", &[coarse]),
    ] {
        for (error, most, of_most) in asked {
            let technique = format!("newton+pixel(error={error})");
            let made = made(&gpu, scene, &technique, [320, 240]);
            let mut off = deviations(&gpu, &made);
            off.sort_by(f32::total_cmp);
            let (worst, p99) = (off[off.len() - 1], off[off.len() * 99 / 100]);
            let name = format!("{scene}, {technique}: {} edges", off.len());
            assert!(off.len() > 60, "{name}");
            assert!(worst <= *most && p99 <= *of_most, "{name}: {worst} {p99}");
        }
    }
}

#[test]
fn a_frame_that_outgrows_its_room_is_made_anew() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let spec = parse("newton+pixel(error=0.02)").expect("a technique");
    let mut prepared = prepare(&gpu, &spec, &scene, SIZE).expect("fits the device");
    let first = prepared.render().expect("renders");
    let triangles = first.triangles.clone().expect("counted");
    assert!(triangles.drawn > 20_000, "{triangles:?}");
    // And every frame is the same to the bit.
    for _ in 0..2 {
        prepared.time_frame().expect("renders");
        let again = prepared.render().expect("renders");
        let layers = |output: &Output| {
            let reflected = output.frame.reflected.clone().expect("layers");
            (output.frame.color.clone(), reflected.position, reflected.id)
        };
        assert!(layers(&first) == layers(&again));
        assert_eq!(
            (&first.triangles, first.searched, first.work),
            (&again.triangles, again.searched, again.work)
        );
    }
}

#[test]
fn what_is_small_in_the_picture_is_split_less() {
    let Some(gpu) = gpu_or_skip() else { return };
    let drawn = |name: &str| {
        let output = output(&gpu, &scene(name), "newton+pixel");
        output.triangles.expect("counted").drawn
    };
    let [large, small] = ["sphere-square", "square-small-4"].map(drawn);
    assert!(2 * small < large, "{large} {small}");
}

#[test]
fn a_limit_that_is_reached_is_counted() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-square");
    for (level, limited) in [(1, true), (8, false)] {
        let technique = format!("newton+pixel(level={level})");
        let triangles = output(&gpu, &scene, &technique).triangles.expect("counted");
        assert_eq!(
            triangles.unfinished > 0,
            limited,
            "{technique}: {triangles:?}"
        );
    }
}

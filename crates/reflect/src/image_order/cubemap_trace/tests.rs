//! On a software adapter: versions of the technique that must agree do.

use catoptric_frame::{Frame, Image, Status, Traced};
use catoptric_scene::Scene;
use glam::Vec3;

use super::maps::{MORE, MirrorMaps, TraceUniform};
use super::options::CubemapTrace;
use crate::gpu::Gpu;
use crate::image_order::cubemaps::{FACES, Wanted, maps_layout};
use crate::testing::{gpu_or_skip, scene, stage};
use crate::{Answer, Output, Question, Spec, parse};

const SIZE: [u32; 2] = [80, 60];

/// Share of mirror pixels that a skipping march must give the same id as one that does not skip:
/// points on the border of two texels may fall into either.
const SAME_BY_SKIPPING: f64 = 0.999;
/// The same for the compute version, which computes where a ray leaves a texel by other formulas.
const SAME_BY_LANES: f64 = 0.995;

fn render(gpu: &Gpu, scene: &Scene, technique: &str) -> Output {
    traced(gpu, scene, technique).0
}

/// A frame, and what its rays took.
fn traced(gpu: &Gpu, scene: &Scene, technique: &str) -> (Output, Traced) {
    let spec = parse(technique).expect("a technique");
    let mut prepared = crate::prepare(gpu, &spec, scene, SIZE).expect("fits the device");
    let output = prepared.render().expect("renders");
    match prepared.ask(Question::Traced) {
        Ok(Some(Answer::Traced(traced))) => (output, traced),
        other => panic!("rays are followed: {other:?}"),
    }
}

fn options(spec: &Spec) -> CubemapTrace {
    let (options, _) = spec.options.of().expect("its own options");
    options
}

/// Share of the mirror pixels that have the same state and id in both.
fn same(a: &Frame, b: &Frame) -> f64 {
    let [a, b] = [a, b].map(|frame| frame.reflected.as_ref().expect("all layers"));
    let states = a.status.pixels().iter().zip(b.status.pixels());
    let ids = a.id.pixels().iter().zip(b.id.pixels());
    let mirror = states
        .zip(ids)
        .filter(|((a, _), _)| **a != Status::NotMirror);
    let (mut same, mut all) = (0, 0);
    for ((a, b), (id_a, id_b)) in mirror {
        all += 1;
        same += u32::from(a == b && id_a == id_b);
    }
    assert!(all > 500, "the mirror is in view: {all}");
    f64::from(same) / f64::from(all)
}

#[test]
fn skipping_changes_nothing_and_saves_samples() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-objects-1k");
    let criteria = [
        "analytic",
        "analytic,accept=any",
        "analytic,restart=clear",
        "analytic,sampling=texel,restart=clear",
        "both,accept=any,restart=clear",
        "analytic,sampling=angle",
        "analytic,sampling=texel",
        "analytic,sampling=texel-entry",
        "distance",
        "both",
        "both,accept=any",
        "both,accept=any,sampling=texel,objects=1,limit=0.1",
        "switch",
    ];
    for criterion in criteria {
        let technique = |pyramid| {
            format!(
                "cubemap-trace(size=128,criterion={criterion},placement=random,pyramid={pyramid})"
            )
        };
        let every = render(&gpu, &scene, &technique("off"));
        let skipping = render(&gpu, &scene, &technique("sound"));
        let share = same(&every.frame, &skipping.frame);
        assert!(share >= SAME_BY_SKIPPING, "{criterion}: {share}");
        assert!(
            skipping.work.samples < every.work.samples.map(|samples| 0.5 * samples),
            "{criterion}"
        );
        assert!(skipping.work.skips > Some(0.0) && every.work.skips == Some(0.0));
        assert!(skipping.work.node_tests > skipping.work.skips);
    }
}

#[test]
fn a_mirror_that_moved_is_seen_where_it_is() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("bowl");
    scene.mirrors[0].cubemaps = vec![scene.camera.eye];
    let technique =
        "cubemap-trace(size=64,objects=1,bounces=3,update=frame,placement=scene,sampling=texel)";
    let spec = parse(technique).expect("a technique");
    let ready = |scene: &Scene| crate::prepare(&gpu, &spec, scene, SIZE).expect("fits the device");
    let picture = |prepared: &mut crate::Prepared<'_>| {
        let output = prepared.render().expect("renders");
        output.frame.color
    };
    let mut moving = ready(&scene);
    let before = picture(&mut moving);
    let catoptric_scene::Shape::Bowl(bowl) = &mut scene.mirrors[0].shape else {
        panic!("a bowl")
    };
    bowl.center.x += 0.3;
    moving.update(&scene).expect("the same scene");
    let moved = picture(&mut moving);
    assert_ne!(before, moved);
    assert_eq!(moved, picture(&mut ready(&scene)));
}

#[test]
fn rays_grow_with_the_scene_where_maps_are_drawn_in_every_frame() {
    let Some(gpu) = gpu_or_skip() else { return };
    let still = scene("sphere-square");
    let mut grown = still.clone();
    let mut far = grown.objects[0].clone();
    for position in &mut far.mesh.positions {
        *position = 3.0 * *position;
    }
    grown.objects[0] = far;
    for criterion in ["analytic", "distance"] {
        let technique = format!(
            "cubemap-trace(size=64,objects=1,update=frame,placement=scene,criterion={criterion})"
        );
        let spec = parse(&technique).expect("a technique");
        let ready = |scene: &Scene| {
            let mut scene = scene.clone();
            scene.mirrors[0].cubemaps = vec![scene.camera.eye];
            let prepared = crate::prepare(&gpu, &spec, &scene, SIZE).expect("fits the device");
            (prepared, scene)
        };
        let picture = |prepared: &mut crate::Prepared<'_>| {
            let output = prepared.render().expect("renders");
            let reflected = output.frame.reflected.expect("all layers");
            (output.frame.color, reflected.id, output.work.samples)
        };
        let (mut moving, _) = ready(&still);
        let before = picture(&mut moving);
        let (mut fresh, grown) = ready(&grown);
        moving.update(&grown).expect("the same scene");
        let moved = picture(&mut moving);
        assert_ne!(before.0, moved.0, "{criterion}");
        assert_eq!(moved, picture(&mut fresh), "{criterion}");
    }
}

#[test]
fn lanes_find_what_fragments_find_texel_by_texel() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    for criterion in ["analytic", "analytic,accept=any", "distance"] {
        // 64: three levels, the last with less than 32 cells a node.
        let technique = |options| {
            format!("cubemap-trace(size=64,criterion={criterion},placement=random,{options})")
        };
        let fragments = render(&gpu, &scene, &technique("sampling=texel"));
        let lanes = render(&gpu, &scene, &technique("stage=compute"));
        let share = same(&fragments.frame, &lanes.frame);
        assert!(share >= SAME_BY_LANES, "{criterion}: {share}");
    }
}

#[test]
fn lanes_agree_by_ballots_as_they_do_in_memory() {
    let Some(gpu) = gpu_or_skip() else { return };
    if gpu.info().subgroups.is_none() {
        eprintln!("skipped: {} has no subgroups", gpu.info().name);
        return;
    }
    let scene = scene("sphere-table");
    let lanes = |agree| {
        let technique =
            format!("cubemap-trace(size=128,stage=compute,placement=random,agree={agree})");
        traced(&gpu, &scene, &technique)
    };
    let (ballot, memory) = (lanes("ballot"), lanes("memory"));
    assert_eq!(same(&ballot.0.frame, &memory.0.frame), 1.0);
    assert_eq!(ballot.1, memory.1);
    assert_ne!(ballot.0.notes, memory.0.notes);
}

#[test]
fn maps_stand_where_the_scene_says() {
    let Some(gpu) = gpu_or_skip() else { return };
    let spec = parse("cubemap-trace(size=32,placement=scene)").expect("a technique");
    let mut scene = scene("sphere-table");
    let reason = |scene: &Scene, spec| match crate::supports(spec, scene) {
        crate::Support::Yes => String::new(),
        crate::Support::No(reason) => reason,
    };
    assert!(reason(&scene, &spec).contains("0 of the 2 maps"));
    let center = scene.mirrors[0].shape.center();
    let above = center + 1.5 * glam::DVec3::Y;
    scene.mirrors[0].cubemaps = vec![above, center];
    assert_eq!(reason(&scene, &spec), "");
    let stage = stage(&gpu, &scene, SIZE);
    let places = super::placement::places(&gpu, &options(&spec), &stage).expect("fits the device");
    assert_eq!(places, [[above, center]]);
    // Where the maps show the mirror, they must see it from outside.
    let spec = parse("cubemap-trace(bounces=2,placement=scene)").expect("a technique");
    assert!(reason(&scene, &spec).contains("inside mirror"));
    let apart =
        parse("cubemap-trace(bounces=2,placement=scene,mirrors=apart)").expect("a technique");
    assert_eq!(reason(&scene, &apart), "");
}

#[test]
fn what_is_counted_adds_up() {
    let Some(gpu) = gpu_or_skip() else { return };
    let (output, traced) = traced(
        &gpu,
        &scene("sphere-table"),
        "cubemap-trace(size=32,objects=3,placement=random,accept=continuous)",
    );
    let status = &output.frame.reflected.expect("all layers").status;
    let count = |state| status.pixels().iter().filter(|s| **s == state).count() as u64;
    assert_eq!(traced.resolved_by.len(), 3);
    assert_eq!(traced.unresolved, count(Status::Unresolved));
    assert_eq!(traced.pixels(), count(Status::Resolved) + traced.unresolved);
    let samples: u64 = traced.samples.pixels().iter().map(|n| u64::from(*n)).sum();
    let mean = samples as f64 / traced.pixels() as f64;
    let samples = output.work.samples.expect("samples are counted");
    assert!((samples - mean).abs() < 1e-9 * mean);
}

#[test]
fn looking_closer_at_a_sign_change_is_counted() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let samples = |accept| {
        let technique =
            format!("cubemap-trace(size=64,objects=1,placement=random,accept={accept})");
        let (output, traced) = traced(&gpu, &scene, &technique);
        assert_eq!(output.work.node_tests, None, "there is no pyramid");
        traced.samples
    };
    let (any, continuous) = (samples("any"), samples("continuous"));
    let pairs = any.pixels().iter().zip(continuous.pixels());
    let more = pairs
        .filter(|(any, _)| **any > 0)
        .map(|(any, more)| more - any);
    let more: Vec<u32> = more.collect();
    // Ten halvings, and the two ends of what they leave.
    assert!(more.iter().all(|more| *more >= 12));
    let at_once = more.iter().filter(|more| **more == 12).count();
    assert!(2 * at_once > more.len(), "{at_once} of {}", more.len());
}

#[test]
fn a_texel_is_looked_up_by_one_lane() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let technique =
        |options| format!("cubemap-trace(size=64,objects=1,placement=random,accept=any,{options})");
    let lanes = render(&gpu, &scene, &technique("stage=compute"));
    let every = render(&gpu, &scene, &technique("sampling=texel"));
    // What the lanes look up are texels that the ray passes, each once, and its start.
    assert!(lanes.work.samples < every.work.samples);
    assert!(lanes.work.samples >= Some(2.0) && lanes.work.node_tests > Some(1.0));
}

#[test]
fn a_pixel_that_no_map_resolves_is_filled() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let left = |unresolved| {
        // Rays too short to reach anything far.
        let technique = format!(
            "cubemap-trace(size=32,objects=1,placement=random,length=0.3,unresolved={unresolved})"
        );
        let (output, traced) = traced(&gpu, &scene, &technique);
        let before = traced.unresolved;
        let status = &output.frame.reflected.expect("all layers").status;
        let states = status.pixels().iter();
        (
            before,
            states.filter(|s| **s == Status::Unresolved).count() as u64,
        )
    };
    let (before, marked) = left("mark");
    assert!(before > 0);
    assert_eq!(marked, before);
    assert_eq!(left("background"), (before, before));
    for filling in ["environment", "best", "trace"] {
        assert_eq!(left(filling), (before, 0), "{filling}");
    }
    let (same, neighbours) = left("neighbours");
    assert!(
        same == before && neighbours < before,
        "{neighbours} of {before}"
    );
}

#[test]
fn the_pyramid_is_that_of_the_cpu() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-objects-1k");
    let options = options(&parse("cubemap-trace").expect("a technique"));
    let stage = stage(&gpu, &scene, SIZE);
    let wanted = Wanted {
        size: 32,
        centers: vec![scene.mirrors[0].shape.center()],
        traced: 1,
        mirrors: None,
    };
    let trace = TraceUniform::new(&options, &scene);
    let layout = maps_layout(&gpu, "test", MORE);
    let maps = MirrorMaps::new(&gpu, true, &trace, &stage, wanted, &layout);
    let maps = maps.expect("fits the device");
    gpu.run(|frame| maps.record(frame, &stage));

    let far = maps.maps.far(&scene);
    let distances = gpu.read_layers(&maps.maps.distances, 0);
    assert!(distances.contains(&0.0), "the background is in view");
    assert!(distances.iter().all(|d| *d < far));
    let range = |d: f32| if d == 0.0 { [far; 2] } else { [d; 2] };
    let mut finer: Vec<[f32; 2]> = distances.into_iter().map(range).collect();
    let pyramid = maps.pyramid.expect("was asked for").texture;
    for level in 0..pyramid.mip_level_count() {
        let side = (pyramid.width() >> level) as usize;
        let mut cells = Vec::with_capacity(finer.len() / 4);
        for row in 0..FACES as usize * side {
            for column in 0..side {
                let at = |dy, dx| finer[(2 * row + dy) * 2 * side + 2 * column + dx];
                let children = [at(0, 0), at(0, 1), at(1, 0), at(1, 1)];
                let least = children.iter().map(|c| c[0]).fold(f32::INFINITY, f32::min);
                let most = children.iter().map(|c| c[1]).fold(0.0, f32::max);
                cells.push([least, most]);
            }
        }
        let on_gpu = gpu.read_layers(&pyramid, level);
        let on_gpu: Vec<[f32; 2]> = on_gpu.chunks_exact(2).map(|c| [c[0], c[1]]).collect();
        assert_eq!(on_gpu, cells, "level {level}");
        finer = cells;
    }
}

#[test]
fn each_texel_is_sampled_once_where_a_ray_enters_it() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let by_size = [64, 256].map(|size| {
        let technique = |sampling| {
            format!("cubemap-trace(size={size},objects=1,placement=random,accept=any,sampling={sampling})")
        };
        let entry = traced(&gpu, &scene, &technique("texel-entry"));
        let texel = traced(&gpu, &scene, &technique("texel"));
        let step = render(&gpu, &scene, &technique("step"));
        assert!(entry.0.work.samples < step.work.samples);
        // What is met inside a texel shows at the border to the next one.
        let pairs = entry.1.samples.pixels().iter().zip(texel.1.samples.pixels());
        let earlier = pairs.filter(|(entry, texel)| *entry + 2 < **texel).count();
        assert!(100 * earlier < texel.1.samples.pixels().len(), "{earlier}");
        1.0 - same(&entry.0.frame, &texel.0.frame)
    });
    // A texel more is less where texels are small.
    assert!(
        by_size[0] < 0.1 && by_size[1] < 0.5 * by_size[0],
        "{by_size:?}"
    );
}

#[test]
fn turning_is_what_the_option_says() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let picture = |options: &str| {
        let technique = format!("cubemap-trace(size=64,placement=random,accept=any,{options})");
        render(&gpu, &scene, &technique).frame.color
    };
    // No ray turns by more than half a turn, and every one by some angle.
    assert_eq!(
        picture("criterion=switch,turn=-1"),
        picture("criterion=analytic")
    );
    assert_eq!(
        picture("criterion=switch,turn=1"),
        picture("criterion=distance")
    );
    assert_eq!(
        picture("criterion=switch"),
        picture("criterion=switch,turn=0.7")
    );
    assert_ne!(
        picture("criterion=switch"),
        picture("criterion=switch,turn=0.2")
    );
}

#[test]
fn colours_are_blended_where_they_are_asked_to_be() {
    let Some(gpu) = gpu_or_skip() else { return };
    let scene = scene("sphere-table");
    let shown = |options: &str| {
        let technique = format!("cubemap-trace(size=32,placement=random,{options})");
        let frame = render(&gpu, &scene, &technique).frame;
        (frame.color, frame.reflected.expect("all layers").id)
    };
    let (nearest, linear) = (shown("filter=nearest"), shown("filter=linear"));
    assert_eq!(nearest.1, linear.1);
    assert_eq!(nearest.0, shown("step=0.001").0);
    // Neighbouring pixels differ less: blended colours are no steps.
    let steps = |image: &Image<Vec3>| -> f32 {
        let rows = image.pixels().chunks_exact(SIZE[0] as usize);
        let pairs = rows.flat_map(|row| row.windows(2));
        pairs.map(|pair| pair[0].distance_squared(pair[1])).sum()
    };
    assert!(steps(&linear.0) < steps(&nearest.0));
}

#[test]
fn maps_by_need_are_placed_anew_when_the_view_has_moved() {
    let Some(gpu) = gpu_or_skip() else { return };
    let mut scene = scene("sphere-table");
    let spec = parse("cubemap-trace(size=32,objects=auto)").expect("a technique");
    let ready = |scene: &Scene| crate::prepare(&gpu, &spec, scene, SIZE).expect("fits the device");
    let picture = |prepared: &mut crate::Prepared<'_>| {
        let output = prepared.render().expect("renders");
        (output.frame.color, output.notes)
    };
    let mut moving = ready(&scene);
    let places = |notes: &[String]| {
        notes
            .iter()
            .find(|note| note.starts_with("maps of"))
            .cloned()
    };
    let (_, before) = picture(&mut moving);
    assert!(places(&before).is_some());
    let mirror = scene.mirrors[0].shape.center();
    scene.camera.eye += 0.05 * (scene.camera.eye - mirror);
    moving.update(&scene).expect("the same scene");
    assert_eq!(places(&picture(&mut moving).1), places(&before));
    scene.camera.eye = 2.0 * mirror - scene.camera.eye;
    moving.update(&scene).expect("the same scene");
    let moved = picture(&mut moving);
    assert_eq!(moved, picture(&mut ready(&scene)));
    assert_ne!(places(&moved.1), places(&before));
}

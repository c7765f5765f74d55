//! Where a search looks for one vertex, step by step.
//!
//! The search runs with the shader feature `path` on a batch of one point: record 0 of its answers
//! is the answer, the records after it are the steps, with the level in place of the state and a
//! distance of 1.

use encase::StorageBuffer;
use glam::Vec3;

use crate::diagnostics::Visit;
use crate::error::ReflectError;
use crate::gpu::{Gpu, storage_bytes};
use crate::search::{Asked, Context, Instrumentation, Sheet};
use crate::stage::Stage;
use crate::stage::options::Hidden;
use crate::stage::points::{Dispatch, Found, Points, Range, points_layout};
use crate::stage::variant::Variant;

/// Steps that are kept.
const MOST: u32 = 4096;

/// The steps of a search for a world-space point on a mirror (an index), at most 4095. Empty for a
/// search that does not tell its steps.
///
/// # Errors
/// As [`crate::prepare`].
pub(crate) fn path(
    gpu: &Gpu,
    asked: &Asked,
    stage: &Stage,
    point: Vec3,
    mirror: usize,
) -> Result<Vec<Visit>, ReflectError> {
    let points_layout = points_layout(gpu);
    let search = asked.recipe.make(&Context {
        gpu,
        stage,
        extends: asked.common.hidden == Hidden::Extend,
        points_layout: &points_layout,
        instrumentation: Instrumentation::Path,
    })?;
    let range = Range {
        first: 0,
        count: 1,
        warm: 0,
        listed: 0,
    };
    let mut bytes = StorageBuffer::new(Vec::new());
    bytes.write(&range).expect("writing to memory");
    let range = storage_bytes(gpu, bytes.as_ref());
    let position = storage_bytes(gpu, bytemuck::cast_slice(&point.extend(1.0).to_array()));
    let dispatch = Dispatch::Direct(1);
    let points = Points::with_range(gpu, &points_layout, &position, MOST, range, dispatch);
    let sheets = Sheet::all(search.as_ref(), stage.world.mirrors.len());
    let first = sheets.into_iter().find(|sheet| sheet.mirror == mirror);
    let first = first.expect("every mirror has a sheet");
    gpu.run(|frame| {
        stage.begin(frame, Variant::AllLayers);
        stage.record_maps(frame, mirror);
        search.record_build(frame, stage, mirror);
        search.record_search(frame, stage, first, &points, Variant::AllLayers);
    });
    let records = points.read_found(gpu, MOST).into_iter().skip(1);
    let visits = records.take_while(|record| record.distance == 1.0);
    let visit = |record: Found| Visit {
        at: record.at,
        level: record.state,
    };
    Ok(visits.map(visit).collect())
}

#[cfg(test)]
mod tests {
    use crate::testing::{Searched, gpu_or_skip, scene};
    use crate::{Answer, Question, parse, prepare};

    #[test]
    fn paths_are_as_long_as_the_counted_steps_and_end_at_the_answer() {
        let Some(gpu) = gpu_or_skip() else { return };
        let (scene, size) = (scene("prototype-sphere"), [128, 128]);
        for technique in ["linear", "ray-hierarchy(repair=enlarge)"] {
            let searched = Searched::new(&gpu, &scene, technique, size);
            let spec = parse(technique).expect("a technique");
            let prepared = prepare(&gpu, &spec, &scene, size).expect("fits the device");
            for vertex in [0, 7] {
                let point = scene.objects[0].mesh.positions[vertex];
                let question = Question::Path { point, mirror: 0 };
                let Ok(Some(Answer::Path(visits))) = prepared.ask(question) else {
                    panic!("{technique} tells its steps")
                };
                let count = vertex as u32 + 1;
                let effort = searched.batches[0].read_efforts(&gpu, count)[vertex];
                let found = searched.batches[0].read_found(&gpu, count)[vertex];
                assert_eq!(visits.len(), effort.steps as usize, "{technique}");
                let last = visits.last().expect("at least one step");
                // The walk ends where it stays; the descent at the parent of the pixel.
                let near = if last.level == 0 { 0.0 } else { 8.0 };
                assert!(
                    last.at.distance(found.at) <= near,
                    "{technique}: {last:?} {found:?}"
                );
            }
        }
    }
}

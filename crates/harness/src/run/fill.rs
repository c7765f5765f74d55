//! Load → trace the reference → render → compare → time → **record**.

use catoptric_metrics::{Comparison, Timing, VertexReport};
use catoptric_reflect::Spec;

use crate::record::{AgainstFull, Raw, Record, Times, Wall};

use super::compare::Compared;
use super::render::Rendered;
use super::sampling::Samples;

/// Fills a row from all that is known.
pub fn record(
    mut row: Record,
    spec: &Spec,
    rendered: &Rendered<'_>,
    compared: Compared,
    samples: Option<Samples>,
) -> Record {
    let Comparison {
        coverage,
        object_agreement,
        mismatch,
        angular_error_deg,
        edge_offset_px,
        color,
        non_finite,
        regions,
        more,
    } = compared.first;
    if coverage.mirror_pixels == 0 {
        row.meta
            .notes
            .push("no mirror pixel is in view: nothing to compare".to_owned());
    }
    row.meta.notes.extend(non_finite.reason());
    row.coverage = Some(coverage);
    row.object_agreement = object_agreement;
    row.mismatch = mismatch;
    row.angular_error_deg = angular_error_deg;
    row.edge_offset_px = edge_offset_px;
    row.pixel_angle_deg = compared.pixel_angle;
    row.color = color;
    row.non_finite = Some(non_finite);
    row.regions = Some(regions);
    row.more = Some(more);
    row.against_full = Some(AgainstFull {
        object_agreement: compared.full.object_agreement,
        angular_error_deg: compared.full.angular_error_deg,
    });
    if let Some(report) = compared.vertices {
        // With a refinement, those are not the scene's vertices alone.
        let searched = rendered.output.searched;
        row.vertices = Some(VertexReport { searched, ..report });
        if spec.refinement().is_some() {
            row.meta.notes.push(
                "vertices.searched counts the refinement's searches; the rest of vertices is about \
                 the scene's own vertices"
                    .to_owned(),
            );
        }
    }
    row.meta.notes.extend(compared.no_exact);
    row.meta.notes.extend(rendered.output.notes.iter().cloned());
    row.triangles = rendered.output.triangles.clone();
    row.work = Some(rendered.output.work.summed());
    row.resolved_by = rendered.traced.as_ref().map(|traced| {
        let pixels = traced.pixels().max(1) as f64;
        let shares = traced.resolved_by.iter();
        shares.map(|count| *count as f64 / pixels).collect()
    });
    row.temporal = rendered.temporal.clone();
    row.motion = rendered.motion.clone();
    if let Some(samples) = samples {
        row.time_ms = times(rendered.prepare_ms, compared.exact_ms, &samples);
        let build = row.time_ms.as_ref().and_then(|times| times.build.as_ref());
        if let Some(build) = build {
            row.meta.notes.push(format!(
                "what the rays are traced through is built on the CPU before each frame, in {:.1} ms, \
                 which the times of the frame do not contain",
                build.median
            ));
        }
        row.raw = Some(Raw {
            frame_ms: samples.gpu().unwrap_or_default(),
            wall_ms: samples.wall(),
        });
    }
    row
}

fn times(prepare: f64, exact_points: Option<f64>, samples: &Samples) -> Option<Times> {
    let (passes, passes_reason) = match samples.passes() {
        Ok(passes) => (Some(passes), None),
        Err(reason) => (None, Some(reason)),
    };
    let wall = Timing::of(&samples.wall())?.median;
    let frame = samples.gpu().and_then(|times| Timing::of(&times));
    Some(Times {
        prepare,
        exact_points,
        frame,
        passes,
        passes_reason,
        build: Timing::of(&samples.builds()),
        own: Timing::of(&samples.own()),
        wall: Wall { median: wall },
    })
}

//! The words of the sentence: load → trace the reference → render → compare → time → record.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use catoptric_frame::{Frame, Status as Pixel, TrueVertex};
use catoptric_metrics::{CompareOptions, Comparison, Summary, Timing, VertexReport};
use catoptric_reference::{NotAvailable, RenderOptions, Tracer, Truth as Bounces, true_vertices};
use catoptric_reflect::{DistanceLevel, Gpu, Output, Prepared, ReflectError, Spec, Support};
use catoptric_scene::{LoadOptions, Scene, SceneError, builtin};
use glam::DVec2;

use crate::exit::bad_input;
use crate::measure::{self, Samples};
use crate::motion::{self, Steadiness};
use crate::record::{AgainstFull, Raw, Record, Status, Times, Wall};

/// Set by Ctrl-C: what is finished is kept, what is not begun is left out.
pub static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// True after Ctrl-C.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Loads a scene. A built-in one whose model is missing is no error but has nothing to show, with a
/// reason; anything else that is wrong is the user's to mend.
pub fn load(name: &str, options: &LoadOptions) -> anyhow::Result<Result<Scene, String>> {
    match catoptric_scene::open(name, options) {
        Ok(scene) => Ok(Ok(scene)),
        Err(error @ SceneError::MissingModel { .. }) if builtin::text(name).is_some() => {
            Ok(Err(error.to_string()))
        }
        Err(error) => Err(error.into()),
    }
}

/// The size of a scene's pictures.
pub fn size(scene: &Scene) -> [u32; 2] {
    scene.camera.resolution
}

/// Pixels of a picture at most, enough for 7680×4320: with all layers, of several renderers, a
/// pixel takes some hundred bytes of memory.
const MOST_PIXELS: u64 = 1 << 25;

/// Refuses a picture that cannot be rendered: sides up to `limit`, [`MOST_PIXELS`] in all.
pub fn check_size(size: [u32; 2], limit: u32, whose: &str) -> anyhow::Result<()> {
    let [width, height] = size;
    let too_large = |why: String| {
        let text = format!("a picture of {width}x{height} pixels is too large: {why}");
        Err(bad_input(text))
    };
    if width.max(height) > limit {
        too_large(format!("{whose} ends at {limit} a side"))
    } else if u64::from(width) * u64::from(height) > MOST_PIXELS {
        too_large(format!("{MOST_PIXELS} are the most"))
    } else {
        Ok(())
    }
}

/// What techniques are judged by.
pub struct Truth {
    /// Reflected rays see everything but mirrors.
    pub first: Frame,
    /// Mirrors are seen in mirrors.
    pub full: Frame,
    /// Exact reflection points, by mirror, object and vertex.
    pub vertices: Result<Vec<TrueVertex>, NotAvailable>,
    /// What answers in whole pixels are off by.
    pub pixel_angle: Option<Summary>,
}

/// Traces both truths and finds the exact reflection points.
pub fn trace_reference(scene: &Scene, bounces: u32) -> anyhow::Result<Truth> {
    let tracer = Tracer::new(scene)?;
    let first = tracer.render(&RenderOptions::new(size(scene), Bounces::FirstBounce));
    let full = tracer.render(&RenderOptions::new(size(scene), Bounces::Full { bounces }));
    let vertices = true_vertices(scene, &scene.camera.view(size(scene)));
    let pixel_angle = catoptric_metrics::pixel_angle_deg(&first)?;
    Ok(Truth {
        first,
        full,
        vertices,
        pixel_angle,
    })
}

/// A technique that stands ready, and its picture with all layers.
pub struct Rendered<'g> {
    prepared: Prepared<'g>,
    prepare_ms: f64,
    /// Over the frames of the scene's motion, once [`follow`] has been there.
    temporal: Option<Steadiness>,
    /// Picture, vertices, triangles and work.
    pub output: Output,
}

impl Rendered<'_> {
    /// The pyramid over the technique's cube maps of distance, if it has one.
    pub fn distance_levels(&self) -> Option<Vec<DistanceLevel>> {
        self.prepared.distance_levels()
    }
}

/// Why a row has no numbers.
pub type Blank = (Status, String);

/// Prepares a technique and renders one frame with all layers: the first one, or the second where
/// a frame helps to find the next, as the timed ones are.
pub fn render<'g>(gpu: &'g Gpu, spec: &Spec, scene: &Scene) -> Result<Rendered<'g>, Blank> {
    if let Support::No(reason) = catoptric_reflect::supports(spec, scene) {
        return Err((Status::NotApplicable, reason));
    }
    let failed = |error: ReflectError| match error {
        ReflectError::Adapter(_) => (Status::NotApplicable, one_line(&error)),
        _ => (Status::Failed, one_line(&error)),
    };
    let start = Instant::now();
    let mut prepared = catoptric_reflect::prepare(gpu, spec, scene, size(scene)).map_err(failed)?;
    let prepare_ms = start.elapsed().as_secs_f64() * 1e3;
    prepared.settle().map_err(failed)?;
    let output = prepared.render().map_err(failed)?;
    Ok(Rendered {
        prepared,
        prepare_ms,
        temporal: None,
        output,
    })
}

/// Follows a technique over `frames` frames of the scene's motion.
pub fn follow(
    rendered: &mut Result<Rendered<'_>, Blank>,
    scene: &Scene,
    frames: u32,
) -> Result<(), Blank> {
    if let Ok(rendered) = rendered {
        rendered.temporal = motion::follow(&mut rendered.prepared, scene, frames)?;
    }
    Ok(())
}

/// What comparing with the truth yields.
pub struct Compared {
    first: Comparison,
    full: Comparison,
    vertices: Option<VertexReport>,
    /// Why there are no exact reflection points to compare with.
    no_exact: Option<String>,
    pixel_angle: Option<Summary>,
}

/// Compares a technique's picture and reflection points with the truth.
pub fn compare(scene: &Scene, truth: &Truth, output: &Output) -> Result<Compared, Blank> {
    let failed = |error: catoptric_metrics::MetricsError| (Status::Failed, error.to_string());
    let options = CompareOptions {
        t_junctions: output.t_junctions,
        may_be_unresolved: output.may_be_unresolved,
        ..CompareOptions::default()
    };
    let first =
        catoptric_metrics::compare_with(&truth.first, &output.frame, &options).map_err(failed)?;
    let full =
        catoptric_metrics::compare_with(&truth.full, &output.frame, &options).map_err(failed)?;
    let vertices = output
        .vertices
        .as_ref()
        .map(|results| match &truth.vertices {
            Err(_) => Ok(VertexReport::without_truth(results)),
            Ok(exact) => {
                let in_view = |pair: usize, at: DVec2| in_view(scene, &truth.first, pair, at);
                catoptric_metrics::vertex_report(results, exact, in_view)
            }
        });
    let reason = truth.vertices.as_ref().err().map(ToString::to_string);
    Ok(Compared {
        first,
        full,
        no_exact: reason.filter(|_| vertices.is_some()),
        vertices: vertices.transpose().map_err(failed)?,
        pixel_angle: truth.pixel_angle,
    })
}

/// Whether image point `at` lies on a pixel that shows the mirror of entry `pair`.
pub fn in_view(scene: &Scene, frame: &Frame, pair: usize, at: DVec2) -> bool {
    let (Some(primary), Some(reflected)) = (&frame.primary, &frame.reflected) else {
        return false;
    };
    let [width, height] = frame.color.size();
    if !(at.x >= 0.0 && at.y >= 0.0 && at.x < f64::from(width) && at.y < f64::from(height)) {
        return false;
    }
    let mirror = scene.mirror_id(pair / scene.vertex_count().max(1));
    let (x, y) = (at.x as u32, at.y as u32);
    *primary.id.at(x, y) == mirror && *reflected.status.at(x, y) != Pixel::Back
}

/// Times the techniques that could be rendered, in turn, within the budget; the result has an
/// entry for each of them, in order.
pub fn time(
    rendered: &mut [Result<Rendered<'_>, Blank>],
    budget: Duration,
) -> Vec<Option<Result<Samples, Blank>>> {
    let places: Vec<bool> = rendered.iter().map(Result::is_ok).collect();
    let mut ready: Vec<&mut Prepared<'_>> = rendered
        .iter_mut()
        .filter_map(|row| row.as_mut().ok())
        .map(|row| &mut row.prepared)
        .collect();
    let mut samples = measure::interleaved(&mut ready, budget, interrupted).into_iter();
    places
        .into_iter()
        .map(|place| place.then(|| samples.next()).flatten())
        .map(|row| row.map(|row| row.map_err(|error| (Status::Failed, one_line(&error)))))
        .collect()
}

/// Fills a row from all that is known.
pub fn record(
    mut row: Record,
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
    } = compared.first;
    if coverage.mirror_pixels == 0 {
        row.meta
            .notes
            .push("no mirror pixel is in view: nothing to compare".to_owned());
    }
    row.coverage = Some(coverage);
    row.object_agreement = object_agreement;
    row.mismatch = mismatch;
    row.angular_error_deg = angular_error_deg;
    row.edge_offset_px = edge_offset_px;
    row.pixel_angle_deg = compared.pixel_angle;
    row.color = color;
    row.non_finite = Some(non_finite);
    row.regions = Some(regions);
    row.against_full = Some(AgainstFull {
        object_agreement: compared.full.object_agreement,
        angular_error_deg: compared.full.angular_error_deg,
    });
    if let Some(report) = compared.vertices {
        // With a refinement, those are not the scene's vertices alone.
        let searched = rendered.output.searched;
        row.vertices = Some(VertexReport { searched, ..report });
        if row.technique.contains('+') {
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
    row.work = Some(rendered.output.work);
    row.resolved_by = rendered.output.traced.as_ref().map(|traced| {
        let pixels = traced.pixels().max(1) as f64;
        let shares = traced.resolved_by.iter();
        shares.map(|count| *count as f64 / pixels).collect()
    });
    row.temporal = rendered.temporal.clone();
    if let Some(samples) = samples {
        row.time_ms = times(rendered.prepare_ms, &samples);
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

fn times(prepare: f64, samples: &Samples) -> Option<Times> {
    let (passes, passes_reason) = match samples.passes() {
        Ok(passes) => (Some(passes), None),
        Err(reason) => (None, Some(reason)),
    };
    let wall = Timing::of(&samples.wall())?.median;
    let frame = samples.gpu().and_then(|times| Timing::of(&times));
    Some(Times {
        prepare,
        frame,
        passes,
        passes_reason,
        build: Timing::of(&samples.builds()),
        wall: Wall { median: wall },
    })
}

/// An error and its causes in one line.
pub fn one_line(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join(": ")
}

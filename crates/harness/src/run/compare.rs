//! Load → trace the reference → render → **compare** → time → record.

use catoptric_frame::{Frame, Status as Pixel};
use catoptric_metrics::{CompareOptions, Comparison, Summary, VertexReport};
use catoptric_reflect::Output;
use catoptric_scene::Scene;
use glam::DVec2;

use crate::record::Status;

use super::render::RowError;
use super::truth::Truth;

/// What comparing with the truth yields.
pub struct Compared {
    pub(super) first: Comparison,
    pub(super) full: Comparison,
    pub(super) vertices: Option<VertexReport>,
    /// Milliseconds that the exact reflection points took; `None` where nothing is compared with them.
    pub(super) exact_ms: Option<f64>,
    /// Why there are no exact reflection points to compare with.
    pub(super) no_exact: Option<String>,
    pub(super) pixel_angle: Option<Summary>,
}

impl Compared {
    /// Against the truth that techniques are judged by.
    pub fn first(&self) -> &Comparison {
        &self.first
    }
}

/// Compares a technique's picture and reflection points with the truth.
pub fn compare(scene: &Scene, truth: &Truth, output: &Output) -> Result<Compared, RowError> {
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
        exact_ms: (vertices.is_some() && truth.vertices.is_ok()).then_some(truth.vertices_ms),
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

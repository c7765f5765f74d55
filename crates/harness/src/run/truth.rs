//! Load → **trace the reference** → render → compare → time → record.

use std::time::Instant;

use catoptric_frame::{Frame, TrueVertex};
use catoptric_metrics::Summary;
use catoptric_reference::{
    NotAvailable, RenderOptions, Tracer, Truth as Bounces, true_vertices_watched,
};
use catoptric_scene::Scene;

use super::load::size;
use super::progress::Progress;

/// What techniques are judged by.
pub struct Truth {
    /// Reflected rays see everything but mirrors.
    pub first: Frame,
    /// Mirrors are seen in mirrors.
    pub full: Frame,
    /// Exact reflection points, by mirror, object and vertex.
    pub vertices: Result<Vec<TrueVertex>, NotAvailable>,
    /// Milliseconds that finding them took.
    pub vertices_ms: f64,
    /// What answers in whole pixels are off by.
    pub pixel_angle: Option<Summary>,
}

/// Traces both truths and finds the exact reflection points.
pub fn trace_reference(scene: &Scene, bounces: u32, progress: &Progress) -> anyhow::Result<Truth> {
    let doing = |what: &str| format!("{}: {what}", scene.name);
    progress.doing(doing("tracing the reference"));
    let tracer = Tracer::new(scene)?;
    let first = tracer.render(&RenderOptions::new(size(scene), Bounces::FirstBounce));
    let full = tracer.render(&RenderOptions::new(size(scene), Bounces::Full { bounces }));
    let start = Instant::now();
    let searching = doing("exact reflection points");
    let vertices = true_vertices_watched(scene, &scene.camera.view(size(scene)), &|found, all| {
        progress.part(&searching, found, all);
    });
    let vertices_ms = start.elapsed().as_secs_f64() * 1e3;
    let pixel_angle = catoptric_metrics::pixel_angle_deg(&first)?;
    Ok(Truth {
        first,
        full,
        vertices,
        vertices_ms,
        pixel_angle,
    })
}

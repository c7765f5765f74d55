//! What the figures share: techniques, and where their numbers stand in a record.

use crate::show::plot::{Axis, Scale};

pub const MEDIAN_PX: &str = "vertices.offset_px.p50";
pub const MEAN_PX: &str = "vertices.offset_px.mean";
pub const P95_PX: &str = "vertices.offset_px.p95";
pub const AGREEMENT: &str = "object_agreement";
pub const MISSING: &str = "coverage.missing";
pub const EXTRA: &str = "coverage.extra";

/// The search as the paper runs it: hidden vertices continued, true virtual depth.
pub fn search(iterations: u32) -> String {
    format!("reflector-cubemap(iterations={iterations},hidden=extend,depth=virtual)")
}

/// With so many per cent of a mesh's vertices in its grid.
pub fn with_grid(iterations: u32, percent: f64) -> String {
    let fraction = (percent * 10.0).round() / 1000.0;
    format!("{}+grid(fraction={fraction})", search(iterations))
}

pub fn names(label: &str, names: &[&str]) -> Axis {
    Axis {
        label: label.to_owned(),
        scale: Scale::Names(names.iter().map(|name| (*name).to_owned()).collect()),
    }
}

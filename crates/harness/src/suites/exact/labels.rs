//! Labels of the series.

pub const BEAMS: &str = "beams";
pub const STATIC: &str = "rays, built once";
pub const REFIT: &str = "rays, refitted";
pub const REBUILT: &str = "rays, built for every frame";
pub const HARDWARE: &str = "hardware, built once";
pub const HARDWARE_REBUILT: &str = "hardware, built for every frame";
pub const MAPS: &str = "cube maps, traced";
pub const SEARCHED: &str = "vertices, searched";

//! Series that figures draw and claims read.

/// Both searches where all is reflected, and where a part is not.
pub const ALL_REFLECTED: &str = "hierarchy, all reflected";
pub const PARTLY_HIDDEN: &str = "hierarchy, some hidden";
/// Series of the sweeps.
pub const CONE: &str = "cones' factor";
pub const SPHERE: &str = "spheres' factor";
pub const STOP: &str = "stopped early";
/// The search of another paper, in maps of the mirror.
pub const REFLECTOR: &str = "reflector cubemap";
/// Series of the pictures.
pub const EXACT_LINEAR: &str = "linear";
pub const ENVIRONMENT: &str = "environment map";
pub const EXACT_PLANAR: &str = "planar";

//! Series and places that figures draw and claims read.

use crate::suites::shelf;

/// Places of the grid's flags (`grid::FLAGS`) on its axis.
pub const PLAIN: usize = 0;
pub const ACCELERATED: usize = 1;
pub const EFFICIENT: usize = 2;
pub const ANALYTIC: usize = 3;
pub const ANALYTIC_EFFICIENT: usize = 5;
pub const SELF_REFLECTING: usize = 7;

/// Series of the three scenes.
pub const TRACED: &str = "cubemap trace";
pub const MAPPED: &str = "environment map";

/// Sizes of faces and numbers of maps are swept with the criterion that does not err at
/// discontinuities, and with the published one.
pub const SWEPT: [(&str, &str); 2] = [
    ("continuous sign changes", "sampling=texel,pyramid=sound"),
    (
        "any, as published",
        "sampling=texel,pyramid=sound,accept=any",
    ),
];
/// The baseline's label and name.
pub const ENVIRONMENT: &str = "environment-map";
/// Places of the sweep of bounces.
pub const ONE: usize = 0;
pub const THREE: usize = 1;
pub const EIGHT: usize = 2;

/// Scenes that each ask for one ability.
pub const NEAR: &str = "near objects";
pub const DISTANT: &str = "distant objects";
pub const TOUCHING: &str = "touching objects";
/// Label and technique; the first one is what the claim is about.
pub const GROWTH: [(&str, &str); 6] = [
    ("cubemap trace", "cubemap-trace(pyramid=sound)"),
    (
        "cubemap trace, redrawn",
        "cubemap-trace(pyramid=sound,update=frame)",
    ),
    ("environment map", "environment-map"),
    ("linear", "linear"),
    shelf::REFLECTOR_CUBEMAP,
    ("ray trace (control)", "ray-trace"),
];

//! Estimators and mirrors of the suite: label and technique.

pub const NONE: (&str, &str) = ("none", "motion-none");
pub const SURFACE: (&str, &str) = ("surface", "motion-surface");
pub const FLAT: (&str, &str) = ("flat mirror", "motion-flat");
pub const LENS: (&str, &str) = ("thin lens", "motion-lens");
pub const NEWTON: (&str, &str) = ("newton", "motion-newton");
pub const LENS_ANALYTIC: (&str, &str) = (
    "thin lens, exact surface",
    "motion-lens(derivatives=analytic)",
);
pub const NEWTON_ANALYTIC: (&str, &str) = (
    "newton, exact surface",
    "motion-newton(derivatives=analytic)",
);

/// Of a figure whose mirrors are meshes alone.
pub const NEWTON_MESH: &str = "newton on a mesh";

/// In the order of the legend.
pub const ESTIMATORS: [(&str, &str); 5] = [NONE, SURFACE, FLAT, LENS, NEWTON];

/// The flat one first, the mesh last.
pub const MIRRORS: [&str; 7] = [
    "plane",
    "ball",
    "ellipsoid",
    "bowl",
    "torus",
    "saddle",
    "mesh",
];

/// Where the flat one stands.
pub const PLANE: f64 = 0.0;

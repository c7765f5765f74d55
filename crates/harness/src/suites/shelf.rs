//! Techniques that several suites measure, as their papers run them: label and name.

/// Szabo's walk from texel to texel.
pub const LINEAR: (&str, &str) = ("linear", "linear");
/// The same with the residual that 32 bits can resolve.
pub const LINEAR_CROSS: (&str, &str) = ("linear, cross", "linear(residual=cross,neighbours=8)");
/// Szabo's descent, with the repair of its holes.
pub const RAY_HIERARCHY: (&str, &str) = ("ray hierarchy", "ray-hierarchy(repair=enlarge)");
/// Estalella's search: a triangle that the mirror hides in part is drawn.
pub const REFLECTOR_CUBEMAP: (&str, &str) = (
    "reflector cubemap",
    "reflector-cubemap(hidden=extend,depth=virtual)",
);
/// What games use instead.
pub const ENVIRONMENT_MAP: (&str, &str) = ("environment map", "environment-map");
/// The same, drawn anew for every frame.
pub const ENVIRONMENT_MAP_REDRAWN: (&str, &str) =
    ("environment map, redrawn", "environment-map(update=frame)");
/// The mirrored eye, for flat mirrors.
pub const PLANAR: (&str, &str) = ("planar", "planar");
/// Číž's cubemap objects as published.
pub const CUBEMAP_PUBLISHED: (&str, &str) =
    ("cubemap trace, published", "cubemap-trace(accept=any)");
/// The same as we correct it.
pub const CUBEMAP: (&str, &str) = (
    "cubemap trace",
    "cubemap-trace(sampling=texel,pyramid=sound)",
);
/// The reference's own rays, traced on the graphics adapter: what all others are compared with.
pub const CONTROL: (&str, &str) = ("ray trace (control)", "ray-trace");
/// Triangles sent down a hierarchy over the rays: exact, without a hierarchy over the scene.
pub const BEAMS: (&str, &str) = ("beams", "beams");

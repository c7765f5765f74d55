//! Series and places that figures draw and claims read.

/// Series: objects of the table that are modelled coarsely and finely.
pub const COARSE: &str = "coarse";
pub const FINE: &str = "fine";
pub const HIERARCHY_FULL: &str = "hierarchy, full";
pub const HIERARCHY_ADAPTIVE: &str = "hierarchy, adaptive";
pub const SPHERE: &str = "sphere";
pub const ELLIPSOID: &str = "ellipsoid";
pub const SPHERE_BY_PIXELS: &str = "sphere, by pixels";
pub const ELLIPSOID_BY_PIXELS: &str = "ellipsoid, by pixels";
pub const LARGE_MIRROR: &str = "large in the picture";
pub const SMALL_MIRROR: &str = "four times smaller";
pub const MOTION: &str = "adaptive";
/// Where the thesis' threshold stands among those that are swept.
pub const THOUSANDTH: f64 = 2.0;

/// The search with four neighbours, of facets.
pub const FOUR: &str = "linear search";

/// A square of which the mirror hides a part; splits at its outline run to any limit.
pub const HIDDEN: &str = "adaptive, some hidden";
/// Series of the figures that show methods side by side.
pub const SEARCH: &str = "linear search";
/// The sweep of levels that ends at five.
pub const TO_FIVE: &str = "up to 5 levels";

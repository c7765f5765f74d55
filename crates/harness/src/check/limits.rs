//! How closely two renderers must agree, and why.
//!
//! Mitsuba 3 traces in float32, in every variant, and moves each reflected ray off the surface by (1 +
//! the largest coordinate) · 1500 · 2⁻²⁴, some 3e-4 in a scene a few units wide; ours are exact to
//! f64. Both grow with the distance from the origin, and so do the limits of lengths: they are stated
//! for mirrors whose points have coordinates up to [`REACH`], and larger in proportion beyond. An
//! error of a point's position turns the normal there by an angle that grows with the mirror's
//! curvature; the limits of normals and directions are widened by this angle.

use catoptric_reference::RayStart;

/// 1 + the largest coordinate of a mirror's point, up to which the limits of lengths hold as they are.
/// If the median point has more, they are multiplied by its value over this one.
pub const REACH: f64 = 3.0;

/// Least share of pixels that see the same thing. The rest is for pixel centres that lie within f32's
/// resolution, or Mitsuba's offset, of an edge: none to 3 of 10 000 mirror pixels were measured.
pub const AGREE: f64 = 0.9995;

/// Least share of pixels whose first reflected ray sees the same thing, with lengths `scale` times
/// those of [`REACH`]. The further the scene reaches, the larger is Mitsuba's offset, and the wider is
/// the band along edges in which the offset changes what a ray sees: 9 of 10 000 mirror pixels in the
/// Sponza, and none if our rays start with that offset. In a scene that is larger in all its parts
/// edges are no denser, so the share never falls below 99.8 %.
pub fn agree_once(start: RayStart, scale: f64) -> f64 {
    match start {
        RayStart::Exact => 1.0 - (1.0 - AGREE) * scale.min(4.0),
        RayStart::Mitsuba => AGREE,
    }
}

/// What a 32-bit float can tell of a number: half the distance to the next one, relative.
pub const FLOAT: f64 = 1.0 / 16_777_216.0;

/// How many roundings of a coordinate a normal may be turned by, in the median and at the 99.9th
/// percentile. On a ball of radius 1 that is 1000 from the origin 0.4 and 7 were measured: where a ray
/// grazes the mirror a point moves further along it than its coordinates are rounded.
pub const ROUNDINGS: Distance = Distance {
    p50: 1.5,
    p999: 20.0,
};

/// This many pixels may always disagree, or exceed the limit of the 99.9th percentile. On a small
/// mirror this takes the place of the shares above.
pub const ALWAYS: usize = 2;

/// Least share that agrees of ids and colours after two reflections and more, where differences are
/// magnified. With rays from the surface, Mitsuba's offset is such a difference: 3 of 100 pixels saw
/// something else in a curved shell in a room, 1 of 100 on a teapot, 5 of 10 000 in the atrium.
pub fn agree_deep(start: RayStart) -> f64 {
    match start {
        RayStart::Exact => 0.95,
        RayStart::Mitsuba => AGREE,
    }
}

/// How colours must agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// A colour agrees if it lies, within this tolerance, between the colours of our pixel and its
    /// eight neighbours. Mitsuba's offset moves what a pixel sees by a small part of a pixel, so where
    /// an edge passes the pixel may have the colour of a neighbour.
    pub within: f64,
    /// Least share of pixels that agree after one reflection.
    pub agree: f64,
}

/// Colours after one reflection; without one they agree on [`AGREE`]. Where rays start
/// on the surface, an 8-bit step (4e-3) was exceeded by 4 of 10 000 pixels in a bowl and by 23 of 1000 on a ball in the
/// Sponza with its fine textures; with Mitsuba's offset a quarter of a step was exceeded by 6 of 10 000 there, by none
/// or one elsewhere.
pub fn color(start: RayStart) -> Color {
    match start {
        RayStart::Exact => Color {
            within: 4e-3,
            agree: 0.97,
        },
        RayStart::Mitsuba => Color {
            within: 1e-3,
            agree: AGREE,
        },
    }
}

/// Least share of agreeing colours among the pixels that show one and the same surface: edges are
/// few (6 of 1000 pixels of the worst one), a wrong colour is everywhere.
pub const AGREE_SURFACE: f64 = 0.95;

/// Surfaces that fewer pixels show are not judged: all of these pixels may lie on edges.
pub const FEWEST: usize = 8;

/// How much a second reflection may magnify the differences before it: off a sphere, rays diverge 2 L
/// / (r cos θ) times faster. Measured in the median: 7 to 12 between mirror balls and in a bowl, 22 on
/// a teapot with its tight curves; at the 99.9th percentile 33 in a room.
pub const MAGNIFICATION: f64 = 40.0;

/// Distances that half and all but a thousandth of the pixels must keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Median.
    pub p50: f64,
    /// 99.9th percentile.
    pub p999: f64,
}

impl Distance {
    /// Both further by as much.
    pub fn widened(self, by: f64) -> Self {
        Self {
            p50: self.p50 + by,
            p999: self.p999 + by,
        }
    }

    /// Both widened by [`ROUNDINGS`] times the angle `turn` by which one rounding of coordinates turns
    /// a normal.
    pub fn turned(self, turn: f64) -> Self {
        Self {
            p50: self.p50 + ROUNDINGS.p50 * turn,
            p999: self.p999 + ROUNDINGS.p999 * turn,
        }
    }

    /// Both further by a factor.
    pub fn scaled(self, by: f64) -> Self {
        Self {
            p50: self.p50 * by,
            p999: self.p999 * by,
        }
    }
}

/// First surfaces: no ray was moved, f32 alone. A floor seen at a glancing angle is the worst.
pub const PRIMARY_POSITION: Distance = Distance {
    p50: 1e-5,
    p999: 1e-4,
};

/// Unit normals of the mirrors, as the length of the difference; either side will do, since
/// renderers differ in which way they turn them.
pub const PRIMARY_NORMAL: Distance = Distance {
    p50: 1e-5,
    p999: 1e-4,
};

/// Unit directions of the first reflected rays, likewise.
pub const DIRECTION: Distance = Distance {
    p50: 1e-5,
    p999: 2e-4,
};

/// Reflected surfaces. Against Mitsuba, with rays starting on the surface, 2e-4 in the median and
/// 4e-3 at p99.9 were measured on other scenes than ours, and up to ten times less with its offset.
pub fn reflected(start: RayStart) -> Distance {
    let exact = Distance {
        p50: 3e-4,
        p999: 6e-3,
    };
    match start {
        RayStart::Exact => exact,
        RayStart::Mitsuba => Distance {
            p50: exact.p50 / 10.0,
            p999: exact.p999 / 10.0,
        },
    }
}

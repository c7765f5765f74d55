//! The true motion of reflections: where the point that a mirror pixel shows now was seen in the frame
//! before.
//!
//! Pixel `p` of frame `f` shows, at the mirror point `P`, the material point `X`: a place on a triangle of
//! an object, or a direction of the background. In the frame before, the object, the mirror and the eye
//! were elsewhere. Let `R` be the point at which the mirror, as it was then, reflects `X`, as it was then;
//! the result is the image of `R` in the camera of then. If there are several such points, `R` is the one
//! into which `P` has moved: [`Follow`] goes from frame to frame in time steps so short that Newton's
//! method converges at once and the image moves by less than 2 pixels. It keeps the orientation of the
//! branch, which is the sign of the derivative's determinant.
//!
//! There is no answer where the branch ends, where `R` leaves the mirror, where the eye of then does not
//! see `R`, and outside the image. Where something else hid `X` from `R`, the vector is kept and the pixel
//! is marked as disoccluded.
//!
//! All computations are done in the mirror's rest frame (`moment`), in which only the eye and `X` move. The
//! surface (`surface`) is that of the scene as written. Only the triangles of mesh mirrors are, at both
//! ends, those of the frames, whose corners are rounded to f32.
//!
//! Image coordinates: x right, y down, pixel centres at +½.

mod moment;
mod surface;
mod target;

use std::sync::atomic::{AtomicU32, Ordering};

use catoptric_frame::{Image, Motion, Status};
use catoptric_scene::{Scene, View};
use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;

use self::moment::{Moments, Situation};
use self::surface::{Local, Place, Surface};
pub use self::target::Target;
use crate::error::ReferenceError;
use crate::render::{Truth, reflect};
use crate::tracer::{self, Tracer};

/// The image moves by less than this in a step of time, in pixels.
const LONGEST_MOVE: f64 = 2.0;

/// Newton steps within which the point of a smooth surface must be found; a mesh takes some more, since its
/// derivatives change from triangle to triangle.
const STEPS: usize = 3;
const STEPS_ON_MESH: usize = 8;

/// Newton's method has converged where its last step is shorter than this, in pixels: between the frames,
/// where the next time step starts from there, and at the end.
const ARRIVED: f64 = 1e-5;
const ARRIVED_AT_THE_END: f64 = 1e-11;

/// Newton steps at the end, each of which squares the error that is left.
const LAST_STEPS: usize = 12;

/// An answer whose next Newton step would still be longer than this, in pixels, is rejected.
const CONVERGED: f64 = 1e-8;

/// Parts of the time between two frames: no step is shorter.
const PARTS: u32 = 1 << 14;

/// Two surfaces are at one place if they are apart by less than this share of the distance.
const SAME: f64 = 1e-6;

/// A reflection: a place on a mirror and what is seen there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Index into the scene's mirrors.
    pub mirror: usize,
    /// What is reflected.
    pub target: Target,
    place: Place,
}

/// Where a reflection is at the other frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// Image coordinates there.
    pub at: DVec2,
    /// The reflection there.
    pub seen: Seen,
    /// Something else hides the point from the mirror there.
    pub hidden: bool,
}

/// Why a reflection has no place at the other frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lost {
    /// The branch of reflection points ends: it meets another one, the mirror's edge, or its outline.
    Ends,
    /// The mirror's point is not seen: something is before it, or it lies outside the image.
    Unseen,
}

/// A pair of frames of a scene.
pub struct Follow {
    moments: Moments,
    from: Tracer,
    to: Tracer,
    views: [View; 2],
    surfaces: Vec<Surface>,
}

impl Follow {
    /// Makes ready to follow reflections of frame `from` to where they are at frame `to`, for pictures of
    /// `size` pixels.
    ///
    /// # Errors
    /// A scene that cannot be traced.
    pub fn new(
        scene: &Scene,
        [from, to]: [u32; 2],
        size: [u32; 2],
    ) -> Result<Self, ReferenceError> {
        let moments = Moments::new(scene, [from, to], size, PARTS);
        let [start, end] = moments.ends().map(Tracer::new);
        let mirrors = scene.mirrors.iter();
        Ok(Self {
            from: start?,
            to: end?,
            views: moments.views(),
            surfaces: mirrors.map(|mirror| Surface::new(&mirror.shape)).collect(),
            moments,
        })
    }

    /// Of the first frame and of the second.
    pub fn tracers(&self) -> [&Tracer; 2] {
        [&self.from, &self.to]
    }

    /// The motion of all reflections of the picture: to frame `to`, from frame `from`.
    pub fn layer(&self, progress: Option<&(dyn Fn(u32, u32) + Sync)>) -> Motion {
        let [width, height] = self.views[0].size;
        let finished = AtomicU32::new(0);
        let rows = (0..height).into_par_iter().flat_map_iter(|y| {
            let pixel = |x| {
                let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                let followed = self.follow(&self.seen_at(at)?).ok()?;
                Some(((followed.at - at).as_vec2(), followed.hidden))
            };
            let row: Vec<_> = (0..width).map(pixel).collect();
            if let Some(progress) = progress {
                progress(finished.fetch_add(1, Ordering::Relaxed) + 1, height);
            }
            row
        });
        let all = Image::from_vec([width, height], rows.collect());
        Motion {
            vector: all.map(|pixel| pixel.unwrap_or_default().0),
            valid: all.map(Option::is_some),
            disoccluded: Some(all.map(|pixel| pixel.is_some_and(|(_, hidden)| hidden))),
            converted: None,
        }
    }

    /// What is reflected at image coordinates `at` of the first frame, if a mirror is seen there.
    pub fn seen_at(&self, at: DVec2) -> Option<Seen> {
        let trace = self
            .from
            .reflect_pixel(&self.views[0], at, Truth::FirstBounce);
        let (mirror, reflection) = (trace.primary?, trace.reflection?);
        let tracer::Surface::Mirror {
            index, triangle, ..
        } = mirror.surface
        else {
            return None;
        };
        if reflection.status != Status::Resolved {
            return None;
        }
        let target = match reflection.hit.map(|hit| hit.surface) {
            None => Target::Direction(reflection.direction),
            Some(tracer::Surface::Object {
                index, triangle, ..
            }) => {
                let corners = self.moments.corners(0, index, triangle);
                Target::Point {
                    object: index,
                    triangle,
                    weights: weights_where(mirror.position, reflection.direction, &corners)?,
                }
            }
            Some(tracer::Surface::Mirror { .. }) => return None,
        };
        Some(Seen {
            mirror: index,
            target,
            place: match triangle {
                Some((triangle, weights)) => Place::OnTriangle { triangle, weights },
                None => Place::Point(self.moments.at_rest(0, index, mirror.position)),
            },
        })
    }

    /// Follows a reflection of the first frame to the second.
    ///
    /// # Errors
    /// Why it is not there.
    pub fn follow(&self, seen: &Seen) -> Result<Followed, Lost> {
        let surface = &self.surfaces[seen.mirror];
        let situation = |part: u32| self.moments.situation(part, seen.mirror, &seen.target);
        let mut now = situation(0);
        let mut way = Way::new(surface, &now, seen.place).ok_or(Lost::Ends)?;
        let orientation = way.orientation();
        let (mut part, mut step) = (0, PARTS);
        while part < PARTS {
            let next = situation(part + step);
            let arrived = way.to(surface, &now, &next, orientation, part + step == PARTS);
            let Some(arrived) = arrived else {
                step /= 2;
                if step == 0 {
                    return Err(Lost::Ends);
                }
                continue;
            };
            (way, now) = (arrived, next);
            part += step;
            step = (2 * step).min(PARTS - part);
            // A number of parts that divides what is left, so that the grid of moments is kept to.
            if step > 0 {
                step = 1 << step.ilog2();
            }
        }
        let (at, _) = now.image_of(way.here.point).ok_or(Lost::Unseen)?;
        let seen = Seen {
            place: way.place,
            ..*seen
        };
        let hidden = self.is_hidden(&seen, &now, way.here.point, at)?;
        Ok(Followed { at, seen, hidden })
    }

    /// Whether something else hides the point that is reflected, at the end, where the mirror's point
    /// (at rest) is seen at `at`.
    fn is_hidden(
        &self,
        seen: &Seen,
        end: &Situation<'_>,
        point: DVec3,
        at: DVec2,
    ) -> Result<bool, Lost> {
        let view = &self.views[1];
        if !view.contains(at) {
            return Err(Lost::Unseen);
        }
        let point = end.in_world(point);
        let direction = (point - view.eye).normalize();
        let hit = self.to.trace(view.eye, direction).ok_or(Lost::Unseen)?;
        let tracer::Surface::Mirror {
            index, front: true, ..
        } = hit.surface
        else {
            return Err(Lost::Unseen);
        };
        let distance = point.distance(view.eye);
        if index != seen.mirror || hit.t < distance * (1.0 - SAME) {
            return Err(Lost::Unseen);
        }
        let reflected = reflect(direction, &hit).ok_or(Lost::Ends)?;
        let first = self.to.trace_reflected(&hit, reflected, false);
        let nearer = |length: f64| first.is_some_and(|first| first.t < length);
        Ok(match end.target_in_world() {
            Ok(target) => nearer(target.distance(point) * (1.0 - SAME)),
            Err(_) => nearer(f64::INFINITY),
        })
    }
}

/// A reflection point at a moment: where it is, and what Newton's method says there.
struct Way {
    place: Place,
    here: Local,
    newton: Newton,
}

/// One step of Newton's method on the tangential part of the bisector (see the specification of the
/// derivative at [`Newton::at`]).
#[derive(Clone, Copy)]
struct Newton {
    /// In the surface's own coordinates.
    step: DVec2,
    /// How far that moves the image at most, in pixels.
    pixels: f64,
    /// Of the derivative, for coordinates that run counter-clockwise seen from the front.
    determinant: f64,
    /// Eye and point lie both in front of the surface.
    in_front: bool,
}

impl Newton {
    /// Let `o` be the unit direction to the eye, at distance `a`, and `v` that to the point, at distance
    /// `b`. At a reflection point the bisector `h = o + v` is normal to the surface: `g = (h·t₁, h·t₂)` is
    /// zero, where `t₁` and `t₂` span the plane perpendicular to the normal `N`. Along a coordinate that
    /// moves the point by `P'` and the normal by `N'`, the derivative of `g` is `−t·(M P') − (h·N)(t·N')`
    /// with `M = (1 − oo)/a + (1 − vv)/b`, where `oo` and `vv` are outer products. For a direction in place
    /// of a point, `1/b` is 0.
    fn at(here: &Local, situation: &Situation<'_>) -> Self {
        let to_eye = situation.eye - here.point;
        let (near, o) = (1.0 / to_eye.length(), to_eye.normalize());
        let (far, v) = match situation.target {
            Ok(target) => {
                let way = target - here.point;
                (1.0 / way.length(), way.normalize())
            }
            Err(direction) => (0.0, direction),
        };
        let bisector = o + v;
        let along = bisector.dot(here.normal);
        let (t1, t2) = here.normal.any_orthonormal_pair();
        let column = |axis: usize| {
            let (point, normal) = (here.points[axis], here.normals[axis]);
            let bent = near * (point - o.dot(point) * o) + far * (point - v.dot(point) * v);
            let change = -bent - along * normal;
            DVec2::new(t1.dot(change), t2.dot(change))
        };
        let derivative = DMat2::from_cols(column(0), column(1));
        let off = DVec2::new(t1.dot(bisector), t2.dot(bisector));
        let step = -(derivative.inverse() * off);
        let moved = step.x * here.points[0] + step.y * here.points[1];
        let turns = here.points[0].cross(here.points[1]).dot(here.normal);
        Self {
            step,
            pixels: moved.length() * near / situation.pixel,
            determinant: derivative.determinant() * turns.signum(),
            in_front: o.dot(here.normal) > 0.0 && v.dot(here.normal) > 0.0,
        }
    }
}

impl Way {
    fn new(surface: &Surface, situation: &Situation<'_>, place: Place) -> Option<Self> {
        let here = surface.at(situation.mesh, &place)?;
        let newton = Newton::at(&here, situation);
        Some(Self {
            place,
            here,
            newton,
        })
    }

    fn orientation(&self) -> f64 {
        self.newton.determinant.signum()
    }

    /// The same branch at another moment; `None` where the step of time is too long for that to be sure,
    /// or where the branch ends.
    fn to(
        &self,
        surface: &Surface,
        now: &Situation<'_>,
        next: &Situation<'_>,
        orientation: f64,
        end: bool,
    ) -> Option<Self> {
        let mut way = Self::new(surface, next, self.place)?;
        let steps = match surface.is_mesh() {
            true => STEPS_ON_MESH,
            false => STEPS,
        };
        let mut taken = 0;
        while way.newton.pixels > ARRIVED || way.newton.pixels.is_nan() {
            if taken == steps {
                return None;
            }
            way = way.stepped(surface, next)?;
            taken += 1;
        }
        if end {
            way = way.settled(surface, next)?;
        }
        let kept = way.orientation() == orientation && way.newton.in_front;
        let (before, _) = now.image_of(self.here.point)?;
        let (after, _) = next.image_of(way.here.point)?;
        (kept && before.distance(after) < LONGEST_MOVE).then_some(way)
    }

    fn stepped(&self, surface: &Surface, situation: &Situation<'_>) -> Option<Self> {
        let place = surface.moved(situation.mesh, &self.place, &self.here, self.newton.step)?;
        Self::new(surface, situation, place)
    }

    /// As exact as f64 allows.
    fn settled(mut self, surface: &Surface, situation: &Situation<'_>) -> Option<Self> {
        for _ in 0..LAST_STEPS {
            if self.newton.pixels <= ARRIVED_AT_THE_END {
                break;
            }
            let next = self.stepped(surface, situation)?;
            if next.newton.pixels >= self.newton.pixels {
                break;
            }
            self = next;
        }
        (self.newton.pixels < CONVERGED).then_some(self)
    }
}

/// Weights of a triangle's corners where the line `origin + t · direction` meets its plane.
fn weights_where(origin: DVec3, direction: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<DVec3> {
    let (to_b, to_c, start) = (*b - *a, *c - *a, origin - *a);
    let across = direction.cross(to_c);
    let determinant = to_b.dot(across);
    let u = start.dot(across) / determinant;
    let v = direction.dot(start.cross(to_b)) / determinant;
    let weights = DVec3::new(1.0 - u - v, u, v);
    weights.is_finite().then_some(weights)
}

//! All points of a smooth surface over which the path from eye to vertex has stationary length.
//!
//! By Fermat's principle these are the reflection points of either side, and the points where the
//! straight path passes through. On a surface of mixed curvature there may be any number, so the
//! surface is divided until each part is settled. Let `L` be the length of the path over the
//! parameters `q`, `G` its gradient and `H` its second derivative at a part's middle `c`, and `T` a
//! bound of its third derivative within twice the part's radius `ρ`:
//!
//! - no zero of `G` lies in the part if `|G| > ‖H‖ρ + Tρ²/2`, nor if Newton's step from the middle
//!   is longer than `ρ (1 + ‖H⁻¹‖Tρ/2)`, both by Taylor's theorem;
//! - no reflection point lies in it if all of it faces away from eye or vertex;
//! - if `‖H⁻¹‖Tρ ≤ 1/4`, `G` is one-to-one on the part and Newton's method from its middle
//!   converges to its only zero, if it has one: so Newton's method is run, and if it finds no zero
//!   there is none.
//!
//! A part of which none of this holds is divided further. So either all points are found, or the
//! answer is that they are not known: where two are about to meet (on a caustic), or eye or vertex
//! lies on the surface.

use catoptric_frame::VertexClass;
use glam::{DMat2, DVec2, DVec3};

use super::patch::{Bounds, Jet, Patch};
use super::solutions::Solutions;

/// A solution is a point where the unit vectors to eye and vertex cancel along the surface to this.
const RESIDUAL: f64 = 1e-12;

/// Most parts looked at for one vertex; usual are some hundreds.
const MOST_PARTS: usize = 50_000;

/// A part of less than this share of the surface's extent is not divided.
const SMALLEST: f64 = 1e-10;

/// Solutions closer than this share of the surface's extent are one, found from two parts.
const SAME: f64 = 1e-9;

/// All reflection points on the front of a patch, as far as it is not hidden from the eye: `seen`
/// says whether a point of it is.
pub(super) fn reflection_points(
    patch: &impl Patch,
    eye: DVec3,
    vertex: DVec3,
    seen: impl Fn(DVec3) -> bool,
) -> Solutions {
    let way = Way {
        patch,
        bounds: patch.bounds(),
        eye,
        vertex,
    };
    let [low, high] = patch.domain();
    let size = (high - low).max_element();
    let mut parts = divided(low, high, patch.parts());
    let mut found: Vec<DVec2> = Vec::new();
    let mut in_front = false;
    let mut looked_at = 0;
    while let Some(part) = parts.pop() {
        looked_at += 1;
        let radius = part.half.length();
        let here = way.at(part.middle);
        in_front |= here.sides.min_element() > 0.0;
        match way.judge(&here, radius) {
            Verdict::Nothing => {}
            Verdict::AtMostOne => {
                let Some(q) = way.newton(part.middle, radius) else {
                    continue;
                };
                let inside = (q - part.middle).abs().cmple(part.half + SAME * size).all();
                let within = q.cmpge(low - SAME * size).all() && q.cmple(high + SAME * size).all();
                let known = |other: &DVec2| {
                    patch.at(*other).point.distance(patch.at(q).point) < SAME * size
                };
                if inside && within && !found.iter().any(known) {
                    found.push(q);
                }
            }
            Verdict::Divide if radius < SMALLEST * size || looked_at > MOST_PARTS => {
                return Solutions::undecided(1 + parts.len() as u64);
            }
            Verdict::Divide => parts.extend(part.quarters()),
        }
    }
    let points: Vec<DVec3> = found
        .into_iter()
        .filter(|q| way.at(*q).sides.min_element() > 0.0)
        .map(|q| patch.at(q).point)
        .collect();
    let class = match (points.is_empty(), in_front) {
        (true, true) => VertexClass::Unreflected,
        (true, false) => VertexClass::Hidden,
        (false, _) => VertexClass::Reflected,
    };
    let points: Vec<DVec3> = points.into_iter().filter(|point| seen(*point)).collect();
    if points.is_empty() && class == VertexClass::Reflected {
        return Solutions::none(VertexClass::Hidden);
    }
    Solutions {
        class,
        points,
        undecided: 0,
    }
}

/// A rectangle of parameters.
#[derive(Clone, Copy)]
struct Part {
    middle: DVec2,
    half: DVec2,
}

impl Part {
    fn quarters(&self) -> [Self; 4] {
        let half = self.half / 2.0;
        [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(x, y)| Self {
            middle: self.middle + DVec2::new(x, y) * half,
            half,
        })
    }
}

fn divided(low: DVec2, high: DVec2, [columns, rows]: [u32; 2]) -> Vec<Part> {
    let half = (high - low) / DVec2::new(f64::from(columns), f64::from(rows)) / 2.0;
    (0..columns * rows)
        .map(|index| {
            let cell = DVec2::new(f64::from(index % columns), f64::from(index / columns));
            Part {
                middle: low + (2.0 * cell + 1.0) * half,
                half,
            }
        })
        .collect()
}

enum Verdict {
    Nothing,
    AtMostOne,
    Divide,
}

/// Ways from eye to vertex over a patch.
struct Way<'a, P> {
    patch: &'a P,
    bounds: Bounds,
    eye: DVec3,
    vertex: DVec3,
}

/// A way's length at some parameters: distances of the eye and the vertex, derivatives.
struct Local {
    distances: DVec2,
    /// How far eye and vertex lie before the tangent plane, times the length of the normal.
    sides: DVec2,
    gradient: DVec2,
    hessian: DMat2,
}

impl<P: Patch> Way<'_, P> {
    fn at(&self, q: DVec2) -> Local {
        let Jet {
            point,
            u,
            v,
            uu,
            uv,
            vv,
            normal,
        } = self.patch.at(q);
        let mut local = Local {
            distances: DVec2::ZERO,
            sides: DVec2::ZERO,
            gradient: DVec2::ZERO,
            hessian: DMat2::ZERO,
        };
        for (end, offset) in [self.eye - point, self.vertex - point]
            .into_iter()
            .enumerate()
        {
            let distance = offset.length();
            let towards = offset / distance;
            let along = DVec2::new(towards.dot(u), towards.dot(v));
            local.distances[end] = distance;
            local.sides[end] = offset.dot(normal);
            local.gradient -= along;
            let mixed = (u.dot(v) - along.x * along.y) / distance - towards.dot(uv);
            local.hessian += DMat2::from_cols(
                DVec2::new(
                    (u.dot(u) - along.x * along.x) / distance - towards.dot(uu),
                    mixed,
                ),
                DVec2::new(
                    mixed,
                    (v.dot(v) - along.y * along.y) / distance - towards.dot(vv),
                ),
            );
        }
        local
    }

    /// What is known of the parameters within `radius` of a place.
    fn judge(&self, here: &Local, radius: f64) -> Verdict {
        let Bounds {
            first,
            second,
            third,
            normal,
        } = self.bounds;
        // A side changes by the normal's change only: moving along the surface is across it.
        let reach = here.distances + first * radius;
        if (here.sides + normal * radius * reach).min_element() < 0.0 {
            return Verdict::Nothing;
        }
        let nearest = here.distances - 2.0 * first * radius;
        if nearest.min_element() <= 0.0 {
            return Verdict::Divide;
        }
        // Of a distance |x|, the second derivative is at most 1/|x| and the third 2/(√3 |x|²).
        let inverse = 1.0 / nearest;
        let change = (inverse * inverse).element_sum() * 2.0 / 3f64.sqrt() * first.powi(3)
            + 3.0 * inverse.element_sum() * first * second
            + 2.0 * third;
        let [least, greatest] = magnitudes(&here.hessian);
        let bend = change * radius / 2.0;
        if here.gradient.length() > radius * (greatest + bend) {
            return Verdict::Nothing;
        }
        if least == 0.0 {
            return Verdict::Divide;
        }
        let step = here.hessian.inverse() * here.gradient;
        if step.length() > radius * (1.0 + bend / least) {
            return Verdict::Nothing;
        }
        if change * radius <= least / 4.0 {
            return Verdict::AtMostOne;
        }
        Verdict::Divide
    }

    /// The zero of the gradient within `radius` of `start`, if there is one.
    fn newton(&self, start: DVec2, radius: f64) -> Option<DVec2> {
        let mut q = start;
        let mut residual = f64::INFINITY;
        for _ in 0..30 {
            let here = self.at(q);
            let now = here.gradient.length();
            if now >= residual && now < RESIDUAL {
                return Some(q);
            }
            residual = now;
            let next = q - here.hessian.inverse() * here.gradient;
            let moved = (next - start).length();
            if moved.is_nan() || moved > 2.0 * radius {
                return None;
            }
            q = next;
        }
        (self.at(q).gradient.length() < RESIDUAL).then_some(q)
    }
}

/// Magnitudes of the eigenvalues of a symmetric matrix, the least first.
fn magnitudes(matrix: &DMat2) -> [f64; 2] {
    let mean = (matrix.x_axis.x + matrix.y_axis.y) / 2.0;
    let spread = ((matrix.x_axis.x - matrix.y_axis.y) / 2.0).hypot(matrix.x_axis.y);
    let (a, b) = ((mean - spread).abs(), (mean + spread).abs());
    [a.min(b), a.max(b)]
}

//! Alhazen's problem: the points of a sphere that reflect a vertex to an eye.
//!
//! All of them lie in the plane of eye, vertex and centre. There, with the sphere scaled to the
//! unit circle, eye and vertex are complex numbers `p` and `q`, and a point `z` of the circle
//! makes equal angles with both, on either side, where `(p−z)(q−z)/z²` is real. With `z̄ = 1/z`
//! that is `p̄q̄ z⁴ − (p̄+q̄) z³ + (p+q) z − pq = 0`. Each root's angle is then polished by Newton's
//! method on the sum of the two directions' components along the circle, which keeps its
//! precision where the polynomial loses it (points far away or close to the surface).

use glam::{DVec2, DVec3};

use super::quartic::{Complex, roots};

/// An angle counts as a solution if the directions' components along the circle cancel to this.
const RESIDUAL: f64 = 1e-12;

/// Angles closer than this are one solution (radians).
const SAME: f64 = 1e-8;

/// Share of a vertex' distance from the centre within which it counts as on the line through
/// the eye and the centre.
const COLLINEAR: f64 = 1e-13;

/// Points of the whole sphere, reflecting outside (`side` 1) or inside (−1). Of a ring of
/// solutions, those in a plane that comes close to `prefer`.
pub(super) fn solve(
    center: DVec3,
    radius: f64,
    eye: DVec3,
    vertex: DVec3,
    side: f64,
    prefer: DVec3,
) -> Vec<DVec3> {
    let (eye, vertex) = ((eye - center) / radius, (vertex - center) / radius);
    let Some(e1) = eye.try_normalize().or_else(|| vertex.try_normalize()) else {
        return Vec::new();
    };
    let across = |v: DVec3| {
        let once = v - v.dot(e1) * e1;
        once - once.dot(e1) * e1
    };
    let off_line = across(vertex);
    let e2 = if off_line.length() > COLLINEAR * vertex.length() {
        off_line.normalize()
    } else {
        across(prefer)
            .try_normalize()
            .unwrap_or_else(|| e1.any_orthonormal_vector())
    };
    let p = DVec2::new(eye.dot(e1), eye.dot(e2));
    let q = DVec2::new(vertex.dot(e1), vertex.dot(e2));
    angles(p, q, side)
        .into_iter()
        .map(|angle| center + radius * (angle.cos() * e1 + angle.sin() * e2))
        .collect()
}

/// Angles on the unit circle at which `p` sees `q`.
fn angles(p: DVec2, q: DVec2, side: f64) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::with_capacity(3);
    for angle in candidates(p, q) {
        let Some(angle) = polish(p, q, angle) else {
            continue;
        };
        let z = DVec2::from_angle(angle);
        let visible = side * (p - z).dot(z) > 0.0 && side * (q - z).dot(z) > 0.0;
        let apart = |other: &f64| {
            let turn = (angle - other).abs().rem_euclid(std::f64::consts::TAU);
            turn.min(std::f64::consts::TAU - turn) > SAME
        };
        if visible && found.iter().all(apart) {
            found.push(angle);
        }
    }
    found
}

/// Angles of the quartic's roots. Those off the circle are no harm: they do not survive
/// polishing, or come to another one.
fn candidates(p: DVec2, q: DVec2) -> Vec<f64> {
    let (p, q) = (Complex::new(p.x, p.y), Complex::new(q.x, q.y));
    let (sum, product) = (p + q, p * q);
    let largest = sum.abs().max(product.abs());
    if product.abs() < 1e-9 * largest {
        // Eye or vertex in the centre: z² = (p+q)/(p̄+q̄).
        let angle = sum.angle();
        return vec![angle, angle + std::f64::consts::PI];
    }
    let (sum, product) = (sum.scale(1.0 / largest), product.scale(1.0 / largest));
    roots(&[
        product.scale(-1.0),
        sum,
        Complex::new(0.0, 0.0),
        sum.conj().scale(-1.0),
        product.conj(),
    ])
    .into_iter()
    .map(Complex::angle)
    .collect()
}

/// Newton's method on the components along the circle of the unit vectors to `p` and `q`.
fn polish(p: DVec2, q: DVec2, start: f64) -> Option<f64> {
    // The sum of components, and its derivative by the angle.
    let residual = |angle: f64| {
        let z = DVec2::from_angle(angle);
        let along = z.perp();
        [p, q]
            .into_iter()
            .fold((0.0, 0.0), |(value, slope), point| {
                let distance = point.distance(z);
                let towards = (point - z) / distance;
                let component = towards.dot(along);
                let turning = towards.dot(z) + (1.0 - component * component) / distance;
                (value + component, slope - turning)
            })
    };
    let mut angle = start;
    let (mut value, mut slope) = residual(angle);
    for _ in 0..50 {
        let next = angle - value / slope;
        if !next.is_finite() || (next - angle).abs() > 1.0 {
            break;
        }
        let (next_value, next_slope) = residual(next);
        if next_value.abs() >= value.abs() {
            break;
        }
        (angle, value, slope) = (next, next_value, next_slope);
    }
    (value.abs() < RESIDUAL).then_some(angle)
}

//! The point of an ellipsoid, seen from outside, that reflects a vertex to an eye.
//!
//! By Fermat's principle the path from eye to mirror to vertex has stationary length. The length of
//! the path over a point is a convex function of that point, and the ellipsoid is a convex body. So
//! if the straight path from eye to vertex misses the body, the shortest path touches the body in
//! exactly one point, where the bisector of the directions to eye and vertex is the outward normal,
//! so that both are in front. If the straight path meets the body, no point reflects. Hence the
//! vertex is hidden exactly if the straight path is blocked; otherwise its only reflection point is
//! a minimum, found by a safeguarded Newton iteration on the unit sphere that the body is an affine
//! image of.

use catoptric_frame::VertexClass;
use catoptric_scene::shape::Ellipsoid;
use glam::{DMat2, DVec2, DVec3};

use super::solutions::{ExactPoints, Solutions};

/// A point is accepted if the sum of the unit vectors to eye and vertex has a component across
/// the normal below this, and the rounding of both vectors.
const RESIDUAL: f64 = 1e-12;

/// Rounding of a unit vector, as a multiple of its end's share of its length.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A straight path that misses the body by less than this share of the body's size counts as
/// touching it: single precision cannot place a vertex nearly as exactly.
const TOUCHING: f64 = 1e-9;

impl ExactPoints for Ellipsoid {
    /// One, or none where the straight way from eye to vertex is blocked, or touches; `Unknown` if
    /// the iteration does not come below its residual, which has not been seen to happen.
    fn points(&self, eye: DVec3, vertex: DVec3) -> Solutions {
        let Self {
            center,
            radii,
            rotation,
        } = *self;
        let size = radii.max_element();
        let local = |point: DVec3| rotation.transpose() * (point - center) / size;
        let path = Path {
            radii: radii / size,
            eye: local(eye),
            vertex: local(vertex),
        };
        let Some(start) = path.start() else {
            return Solutions::none(VertexClass::Hidden);
        };
        let unit = path.minimize(start);
        let nearest = path.legs(unit)[0].1.min(path.legs(unit)[1].1);
        if path.residual(unit) > RESIDUAL + ROUNDING / nearest {
            return Solutions::undecided(1);
        }
        Solutions::at(vec![center + rotation * (unit * radii)])
    }
}

/// Ways from an eye over a point of the ellipsoid to a vertex, in the ellipsoid's axes, its
/// largest radius 1. Points are given as `radii · unit` with `|unit| = 1`.
struct Path {
    radii: DVec3,
    eye: DVec3,
    vertex: DVec3,
}

/// Length of a way, and its derivatives along the sphere of unit vectors.
struct Local {
    length: f64,
    axes: [DVec3; 2],
    gradient: DVec2,
    /// Positive definite: where the true one may not be, it is made so.
    hessian: DMat2,
}

impl Path {
    /// The unit vector towards the point of the straight way that comes closest to the centre,
    /// measured so that the body is a ball; `None` if the way meets or touches the body.
    fn start(&self) -> Option<DVec3> {
        let (eye, vertex) = (self.eye / self.radii, self.vertex / self.radii);
        let along = vertex - eye;
        let length = along.length_squared();
        let share = if length > 0.0 {
            (-eye.dot(along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let nearest = eye + share * along;
        (nearest.length() > 1.0 + TOUCHING).then(|| nearest.normalize())
    }

    /// Unit vectors from a point towards eye and vertex, and the distances.
    fn legs(&self, unit: DVec3) -> [(DVec3, f64); 2] {
        let point = self.radii * unit;
        [self.eye, self.vertex].map(|end| {
            let distance = end.distance(point);
            ((end - point) / distance, distance)
        })
    }

    fn residual(&self, unit: DVec3) -> f64 {
        let [(to_eye, _), (to_vertex, _)] = self.legs(unit);
        let sum = to_eye + to_vertex;
        let normal = (unit / self.radii).normalize();
        if sum.dot(normal) > 0.0 {
            sum.cross(normal).length()
        } else {
            f64::INFINITY
        }
    }

    fn at(&self, unit: DVec3) -> Local {
        let legs = self.legs(unit);
        let gradient = -self.radii * (legs[0].0 + legs[1].0);
        let (x, y) = unit.any_orthonormal_pair();
        let axes = [x, y];
        let gradient_along = DVec2::new(gradient.dot(x), gradient.dot(y));
        // Bending of the sphere itself: positive where moving outward shortens the way.
        let bending = (-gradient.dot(unit)).max(1e-3 * gradient.length());
        let second = |a: DVec3, b: DVec3| {
            let (a, b) = (self.radii * a, self.radii * b);
            legs.iter()
                .map(|(towards, distance)| {
                    (a.dot(b) - a.dot(*towards) * b.dot(*towards)) / distance
                })
                .sum::<f64>()
        };
        let mixed = second(x, y);
        let hessian = DMat2::from_cols(
            DVec2::new(second(x, x) + bending, mixed),
            DVec2::new(mixed, second(y, y) + bending),
        );
        Local {
            length: legs[0].1 + legs[1].1,
            axes,
            gradient: gradient_along,
            hessian,
        }
    }

    /// Newton steps, shortened until the way gets shorter; where rounding no longer tells lengths
    /// apart, until the gradient does.
    fn minimize(&self, start: DVec3) -> DVec3 {
        let mut unit = start;
        let mut here = self.at(unit);
        for _ in 0..200 {
            let step = -(here.hessian.inverse() * here.gradient);
            let descent = here.gradient.dot(step);
            let mut share = (0.7 / step.length()).min(1.0);
            let next = loop {
                let moved = share * step;
                let next = (unit + moved.x * here.axes[0] + moved.y * here.axes[1]).normalize();
                let there = self.at(next);
                let shorter = there.length <= here.length + 1e-4 * share * descent;
                let flatter = there.gradient.length() < here.gradient.length();
                let alike = (there.length - here.length).abs() <= 8.0 * f64::EPSILON * here.length;
                let better = if alike { flatter } else { shorter };
                if better {
                    break Some((next, there));
                }
                share /= 2.0;
                if share < 1e-12 {
                    break None;
                }
            };
            let Some((next, there)) = next else { break };
            (unit, here) = (next, there);
        }
        unit
    }
}

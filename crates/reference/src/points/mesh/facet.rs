//! All points of one triangle that reflect a vertex.
//!
//! A triangle's points and normals are linear in the weights of its corners; a point reflects the vertex
//! where the eye's ray, reflected at the interpolated normal, runs through it (`polynomial`). The triangle
//! is divided until every part is settled. With `F` the polynomial, mixed by the inverse of its derivative in the part's middle
//! so that its derivative `F'` is the unit matrix there:
//!
//! - no zero lies in the part if the coefficients of a value are all of one sign;
//! - if `‖F' − 1‖ ≤ ½` for all coefficients of the derivative, `q − F(q)` at least halves the distance between any two
//!   places of the part. So there is at most one zero, and the iteration, with each place moved back into the part,
//!   ends at it if there is one.
//!
//! So all are found, and what stays undecided at the smallest parts (two points that are about to meet)
//! is counted. Flat triangles have the closed form of a plane.

use glam::{DMat2, DVec2, DVec3};

use super::polynomial::{Linear, Miss, in_the_middle};
use crate::triangles::geometric_normal;

/// A place within so much of a part's edge, as a share of the part, counts as inside: the neighbour may
/// have been settled without it.
const EDGE: f64 = 1e-9;

/// A part of less than this share of its triangle is not divided.
const SMALLEST: f64 = 1e-9;

/// Most parts of one triangle for one vertex; usual are fewer than ten.
const MOST_PARTS: usize = 5_000;

/// Normals that are off a triangle's own by no more than f32's rounding make it flat.
const FLAT: f64 = 1e-6;

/// A triangle with an area.
pub(super) struct Facet {
    pub(super) corners: Linear<DVec3>,
    /// Unit shading normals.
    pub(super) normals: Linear<DVec3>,
    /// Unit normal on the side of the shading normals.
    pub(super) geometric: DVec3,
    /// All shading normals are the triangle's own.
    flat: bool,
}

/// What a triangle answers.
#[derive(Default)]
pub(super) struct Found {
    pub(super) points: Vec<DVec3>,
    pub(super) undecided: u64,
}

/// A part of a triangle: the weights of its corners there.
#[derive(Clone, Copy)]
struct Part([DVec3; 3]);

impl Facet {
    pub(super) fn new(corners: Linear<DVec3>, normals: Linear<DVec3>) -> Option<Self> {
        let facing = geometric_normal(&corners);
        if facing == DVec3::ZERO {
            return None;
        }
        let shading = normals.iter().sum::<DVec3>();
        let geometric = match facing.dot(shading) < 0.0 {
            true => -facing,
            false => facing,
        };
        let is_own = |normal: &DVec3| normal.distance(geometric) < FLAT;
        Some(Self {
            flat: normals.iter().all(is_own),
            corners,
            normals,
            geometric,
        })
    }

    /// Adds the points that reflect `vertex` to `eye`.
    pub(super) fn solve(&self, eye: DVec3, vertex: DVec3, found: &mut Found) {
        if self.flat {
            found.points.extend(self.plane(eye, vertex));
            return;
        }
        let mut parts = vec![Part(DVec3::AXES)];
        let mut looked_at = 0;
        while let Some(part) = parts.pop() {
            looked_at += 1;
            let divide = match self.settle(&part, eye, vertex) {
                Verdict::Nothing => false,
                Verdict::Zero(weights) => {
                    found.points.extend(self.reflecting(weights, eye, vertex));
                    false
                }
                Verdict::Divide => true,
            };
            if divide && (part.size() < SMALLEST || looked_at > MOST_PARTS) {
                found.undecided += 1;
            } else if divide {
                parts.extend(part.quarters());
            }
            if looked_at > MOST_PARTS {
                found.undecided += parts.len() as u64;
                return;
            }
        }
    }

    /// The point where the way to the vertex's mirror image passes, if both are in front.
    fn plane(&self, eye: DVec3, vertex: DVec3) -> Option<DVec3> {
        let [a, b, c] = self.corners;
        let [of_eye, of_vertex] = [eye, vertex].map(|point| (point - a).dot(self.geometric));
        if of_eye <= 0.0 || of_vertex <= 0.0 {
            return None;
        }
        let image = vertex - 2.0 * of_vertex * self.geometric;
        let point = eye + of_eye / (of_eye + of_vertex) * (image - eye);
        let whole = (b - a).cross(c - a);
        let weight = |one: DVec3, other: DVec3| {
            (one - point).cross(other - point).dot(whole) / whole.length_squared()
        };
        let inside = [weight(a, b), weight(b, c), weight(c, a)]
            .iter()
            .all(|weight| *weight >= -EDGE);
        inside.then_some(point)
    }

    /// What is known of a part.
    fn settle(&self, part: &Part, eye: DVec3, vertex: DVec3) -> Verdict {
        let corners = part.mix(&self.corners);
        let d = corners.map(|corner| corner - eye);
        let w = corners.map(|corner| vertex - corner);
        let Some(miss) = Miss::new(&d, &part.mix(&self.normals), &w) else {
            return Verdict::Divide;
        };
        if miss.has_no_zero() {
            return Verdict::Nothing;
        }
        let inverse = in_the_middle(&miss.derivative()).inverse();
        if !inverse.is_finite() {
            return Verdict::Divide;
        }
        let miss = miss.mixed(inverse);
        if miss.has_no_zero() {
            return Verdict::Nothing;
        }
        let off = miss.derivative().map(|derivative| {
            let off = derivative - DMat2::IDENTITY;
            off.x_axis.length_squared() + off.y_axis.length_squared()
        });
        if off.into_iter().fold(0.0, f64::max) > 0.25 {
            return Verdict::Divide;
        }
        match zero(&miss) {
            Some(q) => Verdict::Zero(part.weights(q)),
            None => Verdict::Nothing,
        }
    }

    /// The point with these weights, if eye and vertex see each other in its front.
    fn reflecting(&self, weights: DVec3, eye: DVec3, vertex: DVec3) -> Option<DVec3> {
        let mix = |[a, b, c]: &Linear<DVec3>| weights.x * *a + weights.y * *b + weights.z * *c;
        let (point, normal) = (mix(&self.corners), mix(&self.normals).normalize());
        let d = point - eye;
        let reflected = d - 2.0 * d.dot(normal) * normal;
        // As the tracer has it: the side of the triangle that the shading normal is on.
        let side = self.geometric * self.geometric.dot(normal).signum();
        let in_front = d.dot(side) < 0.0 && reflected.dot(side) > 0.0;
        (in_front && reflected.dot(vertex - point) > 0.0).then_some(point)
    }
}

enum Verdict {
    Nothing,
    /// The only zero: the weights of the triangle's corners.
    Zero(DVec3),
    Divide,
}

/// The zero in the part of a polynomial whose derivative is near the unit matrix on it.
fn zero(miss: &Miss) -> Option<DVec2> {
    /// Each halves what is left.
    const MOST_STEPS: usize = 70;
    let mut q = DVec2::splat(1.0 / 3.0);
    for _ in 0..MOST_STEPS {
        let next = into_triangle(q - miss.at(q));
        let moved = next.distance(q);
        q = next;
        if moved < 4.0 * f64::EPSILON {
            break;
        }
    }
    (miss.at(q).length() <= EDGE.max(4.0 * miss.rounding)).then_some(q)
}

/// The nearest place with weights that are not negative.
fn into_triangle(q: DVec2) -> DVec2 {
    if q.x >= 0.0 && q.y >= 0.0 && q.x + q.y <= 1.0 {
        return q;
    }
    // The nearest point of each edge.
    let edges = [
        (DVec2::ZERO, DVec2::X),
        (DVec2::ZERO, DVec2::Y),
        (DVec2::X, DVec2::Y),
    ];
    let nearest = edges.map(|(from, to)| {
        let along = to - from;
        from + ((q - from).dot(along) / along.length_squared()).clamp(0.0, 1.0) * along
    });
    let by_distance = |one: &DVec2, other: &DVec2| one.distance(q).total_cmp(&other.distance(q));
    nearest.into_iter().min_by(by_distance).unwrap_or(q)
}

impl Part {
    fn mix(&self, corners: &Linear<DVec3>) -> Linear<DVec3> {
        self.0
            .map(|weights| weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2])
    }

    /// Of the place with weights `q` for the second and third corner.
    fn weights(&self, q: DVec2) -> DVec3 {
        (1.0 - q.x - q.y) * self.0[0] + q.x * self.0[1] + q.y * self.0[2]
    }

    /// Share of the triangle's sides.
    fn size(&self) -> f64 {
        (self.0[1] - self.0[0]).abs().max_element()
    }

    fn quarters(&self) -> [Self; 4] {
        let [a, b, c] = self.0;
        let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(Self)
    }
}

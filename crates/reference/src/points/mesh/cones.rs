//! A hierarchy over the triangles of a mirror, for one eye: where it may reflect a vertex.
//!
//! A node knows a ball around its points and a cone around its normals, and from them a cone around the
//! reflected directions of the eye's rays. Over the ball the direction from the eye is within its angular
//! radius of the middle one, and a normal that is off by an angle turns the reflected ray by twice as
//! much; so the triangle inequality on the sphere bounds the reflected rays, and likewise the directions
//! to the vertex. Where the two cones do not meet, no point of the node reflects the vertex.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::facet::Facet;

/// Angles are compared with so much to spare, radians.
const SLACK: f64 = 1e-9;

/// Triangles and their hierarchy.
pub(super) struct Cones {
    nodes: Vec<Node>,
    /// Indices of triangles, in the order of the leaves.
    order: Vec<u32>,
}

struct Node {
    ball: Ball,
    /// Around the normals.
    normals: Cone,
    /// Around the reflected rays; `None` if no ray meets a front here.
    reflected: Option<Cone>,
    kind: Kind,
}

enum Kind {
    /// The two nodes that it is made of.
    Inner([u32; 2]),
    /// A triangle.
    Leaf(u32),
}

#[derive(Clone, Copy)]
struct Ball {
    center: DVec3,
    radius: f64,
}

/// Directions within an angle of an axis; all of them where the angle is π.
#[derive(Clone, Copy)]
struct Cone {
    axis: DVec3,
    angle: f64,
}

impl Ball {
    fn around(facets: &[Facet], triangles: &[u32]) -> Self {
        let corners = || {
            triangles
                .iter()
                .flat_map(|index| facets[*index as usize].corners)
        };
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let center = (low + high) / 2.0;
        let radius = corners()
            .map(|corner| corner.distance(center))
            .fold(0.0, f64::max);
        Self { center, radius }
    }

    /// Directions from a point to all of the ball.
    fn seen_from(&self, point: DVec3) -> Cone {
        let offset = self.center - point;
        let distance = offset.length();
        if distance <= self.radius {
            return Cone {
                axis: DVec3::Z,
                angle: PI,
            };
        }
        Cone {
            axis: offset / distance,
            angle: (self.radius / distance).asin(),
        }
    }
}

impl Cone {
    fn around(normals: [DVec3; 3]) -> Self {
        let axis = normals.iter().sum::<DVec3>().normalize_or_zero();
        let angle = normals
            .map(|normal| normal.angle_between(axis))
            .into_iter()
            .fold(0.0, f64::max);
        // Means of vectors stay in a cone that is less than a half space.
        match axis == DVec3::ZERO || angle.is_nan() || angle > FRAC_PI_2 - SLACK {
            true => Self {
                axis: DVec3::Z,
                angle: PI,
            },
            false => Self { axis, angle },
        }
    }

    fn joined(self, other: Self) -> Self {
        let axis = (self.axis + other.axis).normalize_or_zero();
        let reach = |cone: Self| cone.axis.angle_between(axis) + cone.angle;
        let angle = reach(self).max(reach(other));
        match axis == DVec3::ZERO || angle.is_nan() || angle >= PI {
            true => Self {
                axis: DVec3::Z,
                angle: PI,
            },
            false => Self { axis, angle },
        }
    }

    /// Reflected rays of the eye over a ball with normals in `normals`; `None` if all normals point
    /// away from the eye.
    fn reflected(eye: DVec3, ball: &Ball, normals: &Self) -> Option<Self> {
        let view = ball.seen_from(eye);
        if view.axis.angle_between(-normals.axis) > FRAC_PI_2 + view.angle + normals.angle + SLACK {
            return None;
        }
        let angle = view.angle + 2.0 * normals.angle;
        let axis = view.axis - 2.0 * view.axis.dot(normals.axis) * normals.axis;
        Some(Self {
            axis,
            angle: angle.min(PI),
        })
    }

    fn meets(&self, other: &Self) -> bool {
        let angle = self.angle + other.angle + SLACK;
        angle >= PI || self.axis.dot(other.axis) >= angle.cos()
    }
}

impl Cones {
    /// Builds the hierarchy over triangles that have an area.
    pub(super) fn new(facets: &[Facet], eye: DVec3) -> Self {
        let mut cones = Self {
            nodes: Vec::with_capacity(2 * facets.len()),
            order: (0..facets.len() as u32).collect(),
        };
        let mut order = std::mem::take(&mut cones.order);
        if !order.is_empty() {
            cones.build(facets, eye, &mut order);
        }
        cones.order = order;
        cones
    }

    /// A node over these triangles, and all below it: halves along the longest side of their middles.
    fn build(&mut self, facets: &[Facet], eye: DVec3, triangles: &mut [u32]) -> u32 {
        let ball = Ball::around(facets, triangles);
        let (normals, kind) = if let [triangle] = triangles {
            let normals = Cone::around(facets[*triangle as usize].normals);
            (normals, Kind::Leaf(*triangle))
        } else {
            let middle = |index: &u32| facets[*index as usize].corners.iter().sum::<DVec3>();
            let low = triangles
                .iter()
                .map(middle)
                .fold(DVec3::INFINITY, DVec3::min);
            let high = triangles
                .iter()
                .map(middle)
                .fold(DVec3::NEG_INFINITY, DVec3::max);
            let axis = (high - low).max_position();
            let half = triangles.len() / 2;
            triangles.select_nth_unstable_by(half, |one, other| {
                middle(one)[axis].total_cmp(&middle(other)[axis])
            });
            let (first, second) = triangles.split_at_mut(half);
            let children = [
                self.build(facets, eye, first),
                self.build(facets, eye, second),
            ];
            let [one, other] = children.map(|child| self.nodes[child as usize].normals);
            (one.joined(other), Kind::Inner(children))
        };
        let reflected = Cone::reflected(eye, &ball, &normals);
        self.nodes.push(Node {
            ball,
            normals,
            reflected,
            kind,
        });
        self.nodes.len() as u32 - 1
    }

    /// Calls `meet` with each triangle that may reflect the vertex.
    pub(super) fn candidates(&self, vertex: DVec3, mut meet: impl FnMut(u32)) {
        let Some(top) = self.nodes.len().checked_sub(1) else {
            return;
        };
        let mut open = vec![top as u32];
        while let Some(index) = open.pop() {
            let node = &self.nodes[index as usize];
            let Some(reflected) = &node.reflected else {
                continue;
            };
            let mut to_vertex = node.ball.seen_from(vertex);
            to_vertex.axis = -to_vertex.axis;
            if !reflected.meets(&to_vertex) {
                continue;
            }
            match node.kind {
                Kind::Inner(children) => open.extend(children),
                Kind::Leaf(triangle) => meet(triangle),
            }
        }
    }
}

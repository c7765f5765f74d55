//! Mirrors: exact surfaces in f64, and the triangle proxies they are drawn from.

use glam::{DMat3, DVec2, DVec3};

use crate::mesh::Mesh;

/// A named mirror.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Unique within the scene.
    pub name: String,
    /// The reflecting surface, world space.
    pub shape: Shape,
    /// Segments around the proxy, half as many rings. Unused for meshes.
    pub tessellation: u32,
    /// World-space centres of the cube maps that a technique may trace its reflections in, the most
    /// useful first; mostly empty.
    pub cubemaps: Vec<DVec3>,
}

/// A reflecting surface in world space. Each has a reflecting side; the other is opaque black.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Reflects on its outside.
    Sphere {
        /// Centre.
        center: DVec3,
        /// Radius, positive.
        radius: f64,
    },
    /// Reflects on its outside: the points `center + rotation · p` with `|p / radii| = 1`.
    Ellipsoid {
        /// Centre.
        center: DVec3,
        /// Half axes before the rotation, positive.
        radii: DVec3,
        /// World from ellipsoid axes.
        rotation: DMat3,
    },
    /// A rectangle that reflects on the side its normal points to.
    Plane {
        /// Centre of the rectangle.
        center: DVec3,
        /// Unit normal of the reflecting side.
        normal: DVec3,
        /// Unit, in the plane: the direction of `size.y`.
        up: DVec3,
        /// Full width (along `up × normal`) and height (along `up`).
        size: DVec2,
    },
    /// A spherical cap whose inside reflects: the points of a sphere within `half_angle` of
    /// `axis`, seen from the centre.
    Bowl {
        /// Centre of the sphere.
        center: DVec3,
        /// Radius of the sphere.
        radius: f64,
        /// Unit, from the sphere's centre to the middle of the cap.
        axis: DVec3,
        /// Radians, in (0, π).
        half_angle: f64,
    },
    /// Reflects on its outside: the points `minor` away from a circle.
    Torus {
        /// Centre of the circle.
        center: DVec3,
        /// Unit, perpendicular to the circle.
        axis: DVec3,
        /// Radius of the circle.
        major: f64,
        /// Radius of the tube, positive and smaller than `major`.
        minor: f64,
    },
    /// The points `center + x · right + y · up + z · normal` over a rectangle, with
    /// `right = up × normal` and `z = (curvature.x · x² + curvature.y · y²)/2`, reflecting on the
    /// side its normals point to.
    Saddle {
        /// Middle of the patch.
        center: DVec3,
        /// Unit normal in the middle, on the reflecting side.
        normal: DVec3,
        /// Unit, perpendicular to `normal`.
        up: DVec3,
        /// Full extent along `right` and `up`.
        size: DVec2,
        /// Curvatures in the middle along `right` and `up`, of opposite signs; positive ones bend
        /// towards the reflecting side.
        curvature: DVec2,
    },
    /// Triangles with shading normals (never empty), reflecting where the normals point.
    Mesh(Mesh),
}

/// Where a ray meets an analytic mirror.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit {
    /// Distance along the (unit) ray.
    pub t: f64,
    /// World-space point.
    pub position: DVec3,
    /// Unit normal of the reflecting side.
    pub normal: DVec3,
}

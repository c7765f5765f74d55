//! The eye: a pinhole camera, and the mapping between world space and the image.

use glam::{DVec2, DVec3};

/// A pinhole camera as written in a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Eye position, world space.
    pub eye: DVec3,
    /// A point on the optical axis, world space.
    pub target: DVec3,
    /// Roughly up, world space; not parallel to the optical axis.
    pub up: DVec3,
    /// Field of view.
    pub fov: Fov,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
}

/// A field of view: the full angle, in degrees, across the named image axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fov {
    /// Horizontal.
    X(f64),
    /// Vertical.
    Y(f64),
}

impl Camera {
    /// The camera's frame for an image of `size` (width, height) pixels. Pixels are square.
    pub fn view(&self, size: [u32; 2]) -> View {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(self.up).normalize();
        let up = right.cross(forward);
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let tan = match self.fov {
            Fov::X(degrees) => {
                let x = (degrees.to_radians() / 2.0).tan();
                DVec2::new(x, x / aspect)
            }
            Fov::Y(degrees) => {
                let y = (degrees.to_radians() / 2.0).tan();
                DVec2::new(y * aspect, y)
            }
        };
        View {
            eye: self.eye,
            right,
            up,
            forward,
            tan,
            size,
        }
    }
}

/// A camera resolved for an image size: an orthonormal frame and the tangents of the half angles.
///
/// Image coordinates: x to the right, y down, in pixels; pixel `(i, j)` covers
/// `[i, i+1] × [j, j+1]`, its centre is at `(i + ½, j + ½)`.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Eye position, world space.
    pub eye: DVec3,
    /// Image right, unit, world space.
    pub right: DVec3,
    /// Image up, unit, world space.
    pub up: DVec3,
    /// Optical axis, unit, world space.
    pub forward: DVec3,
    /// Tangents of half the horizontal and vertical field of view.
    pub tan: DVec2,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl View {
    /// Unit world-space direction of the eye ray through image coordinates `at`.
    pub fn ray(&self, at: DVec2) -> DVec3 {
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let ndc = (2.0 * at / size - 1.0) * self.tan;
        (self.forward + ndc.x * self.right - ndc.y * self.up).normalize()
    }

    /// Image coordinates of a world-space point, and its depth along the optical axis.
    /// `None` at or behind the eye's plane.
    pub fn project(&self, point: DVec3) -> Option<(DVec2, f64)> {
        let offset = point - self.eye;
        let depth = offset.dot(self.forward);
        if depth <= 0.0 {
            return None;
        }
        let ndc = DVec2::new(offset.dot(self.right), -offset.dot(self.up)) / (depth * self.tan);
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        Some(((ndc + 1.0) * size / 2.0, depth))
    }

    /// True where image coordinates lie inside the image.
    pub fn contains(&self, at: DVec2) -> bool {
        at.x >= 0.0
            && at.y >= 0.0
            && at.x < f64::from(self.size[0])
            && at.y < f64::from(self.size[1])
    }
}

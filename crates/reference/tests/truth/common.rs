//! Scenes by hand and numbers by seed, for the tests of this crate.

use std::f64::consts::PI;

pub use catoptric_scene::Random;
use catoptric_scene::shape::{Bowl, Ellipsoid, Sphere};
use catoptric_scene::{
    Background, Camera, Fov, Material, Mesh, Mirror, Object, Paint, Scene, Shape,
};
use glam::{DMat3, DVec2, DVec3, Vec3};

/// Random geometry.
pub trait Draw {
    fn log_between(&mut self, low: f64, high: f64) -> f64;
    fn direction(&mut self) -> DVec3;
    fn pixel(&mut self, size: [u32; 2]) -> DVec2;
    fn rotation(&mut self) -> DMat3;
}

impl Draw for Random {
    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let around = self.between(0.0, 2.0 * PI);
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * around.cos(), r * around.sin(), z)
    }

    fn pixel(&mut self, size: [u32; 2]) -> DVec2 {
        DVec2::new(
            self.between(0.0, f64::from(size[0])),
            self.between(0.0, f64::from(size[1])),
        )
    }

    fn rotation(&mut self) -> DMat3 {
        DMat3::from_axis_angle(self.direction(), self.between(0.0, 2.0 * PI))
    }
}

pub fn camera(eye: [f64; 3], fov_y: f64, resolution: [u32; 2]) -> Camera {
    Camera {
        eye: DVec3::from_array(eye),
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov: Fov::Y(fov_y),
        resolution,
    }
}

pub fn scene(camera: Camera, objects: Vec<Object>, mirrors: Vec<Shape>) -> Scene {
    let mirror = |(index, shape)| Mirror {
        name: format!("mirror {index}"),
        shape,
        tessellation: 64,
        cubemaps: Vec::new(),
        proxies: Vec::new(),
        pose: catoptric_scene::Pose::REST,
    };
    Scene {
        name: "test".into(),
        why: "test".into(),
        camera,
        background: Background::Color(Vec3::new(0.1, 0.2, 0.3)),
        objects,
        mirrors: mirrors.into_iter().enumerate().map(mirror).collect(),
        motion: None,
        hash: String::new(),
        warnings: Vec::new(),
    }
}

/// An object of one colour.
pub fn object(name: &str, positions: Vec<Vec3>, triangles: Vec<[u32; 3]>, color: Vec3) -> Object {
    let material = vec![0; triangles.len()];
    let materials = vec![Material {
        name: name.into(),
        paint: Paint::Color(color),
    }];
    let mesh = Mesh {
        positions,
        triangles,
        material,
        materials,
        ..Mesh::default()
    };
    Object {
        name: name.into(),
        mesh,
    }
}

/// A parallelogram from a corner and two edges.
pub fn quad(name: &str, corner: Vec3, u: Vec3, v: Vec3, color: Vec3) -> Object {
    let positions = vec![corner, corner + u, corner + u + v, corner + v];
    object(name, positions, vec![[0, 1, 2], [0, 2, 3]], color)
}

pub fn unit_sphere() -> Shape {
    Shape::Sphere(Sphere {
        center: DVec3::ZERO,
        radius: 1.0,
    })
}

pub fn prototype_ellipsoid() -> Shape {
    Shape::Ellipsoid(Ellipsoid {
        center: DVec3::ZERO,
        radii: DVec3::new(1.5, 0.7, 1.0),
        rotation: DMat3::IDENTITY,
    })
}

/// z < −0.75 of a sphere of radius 1.5 around the origin.
pub fn prototype_bowl() -> Shape {
    Shape::Bowl(Bowl {
        center: DVec3::ZERO,
        radius: 1.5,
        axis: DVec3::NEG_Z,
        half_angle: PI / 3.0,
    })
}

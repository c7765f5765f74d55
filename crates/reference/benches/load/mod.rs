//! What the benchmarks trace: two scenes, and the rays of a picture of each.

use std::f64::consts::PI;
use std::path::PathBuf;

use catoptric_reference::{Tracer, Truth};
use catoptric_scene::shape::Sphere;
use catoptric_scene::{
    Background, Camera, Fov, LoadOptions, Material, Mesh, Mirror, Object, Paint, Scene, Shape,
};
use glam::{DVec2, DVec3, Vec3};

/// 99 200 triangles in 25 balls around a mirror ball; only open air is behind them.
pub fn balls() -> Scene {
    let objects = (0..25).map(|index| {
        let around = 2.0 * PI * f64::from(index) / 25.0;
        let height = f64::from(index % 5) - 2.0;
        let center = DVec3::new(2.6 * around.cos(), height, 2.6 * around.sin());
        let Mesh {
            positions,
            triangles,
            ..
        } = Shape::Sphere(Sphere {
            center,
            radius: 0.45,
        })
        .tessellate(64);
        let name = format!("ball {index}");
        let materials = vec![Material {
            name: name.clone(),
            paint: Paint::Color(Vec3::ONE),
        }];
        let material = vec![0; triangles.len()];
        Object {
            name,
            mesh: Mesh {
                positions,
                triangles,
                material,
                materials,
                ..Mesh::default()
            },
        }
    });
    let shape = Shape::Sphere(Sphere {
        center: DVec3::ZERO,
        radius: 1.5,
    });
    Scene {
        name: "balls".into(),
        why: "A load for benchmarks.".into(),
        camera: Camera {
            eye: DVec3::new(0.6, 1.5, 7.0),
            target: DVec3::ZERO,
            up: DVec3::Y,
            fov: Fov::Y(40.0),
            resolution: [640, 480],
        },
        background: Background::Color(Vec3::ZERO),
        objects: objects.collect(),
        mirrors: vec![Mirror {
            name: "mirror".into(),
            shape,
            tessellation: 64,
            cubemaps: Vec::new(),
            proxies: Vec::new(),
            pose: catoptric_scene::Pose::REST,
        }],
        motion: None,
        hash: String::new(),
        warnings: Vec::new(),
    }
}

/// The atrium of the built-in scene `sponza-ball`, without what else stands in it, along its axis
/// and in a larger ball; where the folder that `CATOPTRIC_MODELS` names has its model.
pub fn sponza() -> Option<Scene> {
    let options = LoadOptions {
        models: std::env::var_os("CATOPTRIC_MODELS").map(PathBuf::from),
        resolution: Some([640, 480]),
    };
    let mut scene = catoptric_scene::open("sponza-ball", &options)
        .inspect_err(|error| eprintln!("left out: {error}"))
        .ok()?;
    scene.objects.truncate(1);
    scene.camera.eye = DVec3::new(-11.0, 2.0, 0.0);
    scene.camera.target = DVec3::new(5.0, 4.0, 0.0);
    scene.camera.fov = Fov::X(70.0);
    scene.mirrors[0].shape = Shape::Sphere(Sphere {
        center: DVec3::new(-7.4, 2.1, 0.3),
        radius: 1.5,
    });
    Some(scene)
}

/// Origin and unit direction.
pub type Ray = (DVec3, DVec3);

/// The rays of a picture: of the eye through all pixel centres, row by row, and those that the
/// mirrors send on.
pub struct Rays {
    /// From the eye.
    pub primary: Vec<Ray>,
    /// From the mirrors.
    pub reflected: Vec<Ray>,
}

impl Rays {
    /// The rays of a picture of `size` pixels.
    pub fn new(tracer: &Tracer, size: [u32; 2]) -> Self {
        let view = tracer.scene().camera.view(size);
        let (mut primary, mut reflected) = (Vec::new(), Vec::new());
        for y in 0..size[1] {
            for x in 0..size[0] {
                let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                let trace = tracer.reflect_pixel(&view, at, Truth::FirstBounce);
                primary.push((view.eye, trace.direction));
                if let (Some(hit), Some(reflection)) = (trace.primary, trace.reflection)
                    && reflection.direction != DVec3::ZERO
                {
                    reflected.push((hit.position, reflection.direction));
                }
            }
        }
        Self { primary, reflected }
    }
}

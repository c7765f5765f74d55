//! What our tracer sees of a scene.

use catoptric_frame::{Frame, Image, Primary, Reflected};
use catoptric_reference::{RayStart, RenderOptions, Tracer, Truth};
use catoptric_scene::Scene;
use glam::{DVec2, Vec3};

/// What our tracer sees.
pub struct Ours {
    pub(super) color: Image<Vec3>,
    pub(super) primary: Primary,
    pub(super) reflected: Reflected,
    /// Unit directions of the first reflected rays, 0 where there are none.
    pub(super) direction: Image<Vec3>,
    pub(super) start: RayStart,
    pub(super) side: u32,
}

impl Ours {
    /// Traces a scene; colour is the mean of `side` × `side` rays a pixel.
    pub fn trace(
        scene: &Scene,
        size: [u32; 2],
        truth: Truth,
        start: RayStart,
        side: u32,
    ) -> anyhow::Result<Self> {
        let tracer = Tracer::new(scene)?.with_ray_start(start);
        let Frame {
            color,
            primary: Some(primary),
            reflected: Some(reflected),
            ..
        } = tracer.render(&RenderOptions {
            samples: side,
            ..RenderOptions::new(size, truth)
        })
        else {
            unreachable!("the tracer fills all layers");
        };
        let view = scene.camera.view(size);
        let [width, height] = size;
        let mut direction = Image::filled(size, Vec3::ZERO);
        for y in 0..height {
            for x in 0..width {
                let at = DVec2::new(f64::from(x), f64::from(y)) + 0.5;
                let pixel = tracer.reflect_pixel(&view, at, Truth::FirstBounce);
                if let Some(reflection) = pixel.reflection {
                    *direction.at_mut(x, y) = reflection.direction.as_vec3();
                }
            }
        }
        Ok(Self {
            color,
            primary,
            reflected,
            direction,
            start,
            side,
        })
    }
}

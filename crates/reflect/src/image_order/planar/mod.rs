//! Flat mirrors: the scene once more, seen by the eye mirrored at the mirror's plane.
//!
//! The mirrored eye keeps the image axes mirrored as well, so that each point falls on the pixel
//! where its mirror image is seen, without a change of handedness afterwards.

use catoptric_frame::Work;
use catoptric_scene::{Scene, View};
use glam::DVec3;

use super::{ImageOrder, Recipe, draw_reflections};
use crate::error::ReflectError;
use crate::gpu::{
    Begin, Gpu, RasterTargets, Recorder, group, module, raster, set_uniform, uniform,
};
use crate::options::options;
use crate::stage::Stage;
use crate::stage::variant::Variant;
use crate::stage::view::ViewUniform;
use crate::technique::{Info, Named};

options! {
    /// The technique; it has no options of its own.
    pub(crate) struct Planar {}
}

impl Named for Planar {
    const INFO: Info = Info {
        name: "planar",
        what: "the scene from the mirrored eye, flat mirrors only",
        paper: "baseline",
    };
}

impl Recipe for Planar {
    /// There is no mirrored eye for a mirror that is not flat.
    fn objection(&self, scene: &Scene) -> Option<String> {
        let mut mirrors = scene.mirrors.iter();
        let curved = mirrors.find(|mirror| mirror.shape.flat().is_none());
        curved.map(|mirror| format!("mirror `{}` is not a plane", mirror.name))
    }

    fn make(&self, gpu: &Gpu, stage: &Stage) -> Result<Box<dyn ImageOrder>, ReflectError> {
        let world = &stage.world;
        let module = module(gpu, "planar", &[])?;
        let layouts = [
            Some(&world.view_layout),
            Some(&stage.gbuffer.mirror_layout),
            Some(&world.surface_layout),
        ];
        let pipeline = |entry, colors| {
            let targets = RasterTargets {
                colors,
                depth: true,
            };
            raster(gpu, &module, entry, targets, &layouts, &[])
        };
        let views = mirrored_views(stage).map(|view| {
            let buffer = uniform(gpu, &view);
            let group = group(gpu, &world.view_layout, &[buffer.as_entire_binding()]);
            (buffer, group)
        });
        Ok(Box::new(Mirrored {
            color: pipeline("color", 1),
            layers: pipeline("layers", 2),
            views: views.collect(),
        }))
    }
}

/// The technique, ready for a scene.
struct Mirrored {
    color: wgpu::RenderPipeline,
    layers: wgpu::RenderPipeline,
    /// View uniform of each mirror's mirrored eye, and the group that holds it.
    views: Vec<(wgpu::Buffer, wgpu::BindGroup)>,
}

fn mirrored_views(stage: &Stage) -> impl Iterator<Item = ViewUniform> {
    let scene = &stage.world.scene;
    let view = scene.camera.view(stage.world.size);
    scene.mirrors.iter().map(move |mirror| {
        let flat = mirror.shape.flat();
        let (center, normal) = flat.expect("curved mirrors are objected to");
        ViewUniform::from_view(scene, &mirrored(&view, center, normal))
    })
}

/// `view` mirrored at the plane through `point` with unit `normal`.
fn mirrored(view: &View, point: DVec3, normal: DVec3) -> View {
    let direction = |d: DVec3| d - 2.0 * d.dot(normal) * normal;
    View {
        eye: point + direction(view.eye - point),
        right: direction(view.right),
        up: direction(view.up),
        forward: direction(view.forward),
        ..*view
    }
}

impl ImageOrder for Mirrored {
    fn update(&mut self, gpu: &Gpu, stage: &Stage) -> Result<(), ReflectError> {
        for ((buffer, _), view) in self.views.iter().zip(mirrored_views(stage)) {
            set_uniform(gpu, buffer, &view);
        }
        Ok(())
    }

    fn record(&self, frame: &mut Recorder<'_>, stage: &Stage, variant: Variant) {
        let mut begin = Begin::Clear;
        for ((_, view), mirror) in self.views.iter().zip(&stage.gbuffer.mirror_groups) {
            let depth = Some(&stage.reflections.depth);
            draw_reflections(frame, "mirrored", stage, variant, begin, depth, |pass| {
                pass.set_pipeline(match variant {
                    Variant::AllLayers => &self.layers,
                    Variant::Color => &self.color,
                });
                pass.set_bind_group(0, view, &[]);
                pass.set_bind_group(1, mirror, &[]);
                pass.set_bind_group(2, &stage.world.surface_group, &[]);
                pass.draw(0..stage.world.corners, 0..1);
            });
            begin = Begin::Keep;
        }
    }

    fn work(&self, _: &Gpu, _: &Stage) -> Work {
        Work::default()
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Camera, Fov};
    use glam::DVec2;

    use super::*;

    /// Rounding of f64 in image coordinates of a few hundred pixels.
    const PIXELS: f64 = 1e-9;

    #[test]
    fn a_point_falls_where_its_mirror_image_is_seen() {
        let camera = Camera {
            eye: DVec3::new(0.4, 1.3, 4.0),
            target: DVec3::new(0.1, -0.2, 0.0),
            up: DVec3::Y,
            fov: Fov::Y(40.0),
            resolution: [320, 240],
        };
        let (point, normal) = (DVec3::new(0.2, 0.1, -1.0), DVec3::new(0.1, 0.3, 1.0));
        let normal = normal.normalize();
        let view = camera.view(camera.resolution);
        let mirrored = mirrored(&view, point, normal);
        let object = DVec3::new(0.7, 0.3, 0.5);
        let image = object - 2.0 * (object - point).dot(normal) * normal;
        let at = |view: &View, point| -> DVec2 { view.project(point).expect("before the eye").0 };
        assert!(at(&mirrored, object).distance(at(&view, image)) < PIXELS);
        assert!(at(&mirrored, object).distance(at(&view, object)) > 1.0);
    }
}
